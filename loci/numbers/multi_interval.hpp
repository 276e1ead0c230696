// The rung above double intervals: intervals with ends n / 2^precision, for signs that doubles cannot decide.
#pragma once

#include <optional>
#include <vector>

#include "core/polynomial.hpp"
#include "core/rational.hpp"
#include "core/root_tower.hpp"

namespace clearloci::loci::sheet {

class MultiInterval {
 public:
  static constexpr int precision = 256;  ///< bits after the binary point

  MultiInterval() = default;
  explicit MultiInterval(const core::Rational& value);
  explicit MultiInterval(double value);
  /// Required: lower <= upper.
  MultiInterval(const core::Rational& lower, const core::Rational& upper)
      : lower_(MultiInterval(lower).lower_), upper_(MultiInterval(upper).upper_) {}

  /// +1 or -1 where the sign is proven, else 0.
  int sign() const { return lower_ > 0 ? 1 : upper_ < 0 ? -1 : 0; }
  bool non_negative() const { return upper_ >= 0; }
  /// Enclosing doubles.
  double lower() const;
  double upper() const;

  friend MultiInterval operator+(const MultiInterval& a, const MultiInterval& b);
  friend MultiInterval operator*(const MultiInterval& a, const MultiInterval& b);
  friend MultiInterval operator-(const MultiInterval& a);
  friend MultiInterval operator-(const MultiInterval& a, const MultiInterval& b);
  friend MultiInterval squared(const MultiInterval& a);
  /// 1/a; where 0 is in `a`, a stand-in for the whole line.
  friend MultiInterval inverse(const MultiInterval& a);
  /// Of the ways (x, y) from the x axis, and 1 / (x^2 + y^2), as of intervals of doubles.
  friend MultiInterval angle_of(const MultiInterval& y, const MultiInterval& x);
  friend MultiInterval angle_slope(const MultiInterval& y, const MultiInterval& x);
  /// Required: non_negative().
  friend MultiInterval square_root(const MultiInterval& a);

  /// Enclosing rationals, exactly.
  core::Rational lower_end() const;
  core::Rational upper_end() const;

 private:
  core::Integer lower_, upper_;
};

/// Value of a polynomial. Of variables that do not occur, the last ones may be left out.
MultiInterval evaluate(const core::Polynomial& p, const std::vector<MultiInterval>& at);

/// Value of what is computed; nothing where it divides by what may be zero.
std::optional<MultiInterval> evaluate(const core::StraightLine& line, const std::vector<MultiInterval>& at);

/// The value of a root that is an angle, from those of the variables before it.
MultiInterval angle_root(const core::Root& root, const std::vector<MultiInterval>& at);

}  // namespace clearloci::loci::sheet
