#include "loci/trace.hpp"

#include <algorithm>
#include <tuple>

#include "core/errors.hpp"
#include "loci/exact_trace.hpp"

namespace clearloci::loci {
namespace {

using core::LocusCurve;
using core::LocusMap;

/// Gravest kinds first, then as the polynomials order them; ids follow.
void sort_and_name(LocusMap& map, const std::vector<core::WorkingMode>& modes) {
  const auto mode_index = [&](const core::WorkingMode& mode) {
    return std::find(modes.begin(), modes.end(), mode) - modes.begin();
  };
  const auto key = [&](const LocusCurve& curve) {
    return std::tuple(mode_index(curve.mode), curve.kind, core::total_degree(curve.implicit), curve.factor,
                      core::to_string(curve.implicit, map.tower.coordinates));
  };
  std::stable_sort(map.curves.begin(), map.curves.end(),
                   [&](const LocusCurve& a, const LocusCurve& b) { return key(a) < key(b); });
  int number = 0;
  for (LocusCurve& curve : map.curves) curve.id = "c" + std::to_string(++number);
}

}  // namespace

LocusMap trace(const core::LocusProblem& problem, const TraceOptions& options) {
  core::ensure(problem.tower.coordinates.size() == 2, "two free coordinates");
  LocusMap map = trace_exactly(problem, options);
  map.tower = problem.tower;
  map.lower = problem.lower;
  map.upper = problem.upper;
  map.tolerance = problem.tolerance;
  sort_and_name(map, problem.modes);
  return map;
}

}  // namespace clearloci::loci
