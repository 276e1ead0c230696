#include "symbolic/residue.hpp"

#include <flint/ulong_extras.h>

#include "core/errors.hpp"

namespace clearloci::symbolic {
namespace {

constexpr unsigned long prime = Residue::prime;

unsigned long sum(unsigned long a, unsigned long b) {
  const unsigned long s = a + b;
  return s >= prime ? s - prime : s;
}
unsigned long negative(unsigned long a) { return a == 0 ? 0 : prime - a; }
/// 2^61 = 1 modulo the prime: the upper bits are added to the lower ones.
unsigned long product(unsigned long a, unsigned long b) {
  unsigned long upper = 0, lower = 0;
  umul_ppmm(upper, lower, a, b);
  return sum(lower & prime, upper << 3 | lower >> 61);
}
unsigned long inverse(unsigned long a) { return n_invmod(a, prime); }

/// Zero where there is none, and of zero.
unsigned long root(unsigned long a) { return a == 0 ? 0 : n_sqrtmod(a, prime); }

}  // namespace

Residue Residue::operator-() const { return {negative(real), negative(imaginary)}; }

Residue operator+(const Residue& a, const Residue& b) { return {sum(a.real, b.real), sum(a.imaginary, b.imaginary)}; }

Residue operator*(const Residue& a, const Residue& b) {
  if (a.imaginary == 0 && b.imaginary == 0) return {product(a.real, b.real), 0};
  return {sum(product(a.real, b.real), negative(product(a.imaginary, b.imaginary))),
          sum(product(a.real, b.imaginary), product(a.imaginary, b.real))};
}

Residue power(const Residue& a, int exponent) {
  Residue result{1, 0};
  for (Residue factor = a; exponent > 0; exponent /= 2, factor = factor * factor)
    if (exponent % 2 == 1) result = result * factor;
  return result;
}

Residue inverse(const Residue& a) {
  const unsigned long norm = sum(product(a.real, a.real), product(a.imaginary, a.imaginary));
  const unsigned long below = inverse(norm);
  return {product(a.real, below), product(negative(a.imaginary), below)};
}

std::optional<Residue> square_root(const Residue& a) {
  if (a.is_zero()) return a;
  if (a.imaginary == 0) {  // either a or -a = a i^2 is a square modulo the prime
    if (const unsigned long real = root(a.real); real != 0) return Residue{real, 0};
    return Residue{0, root(negative(a.real))};
  }
  // (u + v i)^2 = a: u^2 - v^2 = Re a and u^2 + v^2 = n with n^2 = |a|^2, so u^2 = (Re a + n) / 2.
  const unsigned long norm = root(sum(product(a.real, a.real), product(a.imaginary, a.imaginary)));
  if (norm == 0) return std::nullopt;
  const unsigned long half = inverse(2UL);
  for (const unsigned long n : {norm, negative(norm)}) {
    const unsigned long u = root(product(sum(a.real, n), half));
    if (u != 0) return Residue{u, product(product(a.imaginary, half), inverse(u))};
  }
  return std::nullopt;
}

unsigned long residue(const core::Rational& value) {
  const unsigned long top = mpz_fdiv_ui(value.get_num_mpz_t(), prime);
  const unsigned long bottom = mpz_fdiv_ui(value.get_den_mpz_t(), prime);
  core::ensure(bottom != 0, "a denominator that the prime does not divide");
  return bottom == 1 ? top : product(top, inverse(bottom));
}

}  // namespace clearloci::symbolic
