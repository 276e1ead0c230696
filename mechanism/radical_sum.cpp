#include "mechanism/radical_sum.hpp"

#include <mpfr.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "core/reduced.hpp"
#include "core/thread_end.hpp"

namespace clearloci::mechanism {
namespace {

const Integer pi_key = 0;
const Integer rational_key = 1;

// Far beyond what a person means, far below what fills the memory: repeated squaring doubles the bits each time.
constexpr std::size_t largest_result_bits = 100'000;
constexpr std::size_t most_terms = 256;  // different square roots in one number; products multiply their number

/// 10^-digits.
Rational decimal_place(unsigned long digits) {
  Integer scale;
  mpz_ui_pow_ui(scale.get_mpz_t(), 10, digits);
  return Rational(1, scale);
}

// A constant is replaced within 1e-34, four digits below the 1e-30 that evaluate() promises: what multiplies it (a
// length in m, a load in N) may use them up. Replacing as coarsely as allowed keeps the coefficients of the exact
// algebra short.
Rational replacement_tolerance() { return decimal_place(34); }

/// Floating point of a given precision, where a transcendental function is wanted.
class BigFloat {
 public:
  explicit BigFloat(std::size_t bits) {
    core::call_at_thread_end<mpfr_free_cache>();
    mpfr_init2(value_, static_cast<mpfr_prec_t>(bits));
  }
  ~BigFloat() { mpfr_clear(value_); }
  BigFloat(const BigFloat&) = delete;
  BigFloat& operator=(const BigFloat&) = delete;

  mpfr_ptr get() { return value_; }
  Rational rational() const {
    core::ensure(mpfr_number_p(value_) != 0, "the value is finite");
    Rational result;
    mpfr_get_q(result.get_mpq_t(), value_);
    return result;
  }

