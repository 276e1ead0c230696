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

/// The exact arrangement is quick up to the first degree and slows down steeply beyond it (docs/performance.md). Direct
/// singularities and boundaries end the other curves, so they stay exact for longer.
constexpr int quick_degree = 8;
constexpr int bearable_degree = 14;

int highest_degree(const LocusFactor& factor) {
  int degree = -1;
  for (const core::Polynomial& p : factor.implicit) degree = std::max(degree, core::total_degree(p));
  return degree;
}

/// Which factors the adaptive engine takes.
std::vector<bool> shares(const LocusProblem& problem, Engine engine) {
  std::vector<bool> on_sheets(problem.factors.size(), false);
  if (engine == Engine::exact) return on_sheets;
  // Where the direct singularities are too much for the arrangement, it cannot end the other curves on them either.
  const bool heavy = std::any_of(problem.factors.begin(), problem.factors.end(), [](const LocusFactor& factor) {
    return factor.role == FactorRole::direct_singularity && highest_degree(factor) > bearable_degree;
  });
  for (std::size_t i = 0; i < problem.factors.size(); ++i) {
    const LocusFactor& factor = problem.factors[i];
    if (factor.implicit.empty()) continue;
    if (factor.role == FactorRole::direct_singularity) on_sheets[i] = heavy;
    if (factor.role == FactorRole::reaction || factor.role == FactorRole::margin) {
      on_sheets[i] = heavy || engine == Engine::adaptive || highest_degree(factor) > quick_degree;
    }
  }
  return on_sheets;
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
  const std::vector<bool> share = shares(problem, options.engine);
  for (std::size_t i = 0; i < share.size(); ++i) {
    (share[i] ? on_sheets : exact.factors).push_back(problem.factors[i]);
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
