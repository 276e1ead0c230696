#include "analysis/enclosure.hpp"

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "loci/sheet/sheet_program.hpp"

namespace clearloci {
namespace {

using core::Expression;
using Kind = Expression::Kind;
using loci::sheet::Interval;

/// A stand-in for the whole line, small enough that products of a few stay finite (loci/sheet/interval.hpp).
constexpr double unbounded = 1e50;

Interval pi() { return {std::nextafter(std::numbers::pi, 0.0), std::nextafter(std::numbers::pi, 4.0)}; }

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

}  // namespace

Interval range_of(const core::Rational& lower, const core::Rational& upper) {
  return hull(loci::sheet::constant_as(lower, static_cast<Interval*>(nullptr)),
              loci::sheet::constant_as(upper, static_cast<Interval*>(nullptr)));
}

Interval enclosure(const Expression& e, const Ranges& ranges) {
  const auto argument = [&](std::size_t i) { return enclosure(e.arguments()[i], ranges); };
  switch (e.kind()) {
    case Kind::number:
      return range_of(e.value(), e.value());
    case Kind::symbol:
      return ranges.at(e.name());
    case Kind::pi:
      return pi();
    case Kind::add:
      return argument(0) + argument(1);
    case Kind::multiply:
      return argument(0) * argument(1);
    case Kind::divide:
      return argument(0) * inverse(argument(1));
    case Kind::negate:
      return -argument(0);
    case Kind::sqrt:
      return root(argument(0));
    case Kind::cos:
      return cosine(argument(0));
    case Kind::sin:
      return cosine(argument(0) - pi() * Interval(0.5));
    case Kind::power: {
      // Exponents are numbers, whole or half of one.
      const Interval exponent = argument(1);
      const double twice = 2 * exponent.middle();
      if (exponent.lower() != exponent.upper() || twice != std::floor(twice) || std::abs(twice) > 1e6)
        return {-unbounded, unbounded};
      const long halves = static_cast<long>(twice);
      return halves % 2 == 0 ? power(argument(0), halves / 2) : power(root(argument(0)), halves);
    }
  }
  core::ensure(false, "an expression of a known kind");
  return {};
}

}  // namespace clearloci
