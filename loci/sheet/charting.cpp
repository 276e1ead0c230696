#include <algorithm>

#include "core/dense_terms.hpp"
#include "core/errors.hpp"
#include "loci/sheet/apex.hpp"
#include "loci/sheet/patch.hpp"
#include "loci/sheet/remembered.hpp"

namespace clearloci::loci::sheet {

namespace {

using core::Polynomial;
using core::Rational;

}  // namespace

core::Polynomial without_denominators(core::Polynomial function, const core::RootTower& tower) {
  const auto compute = [&] {
    Polynomial rest = function;
    for (const Polynomial& denominator : tower.denominators) {
      if (!double_point(denominator)) continue;
      while (std::optional<Polynomial> quotient = exact_quotient(rest, denominator)) {
        if (quotient->is_zero()) break;
        rest = std::move(*quotient);
      }
    }
    return rest;
  };
  if (function.terms.size() > most_terms_remembered) return compute();
  thread_local Remembered<Polynomial, Polynomial, std::vector<Polynomial>> known;
  return known(compute, function, tower.denominators);
}

namespace {

/// How polynomials are written around a star: with its own weights, those along the tangent there, or both.
class Writing {
 public:
  using Weights = Charting::Weights;
  using Orders = std::array<int, 2>;

  Writing(const Star& star, Weights weights)
      : star_(star), written_(weights == Weights::own ? star : star.tangential.front()), weights_(weights) {}

  Orders orders_of_square(int root) const {
    return {2 * written_.power_of_root(root), weights_ == Weights::both ? 2 * star_.power_of_root(root) : 0};
  }
  /// Without the powers of the distance that it has in common.
  core::StraightLine function(const Polynomial& p) const { return known(p, std::nullopt); }
  core::StraightLine square(const Polynomial& p, int root) const { return known(p, orders_of_square(root)); }

  /// The square of an angle's root: common powers of the distance turn no way.
  core::StraightLine angle(const core::Root& root) const {
    const Polynomial x = around(written_, root.cosine_and_sine[0]), y = around(written_, root.cosine_and_sine[1]);
    Orders orders = orders_of(x.is_zero() ? y : x);
    for (const std::size_t i : {0, 1})
      if (!y.is_zero()) orders[i] = std::min(orders[i], orders_of(y)[i]);
    return core::line_of_angle(line(y, orders), line(x, orders));
  }

 private:
  Orders orders_of(const Polynomial& moved) const {
    if (moved.is_zero()) return {};
    return {order_at(written_, moved), weights_ == Weights::both ? order_at(star_, moved) : 0};
  }
  core::StraightLine line(const Polynomial& moved, const Orders& orders) const {
    return weights_ == Weights::both ? wing_line(star_, moved, orders) : polar_line(written_, moved, orders[0]);
  }
  core::StraightLine known(const Polynomial& p, const std::optional<Orders>& orders) const {
    const auto compute = [&] {
      const Polynomial moved = around(written_, p);
      return line(moved, orders ? *orders : orders_of(moved));
    };
    if (star_.apex || p.terms.size() > most_terms_remembered) return compute();
    std::vector<int> shape = {static_cast<int>(weights_), static_cast<int>(star_.shape), written_.along_y ? 1 : 0,
                              orders ? (*orders)[0] : -1, orders ? (*orders)[1] : -1};
    shape.insert(shape.end(), written_.roots.begin(), written_.roots.end());
    shape.push_back(-1);
    shape.insert(shape.end(), star_.roots.begin(), star_.roots.end());
    thread_local Remembered<core::StraightLine, Rational, Rational, Rational, std::vector<int>, Polynomial> remembered;
    return remembered(compute, star_.x, star_.y, written_.slope, shape, p);
  }

  const Star &star_, &written_;
  Weights weights_;
};

}  // namespace

Charting::Charting(const core::RootTower& tower, std::vector<SheetFunction> functions, const std::vector<Star>& stars)
    : tower_(tower), functions_(std::move(functions)), stars_(stars) {}

const Charting::AtStar& Charting::at_star(const Chart& chart) {
  const Weights weights = chart.is_wing() ? Weights::both : chart.is_tangential() ? Weights::tangential : Weights::own;
  for (const AtStar& at_star : known_)
    if (at_star.star == chart.star && at_star.weights == weights) return at_star;
  AtStar at_star;
  at_star.star = chart.star;
  at_star.weights = weights;
  const Star& star = stars_[static_cast<std::size_t>(chart.star)];
  if (star.apex && !star.apex->exact) {
    for (std::size_t j = 0; j < tower_.roots.size(); ++j) {
      const core::Root& root = tower_.roots[j];
      const int power = star.power_of_root(static_cast<int>(j));
      at_star.squares.push_back(root.is_angle() ? polar_angle(star, tower_, root)
                                : star.is_sheared() && power > 0
                                    ? boundary_line(star, root.square)
                                    : polar_line(star, tower_, SheetFunction{root.square, root.line}, 2 * power));
    }
    for (const SheetFunction& f : functions_) at_star.functions.push_back(polar_line(star, tower_, f));
    known_.push_back(at_star);
    return known_.back();
  }
  const Writing writing(star, weights);
  for (std::size_t j = 0; j < tower_.roots.size(); ++j) {
    const core::Root& root = tower_.roots[j];
    at_star.squares.push_back(root.is_angle() ? writing.angle(root) : writing.square(root.square, static_cast<int>(j)));
  }
  for (const SheetFunction& f : functions_) at_star.functions.push_back(writing.function(f.polynomial));
  known_.push_back(std::move(at_star));
  return known_.back();
}

ChartedSheet Charting::in(const Chart& chart) {
  if (chart.side == Chart::Side::plane) {
    ChartedSheet sheet{tower_, {}};
    for (const SheetFunction& f : functions_)
      sheet.functions.push_back({f.line.empty() ? without_denominators(f.polynomial, tower_) : f.polynomial, f.line});
    return sheet;
  }
  const AtStar& around = at_star(chart);
  const Polynomial nothing{tower_.variables(), {}};  // only the straight lines are written in polar coordinates
  ChartedSheet sheet;
  sheet.tower.coordinates = {"u", "t"};
  sheet.tower.roots = tower_.roots;
  for (std::size_t j = 0; j < tower_.roots.size(); ++j) {
    sheet.tower.roots[j].square = nothing;
    sheet.tower.roots[j].line = chart.in_chart(around.squares[j]);
  }
  for (const core::StraightLine& f : around.functions) sheet.functions.push_back({nothing, chart.in_chart(f)});
  return sheet;
}

ChartedSheet charted(const core::RootTower& tower, const std::vector<SheetFunction>& functions, const Chart& chart,
                     const std::vector<Star>& stars) {
  return Charting(tower, functions, stars).in(chart);
}

}  // namespace clearloci::loci::sheet
