#include "numeric/error_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "mechanism/posture_sample.hpp"
#include "numeric/pose_batch.hpp"
#include "numeric/reactions.hpp"

namespace clearloci::numeric {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Of every pose whether the teeth push and no span is slack; empty without gears and belts.
std::vector<bool> within_efforts(const NumericModel& model, std::span<const double> poses, std::span<const int> mode) {
  const auto& joints = model.mechanism.joints;
  std::vector<bool> within;
  if (std::none_of(joints.begin(), joints.end(), [](const auto& joint) { return joint.meshing.has_value(); }))
    return within;
  ReactionField field;
  reaction_field(model, poses, mode, field);
  for (std::size_t i = 0; i < field.poses; ++i) within.push_back(field.reachable(i));
  return within;
}

/// Beside what |A| usually is: far above its rounding, and rare.
constexpr double small_determinant = 1e-7;

/// Whether |A| is zero within rounding, also that of the middle of a cell.
bool is_singular(const NumericModel& model, std::span<const double> pose, std::span<const int> mode) {
  std::vector<Bounded> at;
  for (std::size_t c = 0; c < pose.size(); ++c) {
    const double extent = std::max({std::abs(model.box[c][0]), std::abs(model.box[c][1]), std::abs(pose[c])});
    at.emplace_back(pose[c], 2 * unit_roundoff * extent);
  }
  const Bounded determinant = bounded_numerators(model, at, mode).determinant;
  return !(std::abs(determinant.value) > determinant.error);
}

}  // namespace

double usual_determinant(const NumericModel& model, std::span<const int> mode) {
  PoseBatch batch(model, mode);
  double largest = 0;
  const std::vector<std::vector<double>> poses = mechanism::spread_poses(model.mechanism, 8 * PoseBatch::lanes);
  for (std::size_t first = 0; first < poses.size(); first += PoseBatch::lanes) {
    for (int l = 0; l < PoseBatch::lanes; ++l)
      for (std::size_t c = 0; c < model.box.size(); ++c)
        batch.input(c, l) = poses[first + static_cast<std::size_t>(l)][c];
    batch.run_tape();
    batch.find_influence();
    for (int l = 0; l < PoseBatch::lanes; ++l)
      if (batch.reachable(l) && std::isfinite(batch.determinant(l)))
        largest = std::max(largest, std::abs(batch.determinant(l)));
  }
  return largest > 0 ? largest : std::numeric_limits<double>::infinity();
}

ErrorSamples error_samples(const NumericModel& model, std::span<const double> poses, std::span<const int> mode,
                           bool under_load, bool worst_case, double worst_case_accuracy, double usual) {
  const std::size_t coordinates = model.box.size();
  core::ensure(coordinates > 0 && poses.size() % coordinates == 0, "a pose has one value for each free coordinate");
  const std::size_t count = poses.size() / coordinates;
  const Vector3d none = Vector3d::Constant(nan);
  ErrorSamples samples;
  samples.error.assign(under_load ? count : 0, {none, none});
  samples.worst.assign(worst_case ? count : 0, {none, none, nan, nan});
  samples.reachable.assign(count, false);
  const std::vector<bool> within = within_efforts(model, poses, mode);
  PoseBatch batch(model, mode);
  constexpr int lanes = PoseBatch::lanes;
  for (std::size_t first = 0; first < count; first += lanes) {
    const int used = static_cast<int>(std::min<std::size_t>(lanes, count - first));
    for (int l = 0; l < lanes; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(std::min(l, used - 1));
      for (std::size_t c = 0; c < coordinates; ++c) batch.input(c, l) = poses[pose * coordinates + c];
    }
    batch.run_tape();
    bool any = false;
    for (int l = 0; l < used; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(l);
      const bool here = batch.reachable(l) && (within.empty() || within[pose]);
      samples.reachable[pose] = here;
      any = any || here;
    }
    if (!any) continue;
    batch.find_influence();
    if (under_load) batch.find_errors_under_load();
    if (worst_case) batch.find_reaches();
    for (int l = 0; l < used; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(l);
      if (!samples.reachable[pose]) continue;
      if (!(std::abs(batch.determinant(l)) > small_determinant * usual) &&
          is_singular(model, poses.subspan(pose * coordinates, coordinates), mode))
        continue;
      if (under_load) samples.error[pose] = batch.error(l);
      if (worst_case) samples.worst[pose] = batch.worst(l, worst_case_accuracy);
    }
  }
  return samples;
}

}  // namespace clearloci::numeric
