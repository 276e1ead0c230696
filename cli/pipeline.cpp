#include "cli/pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "core/angle_chart.hpp"
#include "core/errors.hpp"
#include "loci/chart_maps.hpp"
#include "loci/surfaces.hpp"
#include "mechanism/guide.hpp"
#include "numeric/sketch.hpp"

namespace clearloci {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<core::WorkingMode> modes_to_trace(const mechanism::Mechanism& mechanism, const LociRequest& request,
                                              const core::RootTower& tower) {
  if (request.all_working_modes)
    return core::all_working_modes(tower, mode_of(mechanism::working_mode(mechanism), tower));
  if (request.working_modes.empty()) return {mode_of(mechanism::working_mode(mechanism), tower)};
  std::vector<core::WorkingMode> modes;
  for (const DyadSides& sides : request.working_modes) modes.push_back(mode_of(sides, tower));
  return modes;
}

/// Two to the power of the dyads are soon more than anyone looks at, and than there is memory for.
void check_mode_count(std::size_t dyads) {
  constexpr std::size_t most = 12;
  if (dyads > most)
    throw core::InputError({.file = "--working-mode"},
                           fmt::format("all working modes of {} dyads are more than {}", dyads, 1U << most),
                           "name one at a time");
}

void check_sides(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  const std::size_t dyads = mechanism::dyad_points(mechanism).size();
  if (request.all_working_modes) check_mode_count(dyads);
  for (const DyadSides& sides : request.working_modes)
    if (sides.size() != dyads || std::any_of(sides.begin(), sides.end(), [](int s) { return s != 1 && s != -1; }))
      throw core::InputError({}, "a working mode needs a side for each of the " + std::to_string(dyads) + " dyads",
                             "give +1 (left) or -1 (right) for each");
}

/// The maps of a coordinate's pieces as one: a length is one piece, an angle one a half turn (core/angle_chart.hpp).
core::LocusMap join_charts(const mechanism::Mechanism& mechanism, const std::vector<symbolic::DerivedProblem>& charts,
                           const std::vector<core::LocusMap>& maps) {
  constexpr double same_angle = 1e-12;  // rad: two charts round the angle at which they meet differently
  core::LocusMap joined = maps.front();
  joined.isolated_points.clear();
  joined.reachable.clear();
  const mechanism::Coordinate& coordinate = mechanism.coordinates.front();
  joined.tower.coordinates = {coordinate.name};
  joined.lower = {coordinate.lower};
  joined.upper = {coordinate.upper};
  if (coordinate.angle) joined.angles = {true};
  for (const core::WorkingMode& mode : charts.front().problem.modes) {
    std::vector<core::IsolatedPoint> points;
    std::vector<core::ReachableInterval> reachable;
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const auto& chart = charts[i].problem.charts;
      const auto value = [&](double t) {
        return chart.empty() || !chart.front() ? t : core::angle_at(*chart.front(), t);
      };
      const std::size_t before = points.size();
      for (core::IsolatedPoint point : maps[i].isolated_points) {
        if (point.mode != mode) continue;
        point.at[0] = value(point.at[0]);
        const bool known = std::any_of(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(before),
                                       [&](const core::IsolatedPoint& other) {
                                         return other.kind == point.kind && other.vanishing == point.vanishing &&
                                                std::abs(other.at[0] - point.at[0]) < same_angle;
                                       });
        if (!known) points.push_back(std::move(point));
      }
      for (core::ReachableInterval interval : maps[i].reachable) {
        if (interval.mode != mode) continue;
        interval.from = value(interval.from);
        interval.to = value(interval.to);
        if (i > 0 && !reachable.empty() && std::abs(reachable.back().to - interval.from) < same_angle)
          reachable.back().to = interval.to;
        else
          reachable.push_back(std::move(interval));
      }
    }
    joined.isolated_points.insert(joined.isolated_points.end(), points.begin(), points.end());
    joined.reachable.insert(joined.reachable.end(), reachable.begin(), reachable.end());
  }
  for (const core::LocusMap& map : maps) joined.complete = joined.complete && map.complete;
  return joined;
}

