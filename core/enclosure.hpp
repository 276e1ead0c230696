// Enclosures of expressions of a mechanism file over ranges of its parameters and coordinates.
#pragma once

#include <map>
#include <string>

#include "core/expression.hpp"
#include "core/interval.hpp"

namespace clearloci::inline core {

using Ranges = std::map<std::string, Interval>;

/// The values that an expression takes where its symbols are anywhere in their ranges. Where it is not defined
/// everywhere (a division by zero, the root of a negative number) a stand-in for the whole line. Required: a range for
/// every symbol.
Interval enclosure(const Expression& expression, const Ranges& ranges);

/// The doubles next to a number, or the number itself. Throws LimitReached where it is beyond their range.
Interval enclosed(const Rational& value);

/// The values between two exact ones.
Interval range_of(const Rational& lower, const Rational& upper);

}  // namespace clearloci::inline core
