// Enclosures of expressions of a mechanism file over ranges of parameters.
#pragma once

#include <map>
#include <string>

#include "core/expression.hpp"
#include "loci/sheet/interval.hpp"

namespace clearloci {

using Ranges = std::map<std::string, loci::sheet::Interval>;

/// The values that an expression takes where its symbols are anywhere in their ranges. Where it is not defined
/// everywhere (a division by zero, the root of a negative number) a stand-in for the whole line. Required: a range for
/// every symbol.
loci::sheet::Interval enclosure(const core::Expression& expression, const Ranges& ranges);

/// The values between two exact ones.
loci::sheet::Interval range_of(const core::Rational& lower, const core::Rational& upper);

}  // namespace clearloci
