#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/idle_efforts.hpp"
#include "analysis/loci.hpp"
#include "analysis/model.hpp"
#include "analysis/pose.hpp"
#include "clearloci/sketch.hpp"
#include "core/errors.hpp"
#include "numeric/reactions.hpp"
#include "numeric/sketch.hpp"

namespace clearloci {
namespace {

/// The reachable pose of a grid, off the box's symmetries, that is nearest to its middle.
std::optional<std::vector<double>> middle_pose_in_space(const mechanism::Mechanism& mechanism, const DyadSides& sides) {
  constexpr int steps = 9;
  const numeric::NumericModel model = numeric::compile(with_idle_efforts(mechanism));
  const std::size_t n = mechanism.coordinates.size();
  std::optional<std::vector<double>> best;
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<int> index(n, 0);
  while (true) {
    std::vector<double> pose;
    double away = 0;
    for (std::size_t c = 0; c < n; ++c) {
      const double lower = core::to_double(mechanism.coordinates[c].lower);
      const double upper = core::to_double(mechanism.coordinates[c].upper);
      const double part = (index[c] + 0.46) / steps;
      pose.push_back(lower + (upper - lower) * part);
      away = std::max(away, std::abs(part - 0.5));
    }
    if (away < nearest) {
      const numeric::Posture posture = numeric::posture(model, pose, sides);
      if (posture.reachable() && std::isfinite(numeric::solve_reactions(model, posture).condition)) {
        nearest = away;
        best = std::move(pose);
      }
    }
    std::size_t c = 0;
    while (c < n && ++index[c] == steps) index[c++] = 0;
    if (c == n) return best;
  }
}

}  // namespace

Sketch sketch_pose(const Model& model, const std::vector<double>& at, const DyadSides& working_mode) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  if (mechanism.space == mechanism::Space::spatial)
    throw core::InputError({mechanism.file}, "a spatial mechanism is not sketched in the plane",
                           "draw the points of its pose");
  const DyadSides sides = sides_of(mechanism, working_mode);
  require_values(mechanism, at.size());
  const numeric::NumericModel compiled = numeric::compile(with_idle_efforts(mechanism));
  if (const auto point = numeric::posture(compiled, at, sides).unreachable)
    throw core::InputError(
        {mechanism.file},
        "the pose is out of reach: " + mechanism.points[static_cast<std::size_t>(*point)].name + " cannot be placed",
        "choose another pose");
  return numeric::sketch(compiled, at, sides);
}

std::optional<std::vector<double>> sample_pose(const Model& model, const DyadSides& working_mode) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  const DyadSides sides = sides_of(mechanism, working_mode);
  if (mechanism.space == mechanism::Space::spatial) return middle_pose_in_space(mechanism, sides);
  const numeric::NumericModel compiled = numeric::compile(with_idle_efforts(mechanism));
  return numeric::sample_pose(compiled, sides, compiled.box);
}

bool pose_is_place(const Model& model) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  return mechanism.space == mechanism::Space::planar && pose_is_place_of_end_effector(mechanism);
}

bool pose_is_place_of_end_effector(const mechanism::Mechanism& mechanism) {
  const auto index = static_cast<std::size_t>(mechanism.end_effector_point);
  const auto* const place = std::get_if<mechanism::ExplicitPoint>(&mechanism.points[index].form);
  if (place == nullptr || mechanism.coordinates.size() != 2) return false;
  for (std::size_t i = 0; i < 2; ++i) {
    const core::Expression& expression = place->coordinates[i];
    if (expression.kind() != core::Expression::Kind::symbol || expression.name() != mechanism.coordinates[i].name)
      return false;
  }
  return true;
}

std::vector<core::ModeSketch> sample_sketches(const mechanism::Mechanism& mechanism, const core::LocusMap& map) {
  const bool beside = mechanism.space == mechanism::Space::spatial || !pose_is_place_of_end_effector(mechanism);
  const numeric::NumericModel model = numeric::compile(with_idle_efforts(mechanism));
  std::vector<core::ModeSketch> sketches;
  std::vector<core::WorkingMode> modes;
  const auto add = [&](const core::WorkingMode& mode) {
    if (std::find(modes.begin(), modes.end(), mode) == modes.end()) modes.push_back(mode);
  };
  for (const core::WorkspaceRegion& region : map.workspace) add(region.mode);
  for (const core::ReachableInterval& interval : map.reachable) add(interval.mode);
  for (const core::LocusSurface& surface : map.surfaces) add(surface.mode);
  for (const core::SpaceCurve& curve : map.space_curves) add(curve.mode);
  for (const core::WorkingMode& mode : modes) {
    const std::vector<int> sides = numeric::dyad_signs(model, map.tower, mode);
    if (const std::optional<std::vector<double>> pose = numeric::sample_pose(model, sides, model.box))
      sketches.push_back({mode, numeric::sketch(model, *pose, sides), beside});
  }
  return sketches;
}

}  // namespace clearloci
