// Exact values of constant expressions.
#pragma once

#include <optional>
#include <string>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

struct ExactValue {
  Rational value;
  bool exact = true;  ///< false: a rational within 1e-30 of an irrational value
};

/// Value of an expression without free coordinates, under the mechanism's parameters. Rational numbers, square roots
/// and multiples of pi are kept apart until the end: sqrt(2)^2 is 2, and cos(a) with a = 90 deg is 0. A value that is
/// irrational then is a rational within 1e-30 of it. cos and sin of one angle are the same rational point of the unit
/// circle, so that cos^2 + sin^2 = 1 exactly; that point is exact at multiples of 90 deg, and elsewhere both of its
/// coordinates are replaced, also where one of them is rational (cos(60 deg)).
/// Throws std::domain_error (division by zero, root of a negative number) or std::out_of_range (unknown symbol).
ExactValue evaluate(const Expression& expression, const std::vector<Parameter>& parameters);

/// Why a number of a file or a call cannot be worked with: it or what follows from it would be no double. None: it can.
std::optional<std::string> unusable(const Rational& value);

/// Shorthand for evaluate(expression, mechanism.parameters).value.
Rational value_of(const Expression& expression, const Mechanism& mechanism);

}  // namespace clearloci::mechanism
