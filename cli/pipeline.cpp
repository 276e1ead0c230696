#include "cli/pipeline.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/errors.hpp"

namespace clearloci {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The tower may hold lengths between the dyads' roots; those have no side to choose.
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

std::vector<core::WorkingMode> modes_to_trace(const mechanism::Mechanism& mechanism, const LociRequest& request,
                                              const core::RootTower& tower) {
  if (request.all_working_modes)
    return core::all_working_modes(tower, mode_of(mechanism::working_mode(mechanism), tower));
  if (request.working_modes.empty()) return {mode_of(mechanism::working_mode(mechanism), tower)};
  std::vector<core::WorkingMode> modes;
  for (const DyadSides& sides : request.working_modes) modes.push_back(mode_of(sides, tower));
  return modes;
}

void check_sides(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  const std::size_t dyads = mechanism::dyad_points(mechanism).size();
  for (const DyadSides& sides : request.working_modes)
    if (sides.size() != dyads || std::any_of(sides.begin(), sides.end(), [](int s) { return s != 1 && s != -1; }))
      throw core::InputError({}, "a working mode needs a side for each of the " + std::to_string(dyads) + " dyads",
                             "give +1 (left) or -1 (right) for each");
}

/// What every map says, traced or not.
void describe(core::LocusMap& map, const mechanism::Mechanism& mechanism, const LociRequest& request) {
  map.mechanism = mechanism.name;
  for (const mechanism::Parameter& parameter : mechanism.parameters)
    map.parameters.emplace_back(parameter.name, core::to_string(parameter.value));
  map.tolerance = request.tolerance;
}

/// The map of work that a deadline ended before there was a curve to trace.
core::LocusMap nothing_known(const mechanism::Mechanism& mechanism, const LociRequest& request,
                             const std::string& reason, double seconds) {
  core::LocusMap map;
  describe(map, mechanism, request);
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
    map.tower.coordinates.push_back(coordinate.name);
    map.lower.push_back(coordinate.lower);
    map.upper.push_back(coordinate.upper);
  }
  map.complete = false;
  map.notes = {reason};
  map.timing = {{"symbolic", seconds}, {"elimination", 0}, {"tracing", 0}};
  return map;
}

}  // namespace

core::LocusMap trace_loci(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  check_sides(mechanism, request);
  const auto report = [&](double fraction, std::string_view stage) {
    if (request.progress) request.progress(fraction, stage);
  };

  const Clock::time_point start = Clock::now();
  report(0, "equations");
  symbolic::DerivedProblem derived;
  try {
    derived = symbolic::locus_problem(mechanism, request.selection);
  } catch (const core::LimitReached& limit) {
    return nothing_known(mechanism, request, limit.what(), seconds_since(start));
  }
  derived.problem.tolerance = request.tolerance;
  derived.problem.modes = modes_to_trace(mechanism, request, derived.problem.tower);

  const Clock::time_point traced_from = Clock::now();
  core::LocusMap map = loci::trace(
      derived.problem, {.engine = request.engine, .progress = request.progress, .deadline = request.deadline});
  const double tracing = seconds_since(traced_from);

  describe(map, mechanism, request);
  map.notes.insert(map.notes.begin(), derived.notes.begin(), derived.notes.end());
  map.timing = {
      {"symbolic", derived.symbolic_seconds}, {"elimination", derived.elimination_seconds}, {"tracing", tracing}};
  return map;
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
    reactions.push_back({joint.name, core::Quantity::fx});
    reactions.push_back({joint.name, core::Quantity::fy});
    if (joint.actuated) reactions.push_back({joint.name, core::Quantity::M});
  }
  return reactions;
}

LociValidation validate_loci(const mechanism::Mechanism& mechanism, LociRequest request,
                             const numeric::GridSpec& grid) {
  request.selection.quantities = {core::Quantity::f, core::Quantity::M, core::Quantity::fx, core::Quantity::fy};
  core::LocusMap map = trace_loci(mechanism, request);
  if (!map.complete)
    throw core::LimitReached("the loci could not be traced completely within the time limit; allow more time");
  numeric::ValidationReport report =
      numeric::validate(mechanism, map, grid, selected_reactions(mechanism, request.selection));
  return {std::move(map), std::move(report)};
}

}  // namespace clearloci
