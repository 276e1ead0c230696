#include "core/enclosure.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/errors.hpp"
#include "core/interpret.hpp"

namespace clearloci::inline core {
namespace {

using core::Expression;
using Kind = Expression::Kind;
using core::Interval;

/// A stand-in for the whole line, small enough that products of a few stay finite (core/interval.hpp).
constexpr double unbounded = 1e50;

Interval enclosed_pi() { return {std::nextafter(std::numbers::pi, 0.0), std::nextafter(std::numbers::pi, 4.0)}; }

Interval cosine(const Interval& angle) {
  constexpr double largest = 1e6;  // beyond, quarter turns are counted too coarsely
  if (angle.magnitude() > largest || angle.width() >= 2 * std::numbers::pi) return {-1, 1};
  // glibc errs by less than one unit in the last place; two cover that and the argument's own end is exact.
  const auto around = [](double x) {
    const double value = std::cos(x);
    return Interval(value - 0x1p-51, value + 0x1p-51);
  };
  Interval result = hull(around(angle.lower()), around(angle.upper()));
  constexpr double hair = 1e-9;  // half turns are placed to less than that below `largest`
  for (double k = std::floor(angle.lower() / std::numbers::pi - hair);
       k <= std::ceil(angle.upper() / std::numbers::pi + hair); ++k) {
    const double at = k * std::numbers::pi;
    if (at < angle.lower() - hair || at > angle.upper() + hair) continue;
    result = hull(result, Interval(std::fmod(std::abs(k), 2.0) == 0 ? 1.0 : -1.0));
  }
  return {std::max(-1.0, result.lower()), std::min(1.0, result.upper())};
}

Interval power(const Interval& base, long exponent) {
  if (exponent < 0) return inverse(power(base, -exponent));
  if (exponent == 0) return 1.0;
  if (exponent == 1) return base;
  const Interval half = power(base, exponent / 2);
  return exponent % 2 == 0 ? squared(half) : squared(half) * base;
}

Interval root(const Interval& square) {
  return square.lower() < 0 ? Interval(-unbounded, unbounded) : square_root(square);
}

struct Enclosing {
  using Value = Interval;
  const Ranges& ranges;

  /// A number beyond the range of doubles may stand in what is small all the same, as a factor of 0.
  Interval number(const Rational& value) const {
    return std::isfinite(to_double(value)) ? enclosed(value) : Interval(-unbounded, unbounded);
  }
  Interval symbol(const std::string& name) const { return ranges.at(name); }
  Interval pi() const { return enclosed_pi(); }
  Interval negate(const Interval& a) const { return -a; }
  Interval add(const Interval& a, const Interval& b) const { return a + b; }
  Interval multiply(const Interval& a, const Interval& b) const { return a * b; }
  Interval divide(const Interval& a, const Interval& b, const Expression&) const { return a * inverse(b); }
  Interval sqrt(const Interval& a, const Expression&) const { return root(a); }
  Interval cos(const Interval& a, const Expression&) const { return cosine(a); }
  Interval sin(const Interval& a, const Expression&) const { return cosine(a - enclosed_pi() * Interval(0.5)); }
  Interval atan(const Interval& a, const Expression&) const { return angle_of(a, Interval(1.0)); }

  /// Exponents are numbers, whole or half of one.
  Interval power(const Interval& base, const Expression& e) const {
    const Interval exponent = interpret(e.arguments()[1], *this);
    const double twice = 2 * exponent.middle();
    if (exponent.lower() != exponent.upper() || twice != std::floor(twice) || std::abs(twice) > 1e6)
      return {-unbounded, unbounded};
    const long halves = static_cast<long>(twice);
    return halves % 2 == 0 ? core::power(base, halves / 2) : core::power(root(base), halves);
  }
};

}  // namespace

namespace {

/// Whether a finite double next to a fraction in lowest terms is the fraction itself: of other denominators than powers
/// of two none is.
bool is_exactly(double nearest, const Rational& value) {
  return mpz_popcount(value.get_den_mpz_t()) == 1 && Rational(nearest) == value;
}

}  // namespace

Interval enclosed(const Rational& value) {
  const double nearest = to_double(value);
  // Products with an infinite end are no numbers, of which comparisons prove nothing.
  if (!std::isfinite(nearest)) throw LimitReached("the equations hold numbers beyond the range of doubles");
  if (is_exactly(nearest, value)) return nearest;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {std::nextafter(nearest, -infinity), std::nextafter(nearest, infinity)};
}

Interval range_of(const Rational& lower, const Rational& upper) { return hull(enclosed(lower), enclosed(upper)); }

Interval enclosure(const Expression& e, const Ranges& ranges) { return interpret(e, Enclosing{ranges}); }

}  // namespace clearloci::inline core
