// Sums of rational multiples of square roots of rational numbers, exactly: what roots of the tower are at a rational
// point.
#pragma once

#include <optional>
#include <vector>

#include "core/rational.hpp"

namespace clearloci::loci {

class Surd {
 public:
  Surd() = default;
  Surd(const core::Rational& value);
  explicit Surd(int value) : Surd(core::Rational(value)) {}

  /// Required: square >= 0.
  static Surd root_of(const core::Rational& square);

  bool is_zero() const { return terms_.empty(); }
  /// Nothing where it is irrational.
  std::optional<core::Rational> rational() const;
  /// Nothing of zero, and of a sum of more than two terms.
  std::optional<Surd> reciprocal() const;

  friend Surd operator+(Surd a, const Surd& b);
  friend Surd operator-(Surd a, const Surd& b);
  friend Surd operator*(const Surd& a, const Surd& b);

 private:
  /// factor √radicand; no factor is zero, and no quotient of two radicands a square, so that the sum is zero only where
  /// there is no term: square roots of rational numbers are independent over the rationals but for squares.
  struct Term {
    core::Rational factor, radicand;
  };
  void add(Term term);

  std::vector<Term> terms_;
};

}  // namespace clearloci::loci
