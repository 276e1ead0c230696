// A function on a cell with its slopes: every step of a computation is met with its mean-value form
//     f(X) c f(m) + sum_c f_c(X) (X_c - m_c)
// so that enclosures shrink with the square of the cell where plain intervals shrink with the cell itself. Slopes are
// per half width of the cell: X_c - m_c = r_c [-1, 1].
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/interval.hpp"

namespace clearloci::loci::sheet {

/// `N`: coordinates.
template <std::size_t N>
struct JetOver {
  Interval value, middle;
  std::array<Interval, N> slope{};
  bool bounded = true;  ///< false: divided by what may be 0, nothing is known

  JetOver() = default;
  JetOver(const Interval& constant) : value(constant), middle(constant) {}  // NOLINT: a number is a constant function
  /// The coordinate c itself.
  JetOver(const Interval& range, int c) : value(range), middle(range.middle()) {
    const double half = std::max(range.upper() - middle.upper(), middle.lower() - range.lower());
    slope[static_cast<std::size_t>(c)] = half * (1 + 0x1p-51);
  }

  /// The value met with its mean-value form.
  JetOver& tighten() {
    Interval inner = middle;
    for (std::size_t c = 2; c < N; ++c) inner = around(inner, slope[c], 0.0);
    value = meet(value, around(inner, slope[0], slope[1]));
    return *this;
  }
};
using Jet = JetOver<2>;

template <std::size_t N>
bool is_known(const JetOver<N>& a) {
  const auto is_finite = [](const Interval& range) {
    return std::isfinite(range.lower()) && std::isfinite(range.upper());
  };
  return a.bounded && is_finite(a.value) && std::all_of(a.slope.begin(), a.slope.end(), is_finite);
}

namespace jet_detail {
template <std::size_t N>
JetOver<N> joined(JetOver<N> result, bool bounded) {
  result.bounded = bounded;
  return result.tighten();
}
}  // namespace jet_detail

template <std::size_t N>
JetOver<N> operator+(const JetOver<N>& a, const JetOver<N>& b) {
  JetOver<N> sum(a.value + b.value);
  sum.middle = a.middle + b.middle;
  for (std::size_t c = 0; c < N; ++c) sum.slope[c] = a.slope[c] + b.slope[c];
  return jet_detail::joined(sum, a.bounded && b.bounded);
}

template <std::size_t N>
JetOver<N> operator-(const JetOver<N>& a) {
  JetOver<N> negated(-a.value);
  negated.middle = -a.middle;
  for (std::size_t c = 0; c < N; ++c) negated.slope[c] = -a.slope[c];
  negated.bounded = a.bounded;
  return negated;
}

template <std::size_t N>
JetOver<N> operator-(const JetOver<N>& a, const JetOver<N>& b) {
  return a + -b;
}

template <std::size_t N>
JetOver<N> operator*(const JetOver<N>& a, const JetOver<N>& b) {
  JetOver<N> product(a.value * b.value);
  product.middle = a.middle * b.middle;
  for (std::size_t c = 0; c < N; ++c) product.slope[c] = a.slope[c] * b.value + a.value * b.slope[c];
  return jet_detail::joined(product, a.bounded && b.bounded);
}

template <std::size_t N>
JetOver<N> squared(const JetOver<N>& a) {
  JetOver<N> square(squared(a.value));
  square.middle = squared(a.middle);
  for (std::size_t c = 0; c < N; ++c) square.slope[c] = Interval(2.0) * a.value * a.slope[c];
  return jet_detail::joined(square, a.bounded);
}

template <std::size_t N>
JetOver<N> inverse(const JetOver<N>& a) {
  if (!a.bounded || a.value.contains_zero()) {
    JetOver<N> unknown(Interval(0.0));
    unknown.bounded = false;
    return unknown;
  }
  JetOver<N> result(inverse(a.value));
  result.middle = inverse(meet(a.middle, a.value));
  const Interval factor = -squared(result.value);
  for (std::size_t c = 0; c < N; ++c) result.slope[c] = factor * a.slope[c];
  return jet_detail::joined(result, true);
}

template <std::size_t N>
JetOver<N> angle_of(const JetOver<N>& y, const JetOver<N>& x) {
  JetOver<N> result(angle_of(y.value, x.value));
  result.bounded = y.bounded && x.bounded && !crosses_cut(y.value, x.value);
  if (!result.bounded) return result;
  result.middle = angle_of(meet(y.middle, y.value), meet(x.middle, x.value));
  const Interval slope = angle_slope(y.value, x.value);
  for (std::size_t c = 0; c < N; ++c) result.slope[c] = slope * (x.value * y.slope[c] - y.value * x.slope[c]);
  return result.tighten();
}

template <std::size_t N>
JetOver<N> angle_slope(const JetOver<N>& y, const JetOver<N>& x) {
  JetOver<N> result = inverse(squared(x) + squared(y));
  result.bounded = result.bounded && !crosses_cut(y.value, x.value);
  return result;
}

/// Required: a.value.lower() > 0.
template <std::size_t N>
JetOver<N> square_root(const JetOver<N>& a) {
  JetOver<N> root(square_root(a.value));
  root.middle = square_root(meet(a.middle, a.value));
  const Interval factor = inverse(Interval(2.0) * root.value);
  for (std::size_t c = 0; c < N; ++c) root.slope[c] = factor * a.slope[c];
  return jet_detail::joined(root, a.bounded);
}

}  // namespace clearloci::loci::sheet
