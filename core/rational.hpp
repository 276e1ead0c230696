// Exact numbers: everything between the mechanism file and the traced curve is rational.
#pragma once

#include <gmpxx.h>

#include <optional>
#include <string>
#include <string_view>

namespace clearloci::core {

using Integer = mpz_class;
using Rational = mpq_class;

/// The exact value of a decimal such as `0.5`, `10e-6` or `-3`. Throws std::invalid_argument for anything else.
Rational rational_from_decimal(std::string_view text);

/// `"1/2"`, `"-3"`: canonical, reduced.
std::string to_string(const Rational& value);

/// Nearest double, correctly rounded (mpq_class::get_d truncates).
double to_double(const Rational& value);

/// The non-negative root of a square of a rational; none of any other number.
std::optional<Rational> square_root(const Rational& value);

/// The rational with the smallest denominator within `tolerance` of `value` (continued fraction, Stern-Brocot).
Rational simplest_rational_near(const Rational& value, const Rational& tolerance);

}  // namespace clearloci::core
