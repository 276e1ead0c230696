#include "symbolic/force_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::symbolic {
namespace {

constexpr double most_terms = 20000;  // of a product, before it is multiplied out
// Of a new polynomial: longer ones take longer to put over the tower than the search that they shorten. The moments of
// a force may be as long as its components.
constexpr std::size_t most_terms_over_tower = 64;

/// The last variable of a linear polynomial, which is a coordinate of the point that is constructed last.
std::optional<int> last_variable(const Poly& p) {
  if (p.total_degree() != 1) return std::nullopt;
  for (int v = p.ring().size() - 1; v >= 0; --v)
    if (p.depends_on(v)) return v;
  return std::nullopt;
}

/// With the last variable of a linear polynomial from its zero.
Poly modulo(const Poly& p, const Poly& linear, int variable) {
  if (!p.depends_on(variable)) return p;
  const std::vector<Poly> sides = linear.coefficients(variable);
  const core::Rational scale = -1 / sides[1].constant();
  const Poly value = sides[0].scaled(scale);
  const std::vector<Poly> coefficients = p.coefficients(variable);
  Poly result(p.ring());
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) result = result * value + *c;
  return result;
}

/// a / b of two polynomials that are the same but for a constant factor; none of others.
std::optional<core::Rational> ratio(const Poly& a, const Poly& b) {
  if (a.is_zero()) return std::nullopt;
  Poly quotient(a.ring());
  if (!a.divides(b, quotient) || !quotient.is_constant()) return std::nullopt;
  return quotient.constant();
}

}  // namespace

const std::vector<PairReduction::Way>& PairReduction::ways() {
  if (ways_) return *ways_;
  ways_.emplace();
  for (const mechanism::Link& link : geometry_->mechanism().links)
    for (std::size_t i = 0; i < link.points.size(); ++i)
      for (std::size_t k = i + 1; k < link.points.size(); ++k) {
        const auto &a = geometry_->natural(link.points[i]), &b = geometry_->natural(link.points[k]);
        ways_->push_back({geometry_->poly((a[0] - b[0]).expand()), geometry_->poly((a[1] - b[1]).expand())});
      }
  return *ways_;
}

std::optional<std::vector<LowerPair>> PairReduction::lowered(const Poly& x, const Poly& y,
                                                             const std::array<FactoredPoly, 2>& components) {
  if (x.total_degree() == 1 && y.total_degree() == 1) return std::nullopt;
  if (auto pairs = lowered_by(x, y)) return pairs;
  if (auto pairs = lowered_by(y, x)) return pairs;
  std::array<FactoredPoly, 2> beside = components;
  const FactoredPoly shared = common_factors(components[0], components[1]);
  for (FactoredPoly& component : beside) multiply(component, shared, -1);
  multiply(beside[0], {1, {{x, 1}}}, -1);
  multiply(beside[1], {1, {{y, 1}}}, -1);
  if (beside[0].factors.empty() && beside[1].factors.empty())
    return lowered_by_two_moments(x.scaled(beside[0].constant), y.scaled(beside[1].constant));
  if (beside[1].factors.empty()) return lowered_by_moment(x, y, beside[0], beside[1].constant, true);
  if (beside[0].factors.empty()) return lowered_by_moment(y, x, beside[1], beside[0].constant, false);
  return std::nullopt;
}

std::optional<std::vector<LowerPair>> PairReduction::lowered_by(const Poly& p, const Poly& q) const {
  const std::optional<int> variable = last_variable(p);
  if (!variable) return std::nullopt;
  const Poly rest = modulo(q, p, *variable);
  if (rest.is_zero()) return std::nullopt;
  std::vector<LowerPair> pairs;
  for (const PolyFactor& factor : factored(rest, determinant_->factors).factors) {
    if (factor.poly.total_degree() >= q.total_degree() || factor.poly.length() > most_terms_over_tower)
      return std::nullopt;
    const std::optional<int> other = last_variable(factor.poly);
    const Poly lower = other ? modulo(p, factor.poly, *other).primitive() : p;
    if (lower.is_zero()) return std::nullopt;
    if (!lower.is_constant() && !elimination_->are_components_of_link(lower, factor.poly))
      pairs.push_back({p, factor.poly});
  }
  return pairs;
}

