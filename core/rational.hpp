// Exact numbers: everything between the mechanism file and the traced curve is rational.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "clearloci/exact.hpp"

namespace clearloci::inline core {

/// The exact value of a decimal such as `0.5`, `10e-6` or `-3`. Throws std::invalid_argument for anything else.
Rational rational_from_decimal(std::string_view text);

/// The non-negative root of a square of a rational; none of any other number.
std::optional<Rational> square_root(const Rational& value);

/// The rational with the smallest denominator within `tolerance` of `value` (continued fraction, Stern-Brocot).
Rational simplest_rational_near(const Rational& value, const Rational& tolerance);

}  // namespace clearloci::inline core
