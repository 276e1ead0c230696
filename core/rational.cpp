#include "core/rational.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

#include "core/errors.hpp"
#include "core/reduced.hpp"

namespace clearloci::inline core {
namespace {

// No quantity of mechanics needs more; without a bound `1e999999999` would fill the memory.
constexpr int largest_exponent = 4096;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Consumes leading digits of `text`.
std::string take_digits(std::string_view& text) {
  std::size_t count = 0;
  while (count < text.size() && is_digit(text[count])) ++count;
  std::string digits(text.substr(0, count));
  text.remove_prefix(count);
  return digits;
}

bool take_minus(std::string_view& text) {
  if (text.empty() || (text.front() != '-' && text.front() != '+')) return false;
  const bool minus = text.front() == '-';
  text.remove_prefix(1);
  return minus;
}

Integer power_of_ten(unsigned long exponent) {
  Integer result;
  mpz_ui_pow_ui(result.get_mpz_t(), 10, exponent);
  return result;
}

/// The nearest double of a number of usual size: 55 or 56 bits of the quotient, the last one set where others follow,
/// are rounded once.
double rounded_once(const Rational& value) {
  const auto bits = [](const Integer& n) { return static_cast<long>(mpz_sizeinbase(n.get_mpz_t(), 2)); };
  const long shift = 55 - (bits(value.get_num()) - bits(value.get_den()));
  thread_local Integer top, below, rest;  // keep their memory
  mpz_abs(top.get_mpz_t(), value.get_num_mpz_t());
  mpz_set(below.get_mpz_t(), value.get_den_mpz_t());
  Integer& shifted = shift >= 0 ? top : below;
  mpz_mul_2exp(shifted.get_mpz_t(), shifted.get_mpz_t(), static_cast<mp_bitcnt_t>(std::abs(shift)));
  mpz_tdiv_qr(top.get_mpz_t(), rest.get_mpz_t(), top.get_mpz_t(), below.get_mpz_t());
  const unsigned long quotient = mpz_get_ui(top.get_mpz_t()) | (rest == 0 ? 0UL : 1UL);
  const double size = std::ldexp(static_cast<double>(quotient), static_cast<int>(-shift));
  return sgn(value) < 0 ? -size : size;
}

}  // namespace

Rational rational_from_decimal(std::string_view text) {
  const std::string whole(text);
  const auto refuse = [&whole]() { return std::invalid_argument("'" + whole + "' is not a decimal number"); };
  const bool negative = take_minus(text);
  const std::string before = take_digits(text);
  std::string after;
  if (!text.empty() && text.front() == '.') {
    text.remove_prefix(1);
    after = take_digits(text);
  }
  if (before.empty() && after.empty()) throw refuse();
  long exponent = 0;
  if (!text.empty() && (text.front() == 'e' || text.front() == 'E')) {
    text.remove_prefix(1);
    const bool negative_exponent = take_minus(text);
    const std::string digits = take_digits(text);
    if (digits.empty()) throw refuse();
    if (digits.size() > 9 || std::stol(digits) > largest_exponent)
      throw std::invalid_argument("the exponent of '" + whole + "' is beyond " + std::to_string(largest_exponent));
    exponent = std::stol(digits) * (negative_exponent ? -1 : 1);
  }
  if (!text.empty()) throw refuse();

  const Integer mantissa(before + after, 10);
  exponent -= static_cast<long>(after.size());
  const Integer scale = power_of_ten(static_cast<unsigned long>(std::labs(exponent)));
  const Rational value = exponent >= 0 ? Rational(mantissa * scale) : reduced(mantissa, scale);
  return negative ? Rational(-value) : value;
}

std::string to_string(const Rational& value) { return value.get_str(); }

std::optional<Rational> square_root(const Rational& value) {
  if (sgn(value) < 0 || mpz_perfect_square_p(value.get_num_mpz_t()) == 0 ||
      mpz_perfect_square_p(value.get_den_mpz_t()) == 0)
    return std::nullopt;
  return Rational(sqrt(value.get_num()), sqrt(value.get_den()));
}

namespace {

/// Both ends of the fraction are doubles, so that their quotient is rounded once.
bool is_quotient_of_doubles(const Rational& value) {
  constexpr std::size_t digits = std::numeric_limits<double>::digits;
  return mpz_sizeinbase(value.get_num_mpz_t(), 2) <= digits && mpz_sizeinbase(value.get_den_mpz_t(), 2) <= digits;
}

}  // namespace

double to_double(const Rational& value) {
  if (sgn(value) == 0) return 0;
  if (is_quotient_of_doubles(value)) return value.get_num().get_d() / value.get_den().get_d();
  constexpr double least = 0x1p-1000, most = 0x1p1000;
  if (const double near = std::abs(value.get_d()); near > least && near < most) return rounded_once(value);
  // GMP truncates towards zero; the nearest double is that one or its neighbour away from zero.
  const double truncated = value.get_d();
  if (!std::isfinite(truncated)) return truncated;
  if (Rational(truncated) == value) return truncated;
  const double infinity =
      sgn(value) < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  const double away = std::nextafter(truncated, infinity);
  if (!std::isfinite(away)) return truncated;
  const int nearer = cmp(abs(Rational(away) - value), abs(value - Rational(truncated)));
  if (nearer != 0) return nearer < 0 ? away : truncated;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &truncated, sizeof bits);
  return bits % 2 == 0 ? truncated : away;
}

Rational simplest_rational_near(const Rational& value, const Rational& tolerance) {
  ensure(sgn(tolerance) >= 0, "a tolerance is not negative");
  Rational low = value - tolerance;
  Rational high = value + tolerance;
  if (sgn(low) <= 0 && sgn(high) >= 0) return Rational(0);
  const bool negative = sgn(high) < 0;
  if (negative) {
    const Rational mirrored = -low;
    low = -high;
    high = mirrored;
  }
  // The simplest number of [low, high], 0 < low: descend the continued fraction that both ends share.
  std::vector<Integer> quotients;
  for (;;) {
    Integer floor;
    mpz_fdiv_q(floor.get_mpz_t(), low.get_num_mpz_t(), low.get_den_mpz_t());
    if (floor == low) {
      quotients.push_back(floor);
      break;
    }
    if (floor + 1 <= high) {
      quotients.emplace_back(floor + 1);
      break;
    }
    quotients.push_back(floor);
    const Rational next_low = 1 / Rational(high - floor);
    high = 1 / Rational(low - floor);
    low = next_low;
  }
  Rational result(quotients.back());
  for (std::size_t i = quotients.size() - 1; i-- > 0;) result = quotients[i] + 1 / result;
  return negative ? Rational(-result) : result;
}

}  // namespace clearloci::inline core
