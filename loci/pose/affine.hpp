// Enclosures of functions over a box of up to seven coordinates, to first order: with every coordinate of the box a
// noise e_i in [-1, 1],
//     f(x) in c + sum a_i e_i + [-r, r]
// for every x of the box. What is linear in the coordinates stays so through sums and differences; r shrinks with the
// square of the box. r takes up every rounding:
//     fl(a op b) = (a op b)(1 + e), |e| <= u = 2^-53
#pragma once

#include <array>
#include <cmath>

#include "core/rational.hpp"

namespace clearloci::loci::pose {

struct Affine {
  /// Coordinates of a box: six of a pose and the way along a path; one more makes the number even.
  static constexpr std::size_t noises = 8;

  double c = 0, r = 0;
  std::array<double, noises> a{};

  Affine() = default;
  explicit Affine(double value) : c(value) {}

  double linear() const {
    double sum = 0;
    for (const double own : a) sum += std::abs(own);
    return sum;
  }
  /// Largest difference from c.
  double radius() const { return (linear() + r) * (1 + 0x1p-48); }
  double lower() const { return down(c - radius()); }
  double upper() const { return -down(-c - radius()); }
  bool contains_zero() const { return lower() <= 0 && upper() >= 0; }
  double magnitude() const { return (std::abs(c) + radius()) * (1 + 0x1p-48); }

  /// Sums of some roundings, one part in 2^50 of what was summed.
  static double slack(double size) { return size * 0x1p-49 + 0x1p-1000; }
  /// Not above the exact result of the operation whose rounded result it is.
  static double down(double rounded) { return rounded - std::abs(rounded) * 0x1p-52 - 0x1p-1000; }
};

/// A number known to half a unit in the last place or exactly.
inline Affine nearest(const core::Rational& value) {
  Affine own(core::to_double(value));
  if (core::Rational(own.c) != value) own.r = std::abs(own.c) * 0x1p-52 + 0x1p-1000;
  return own;
}

inline Affine operator+(const Affine& x, const Affine& y) {
  Affine sum(x.c + y.c);
  for (std::size_t i = 0; i < Affine::noises; ++i) sum.a[i] = x.a[i] + y.a[i];
  sum.r = x.r + y.r;
  sum.r += Affine::slack(std::abs(sum.c) + sum.linear() + sum.r);
  return sum;
}

inline Affine operator-(const Affine& x, const Affine& y) {
  Affine difference(x.c - y.c);
  for (std::size_t i = 0; i < Affine::noises; ++i) difference.a[i] = x.a[i] - y.a[i];
  difference.r = x.r + y.r;
  difference.r += Affine::slack(std::abs(difference.c) + difference.linear() + difference.r);
  return difference;
}

/// (c + A + r)(c' + A' + r'): of A A' the squares e_i^2 = 1/2 + [-1/2, 1/2] are half known.
inline Affine operator*(const Affine& x, const Affine& y) {
  Affine product(x.c * y.c);
  double together = 0, squares = 0, of_x = 0, of_y = 0;
  for (std::size_t i = 0; i < Affine::noises; ++i) {
    const double both = x.a[i] * y.a[i];
    together += both;
    squares += std::abs(both);
    of_x += std::abs(x.a[i]);
    of_y += std::abs(y.a[i]);
    product.a[i] = x.c * y.a[i] + y.c * x.a[i];
  }
  const double size_x = std::abs(x.c), size_y = std::abs(y.c);
  product.r = (of_x * of_y - 0.5 * squares) + (size_x + of_x) * y.r + (size_y + of_y) * x.r + x.r * y.r;
  product.r += Affine::slack((size_x + of_x) * (size_y + of_y) + product.r);
  product.c += 0.5 * together;
  return product;
}

/// f(c) + f'(c) t + f''(.) t^2 / 2 with |t| <= radius, where f'' is within [low, high] and the three are known to some
/// roundings.
inline Affine by_taylor(const Affine& x, double value, double slope, double low, double high) {
  const double t = x.radius(), half = 0.5 * t * t;
  const double least = std::fmin(0.0, low) * half, most = std::fmax(0.0, high) * half;
  Affine result(value + 0.5 * (least + most));
  for (std::size_t i = 0; i < Affine::noises; ++i) result.a[i] = slope * x.a[i];
  result.r = std::abs(slope) * x.r + 0.5 * (most - least);
  result.r += 16 * Affine::slack(std::abs(value) + std::abs(slope) * t + (most - least) + result.r);
  return result;
}

inline Affine squared(const Affine& x) { return by_taylor(x, x.c * x.c, 2 * x.c, 2, 2); }

/// Required: zero is not in `x`.
inline Affine inverse(const Affine& x) {
  const double value = 1 / x.c, near = x.c > 0 ? x.lower() : x.upper(), far = x.c > 0 ? x.upper() : x.lower();
  const double at_near = 2 / (near * near * near), at_far = 2 / (far * far * far);
  return by_taylor(x, value, -value * value, std::fmin(at_near, at_far), std::fmax(at_near, at_far));
}

/// Required: x.lower() > 0.
inline Affine square_root(const Affine& x) {
  const double value = std::sqrt(x.c), low = x.lower(), high = x.upper();
  return by_taylor(x, value, 0.5 / value, -0.25 / (low * std::sqrt(low)), -0.25 / (high * std::sqrt(high)));
}

/// -cos over an interval is within t of -cos at its middle, and within [-1, 1].
inline Affine cosine(const Affine& x) {
  const double value = std::cos(x.c), t = x.radius() + 0x1p-40;
  return by_taylor(x, value, -std::sin(x.c), std::fmax(-1.0, -value - t), std::fmin(1.0, -value + t));
}

inline Affine sine(const Affine& x) {
  const double value = std::sin(x.c), t = x.radius() + 0x1p-40;
  return by_taylor(x, value, std::cos(x.c), std::fmax(-1.0, -value - t), std::fmin(1.0, -value + t));
}

/// Sums of numbers times enclosures, with the roundings of all added at the end.
class AffineSum {
 public:
  void add(double factor, const Affine& x) {
    sum_.c += factor * x.c;
    double size = std::abs(x.c);
    for (std::size_t i = 0; i < Affine::noises; ++i) {
      sum_.a[i] += factor * x.a[i];
      size += std::abs(x.a[i]);
    }
    sum_.r += std::abs(factor) * x.r;
    size_ += std::abs(factor) * size;
    ++terms_;
  }
  Affine result() const {
    Affine own = sum_;
    own.r += (terms_ + 4) * Affine::slack(size_ + own.r);
    return own;
  }

 private:
  Affine sum_;
  double size_ = 0;
  int terms_ = 0;
};

}  // namespace clearloci::loci::pose
