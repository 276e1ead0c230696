// The rung between intervals of doubles and MultiInterval: a number of 106 bits, the unevaluated sum of two doubles,
// and a radius around it. Some twenty times as quick as MultiInterval, and enough for most of what doubles cannot
// decide.
//
// Sums, products and roots: M. Joldes, J.-M. Muller, V. Popescu, Tight and rigorous error bounds for basic building
// blocks of double-word arithmetic, ACM Trans. Math. Softw. 44 (2017); V. Lefevre and others, Accurate calculation of
// Euclidean norms using double-word arithmetic, ACM Trans. Math. Softw. 49 (2023). With u = 2^-53 their errors are at
// most 3 u^2, 5 u^2 and 25/8 u^2 of the result: 2^-102 and 2^-1000, for underflow, bound them all.
#pragma once

#include <cmath>

#include "core/interval.hpp"
#include "core/rational.hpp"

namespace clearloci::loci::sheet {

class DoubleDouble {
 public:
  DoubleDouble() = default;
  explicit DoubleDouble(double value) : high_(value) {}
  /// All within `radius` of the value.
  explicit DoubleDouble(const core::Rational& value, const core::Rational& radius = 0) {
    const double high = core::to_double(value);
    const core::Rational rest = value - core::Rational(high);
    *this = rounded(high, core::to_double(rest), core::to_double(radius) * (1 + 0x1p-50));
  }

  /// +1 or -1 where the sign is proven, else 0.
  int sign() const { return high_ + low_ > grown(radius_) ? 1 : high_ + low_ < -grown(radius_) ? -1 : 0; }
  bool non_negative() const { return sign() >= 0; }
  Interval enclosure() const { return Interval(high_) + (Interval(low_) + Interval(-radius_, radius_)); }
  /// Enclosing rationals, exactly.
  core::Rational lower_end() const { return core::Rational(high_) + core::Rational(low_) - core::Rational(radius_); }
  core::Rational upper_end() const { return core::Rational(high_) + core::Rational(low_) + core::Rational(radius_); }
  /// The distance within which the number is known.
  double radius() const { return radius_; }
  /// Known as well as a double tells.
  bool is_sharp() const { return radius_ <= 0x1p-54 * std::abs(high_); }

  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const Sum highs = two_sum(a.high_, b.high_), lows = two_sum(a.low_, b.low_);
    const Sum first = quick_two_sum(highs.value, highs.error + lows.value);
    return rounded(first.value, lows.error + first.error, a.radius_ + b.radius_);
  }
  friend DoubleDouble operator-(const DoubleDouble& a) {
    DoubleDouble result;
    result.high_ = -a.high_;
    result.low_ = -a.low_;
    result.radius_ = a.radius_;
    return result;
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const double value = a.high_ * b.high_, error = std::fma(a.high_, b.high_, -value);
    return rounded(value, error + std::fma(a.low_, b.high_, a.high_ * b.low_),
                   a.size() * b.radius_ + a.radius_ * (b.size() + b.radius_));
  }
  friend DoubleDouble squared(const DoubleDouble& a) { return a * a; }
  /// 1/a; where 0 is in `a`, a stand-in for the whole line.
  friend DoubleDouble inverse(const DoubleDouble& a) {
    if (a.sign() == 0) return unknown();
    const double value = 1 / a.high_;
    const double defect = std::fma(-a.high_, value, 1.0) - a.low_ * value;
    const double least = std::abs(a.high_) * (1 - 0x1p-50) - grown(a.radius_);
    if (!(least > 0)) return unknown();
    return rounded(value, value * defect, grown(a.radius_ / least) * grown(std::abs(value)));
  }
  /// Required: non_negative().
  friend DoubleDouble square_root(const DoubleDouble& a) {
    const double root = std::sqrt(std::abs(a.high_));
    if (a.sign() <= 0 || root == 0) {
      const double most = std::sqrt(grown(a.size() + a.radius_));
      return rounded(0.5 * most, 0, 0.5 * grown(most));
    }
    const double rest = a.low_ + std::fma(-root, root, a.high_);
    return rounded(root, rest / (2 * root), grown(a.radius_ / root));
  }
  /// Not told of angles.
  friend DoubleDouble angle_of(const DoubleDouble&, const DoubleDouble&) { return unknown(); }
  friend DoubleDouble angle_slope(const DoubleDouble&, const DoubleDouble&) { return unknown(); }

 private:
  struct Sum {
    double value, error;
  };
  static Sum two_sum(double a, double b) {
    const double value = a + b, of_b = value - a;
    return {value, (a - (value - of_b)) + (b - of_b)};
  }
  /// Required: |a| >= |b|, or a = 0.
  static Sum quick_two_sum(double a, double b) {
    const double value = a + b;
    return {value, b - (value - a)};
  }
  /// What radii lose by being rounded themselves.
  static double grown(double radius) { return radius * (1 + 0x1p-48); }
  static DoubleDouble rounded(double high, double low, double radius) {
    const Sum sum = quick_two_sum(high, low);
    DoubleDouble result;
    result.high_ = sum.value;
    result.low_ = sum.error;
    result.radius_ = grown(radius) + (std::abs(sum.value) * 0x1p-100 + 0x1p-1000);
    return result;
  }
  static DoubleDouble unknown() {
    constexpr double unbounded = 1e50;
    DoubleDouble result;
    result.radius_ = unbounded;
    return result;
  }
  /// At least its absolute value.
  double size() const { return grown(std::abs(high_)); }

  double high_ = 0, low_ = 0;
  double radius_ = 0;  // around high_ + low_
};

}  // namespace clearloci::loci::sheet
