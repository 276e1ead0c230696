#include "loci/sheet/way_zeros.hpp"

#include <array>
#include <memory>
#include <utility>

namespace clearloci::loci::sheet {
namespace {

using core::Polynomial;
using core::Rational;
using Element = NumberField::Element;

/// By powers of a coordinate, in the other one.
std::vector<Polynomial> coefficients_of(const Polynomial& p, int variable) {
  const auto v = static_cast<std::size_t>(variable);
  std::vector<Polynomial> result;
  for (const core::Term& term : p.terms) {
    const auto power = static_cast<std::size_t>(term.exponents[v]);
    while (result.size() <= power) result.push_back({1, {}});
    result[power] = result[power] + Polynomial{1, {{{term.exponents[1 - v]}, term.coefficient}}};
  }
  return result;
}

/// What is left of a part where the other one, a + b v, is zero: its zeros are those of the way, but where b is zero
/// too.
Polynomial eliminated(const std::vector<Polynomial>& part, const Polynomial& a, const Polynomial& b) {
  Polynomial sum{1, {}}, divisor = core::constant_polynomial(1, 1);
  const Polynomial minus_a = core::constant_polynomial(1, -1) * a;
  for (auto c = part.rbegin(); c != part.rend(); ++c) {
    sum = sum * minus_a + *c * divisor;
    divisor = divisor * b;
  }
  return sum;
}

Element value_at(const NumberField& field, const Polynomial& p, const Element& at) {
  Element sum;
  int power = core::degree_in(p, 0);
  for (const core::Term& term : p.terms) {
    for (; power > term.exponents[0]; --power) sum = field.product(sum, at);
    sum = field.sum(sum, {term.coefficient});
  }
  for (; power > 0; --power) sum = field.product(sum, at);
  return sum;
}

Element value_at(const AlgebraicPoint& point, const Polynomial& p) {
  Element sum;
  const std::vector<Polynomial> by_power = coefficients_of(p, 1);
  for (auto c = by_power.rbegin(); c != by_power.rend(); ++c)
    sum = point.field.sum(point.field.product(sum, point.y), value_at(point.field, *c, point.x));
  return sum;
}

/// An algebraic number, in a field of degree 1 a rational one.
Rational middle_of(const NumberField& field, const Element& value, Rational& radius) {
  if (value.empty()) return 0;
  if (value.size() == 1) return value.front();
  const MultiInterval enclosure = field.enclosure(value);
  const Rational lower = enclosure.lower_end(), upper = enclosure.upper_end();
  radius = std::max(radius, Rational((upper - lower) / 2));
  return (lower + upper) / 2;
}

class WayZeros {
 public:
  WayZeros(const core::RootTower& tower, const core::DyadBase& way, const std::vector<Rational>& lower,
           const std::vector<Rational>& upper)
      : tower_(tower), way_(way), lower_(lower), upper_(upper) {}

  /// False: not with this coordinate and this part.
  bool find(int variable, const Polynomial& linear, const Polynomial& other) {
    const std::vector<Polynomial> line = coefficients_of(linear, variable);
    if (line.size() != 2) return false;
    const Polynomial rest = eliminated(coefficients_of(other, variable), line[0], line[1]);
    if (rest.is_zero()) return false;
    const auto o = static_cast<std::size_t>(1 - variable);
    std::vector<Star> stars;
    for (const Univariate& factor : irreducible_factors(univariate(rest)))
      for (const RealRoot& root : real_roots(factor, lower_[o], upper_[o])) {
        const NumberField field(root);
        const Element at = field.alpha(), b = value_at(field, line[1], at);
        if (b.empty()) return false;
        const Element a = value_at(field, line[0], at);
        const Element along = field.times(field.product(a, field.inverse(b)), -1);
        if (std::optional<Star> star = star_at({field, variable == 0 ? along : at, variable == 0 ? at : along}))
          stars.push_back(std::move(*star));
      }
    stars_ = std::move(stars);
    return true;
  }

  std::vector<Star> stars() { return std::move(stars_); }

 private:
  std::optional<Star> star_at(const AlgebraicPoint& point) const {
    Star star;
    star.no_length = is_leg(way_);
    Apex apex;
    apex.roots.resize(tower_.roots.size());
    star.x = middle_of(point.field, point.x, apex.radius);
    star.y = middle_of(point.field, point.y, apex.radius);
    const bool is_rational = apex.radius == 0;
    if (star.x + apex.radius < lower_[0] || star.x - apex.radius > upper_[0] || star.y + apex.radius < lower_[1] ||
        star.y - apex.radius > upper_[1])
      return std::nullopt;
    const auto slope = [&](const Polynomial& p, int c) { return value_at(point, core::derivative(p, c)); };
    const std::array<Element, 4> slopes = {slope(way_.x, 0), slope(way_.x, 1), slope(way_.y, 0), slope(way_.y, 1)};
    const NumberField& field = point.field;
    const bool is_simple =
        !field.sum(field.product(slopes[0], slopes[3]), field.times(field.product(slopes[1], slopes[2]), -1)).empty();
    if (!is_rational) {
      apex.exact = std::make_shared<const AlgebraicPoint>(point);
      star.apex = std::move(apex);
    }
    if (!is_simple && (!is_rational || !shear(star, slopes))) return std::nullopt;
    if (!settle_roots(star, tower_) || (!is_leg(way_) && star.roots.empty())) return std::nullopt;
    return star;
  }

  /// Along the one tangent that both parts have; none where they are alike to the second order too.
  bool shear(Star& star, const std::array<Element, 4>& slopes) const {
    const auto number = [](const Element& value) { return value.empty() ? Rational(0) : value.front(); };
    Rational dx = number(slopes[0]), dy = number(slopes[1]);
    if (dx == 0 && dy == 0) dx = number(slopes[2]), dy = number(slopes[3]);
    if (dx == 0 && dy == 0) return false;
    star.shape = Star::Shape::touch;
    star.along_y = abs(dx) > abs(dy);
    star.slope = star.along_y ? -dy / dx : -dx / dy;
    // a off + b along^2
    const std::size_t along = star.along_y ? 1 : 0;
    const auto parts = [&](const Polynomial& p) {
      const Polynomial around_star = around(star, p);
      std::vector<int> off(static_cast<std::size_t>(p.variables), 0), squared = off;
      off[1 - along] = 1;
      squared[along] = 2;
      return std::array{core::coefficient(around_star, off), core::coefficient(around_star, squared)};
    };
    const auto [a, b] = parts(way_.x);
    const auto [c, d] = parts(way_.y);
    return a * d != b * c;
  }

  const core::RootTower& tower_;
  const core::DyadBase& way_;
  const std::vector<Rational>&lower_, &upper_;
  std::vector<Star> stars_;
};

}  // namespace

std::optional<std::vector<Star>> zeros_of_way(const core::RootTower& tower, const core::DyadBase& way,
                                              const std::vector<Rational>& lower, const std::vector<Rational>& upper) {
  for (const Polynomial* part : {&way.x, &way.y})
    for (int v = 2; v < part->variables; ++v)
      if (core::depends_on(*part, v)) return std::nullopt;
  WayZeros zeros(tower, way, lower, upper);
  for (const int variable : {0, 1})
    if (zeros.find(variable, way.x, way.y) || zeros.find(variable, way.y, way.x)) return zeros.stars();
  return std::nullopt;
}

}  // namespace clearloci::loci::sheet
