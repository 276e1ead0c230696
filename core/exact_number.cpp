#include "clearloci/exact_number.hpp"

#include <stdexcept>

#include "core/rational.hpp"

namespace clearloci::inline core {

std::optional<Rational> exact_number(std::string_view text) {
  constexpr std::size_t longest = 200;
  if (text.size() > longest) return std::nullopt;
  const std::size_t slash = text.find('/');
  try {
    Rational value = rational_from_decimal(text.substr(0, slash));
    if (slash == std::string_view::npos) return value;
    const Rational below = rational_from_decimal(text.substr(slash + 1));
    return below == 0 ? std::nullopt : std::optional(Rational(value / below));
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace clearloci::inline core
