// Enclosures of functions over a box of up to eight coordinates, to first order or, in the first three, to second: with
// every coordinate of the box a noise e_i in [-1, 1],
//     f(x) in c + sum a_i e_i + sum b_ij e_i e_j + [-r, r]
// for every x of the box. What is linear in the coordinates, and quadratic in the first three, stays so through sums
// and differences: terms cancel before they are bounded. r shrinks with the cube of a box of three coordinates, else
// with the square. r takes up every rounding:
//     fl(a op b) = (a op b)(1 + e), |e| <= u = 2^-53
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "core/rational.hpp"

namespace clearloci::loci::pose {

/// `second_order`: with products of the first three noises. They cost more than half as much again as what is linear.
template <bool second_order>
struct AffineForm {
  /// Coordinates of a box at most, an even number: those of a pose or of a pose and efforts, and the way along a path.
  static constexpr std::size_t noises = 8;
  /// The first of them have squares and products.
  static constexpr std::size_t curved = second_order ? 3 : 0, products = second_order ? 6 : 0;

  double c = 0, r = 0;
  std::array<double, noises> a{};
  std::array<double, products> b{};  ///< of e_0^2, e_1^2, e_2^2, e_0 e_1, e_0 e_2, e_1 e_2

  AffineForm() = default;
  explicit AffineForm(double value) : c(value) {}

  double linear() const {
    // In pairs, which go through registers together: compilers keep the order of a plain sum.
    std::array<double, 2> sums{};
    for (std::size_t i = 0; i < noises; i += 2) {
      sums[0] += std::abs(a[i]);
      sums[1] += std::abs(a[i + 1]);
    }
    return sums[0] + sums[1];
  }
  double quadratic() const {
    double sum = 0;
    for (const double noise : b) sum += std::abs(noise);
    return sum;
  }
  /// What its roundings are parts of.
  double size() const { return std::abs(c) + linear() + quadratic(); }
  /// Largest difference from c.
  double radius() const { return (linear() + quadratic() + r) * (1 + 0x1p-48); }
  double lower() const { return down(c - below(1)); }
  double upper() const { return -down(-c - below(-1)); }
  bool contains_zero() const { return lower() <= 0 && upper() >= 0; }
  double magnitude() const {
    if constexpr (!second_order) return (std::abs(c) + radius()) * (1 + 0x1p-48);
    return std::fmax(std::abs(lower()), std::abs(upper())) * (1 + 0x1p-48);
  }

  /// Without products: e_i^2 = 1/2 + [-1/2, 1/2].
  AffineForm flattened() const {
    AffineForm form = *this;
    for (std::size_t i = 0; i < products; ++i) {
      form.b[i] = 0;
      form.c += i < curved ? 0.5 * b[i] : 0;
      form.r += i < curved ? 0.5 * std::abs(b[i]) : std::abs(b[i]);
    }
    form.r += slack(std::abs(c) + quadratic() + form.r);
    return form;
  }

  /// Sums of some roundings, one part in 2^50 of what was summed.
  static double slack(double size) { return size * 0x1p-49 + 0x1p-1000; }
  /// Not above the exact result of the operation whose rounded result it is.
  static double down(double rounded) { return rounded - std::abs(rounded) * 0x1p-52 - 0x1p-1000; }

