#include "loci/curves/arc_stretches.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "loci/curves/arc_orders.hpp"
#include "loci/curves/reaction_orders.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {
namespace {

using core::LocusProblem;
using core::Point2;

// A square is close to zero where it is below this part of its largest value along the arc. Next to a zero of order two
// it is below that at the nearest vertex: vertices are a hundredth of an arc's radius apart, or a few hundredths on the
// smallest arcs. Cutting an arc where it need not be cut costs a sample.
constexpr double close_to_zero = 0.05;

// Below this part of the largest value of any of the tower's squares a root is zero all along: the arc's own boundary.
constexpr double zero_all_along = 1e-9;

// A sample is on the curve where the curve is this near, relative to the box: vertices are far nearer.
constexpr double on_curve = 1e-9;

/// Q_j at every vertex, root by root.
std::vector<std::vector<double>> squares_along(const core::RootTower& tower, const core::WorkingMode& mode,
                                               const core::Polyline& vertices) {
  const sheet::SheetProgram program(tower, std::vector<core::Polynomial>{});
  auto registers = program.registers<double>();
  std::vector<std::vector<double>> squares(tower.roots.size());
  for (const Point2& at : vertices) {
    for (const int v : {0, 1}) registers.set(v, at[static_cast<std::size_t>(v)]);
    for (int j = 0; j < program.roots(); ++j) {
      registers.run_square(j);
      const double square = std::max(0.0, registers.square(j));
      squares[static_cast<std::size_t>(j)].push_back(square);
      registers.set(2 + j, mode[static_cast<std::size_t>(j)] * std::sqrt(square));
    }
  }
  return squares;
}

}  // namespace

std::vector<Point2> stretch_samples(const core::RootTower& tower, const core::WorkingMode& mode,
                                    const core::Polyline& vertices) {
  const std::size_t n = vertices.size();
  std::vector<std::size_t> cuts = {0, n - 1};
  const auto squares = squares_along(tower, mode, vertices);
  double largest = 0;
  for (const auto& values : squares) largest = std::max(largest, *std::max_element(values.begin(), values.end()));
  for (const auto& values : squares) {
    const double value = *std::max_element(values.begin(), values.end());
    if (value <= zero_all_along * largest) continue;
    for (std::size_t i = 1; i + 1 < n; ++i)
      if (values[i] <= close_to_zero * value && values[i] <= values[i - 1] && values[i] <= values[i + 1])
        cuts.push_back(i);
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<Point2> samples;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    if (cuts[k + 1] > cuts[k] + 1) samples.push_back(vertices[(cuts[k] + cuts[k + 1]) / 2]);
  return samples;
}

bool same_orders_all_along(const LocusProblem& problem, const core::WorkingMode& mode, const core::Polynomial& curve,
                           const std::shared_ptr<CurveAlgebra>& algebra, const core::Polyline& vertices) {
  const std::vector<int> candidates = factors_on(problem, curve);
  if (candidates.size() < 2 && !needs_orders(problem, curve)) return true;
  const std::vector<Point2> samples = stretch_samples(problem.tower, mode, vertices);
  if (samples.size() < 2) return true;
  const double reach = on_curve * std::max(core::to_double(problem.upper[0] - problem.lower[0]),
                                           core::to_double(problem.upper[1] - problem.lower[1]));
  std::optional<ReactionOrders> first;
  for (const Point2& at : samples) {
    const std::optional<EnclosedPoint> point = curve_point(curve, at, reach);
    if (!point) return false;
    ArcOrders arc(problem.tower, mode, algebra, *point);
    ReactionOrders orders = reaction_orders(problem, arc, candidates);
    if (!orders.decided) return false;
    if (first && !(orders.vanishes == first->vanishes && orders.vanishing == first->vanishing &&
                   orders.singular == first->singular && orders.excited == first->excited))
      return false;
    if (!first) first = std::move(orders);
  }
  return true;
}

}  // namespace clearloci::loci