/// The coordinates of the mechanism in place of those of the charts.
void name_coordinates(const mechanism::Mechanism& mechanism, core::LocusMap& map) {
  map.tower.coordinates.clear();
  map.lower.clear();
  map.upper.clear();
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
    map.tower.coordinates.push_back(coordinate.name);
    map.lower.push_back(coordinate.lower);
    map.upper.push_back(coordinate.upper);
  }
}

/// Of the charts of one mechanism together.
core::LocusMap trace_charts(const mechanism::Mechanism& mechanism, const LociRequest& request,
                            const std::vector<symbolic::DerivedProblem>& charts) {
  const loci::TraceOptions options{
      .engine = request.engine,
      .progress = request.progress,
      .deadline = request.deadline,
      .certificate = request.certificate};
  if (mechanism.coordinates.size() == 3) {
    std::vector<const core::LocusProblem*> problems;
    for (const symbolic::DerivedProblem& derived : charts) problems.push_back(&derived.problem);
    core::LocusMap map = loci::trace_surfaces(problems, {.trace = options, .mesh_size = request.mesh_size});
    name_coordinates(mechanism, map);
    return map;
  }
  std::vector<core::LocusMap> maps;
  std::vector<const core::LocusProblem*> problems;
  for (const symbolic::DerivedProblem& derived : charts) {
    if (request.deadline && Clock::now() >= *request.deadline) throw core::LimitReached("the time limit was reached");
    maps.push_back(loci::trace(derived.problem, options));
    problems.push_back(&derived.problem);
  }
  if (mechanism.coordinates.size() == 1) return join_charts(mechanism, charts, maps);
  if (problems.front()->charts.empty()) return std::move(maps.front());
  core::LocusMap map = loci::join_charts(problems, std::move(maps), request.tolerance);
  name_coordinates(mechanism, map);
  return map;
}

/// Derives the problem and traces it; fills in the notes and the time of every stage begun.
/// `family`: of which the mechanism is a member; may be null.
TracedProblem derive_and_trace(const mechanism::Mechanism& mechanism, const LociRequest& request,
                               const symbolic::LocusFamily* family) {
  const auto check_deadline = [&] {
    if (request.deadline && Clock::now() >= *request.deadline) throw core::LimitReached("the time limit was reached");
  };
  double symbolic = 0, elimination = 0, tracing = 0;
  TracedProblem traced;
  core::LocusMap& map = traced.map;
  Clock::time_point start = Clock::now();
  try {
    if (request.progress) request.progress(0, "equations");
    check_deadline();
    std::vector<symbolic::DerivedProblem> charts = family != nullptr
                                                       ? family->problems(mechanism, request.selection)
                                                       : symbolic::locus_problems(mechanism, request.selection);
    for (symbolic::DerivedProblem& derived : charts) {
      symbolic += derived.symbolic_seconds;
      elimination += derived.elimination_seconds;
      derived.problem.tolerance =
          derived.problem.charts.empty() ? request.tolerance : loci::chart_tolerance(request.tolerance);
      derived.problem.modes = modes_to_trace(mechanism, request, derived.problem.tower);
    }

    start = Clock::now();
    check_deadline();
    map = trace_charts(mechanism, request, charts);
    tracing = seconds_since(start);
    if (request.certificate != nullptr) {
      auto& factors = request.certificate->problem.factors;
      factors.insert(factors.end(), charts.front().rest.begin(), charts.front().rest.end());
    }
    map.notes.insert(map.notes.begin(), charts.front().notes.begin(), charts.front().notes.end());
    traced.problem = std::move(charts.front().problem);
  } catch (const core::LimitReached& limit) {
    (symbolic > 0 ? tracing : symbolic) = seconds_since(start);
    map = unfinished_map(mechanism, limit.what());
  }
  map.timing = {{"symbolic", symbolic}, {"elimination", elimination}, {"tracing", tracing}};
  return traced;
}

