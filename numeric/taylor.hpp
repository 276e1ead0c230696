// Truncated Taylor series: a quantity with its first N derivatives, carried through arithmetic exactly (automatic
// differentiation; Griewank and Walther, Evaluating Derivatives, 2nd ed., section 13.2). c[k] is the k-th derivative
// divided by k!.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace clearloci::numeric {

template <int N>
struct Taylor {
  std::array<double, N + 1> c{};

  Taylor() = default;
  Taylor(double value) { c[0] = value; }  // NOLINT(google-explicit-constructor): a constant is a series

  double value() const { return c[0]; }
  /// The series of the derivative, one term shorter.
  Taylor<N - 1> derivative() const {
    Taylor<N - 1> d;
    for (std::size_t k = 0; k < N; ++k) d.c[k] = static_cast<double>(k + 1) * c[k + 1];
    return d;
  }
  /// The first M terms.
  template <int M>
  Taylor<M> truncated() const {
    static_assert(M <= N);
    Taylor<M> t;
    for (std::size_t k = 0; k <= M; ++k) t.c[k] = c[k];
    return t;
  }
};

template <int N>
Taylor<N> operator+(Taylor<N> a, const Taylor<N>& b) {
  for (std::size_t k = 0; k <= N; ++k) a.c[k] += b.c[k];
  return a;
}

template <int N>
Taylor<N> operator-(Taylor<N> a, const Taylor<N>& b) {
  for (std::size_t k = 0; k <= N; ++k) a.c[k] -= b.c[k];
  return a;
}

template <int N>
Taylor<N> operator-(const Taylor<N>& a) {
  return Taylor<N>() - a;
}

template <int N>
Taylor<N> operator*(double s, Taylor<N> a) {
  for (double& c : a.c) c *= s;
  return a;
}

template <int N>
Taylor<N> operator*(const Taylor<N>& a, const Taylor<N>& b) {
  Taylor<N> p;
  for (std::size_t k = 0; k <= N; ++k)
    for (std::size_t i = 0; i <= k; ++i) p.c[k] += a.c[i] * b.c[k - i];
  return p;
}

/// q b = a, term by term.
template <int N>
Taylor<N> operator/(const Taylor<N>& a, const Taylor<N>& b) {
  Taylor<N> q;
  for (std::size_t k = 0; k <= N; ++k) {
    double rest = a.c[k];
    for (std::size_t i = 0; i < k; ++i) rest -= q.c[i] * b.c[k - i];
    q.c[k] = rest / b.c[0];
  }
  return q;
}

/// r r = a, term by term. A constant zero has the root zero; a series that touches zero otherwise has none.
template <int N>
Taylor<N> sqrt(const Taylor<N>& a) {
  Taylor<N> r;
  r.c[0] = std::sqrt(a.c[0]);
  for (std::size_t k = 1; k <= N; ++k) {
    double rest = a.c[k];
    for (std::size_t i = 1; i < k; ++i) rest -= r.c[i] * r.c[k - i];
    r.c[k] = rest == 0 && r.c[0] == 0 ? 0 : rest / (2 * r.c[0]);
  }
  return r;
}

/// s' = a' c and c' = -a' s, term by term.
template <int N>
void sin_cos(const Taylor<N>& a, Taylor<N>& s, Taylor<N>& c) {
  s.c[0] = std::sin(a.c[0]);
  c.c[0] = std::cos(a.c[0]);
  for (std::size_t k = 1; k <= N; ++k) {
    double sum_s = 0, sum_c = 0;
    for (std::size_t i = 1; i <= k; ++i) {
      sum_s += static_cast<double>(i) * a.c[i] * c.c[k - i];
      sum_c -= static_cast<double>(i) * a.c[i] * s.c[k - i];
    }
    s.c[k] = sum_s / static_cast<double>(k);
    c.c[k] = sum_c / static_cast<double>(k);
  }
}

template <int N>
Taylor<N> sin(const Taylor<N>& a) {
  Taylor<N> s, c;
  sin_cos(a, s, c);
  return s;
}

template <int N>
Taylor<N> cos(const Taylor<N>& a) {
  Taylor<N> s, c;
  sin_cos(a, s, c);
  return c;
}

/// a' = (x y' - y x') / (x² + y²), term by term.
template <int N>
Taylor<N> atan2(const Taylor<N>& y, const Taylor<N>& x) {
  Taylor<N> a;
  a.c[0] = std::atan2(y.c[0], x.c[0]);
  const Taylor<N> square = x * x + y * y;
  for (std::size_t k = 1; k <= N; ++k) {
    double rest = 0;
    for (std::size_t i = 1; i <= k; ++i) rest += static_cast<double>(i) * (x.c[k - i] * y.c[i] - y.c[k - i] * x.c[i]);
    for (std::size_t i = 1; i < k; ++i) rest -= static_cast<double>(i) * a.c[i] * square.c[k - i];
    a.c[k] = rest / (static_cast<double>(k) * square.c[0]);
  }
  return a;
}

}  // namespace clearloci::numeric
