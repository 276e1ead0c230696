#include "loci/trace.hpp"

#include <algorithm>
#include <array>

#include "core/errors.hpp"
#include "loci/curves/curves.hpp"
#include "loci/points/points.hpp"
#include "loci/search/search.hpp"
#include "loci/zones/zones.hpp"

namespace clearloci::loci {
namespace {

using core::LocusMap;
using core::LocusProblem;

struct EngineEntry {
  Engine engine;
  FindLoci find;
};
constexpr std::array engines = {EngineEntry{Engine::adaptive_then_exact, find_adaptively},
                                EngineEntry{Engine::adaptive, find_adaptively},
                                EngineEntry{Engine::exact, find_exactly}};

FindLoci finder_of(Engine engine) {
  const auto* const entry = std::find_if(
      engines.begin(), engines.end(), [&](const EngineEntry& engine_entry) { return engine_entry.engine == engine; });
  core::ensure(entry != engines.end(), "an engine that is known");
  return entry->find;
}

void add_workspace(const LocusProblem& problem, LocusMap& map) {
  bool by_cells = false;
  for (const core::WorkingMode& mode : problem.modes) {
    WorkspaceRings workspace = workspace_rings(problem, mode, map);
    by_cells = by_cells || workspace.by_cells;
    map.workspace.push_back({mode, std::move(workspace.rings)});
  }
  if (by_cells)
    map.notes.emplace_back(
        "the workspace boundary has gaps where places are open: beside them the rings of the workspace are those of "
        "cells, 1/256 of the coordinates' ranges wide");
}

/// Where reactions vanish and boundaries touch in points alone. `withheld`: as Found's.
void add_points(const LocusProblem& problem, const TraceOptions& options, bool withheld, LocusMap& map) {
  const std::size_t count_before = map.isolated_points.size();
  const std::function<bool()> stop = [&] {
    return options.deadline && std::chrono::steady_clock::now() > *options.deadline;
  };
  for (const core::WorkingMode& mode : problem.modes) {
    if (stop()) throw core::LimitReached("the time limit was reached");
    add_contact_loss_points(problem, mode, map, stop,
                            options.sketch ? sheet::cells_of_a_sketch : sheet::ZeroOptions().most_cells,
                            options.searches);
    add_singular_points(problem, mode, map);
  }
  // A point that lies on an arc which is withheld looks isolated.
  for (std::size_t i = count_before; withheld && i < map.isolated_points.size(); ++i)
    map.isolated_points[i].certified = false;
}

}  // namespace

LocusMap trace(const LocusProblem& problem, const TraceOptions& options) {
  const std::size_t coordinates = problem.tower.coordinates.size();
  core::ensure(coordinates == 1 || coordinates == 2, "one or two free coordinates");
  LocusMap map;
  try {
    if (coordinates == 1) {
      add_points_of_one_coordinate(problem, options, map);
    } else {
      if (options.engine == Engine::exact && core::has_angles(problem.tower))
        throw core::InputError({}, "the exact engine knows polynomials only, and torsion springs turn with angles",
                               "leave --engine exact out");
      Found found = finder_of(options.sketch ? Engine::adaptive : options.engine)(problem, options);
      map = std::move(found.map);
      map.lower = problem.lower;
      map.upper = problem.upper;
      drop_points_on_curves(map);
      if (found.leaves_workspace) add_workspace(problem, map);
      add_points(problem, options, found.withheld, map);
    }
  } catch (const core::LimitReached&) {
    map.out_of_time = true;
  }
  map.tower = names_of(problem.tower);
  map.lower = problem.lower;
  map.upper = problem.upper;
  map.tolerance = problem.tolerance;
  if (options.sketch) {  // what a sketch leaves open says nothing about the mechanism
    map.notes.clear();
    map.open.clear();
  }
  finish_open_regions(map);
  sort_and_name(map, problem.modes);
  return map;
}

}  // namespace clearloci::loci