/// Whether the free coordinates are x and y of the end effector's point: a picture over them then shows the mechanism.
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

TracedProblem trace_member(const mechanism::Mechanism& mechanism, const LociRequest& request,
                           const symbolic::LocusFamily* family) {
  require_coordinates(mechanism, 1, 3, "loci are traced");
  check_sides(mechanism, request);
  TracedProblem traced = derive_and_trace(mechanism, request, family);
  core::LocusMap& map = traced.map;
  map.mechanism = mechanism.name;
  for (const mechanism::Parameter& parameter : mechanism.parameters)
    map.parameters.emplace_back(
        parameter.name, parameter.exact ? core::to_string(parameter.value) : core::to_string(parameter.expression));
  map.tolerance = request.tolerance;
  return traced;
}

}  // namespace

core::WorkingMode mode_of(const DyadSides& sides, const core::RootTower& tower) {
  core::WorkingMode mode;
  std::size_t dyad = 0;
  for (const core::Root& root : tower.roots) {
    if (root.role != core::RootRole::working_mode) {
      mode.push_back(1);
      continue;
    }
    core::ensure(dyad < sides.size(), "the tower has one working_mode root a dyad");
    mode.push_back(sides[dyad++]);
  }
  core::ensure(dyad == sides.size(), "the tower has one working_mode root a dyad");
  return mode;
}

std::vector<DyadSides> requested_modes(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  const DyadSides own = mechanism::working_mode(mechanism);
  if (!request.all_working_modes && !request.working_modes.empty()) return request.working_modes;
  if (!request.all_working_modes) return {own};
  check_mode_count(own.size());
  std::vector<DyadSides> modes = {own};
  for (std::size_t pattern = 0; pattern < std::size_t{1} << own.size(); ++pattern) {
    DyadSides sides;
    for (std::size_t j = 0; j < own.size(); ++j) sides.push_back((pattern >> j & 1) != 0 ? -1 : 1);
    if (sides != own) modes.push_back(sides);
  }
  return modes;
}

core::LocusMap empty_map(const mechanism::Mechanism& mechanism) {
  core::LocusMap map;
  map.mechanism = mechanism.name;
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
    map.tower.coordinates.push_back(coordinate.name);
    map.lower.push_back(coordinate.lower);
    map.upper.push_back(coordinate.upper);
    map.angles.push_back(coordinate.angle);
  }
  if (std::none_of(map.angles.begin(), map.angles.end(), [](bool angle) { return angle; })) map.angles.clear();
  for (const mechanism::PointIndex dyad : mechanism::dyad_points(mechanism)) {
    core::Root root;
    root.point = mechanism.points[static_cast<std::size_t>(dyad)].name;
    root.role = core::RootRole::working_mode;
    map.tower.roots.push_back(std::move(root));
  }
  return map;
}

core::LocusMap unfinished_map(const mechanism::Mechanism& mechanism, const std::string& reason) {
  core::LocusMap map = empty_map(mechanism);
  map.tower.roots.clear();
  map.complete = false;
  map.notes = {reason};
  return map;
}

void require_coordinates(const mechanism::Mechanism& mechanism, std::size_t least, std::size_t most,
                         const std::string& what) {
  const std::size_t count = mechanism.coordinates.size();
  if (least <= count && count <= most) return;
  const std::string wanted = least == most ? std::to_string(least) : "one to three";
  throw core::InputError(
      {mechanism.file}, what + " over " + wanted + " free coordinates; this workspace has " + std::to_string(count),
      count > most
          ? "make " + std::to_string(count - most) + " of them a parameter, such as z: 0.5, and vary it with --set"
          : "give 'workspace' another coordinate with its range");
}

