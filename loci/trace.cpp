#include "loci/trace.hpp"

#include <algorithm>
#include <tuple>

#include "core/errors.hpp"
#include "loci/exact_trace.hpp"
#include "loci/isolated_points.hpp"
#include "loci/sheet_loci.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusCurve;
using core::LocusFactor;
using core::LocusMap;
using core::LocusProblem;

/// The exact arrangement is quick up to this degree and slows down steeply beyond it (docs/performance.md).
constexpr int quick_degree = 8;

int highest_degree(const LocusFactor& factor) {
  int degree = -1;
  for (const core::Polynomial& p : factor.implicit) degree = std::max(degree, core::total_degree(p));
  return degree;
}

bool belongs_to_sheets(const LocusFactor& factor, Engine engine) {
  const bool traced = factor.role == FactorRole::reaction || factor.role == FactorRole::margin;
  if (!traced || factor.implicit.empty() || engine == Engine::exact) return false;
  return engine == Engine::adaptive || highest_degree(factor) > quick_degree;
}

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

LocusMap trace(const LocusProblem& problem, const TraceOptions& options) {
  core::ensure(problem.tower.coordinates.size() == 2, "two free coordinates");
  LocusProblem exact = problem;
  std::vector<LocusFactor> on_sheets;
  exact.factors.clear();
  for (const LocusFactor& factor : problem.factors) {
    (belongs_to_sheets(factor, options.engine) ? on_sheets : exact.factors).push_back(factor);
  }
  LocusMap map;
  try {
    map = trace_exactly(exact, options);
    add_sheet_loci(problem, on_sheets, options, map);
    for (const core::WorkingMode& mode : problem.modes) add_contact_loss_points(problem, mode, map);
  } catch (const core::LimitReached&) {
    map.complete = false;
  }
  map.tower = problem.tower;
  map.lower = problem.lower;
  map.upper = problem.upper;
  map.tolerance = problem.tolerance;
  sort_and_name(map, problem.modes);
  return map;
}

}  // namespace clearloci::loci
