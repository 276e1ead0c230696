// Numbers as decimals: the shortest within a tolerance, or exactly.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "mechanism/import/common.hpp"

namespace clearloci::mechanism::imports {

std::string shortest_decimal(double value, double tolerance) {
  if (std::abs(value) <= tolerance || value == 0 || !std::isfinite(value)) return "0";
  constexpr int most = 17;
  char text[400];
  for (int digits = 0; digits <= most + 12; ++digits) {
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    if (std::abs(std::strtod(text, nullptr) - value) <= tolerance) break;
  }
  std::string result = text;
  if (result.find('.') != std::string::npos) {
    while (result.back() == '0') result.pop_back();
    if (result.back() == '.') result.pop_back();
  }
  return result == "-0" ? "0" : result;
}

std::string exact_decimal(const core::Rational& value) {
  const mpz_class& denominator = value.get_den();
  std::size_t digits = 0;
  mpz_class power = 1;
  constexpr std::size_t most = 60;
  while (power % denominator != 0 && digits < most) {
    power *= 10;
    ++digits;
  }
  if (digits == most) return value.get_str();
  mpz_class whole = abs(value.get_num()) * (power / denominator);
  std::string text = whole.get_str();
  if (digits > 0) {
    if (text.size() <= digits) text.insert(0, digits + 1 - text.size(), '0');
    text.insert(text.size() - digits, ".");
  }
  return (sgn(value) < 0 ? "-" : "") + text;
}

}  // namespace clearloci::mechanism::imports