core::LocusMap trace_loci(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  return trace_member(mechanism, request, nullptr).map;
}

TracedProblem trace_problem(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  return trace_member(mechanism, request, nullptr);
}

Loci::Loci(std::string text, std::string file)
    : text_(std::move(text)), file_(std::move(file)), family_(mechanism::parse_mechanism(text_, file_)) {}

Loci Loci::read(const std::string& path) {
  (void)mechanism::read_mechanism(path);  // complains as usual where the file cannot be read
  std::ifstream stream(path);
  return {std::string(std::istreambuf_iterator<char>(stream), {}), path};
}

mechanism::Mechanism Loci::mechanism(const std::vector<mechanism::Override>& values) const {
  return mechanism::parse_mechanism(text_, file_, values);
}

core::LocusMap Loci::trace(const mechanism::Mechanism& member, const LociRequest& request) const {
  return trace_member(member, request, &family_).map;
}

std::vector<numeric::TracedReaction> selected_reactions(const mechanism::Mechanism& mechanism,
                                                        const symbolic::Selection& selection) {
  const std::vector<mechanism::Joint>& joints = mechanism.joints;
  const bool any_clearance =
      std::any_of(joints.begin(), joints.end(), [](const mechanism::Joint& joint) { return joint.clearance; });
  const std::vector<std::string>& named = selection.joints;
  std::vector<numeric::TracedReaction> reactions;
  for (const mechanism::Joint& joint : joints) {
    const bool wanted = named.empty() ? joint.clearance.has_value() || !any_clearance
                                      : std::find(named.begin(), named.end(), joint.name) != named.end();
    if (!wanted) continue;
    const bool every = mechanism.space == mechanism::Space::planar || !named.empty();
    for (const core::Quantity quantity :
         every ? mechanism::reaction_components(mechanism, joint) : mechanism::force_components(mechanism, joint))
      reactions.push_back({joint.name, quantity});
    if (joint.actuated) reactions.push_back({joint.name, mechanism::actuator_quantity(joint)});
    if (mechanism::has_guide_ends(mechanism, joint))
      for (const auto& [end, sign] : mechanism::guide_end_signs) reactions.push_back({joint.name, end});
  }
  return reactions;
}

LociValidation validate_loci(const mechanism::Mechanism& mechanism, LociRequest request,
                             const numeric::GridSpec& grid) {
  require_coordinates(mechanism, 2, 2, "loci are held against a grid");
  const std::vector<numeric::TracedReaction> reactions = selected_reactions(mechanism, request.selection);
  std::vector<core::Quantity>& quantities = request.selection.quantities = {core::Quantity::f};
  for (const numeric::TracedReaction& reaction : reactions)
    if (std::find(quantities.begin(), quantities.end(), reaction.quantity) == quantities.end())
      quantities.push_back(reaction.quantity);
  core::LocusMap map = trace_loci(mechanism, request);
  if (!map.complete)
    throw core::LimitReached("the loci could not be traced completely within the time limit; allow more time");
  numeric::ValidationReport report = numeric::validate(mechanism, map, grid, reactions);
  return {std::move(map), std::move(report)};
}

std::vector<report::ModeSketch> sample_sketches(const mechanism::Mechanism& mechanism, const core::LocusMap& map) {
  if (mechanism.space == mechanism::Space::spatial || !pose_is_place_of_end_effector(mechanism)) return {};
  const numeric::NumericModel model = numeric::compile(mechanism);
  std::vector<report::ModeSketch> sketches;
  for (const core::WorkspaceRegion& region : map.workspace) {
    const std::vector<int> sides = numeric::dyad_signs(model, map.tower, region.mode);
    if (const std::optional<std::vector<double>> pose = numeric::sample_pose(model, sides, model.box))
      sketches.push_back({region.mode, numeric::sketch(model, *pose, sides)});
  }
  return sketches;
}

}  // namespace clearloci