 private:
  mpfr_t value_;
};

std::size_t bits(const Rational& value) {
  return mpz_sizeinbase(value.get_num_mpz_t(), 2) + mpz_sizeinbase(value.get_den_mpz_t(), 2);
}

/// Throws std::domain_error where a number has grown beyond all use.
RadicalSum checked(RadicalSum sum) {
  if (sum.terms.size() > most_terms) throw std::domain_error("a number of more than 256 different roots");
  std::size_t size = 0;
  for (const auto& [key, coefficient] : sum.terms) size += mpz_sizeinbase(key.get_mpz_t(), 2) + bits(coefficient);
  if (size > largest_result_bits) throw std::domain_error("a number of more than 100000 bits");
  return sum;
}

/// pi within 10^-80.
const Rational& precise_pi() {
  static const Rational value = [] {
    BigFloat pi(272);
    mpfr_const_pi(pi.get(), MPFR_RNDN);
    return pi.rational();
  }();
  return value;
}

/// Nearest rational of short numerator and denominator to sqrt(n), n > 1 an integer.
Rational root_replacement(const Integer& n) {
  constexpr unsigned long digits = 40;
  Integer scale;
  mpz_ui_pow_ui(scale.get_mpz_t(), 10, digits);
  const Integer scaled = sqrt(Integer(n * scale * scale));
  return core::simplest_rational_near(core::reduced(scaled, scale), replacement_tolerance());
}

RadicalSum single(const Integer& key, const Rational& coefficient, bool exact = true) {
  RadicalSum result;
  if (sgn(coefficient) != 0) result.terms.emplace(key, coefficient);
  result.exact = exact;
  return result;
}

RadicalSum replaced(const Rational& value) { return single(rational_key, value, false); }

/// sqrt(p q)/q as c sqrt(n), squares of small primes taken out of n: enough to recognise equal roots that people write.
RadicalSum root_of_rational(const Rational& value) {
  if (sgn(value) < 0) throw std::domain_error("the square root of the negative number " + core::to_string(value));
  if (sgn(value) == 0) return {};
  Integer n = value.get_num() * value.get_den();
  Rational factor(1, value.get_den());
  if (mpz_perfect_square_p(n.get_mpz_t())) return single(rational_key, factor * sqrt(n));
  for (unsigned long prime = 2; prime < 1000; ++prime) {
    while (mpz_divisible_ui_p(n.get_mpz_t(), prime * prime)) {
      n /= prime * prime;
      factor *= prime;
    }
  }
  if (mpz_perfect_square_p(n.get_mpz_t())) return single(rational_key, factor * sqrt(n));
  return single(n, factor);
}

/// sqrt(m) sqrt(n) = g sqrt(m n / g^2) with g = gcd(m, n). Products with pi are outside the form.
std::optional<std::pair<Integer, Rational>> basis_product(const Integer& m, const Integer& n) {
  if (m == rational_key) return std::pair{n, Rational(1)};
  if (n == rational_key) return std::pair{m, Rational(1)};
  if (m == pi_key || n == pi_key) return std::nullopt;
  const Integer common = gcd(m, n);
  return std::pair{Integer((m / common) * (n / common)), Rational(common)};
}

void add_to(RadicalSum& sum, const Integer& key, const Rational& coefficient) {
  Rational& total = sum.terms[key];
  total += coefficient;
  if (sgn(total) == 0) sum.terms.erase(key);
}

RadicalSum integer_power(const RadicalSum& base, long exponent) {
  if (exponent < 0) return radical_sum(1) / integer_power(base, -exponent);
  RadicalSum result = radical_sum(1);
  RadicalSum square = base;
  for (long rest = exponent; rest > 0; rest /= 2) {
    if (rest % 2 == 1) result = result * square;
    if (rest > 1) square = square * square;
  }
  return result;
}

/// The q-th root of a rational, where it is rational.
std::optional<Rational> exact_root(const Rational& value, unsigned long q) {
  Integer numerator, denominator;
  if (!mpz_root(numerator.get_mpz_t(), value.get_num_mpz_t(), q)) return std::nullopt;
  if (!mpz_root(denominator.get_mpz_t(), value.get_den_mpz_t(), q)) return std::nullopt;
  return Rational(numerator, denominator);
}

/// x^y of rationals, x > 0, y not an integer.
RadicalSum fractional_power(const Rational& x, const Rational& y) {
  if (y.get_den() == 2) return integer_power(root_of_rational(x), y.get_num().get_si());
  if (y.get_den() < 100) {
    if (const auto root = exact_root(x, y.get_den().get_ui()))
      return integer_power(radical_sum(*root), y.get_num().get_si());
  }
  const std::size_t precision = 512 + bits(x) + bits(y);
  BigFloat base(precision), exponent(precision);
  mpfr_set_q(base.get(), x.get_mpq_t(), MPFR_RNDN);
  mpfr_set_q(exponent.get(), y.get_mpq_t(), MPFR_RNDN);
  mpfr_pow(base.get(), base.get(), exponent.get(), MPFR_RNDN);
  return replaced(core::simplest_rational_near(base.rational(), replacement_tolerance()));
}

}  // namespace

Rational RadicalSum::coefficient(const Integer& key) const {
  const auto found = terms.find(key);
  return found == terms.end() ? Rational(0) : found->second;
}

RadicalSum radical_sum(const Rational& value) { return single(rational_key, value); }

RadicalSum pi_multiple(const Rational& factor) { return single(pi_key, factor); }

Rational rational_value(const RadicalSum& sum) {
  // Finer than a root: angles in degrees run to large multiples of pi.
  static const Rational pi_replacement = core::simplest_rational_near(precise_pi(), decimal_place(40));
  Rational value = 0;
  for (const auto& [key, coefficient] : sum.terms) {
    if (key == rational_key)
      value += coefficient;
    else
      value += coefficient * (key == pi_key ? pi_replacement : root_replacement(key));
  }
  return value;
}

RadicalSum operator+(const RadicalSum& a, const RadicalSum& b) {
  RadicalSum sum = a;
  for (const auto& [key, coefficient] : b.terms) add_to(sum, key, coefficient);
  sum.exact = a.exact && b.exact;
  return checked(std::move(sum));
}

RadicalSum operator-(const RadicalSum& a) {
  RadicalSum result = a;
  for (auto& [key, coefficient] : result.terms) coefficient = -coefficient;
  return result;
}

RadicalSum operator*(const RadicalSum& a, const RadicalSum& b) {
  RadicalSum result;
  result.exact = a.exact && b.exact;
  for (const auto& [m, p] : a.terms) {
    for (const auto& [n, q] : b.terms) {
      const auto product = basis_product(m, n);
      if (!product) return replaced(rational_value(a) * rational_value(b));
      add_to(result, product->first, p * q * product->second);
    }
  }
  return checked(std::move(result));
}

RadicalSum operator/(const RadicalSum& a, const RadicalSum& b) {
  if (b.terms.empty()) throw std::domain_error("division by zero");
  const bool exact = a.exact && b.exact;
  if (b.terms.size() == 1) {
    const auto& [key, coefficient] = *b.terms.begin();
    if (key != pi_key) {  // 1/(c sqrt(n)) = sqrt(n)/(c n)
      const RadicalSum inverse = single(key, Rational(1) / Rational(coefficient * key), b.exact);
      return a * inverse;
    }
    if (a.terms.empty()) return a;
    if (a.terms.size() == 1 && a.terms.begin()->first == pi_key)
      return single(rational_key, a.terms.begin()->second / coefficient, exact);
  }
  const Rational divisor = rational_value(b);
  if (sgn(divisor) == 0) throw std::domain_error("division by zero");
  return replaced(rational_value(a) / divisor);
}

RadicalSum power(const RadicalSum& base, const RadicalSum& exponent) {
  const Rational y = rational_value(exponent);
  const Rational x = rational_value(base);
  if (base.terms.empty() && sgn(y) < 0) throw std::domain_error("division by zero (0 to a negative power)");
  if (base.terms.empty()) return sgn(y) == 0 ? radical_sum(1) : RadicalSum{{}, base.exact};
  const Rational steps = abs(y);
  if (steps * bits(x) > largest_result_bits) throw std::domain_error("a number of more than 100000 bits");
  if (y.get_den() == 1) return integer_power(base, y.get_num().get_si());
  if (sgn(x) < 0) throw std::domain_error("a fractional power of the negative number " + core::to_string(x));
  RadicalSum result = fractional_power(x, y);
  if (!base.is_rational() || !base.exact || !exponent.is_rational() || !exponent.exact)
    result = replaced(rational_value(result));
  return result;
}

RadicalSum square_root(const RadicalSum& a) {
  if (a.is_rational()) {
    RadicalSum root = root_of_rational(rational_value(a));
    root.exact = root.exact && a.exact;
    return root;
  }
  return replaced(rational_value(root_of_rational(rational_value(a))));
}

CirclePoint circle_point(const RadicalSum& angle) {
  // angle = a + b pi, anything else replaced. Split off quarter turns: angle = k pi/2 + rest, |rest| <= pi/4 or so.
  const Rational b = angle.coefficient(pi_key);
  const Rational a = rational_value(angle + pi_multiple(-b));
  const Rational quarters = 2 * b + 2 * a / precise_pi();
  Integer k;
  const Rational rounded = quarters + Rational(1, 2);
  mpz_fdiv_q(k.get_mpz_t(), rounded.get_num_mpz_t(), rounded.get_den_mpz_t());
  const Rational rest_of_pi = b - Rational(k) / 2;

  CirclePoint point{1, 0, true};
  if (sgn(a) != 0 || sgn(rest_of_pi) != 0) {
    const std::size_t precision = 512 + bits(a) + bits(rest_of_pi);
    BigFloat half(precision), pi(precision);
    mpfr_const_pi(pi.get(), MPFR_RNDN);
    mpfr_mul_q(pi.get(), pi.get(), rest_of_pi.get_mpq_t(), MPFR_RNDN);
    mpfr_add_q(half.get(), pi.get(), a.get_mpq_t(), MPFR_RNDN);
    mpfr_div_2ui(half.get(), half.get(), 1, MPFR_RNDN);
    mpfr_tan(half.get(), half.get(), MPFR_RNDN);
    const Rational t = core::simplest_rational_near(half.rational(), replacement_tolerance() / 2);
    point = {(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t), false};
  }
  const unsigned long turn = mpz_fdiv_ui(k.get_mpz_t(), 4);
  for (unsigned long i = 0; i < turn; ++i) point = {-point.sine, point.cosine, point.exact};
  // cos and sin of a replaced angle are replaced values even where they come out at a quarter turn.
  if (!angle.exact) point.exact = false;
  return point;
}

}  // namespace clearloci::mechanism
