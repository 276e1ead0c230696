#include "symbolic/shared_curves.hpp"

#include <flint/nmod_poly.h>
#include <flint/nmod_poly_factor.h>
#include <flint/ulong_extras.h>

#include <algorithm>

#include "core/errors.hpp"

namespace clearloci::symbolic {
namespace {

constexpr unsigned long prime = Residue::prime;

/// Lines tried until the curve has a point on one of them above which every root is in the field: that is the first one
/// on which the curve has a point, unless roots stand below roots.
constexpr unsigned lines_tried = 200;

/// Numbers that follow no pattern, the same in every run.
unsigned long scattered(unsigned long seed) {
  seed += 0x9E3779B97F4A7C15UL;
  seed = (seed ^ (seed >> 30)) * 0xBF58476D1CE4E5B9UL;
  seed = (seed ^ (seed >> 27)) * 0x94D049BB133111EBUL;
  return (seed ^ (seed >> 31)) % prime;
}

/// A root in the field of a polynomial given by its coefficients.
std::optional<unsigned long> root_of(const std::vector<unsigned long>& coefficients) {
  nmod_poly_t p, x_power, x;
  nmod_poly_init(p, prime);
  nmod_poly_init(x_power, prime);
  nmod_poly_init(x, prime);
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    nmod_poly_set_coeff_ui(p, static_cast<slong>(i), coefficients[i]);
  std::optional<unsigned long> root;
  if (nmod_poly_degree(p) >= 1) {
    // The product of the linear factors is gcd(p, x^prime - x).
    nmod_poly_set_coeff_ui(x, 1, 1);
    nmod_poly_powmod_ui_binexp(x_power, x, prime, p);
    nmod_poly_sub(x_power, x_power, x);
    nmod_poly_gcd(p, p, x_power);
    if (nmod_poly_degree(p) >= 1) {
      nmod_poly_factor_t factors;
      nmod_poly_factor_init(factors);
      nmod_poly_factor_equal_deg(factors, p, 1);
      const nmod_poly_struct* linear = factors->p;
      const unsigned long slope = nmod_poly_get_coeff_ui(linear, 1);
      root = n_mulmod2(n_negmod(nmod_poly_get_coeff_ui(linear, 0), prime), n_invmod(slope, prime), prime);
      nmod_poly_factor_clear(factors);
    }
  }
  nmod_poly_clear(p);
  nmod_poly_clear(x_power);
  nmod_poly_clear(x);
  return root;
}

}  // namespace

SharedCurves::SharedCurves(const Geometry& geometry) : geometry_(geometry) {}

const SharedCurves::Reduced& SharedCurves::reduced(const Poly& p) {
  for (const auto& [known, result] : known_)
    if (known == p) return result;
  Reduced result;
  for (const core::Term& term : p.plain().terms) {
    result.coefficients.push_back(residue(term.coefficient));
    auto& monomial = result.monomials.emplace_back();
    for (std::size_t v = 0; v < term.exponents.size(); ++v)
      if (term.exponents[v] > 0) monomial.emplace_back(static_cast<int>(v), term.exponents[v]);
  }
  return known_.emplace_back(p, std::move(result)).second;
}

Residue SharedCurves::value(const Reduced& p, const std::vector<Residue>& at) const {
  Residue total;
  for (std::size_t i = 0; i < p.coefficients.size(); ++i) {
    Residue term{p.coefficients[i], 0};
    for (const auto& [variable, exponent] : p.monomials[i])
      term = term * power(at[static_cast<std::size_t>(variable)], exponent);
    total = total + term;
  }
  return total;
}

/// The points above one point of the curve; nothing where some root of theirs is not in the field, or a place divides
/// by zero.
std::optional<SharedCurves::Fibre> SharedCurves::fibre(const Poly& curve, unsigned seed) {
  std::vector<Residue> start(static_cast<std::size_t>(geometry_.ring().size()));
  int along = geometry_.coordinates() - 1;
  while (along > 0 && !curve.depends_on(along)) --along;
  for (int i = 0; i < geometry_.coordinates(); ++i)
    if (i != along) start[static_cast<std::size_t>(i)] = {scattered(seed * 8UL + static_cast<unsigned long>(i)), 0};
  std::vector<unsigned long> coefficients;
  for (const Poly& coefficient : curve.coefficients(along))
    coefficients.push_back(value(reduced(coefficient), start).real);
  const std::optional<unsigned long> root = root_of(coefficients);
  if (!root) return std::nullopt;
  start[static_cast<std::size_t>(along)] = {*root, 0};
  Fibre points = {start};
  for (const TowerRoot& own : geometry_.roots()) {
    Fibre next;
    for (std::vector<Residue>& point : points) {
      const std::optional<Residue> root_there = square_root(value(reduced(own.square), point));
      if (!root_there) return std::nullopt;
      Residue& s = point[static_cast<std::size_t>(own.variable)];
      s = *root_there;
      if (!s.is_zero()) {
        next.push_back(point);
        s = -s;
      }
      next.push_back(std::move(point));
    }
    points = std::move(next);
  }
  const std::vector<Substitution> places = geometry_.substitutions();
  for (std::vector<Residue>& point : points)
    for (auto pair = places.rbegin(); pair != places.rend(); ++pair) {
      const Residue w = value(reduced(pair->place.w), point);
      if (w.is_zero()) return std::nullopt;
      const Residue below = inverse(w);
      point[static_cast<std::size_t>(pair->x)] = value(reduced(pair->place.x), point) * below;
      if (pair->y >= 0)
        point[static_cast<std::size_t>(pair->y)] = value(reduced(pair->place.y), point) * below;
      if (pair->z >= 0)
        point[static_cast<std::size_t>(pair->z)] = value(reduced(pair->place.z), point) * below;
    }
  return points;
}

const std::optional<SharedCurves::Fibre>& SharedCurves::fibre_of(const Poly& curve) {
  for (const auto& [known, result] : fibres_)
    if (known == curve) return result;
  std::optional<Fibre> found;
  // With one coordinate the curve is a few points: there is one line only.
  const unsigned lines = geometry_.coordinates() == 1 ? 1 : lines_tried;
  for (unsigned line = 1; !found && line <= lines; ++line) found = fibre(curve, line);
  return fibres_.emplace_back(curve, std::move(found)).second;
}

bool SharedCurves::may_vanish_along(const std::vector<Poly>& curves, const Poly& sheet, const Poly& natural) {
  return std::any_of(curves.begin(), curves.end(), [&](const Poly& curve) {
    const std::optional<Fibre>& points = fibre_of(curve);
    return !points || std::any_of(points->begin(), points->end(), [&](const std::vector<Residue>& point) {
      return value(reduced(sheet), point).is_zero() && value(reduced(natural), point).is_zero();
    });
  });
}

}  // namespace clearloci::symbolic