 private:
  /// How far below c (`sign` 1), or above it (-1), the form may be: a e + b e^2 has its ends at -1, 1 or -a / 2b.
  double below(double sign) const {
    if constexpr (!second_order) return radius();
    double sum = r;
    for (std::size_t i = 0; i < noises; ++i) {
      const double size = std::abs(a[i]), square = i < curved ? sign * b[i] : 0;
      const bool inside = square > 0 && size < 2 * square;
      sum += inside ? size * size / (4 * square) : size - square;
    }
    for (std::size_t i = curved; i < products; ++i) sum += std::abs(b[i]);
    return sum * (1 + 0x1p-46);
  }
};

using Affine = AffineForm<true>;
using FlatAffine = AffineForm<false>;

/// A number known to half a unit in the last place or exactly.
template <class Form = Affine>
Form nearest(const core::Rational& value) {
  Form nearest(core::to_double(value));
  if (core::Rational(nearest.c) != value) nearest.r = std::abs(nearest.c) * 0x1p-52 + 0x1p-1000;
  return nearest;
}

template <bool k>
AffineForm<k> operator+(const AffineForm<k>& x, const AffineForm<k>& y) {
  AffineForm<k> sum(x.c + y.c);
  for (std::size_t i = 0; i < AffineForm<k>::noises; ++i) sum.a[i] = x.a[i] + y.a[i];
  for (std::size_t i = 0; i < AffineForm<k>::products; ++i) sum.b[i] = x.b[i] + y.b[i];
  sum.r = x.r + y.r;
  sum.r += AffineForm<k>::slack(std::abs(sum.c) + sum.linear() + sum.quadratic() + sum.r);
  return sum;
}

template <bool k>
AffineForm<k> operator-(const AffineForm<k>& x, const AffineForm<k>& y) {
  AffineForm<k> difference(x.c - y.c);
  for (std::size_t i = 0; i < AffineForm<k>::noises; ++i) difference.a[i] = x.a[i] - y.a[i];
  for (std::size_t i = 0; i < AffineForm<k>::products; ++i) difference.b[i] = x.b[i] - y.b[i];
  difference.r = x.r + y.r;
  difference.r +=
      AffineForm<k>::slack(std::abs(difference.c) + difference.linear() + difference.quadratic() + difference.r);
  return difference;
}

/// The product of two linear parts, times `factor`: among the first three noises exactly; of the others the squares
/// e_i^2 = 1/2 + [-1/2, 1/2] are half known.
template <bool k>
void add_linear_product(AffineForm<k>& sum, double factor, const std::array<double, AffineForm<k>::noises>& x,
                        const std::array<double, AffineForm<k>::noises>& y) {
  using Form = AffineForm<k>;
  double of_x = 0, of_y = 0, of_curved_x = 0, of_curved_y = 0, squares = 0, together = 0;
  for (std::size_t i = 0; i < Form::noises; ++i) {
    of_x += std::abs(x[i]);
    of_y += std::abs(y[i]);
    const double both = x[i] * y[i];
    if (i < Form::curved) {
      sum.b[i] += factor * both;
      of_curved_x += std::abs(x[i]);
      of_curved_y += std::abs(y[i]);
    } else {
      together += both;
      squares += std::abs(both);
    }
  }
  if constexpr (k) {
    sum.b[3] += factor * (x[0] * y[1] + x[1] * y[0]);
    sum.b[4] += factor * (x[0] * y[2] + x[2] * y[0]);
    sum.b[5] += factor * (x[1] * y[2] + x[2] * y[1]);
  }
  sum.c += 0.5 * factor * together;
  const double size = std::abs(factor) * of_x * of_y;
  if (of_x > of_curved_x || of_y > of_curved_y)
    sum.r += std::abs(factor) * std::fmax(0.0, of_x * of_y - of_curved_x * of_curved_y - 0.5 * squares);
  sum.r += 8 * Form::slack(size);
}

template <bool k>
AffineForm<k> operator*(const AffineForm<k>& x, const AffineForm<k>& y) {
  AffineForm<k> product(x.c * y.c);
  for (std::size_t i = 0; i < AffineForm<k>::noises; ++i) product.a[i] = x.c * y.a[i] + y.c * x.a[i];
  for (std::size_t i = 0; i < AffineForm<k>::products; ++i) product.b[i] = x.c * y.b[i] + y.c * x.b[i];
  add_linear_product(product, 1, x.a, y.a);
  const double linear_x = x.linear(), linear_y = y.linear(), quadratic_x = x.quadratic(), quadratic_y = y.quadratic();
  const double size_x = std::abs(x.c) + linear_x + quadratic_x, size_y = std::abs(y.c) + linear_y + quadratic_y;
  product.r += linear_x * quadratic_y + quadratic_x * (linear_y + quadratic_y);
  product.r += size_x * y.r + size_y * x.r + x.r * y.r;
  product.r += AffineForm<k>::slack(size_x * size_y + product.r);
  return product;
}

/// Of a function at x.c: its value and derivatives, the second within [low, high] over x and the third of a size of
/// `third` at most there, all known to some roundings. With t = x - x.c
///     f(c) + f' t + f''(c) t^2 / 2 + [-third, third] |t|^3 / 6,  or where that says more  f(c) + f' t + f''(.) t^2 / 2
struct Derivatives {
  double value = 0, slope = 0, second = 0, low = 0, high = 0, third = 0;
};
template <bool k>
AffineForm<k> by_taylor(const AffineForm<k>& x, const Derivatives& f) {
  using Form = AffineForm<k>;
  const double t = x.radius(), half = 0.5 * t * t;
  Form result(f.value);
  for (std::size_t i = 0; i < Form::noises; ++i) result.a[i] = f.slope * x.a[i];
  for (std::size_t i = 0; i < Form::products; ++i) result.b[i] = f.slope * x.b[i];
  result.r = std::abs(f.slope) * x.r;
  const double least = std::fmin(0.0, f.low) * half, most = std::fmax(0.0, f.high) * half;
  const double cubic = f.third * t * half / 3;
  const double bent = x.quadratic() + x.r, beside = 0.5 * std::abs(f.second) * bent * (2 * x.linear() + bent);
  if (k && cubic + beside < 0.5 * (most - least)) {
    add_linear_product(result, 0.5 * f.second, x.a, x.a);
    result.r += cubic + beside;
  } else {
    result.c += 0.5 * (least + most);
    result.r += 0.5 * (most - least);
  }
  result.r += 16 * Form::slack(std::abs(f.value) + std::abs(f.slope) * t + std::abs(f.second) * half + result.r);
  return result;
}

template <bool k>
AffineForm<k> squared(const AffineForm<k>& x) {
  return by_taylor(x, Derivatives{x.c * x.c, 2 * x.c, 2, 2, 2, 0});
}

/// Required: zero is not in `x`.
template <bool k>
AffineForm<k> inverse(const AffineForm<k>& x) {
  const double value = 1 / x.c, near = x.c > 0 ? x.lower() : x.upper(), far = x.c > 0 ? x.upper() : x.lower();
  const double at_near = 2 / (near * near * near), at_far = 2 / (far * far * far);
  return by_taylor(x, Derivatives{value, -value * value, 2 * value * value * value, std::fmin(at_near, at_far),
                                  std::fmax(at_near, at_far), 6 / (near * near * near * near)});
}

/// Required: x.lower() > 0.
template <bool k>
AffineForm<k> square_root(const AffineForm<k>& x) {
  const double value = std::sqrt(x.c), low = x.lower(), high = x.upper();
  return by_taylor(x, Derivatives{value, 0.5 / value, -0.25 / (x.c * value), -0.25 / (low * std::sqrt(low)),
                                  -0.25 / (high * std::sqrt(high)), 0.375 / (low * low * std::sqrt(low))});
}

/// -cos over an interval is within t of -cos at its middle, and within [-1, 1].
template <bool k>
AffineForm<k> cosine(const AffineForm<k>& x) {
  const double value = std::cos(x.c), t = x.radius() + 0x1p-40;
  return by_taylor(
      x, Derivatives{value, -std::sin(x.c), -value, std::fmax(-1.0, -value - t), std::fmin(1.0, -value + t), 1});
}

template <bool k>
AffineForm<k> sine(const AffineForm<k>& x) {
  const double value = std::sin(x.c), t = x.radius() + 0x1p-40;
  return by_taylor(
      x, Derivatives{value, std::cos(x.c), -value, std::fmax(-1.0, -value - t), std::fmin(1.0, -value + t), 1});
}

/// The second derivative of atan, -2 t / (1 + t^2)^2, is never above 0.6496 in size, the third never above 2.
template <bool k>
AffineForm<k> arc_tangent(const AffineForm<k>& x) {
  constexpr double most = 0.65;
  const double slope = 1 / (1 + x.c * x.c);
  const double low = std::fmin(most, std::fmax(0.0, 2 * x.upper())),
               high = std::fmin(most, std::fmax(0.0, -2 * x.lower()));
  return by_taylor(x, Derivatives{std::atan(x.c), slope, -2 * x.c * slope * slope, -low, high, 2});
}

/// Of the ways (x, y) from the x axis, counted on from the one in the middle beyond half a turn; nothing where they
/// reach a right angle off that one.
template <bool k>
std::optional<AffineForm<k>> angle_of(const AffineForm<k>& y, const AffineForm<k>& x) {
  using Form = AffineForm<k>;
  const double size = std::hypot(x.c, y.c);
  if (!(size > 0)) return std::nullopt;
  const Form c(x.c / size), s(y.c / size);  // nearly: any way will do to count from
  const Form ahead = c * x + s * y, aside = c * y - s * x;
  if (!(ahead.lower() > 0)) return std::nullopt;
  Form from(std::atan2(s.c, c.c));
  from.r = Form::slack(4);
  return from + arc_tangent(aside * inverse(ahead));
}

/// Sums of numbers times enclosures, with the roundings of all added at the end.
template <class Form>
class SumOf {
 public:
  void add(double factor, const Form& x) { add(factor, x, x.size()); }
  /// Of a form that is in many sums: with its size, found once.
  void add(double factor, const Form& x, double size) {
    sum_.c += factor * x.c;
    for (std::size_t i = 0; i < Form::noises; ++i) sum_.a[i] += factor * x.a[i];
    for (std::size_t i = 0; i < Form::products; ++i) sum_.b[i] += factor * x.b[i];
    sum_.r += std::abs(factor) * x.r;
    size_ += std::abs(factor) * size;
    ++terms_;
  }
  /// Where x is a number, known to its r.
  void add_number(double factor, const Form& x) {
    sum_.c += factor * x.c;
    sum_.r += std::abs(factor) * x.r;
    size_ += std::abs(factor) * std::abs(x.c);
    ++terms_;
  }
  Form result() const {
    Form sum = sum_;
    sum.r += (terms_ + 4) * Form::slack(size_ + sum.r);
    return sum;
  }

 private:
  Form sum_;
  double size_ = 0;
  int terms_ = 0;
};

using AffineSum = SumOf<Affine>;

}  // namespace clearloci::loci::pose
