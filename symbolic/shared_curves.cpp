#include "symbolic/shared_curves.hpp"

#include <flint/nmod_poly.h>
#include <flint/nmod_poly_factor.h>
#include <flint/ulong_extras.h>

#include <algorithm>
#include <map>

#include "core/errors.hpp"

namespace clearloci::symbolic {
namespace {

constexpr unsigned long prime = Residue::prime;

/// Lines tried until the curve has a point on one of them in the field or its extension.
constexpr unsigned lines_tried = 200;

/// Numbers that follow no pattern, the same in every run.
unsigned long scattered(unsigned long seed) {
  seed += 0x9E3779B97F4A7C15UL;
  seed = (seed ^ (seed >> 30)) * 0xBF58476D1CE4E5B9UL;
  seed = (seed ^ (seed >> 27)) * 0x94D049BB133111EBUL;
  return (seed ^ (seed >> 31)) % prime;
}

/// A polynomial modulo the prime.
class PrimePoly {
 public:
  PrimePoly() { nmod_poly_init(raw, prime); }
  PrimePoly(const PrimePoly&) = delete;
  PrimePoly& operator=(const PrimePoly&) = delete;
  ~PrimePoly() { nmod_poly_clear(raw); }

  Residue operator[](slong i) const { return {nmod_poly_get_coeff_ui(raw, i), 0}; }
  nmod_poly_t raw;
};

/// One of the irreducible factors, all of this degree.
void take_factor(PrimePoly& product, slong degree) {
  nmod_poly_factor_t factors;
  nmod_poly_factor_init(factors);
  nmod_poly_factor_equal_deg(factors, product.raw, degree);
  nmod_poly_set(product.raw, factors->p);
  nmod_poly_factor_clear(factors);
}

/// A root of a polynomial given by its coefficients: in the field of the prime where there is one, else in the
/// extension.
std::optional<Residue> root_of(const std::vector<unsigned long>& coefficients) {
  PrimePoly p, x, power, found;
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    nmod_poly_set_coeff_ui(p.raw, static_cast<slong>(i), coefficients[i]);
  if (nmod_poly_degree(p.raw) < 1) return std::nullopt;
  nmod_poly_make_monic(p.raw, p.raw);
  // The product of the factors whose degrees divide n is gcd(p, x^(prime^n) - x).
  nmod_poly_set_coeff_ui(x.raw, 1, 1);
  nmod_poly_powmod_ui_binexp(power.raw, x.raw, prime, p.raw);
  nmod_poly_sub(found.raw, power.raw, x.raw);
  nmod_poly_gcd(found.raw, found.raw, p.raw);
  if (nmod_poly_degree(found.raw) >= 1) {
    take_factor(found, 1);
    return -found[0] * inverse(found[1]);
  }
  if (nmod_poly_degree(p.raw) < 2) return std::nullopt;
  nmod_poly_compose_mod(power.raw, power.raw, power.raw, p.raw);
  nmod_poly_sub(found.raw, power.raw, x.raw);
  nmod_poly_gcd(found.raw, found.raw, p.raw);
  if (nmod_poly_degree(found.raw) < 2) return std::nullopt;
  take_factor(found, 2);
  const Residue a = found[2], b = found[1], c = found[0], two{2, 0};
  const std::optional<Residue> root = square_root(b * b + -(two * two * a * c));
  return root ? std::optional((-b + *root) * inverse(two * a)) : std::nullopt;
}

}  // namespace

SharedCurves::SharedCurves(const Geometry& geometry) : geometry_(geometry), substitutions_(geometry.substitutions()) {}

const SharedCurves::Reduced& SharedCurves::reduced(const Poly& p) {
  for (const auto& [other, result] : known_)
    if (other == p) return result;
  Reduced result;
  for (const core::Term& term : p.plain().terms) {
    result.coefficients.push_back(residue(term.coefficient));
    auto& monomial = result.monomials.emplace_back();
    for (std::size_t v = 0; v < term.exponents.size(); ++v)
      if (term.exponents[v] > 0) monomial.emplace_back(static_cast<int>(v), term.exponents[v]);
  }
  return known_.emplace_back(p, std::move(result)).second;
}

Extension::Element SharedCurves::value(const Reduced& p, const Point& point) {
  const Extension& field = point.field;
  std::map<std::pair<int, int>, Extension::Element> powers;
  const auto power_of = [&](const std::pair<int, int>& factor) -> const Extension::Element& {
    const auto [found, fresh] = powers.try_emplace(factor);
    if (fresh) {
      found->second = Extension::number({1, 0});
      for (int k = 0; k < factor.second; ++k)
        found->second = field.multiply(found->second, point.at[static_cast<std::size_t>(factor.first)]);
    }
    return found->second;
  };
  Extension::Element total = Extension::number({});
  for (std::size_t i = 0; i < p.coefficients.size(); ++i) {
    Extension::Element term = Extension::number({p.coefficients[i], 0});
    for (const auto& factor : p.monomials[i]) term = field.multiply(power_of(factor), term);
    total = Extension::add(total, term);
  }
  return total;
}

Residue SharedCurves::value(const Poly& p, const std::vector<Residue>& at) {
  Point point;
  for (const Residue& coordinate : at) point.at.push_back(Extension::number(coordinate));
  return value(reduced(p), point)[0];
}

/// The points above one point of the curve; nothing where a place divides by zero.
std::optional<SharedCurves::Fibre> SharedCurves::fibre(const Poly& curve, unsigned seed) {
  std::vector<Residue> start(static_cast<std::size_t>(geometry_.ring().size()));
  int along = geometry_.coordinates() - 1;
  while (along > 0 && !curve.depends_on(along)) --along;
  for (int i = 0; i < geometry_.coordinates(); ++i)
    if (i != along) start[static_cast<std::size_t>(i)] = {scattered(seed * 8UL + static_cast<unsigned long>(i)), 0};
  std::vector<unsigned long> coefficients;
  for (const Poly& coefficient : curve.coefficients(along)) coefficients.push_back(value(coefficient, start).real);
  const std::optional<Residue> root = root_of(coefficients);
  if (!root) return std::nullopt;
  start[static_cast<std::size_t>(along)] = *root;
  Point first;
  for (const Residue& coordinate : start) first.at.push_back(Extension::number(coordinate));
  Fibre points = {std::move(first)};
  for (const TowerRoot& tower_root : geometry_.roots()) {
    const auto variable = static_cast<std::size_t>(tower_root.variable);
    Fibre next;
    for (Point& point : points) {
      if (tower_root.is_angle()) {  // depends on nothing algebraic: any value
        point.at[variable] =
            Extension::number({scattered(seed * 8UL + static_cast<unsigned long>(tower_root.variable)), 0});
        next.push_back(std::move(point));
        continue;
      }
      const Extension::Element square = value(reduced(tower_root.square), point);
      const std::optional<Residue> root_there = square.size() == 1 ? square_root(square[0]) : std::nullopt;
      if (!root_there) {
        point.at[variable] = point.field.adjoin(square);
        next.push_back(std::move(point));
        continue;
      }
      if (!root_there->is_zero()) {
        next.push_back(point);
        next.back().at[variable] = Extension::number(-*root_there);
      }
      point.at[variable] = Extension::number(*root_there);
      next.push_back(std::move(point));
    }
    points = std::move(next);
  }
  for (Point& point : points)
    if (!place(point)) return std::nullopt;
  return points;
}

bool SharedCurves::place(Point& point) {
  for (auto pair = substitutions_.rbegin(); pair != substitutions_.rend(); ++pair) {
    const std::optional<Extension::Element> below = point.field.inverse(value(reduced(pair->place.w), point));
    if (!below) return false;
    std::vector<std::pair<int, Extension::Element>> parts;
    for (const auto& [variable, numerator] :
         {std::pair(pair->x, &pair->place.x), {pair->y, &pair->place.y}, {pair->z, &pair->place.z}})
      if (variable >= 0) parts.emplace_back(variable, point.field.multiply(value(reduced(*numerator), point), *below));
    for (auto& [variable, part] : parts) point.at[static_cast<std::size_t>(variable)] = std::move(part);
  }
  return true;
}

const std::optional<SharedCurves::Fibre>& SharedCurves::fibre_of(const Poly& curve) {
  for (const auto& [other, result] : fibres_)
    if (other == curve) return result;
  std::optional<Fibre> found;
  // With one coordinate the curve is a few points: there is one line only.
  const unsigned lines = geometry_.coordinates() == 1 ? 1 : lines_tried;
  for (unsigned line = 1; !found && line <= lines; ++line) found = fibre(curve, line);
  return fibres_.emplace_back(curve, std::move(found)).second;
}

bool SharedCurves::may_vanish_along(const std::vector<Poly>& curves, const Poly& sheet, const Poly& natural) {
  return std::any_of(curves.begin(), curves.end(), [&](const Poly& curve) {
    const std::optional<Fibre>& points = fibre_of(curve);
    return !points || std::any_of(points->begin(), points->end(), [&](const Point& point) {
      const auto vanishes = [&](const Poly& p) { return point.field.norm(value(reduced(p), point)).is_zero(); };
      return vanishes(sheet) && vanishes(natural);
    });
  });
}

bool SharedCurves::may_be_constant(const Poly& natural) {
  const Poly x = Poly::variable(geometry_.ring(), 0);
  std::optional<Residue> first;
  for (const int place : {37, 53}) {
    const std::optional<Fibre>& points = fibre_of(x - Poly(geometry_.ring(), core::Rational(place, 101)));
    if (!points) return true;
    for (const Point& point : *points) {
      Extension::Element here = value(reduced(natural), point);
      if (!first) first = here[0];
      here[0] = here[0] + -*first;
      if (std::any_of(here.begin(), here.end(), [](const Residue& part) { return !part.is_zero(); })) return false;
    }
  }
  return true;
}

}  // namespace clearloci::symbolic
