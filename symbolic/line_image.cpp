#include "symbolic/line_image.hpp"

#include "symbolic/tower_steps.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;

void divide_out(ResiduePoly& p, const std::vector<ResiduePoly>& divisors) {
  ResiduePoly quotient(p.ring());
  for (const ResiduePoly& divisor : divisors)
    while (!p.is_zero() && !divisor.is_constant() && p.divides(divisor, quotient)) p = quotient;
}

}  // namespace

LineImage::LineImage(const Geometry& geometry, const std::vector<Poly>& divisors, const std::vector<Poly>& denominators,
                     const std::vector<TowerRoot>& independent)
    : ring_(geometry.ring().size()), last_(geometry.coordinates() - 1) {
  for (int variable = 0; variable < last_; ++variable)
    along_.push_back(ResiduePoly(ring_, Rational(911 + 97 * variable, 1873)) +
                     ResiduePoly::variable(ring_, last_) * ResiduePoly(ring_, Rational(-577, 1021 + variable)));
  for (const TowerRoot& root : geometry.roots()) roots_.push_back(image(root));
  for (const TowerRoot& root : independent) independent_.push_back(image(root));
  for (const Substitution& pair : geometry.substitutions())
    places_.push_back(
        {pair.x, pair.y, pair.z, {of(pair.place.x), of(pair.place.y), of(pair.place.z), of(pair.place.w)}});
  for (const Poly& divisor : divisors) divisors_.push_back(of(divisor));
  for (const Poly& denominator : denominators) denominators_.push_back(of(denominator));
}

ResiduePoly LineImage::of(const Poly& p) const {
  ResiduePoly result(ring_, p);
  for (int variable = 0; variable < last_; ++variable) {
    const std::vector<ResiduePoly> powers = result.coefficients(variable);
    if (powers.size() == 1) continue;
    result = powers.back();
    for (auto power = powers.rbegin() + 1; power != powers.rend(); ++power)
      result = result * along_[static_cast<std::size_t>(variable)] + *power;
  }
  return result;
}

ResiduePoly LineImage::over_tower(const Poly& natural) const {
  ResiduePoly result = of(natural);
  for (const PlacedAt& placed : places_) {
    std::vector<int> variables = {placed.x};
    if (placed.y >= 0) variables.push_back(placed.y);
    if (placed.z >= 0) variables.push_back(placed.z);
    const int degree = result.degree(variables);
    if (degree == 0) continue;
    result = with_place(result, placed, degree, roots_);
    divide_out(result, divisors_);
  }
  return result;
}

ResiduePoly LineImage::norm(ResiduePoly element) const {
  for (auto root = roots_.rbegin(); root != roots_.rend(); ++root) {
    if (!element.depends_on(root->variable)) continue;
    const auto [even, odd] = even_and_odd(element, root->variable, root->square);
    element = even * even - odd * odd * root->square;
  }
  divide_out(element, denominators_);
  return element;
}

bool LineImage::may_divide(const Poly& divisor, const ResiduePoly& image) const {
  return quotient_in(image, of(divisor), independent_).has_value();
}

}  // namespace clearloci::symbolic