std::optional<std::vector<LowerPair>> PairReduction::lowered_by_moment(const Poly& p, const Poly& q,
                                                                       const FactoredPoly& beside_p,
                                                                       const core::Rational& beside_q, bool p_is_x) {
  for (const PolyFactor& factor : beside_p.factors) {
    if (factor.multiplicity != 1 || factor.poly.total_degree() != 1) continue;
    FactoredPoly cofactor = beside_p;
    multiply(cofactor, {1, {factor}}, -1);
    double terms = static_cast<double>(p.length());
    bool is_quotient = false;
    for (const PolyFactor& other : cofactor.factors) {
      terms *= std::pow(static_cast<double>(other.poly.length()), other.multiplicity);
      is_quotient = is_quotient || other.multiplicity < 0;
    }
    if (is_quotient || terms > most_terms) continue;
    const Poly other_part = expanded(cofactor, p.ring()) * p;
    for (const Way& way : ways()) {
      const std::optional<core::Rational> scale = ratio(way[p_is_x ? 0 : 1], factor.poly);
      if (!scale) continue;
      Poly rest = q.scaled(*scale * beside_q) - way[p_is_x ? 1 : 0] * other_part;
      std::vector<LowerPair> pairs;
      for (const PolyFactor& part : determinant_->factors) {
        bool divides = false;
        for (Poly quotient(p.ring()); !rest.is_zero() && rest.divides(part.poly, quotient); divides = true)
          rest = quotient;
        if (divides) pairs.push_back({p, part.poly});
      }
      if (!rest.is_zero() && rest.is_constant()) return pairs;
    }
  }
  return std::nullopt;
}

Poly PairReduction::known_on(const Poly& divisor, Poly p) {
  Poly quotient(p.ring());
  for (const PolyPair& known : known_)
    if (known[0] == divisor && (p - known[1]).divides(divisor, quotient)) return known[1];
  known_.push_back({divisor, p});
  return p;
}

std::vector<PairReduction::Moment> PairReduction::moments(const Poly& x, const Poly& y) {
  std::vector<Moment> found;
  for (const Way& way : ways()) {
    const Poly moment = way[0] * y - way[1] * x;
    Poly quotient(x.ring());
    for (const PolyFactor& part : determinant_->factors)
      if (!moment.is_zero() && moment.divides(part.poly, quotient)) found.push_back({&way, &part.poly, quotient});
  }
  return found;
}

std::optional<std::vector<LowerPair>> PairReduction::regular_pairs(const Poly& g, const Poly& h) const {
  std::vector<LowerPair> pairs;
  for (const PolyFactor& first : factored(g, determinant_->factors).factors)
    for (const PolyFactor& second : factored(h, determinant_->factors).factors) {
      if (first.poly == second.poly) return std::nullopt;
      if (!elimination_->are_components_of_link(first.poly, second.poly)) pairs.push_back({first.poly, second.poly});
    }
  return pairs;
}

std::optional<Poly> PairReduction::short_work(const Moment& a, const Moment& b) {
  const auto dot = [](const Way& one, const Way& other) { return one[0] * other[0] + one[1] * other[1]; };
  const std::optional<core::Rational> squared = elimination_->constant_over_tower(dot(*a.way, *a.way));
  if (!squared || *squared == 0) return std::nullopt;
  Poly work = known_on(*a.divisor, dot(*a.way, *b.way) * a.value - b.value.scaled(*squared));
  if (work.is_zero() || work.length() > most_terms_over_tower) return std::nullopt;
  return work;
}

std::optional<std::vector<LowerPair>> PairReduction::lowered_by_two_moments(const Poly& x, const Poly& y) {
  // Each of the two is c (x, y) = g b - h a, with ways of up to four terms.
  const std::size_t terms = std::max(x.length(), y.length());
  if (terms > 8 * most_terms_over_tower) return std::nullopt;
  std::optional<std::vector<LowerPair>> by_component;
  const std::vector<Moment> known = moments(x, y);
  for (const Moment& a : known)
    for (const Moment& b : known) {
      if (&a == &b || a.divisor != b.divisor ||
          std::max(a.value.length(), b.value.length()) > std::max(most_terms_over_tower, terms) ||
          !ratio((*a.way)[0] * (*b.way)[1] - (*a.way)[1] * (*b.way)[0], *a.divisor))
        continue;
      if (const std::optional<Poly> work = short_work(a, b)) {
        std::optional<std::vector<LowerPair>> pairs = regular_pairs(a.value, b.value);
        for (const PolyFactor& factor : factored(*work, determinant_->factors).factors) {
          if (!pairs || factor.poly == *a.divisor) return std::nullopt;
          pairs->push_back({*a.divisor, factor.poly});
        }
        return pairs;
      }
      const bool by_x = !(*a.way)[0].is_zero();
      if (by_component || ratio(x, *a.divisor) || ratio(y, *a.divisor)) continue;
      by_component = regular_pairs(a.value, b.value);
      const LowerPair::Normal normal{(*a.way)[by_x ? 0 : 1], by_x ? core::Quantity::fx : core::Quantity::fy};
      if (by_component) by_component->push_back({*a.divisor, by_x ? x : y, normal});
    }
  return by_component;
}

}  // namespace clearloci::symbolic
