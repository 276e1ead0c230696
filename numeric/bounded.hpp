// A double with a bound on its rounding error, carried along by running error analysis (Higham, Accuracy and Stability
// of Numerical Algorithms, 2nd ed., section 3.3): |computed - exact| <= error. It says when a sign is decided.
#pragma once

#include <cmath>
#include <limits>

namespace clearloci::numeric {

/// Unit roundoff of double, 2^-53: one rounded operation errs by at most this, relative to its result.
inline constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

struct Bounded {
  double value = 0;
  double error = 0;  ///< >= 0, absolute

  Bounded() = default;
  Bounded(double v) : value(v) {}  // NOLINT(google-explicit-constructor): an exact double is a bounded one
  Bounded(double v, double e) : value(v), error(e) {}
};

/// The bound itself is computed in floating point; this covers its own few roundings.
inline constexpr double bound_inflation = 1 + 8 * unit_roundoff;

inline Bounded rounded(double value, double propagated) {
  return {value, (propagated + unit_roundoff * std::abs(value)) * bound_inflation};
}

inline Bounded operator-(const Bounded& a) { return {-a.value, a.error}; }
inline Bounded operator+(const Bounded& a, const Bounded& b) { return rounded(a.value + b.value, a.error + b.error); }
inline Bounded operator-(const Bounded& a, const Bounded& b) { return rounded(a.value - b.value, a.error + b.error); }

inline Bounded operator*(const Bounded& a, const Bounded& b) {
  const double propagated = std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error;
  if (propagated == 0 && (a.value == 0 || b.value == 0 || std::abs(a.value) == 1 || std::abs(b.value) == 1)) {
    return {a.value * b.value, 0};  // exact
  }
  return rounded(a.value * b.value, propagated);
}

inline Bounded operator/(const Bounded& a, const Bounded& b) {
  const double quotient = a.value / b.value;
  const double least = std::abs(b.value) - b.error;
  if (!(least > 0)) return {quotient, std::numeric_limits<double>::infinity()};
  return rounded(quotient, (a.error + std::abs(quotient) * b.error) / least);
}

inline Bounded sqrt(const Bounded& a) {
  const double root = std::sqrt(a.value);
  // |sqrt(a + e) - sqrt(a)| <= e / sqrt(a), and never more than sqrt(e).
  const double propagated = a.error > 0 ? std::fmin(a.error / root, std::sqrt(a.error)) : 0.0;
  return rounded(root, propagated);
}

/// The C library's cos and sin are within one unit in the last place, two unit roundoffs of a value up to 1.
inline Bounded cos(const Bounded& a) { return {std::cos(a.value), (a.error + 2 * unit_roundoff) * bound_inflation}; }
inline Bounded sin(const Bounded& a) { return {std::sin(a.value), (a.error + 2 * unit_roundoff) * bound_inflation}; }

/// The angle turns by no more than the way of (x, y) over its distance from the origin, x pi/2 where that is not small;
/// the C library's is within two units in the last place.
inline Bounded atan2(const Bounded& y, const Bounded& x) {
  const double angle = std::atan2(y.value, x.value);
  const double least = std::hypot(x.value, y.value) - (x.error + y.error);
  if (!(least > 0)) return {angle, std::numeric_limits<double>::infinity()};
  // Across the cut at half a turn the angle jumps.
  if (y.error > 0 && std::abs(y.value) <= y.error && x.value < 0)
    return {angle, std::numeric_limits<double>::infinity()};
  constexpr double half_pi = 1.5707963267948968;
  return rounded(angle, half_pi * (x.error + y.error) / least + 4 * unit_roundoff * std::abs(angle));
}

inline double magnitude(const Bounded& a) { return std::abs(a.value); }
inline double magnitude(double a) { return std::abs(a); }
inline double nominal(const Bounded& a) { return a.value; }
inline double nominal(double a) { return a; }

}  // namespace clearloci::numeric
