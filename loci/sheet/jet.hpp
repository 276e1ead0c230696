// A function on a cell with its slopes: every step of a computation is met with its mean-value form
//     f(X) c f(m) + sum_c f_c(X) (X_c - m_c)
// so that enclosures shrink with the square of the cell where plain intervals shrink with the cell itself. Slopes are
// per half width of the cell: X_c - m_c = r_c [-1, 1].
#pragma once

#include <array>
#include <cmath>

#include "core/interval.hpp"

namespace clearloci::loci::sheet {

struct Jet {
  Interval value, middle;
  std::array<Interval, 2> slope{};
  bool bounded = true;  ///< false: divided by what may be 0, nothing is known

  Jet() = default;
  Jet(const Interval& constant) : value(constant), middle(constant) {}  // NOLINT: a number is a constant function
  /// The coordinate c itself.
  Jet(const Interval& range, int c) : value(range), middle(range.middle()) {
    const double half = std::max(range.upper() - middle.upper(), middle.lower() - range.lower());
    slope[static_cast<std::size_t>(c)] = half * (1 + 0x1p-51);
  }

  /// The value met with its mean-value form.
  Jet& tighten() {
    value = meet(value, around(middle, slope[0], slope[1]));
    return *this;
  }
};

namespace jet_detail {
inline Jet joined(Jet result, bool bounded) {
  result.bounded = bounded;
  return result.tighten();
}
}  // namespace jet_detail

inline Jet operator+(const Jet& a, const Jet& b) {
  Jet sum(a.value + b.value);
  sum.middle = a.middle + b.middle;
  for (std::size_t c = 0; c < 2; ++c) sum.slope[c] = a.slope[c] + b.slope[c];
  return jet_detail::joined(sum, a.bounded && b.bounded);
}

inline Jet operator-(const Jet& a) {
  Jet negated(-a.value);
  negated.middle = -a.middle;
  for (std::size_t c = 0; c < 2; ++c) negated.slope[c] = -a.slope[c];
  negated.bounded = a.bounded;
  return negated;
}

inline Jet operator-(const Jet& a, const Jet& b) { return a + -b; }

inline Jet operator*(const Jet& a, const Jet& b) {
  Jet product(a.value * b.value);
  product.middle = a.middle * b.middle;
  for (std::size_t c = 0; c < 2; ++c) product.slope[c] = a.slope[c] * b.value + a.value * b.slope[c];
  return jet_detail::joined(product, a.bounded && b.bounded);
}

inline Jet squared(const Jet& a) {
  Jet square(squared(a.value));
  square.middle = squared(a.middle);
  for (std::size_t c = 0; c < 2; ++c) square.slope[c] = Interval(2.0) * a.value * a.slope[c];
  return jet_detail::joined(square, a.bounded);
}

inline Jet inverse(const Jet& a) {
  if (!a.bounded || a.value.contains_zero()) {
    Jet unknown(Interval(0.0));
    unknown.bounded = false;
    return unknown;
  }
  Jet result(inverse(a.value));
  result.middle = inverse(meet(a.middle, a.value));
  const Interval factor = -squared(result.value);
  for (std::size_t c = 0; c < 2; ++c) result.slope[c] = factor * a.slope[c];
  return jet_detail::joined(result, true);
}

inline Jet angle_of(const Jet& y, const Jet& x) {
  Jet result(angle_of(y.value, x.value));
  result.bounded = y.bounded && x.bounded && !crosses_cut(y.value, x.value);
  if (!result.bounded) return result;
  result.middle = angle_of(meet(y.middle, y.value), meet(x.middle, x.value));
  const Interval slope = angle_slope(y.value, x.value);
  for (std::size_t c = 0; c < 2; ++c) result.slope[c] = slope * (x.value * y.slope[c] - y.value * x.slope[c]);
  return result.tighten();
}

inline Jet angle_slope(const Jet& y, const Jet& x) {
  Jet result = inverse(squared(x) + squared(y));
  result.bounded = result.bounded && !crosses_cut(y.value, x.value);
  return result;
}

/// Required: a.value.lower() > 0.
inline Jet square_root(const Jet& a) {
  Jet root(square_root(a.value));
  root.middle = square_root(meet(a.middle, a.value));
  const Interval factor = inverse(Interval(2.0) * root.value);
  for (std::size_t c = 0; c < 2; ++c) root.slope[c] = factor * a.slope[c];
  return jet_detail::joined(root, a.bounded);
}

}  // namespace clearloci::loci::sheet
