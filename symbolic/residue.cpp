#include "symbolic/residue.hpp"

#include <flint/ulong_extras.h>

#include <bit>

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

namespace {

using Element = Extension::Element;

Element lower_half(const Element& a) { return {a.begin(), a.begin() + static_cast<std::ptrdiff_t>(a.size() / 2)}; }
Element upper_half(const Element& a) { return {a.begin() + static_cast<std::ptrdiff_t>(a.size() / 2), a.end()}; }

/// low + high t, where t is the root of elements of twice the size of `half`.
Element joined(Element low, Element high, std::size_t half) {
  low.resize(half);
  high.resize(half);
  low.insert(low.end(), high.begin(), high.end());
  return low;
}

Element opposite(Element a) {
  for (Residue& part : a) part = -part;
  return a;
}

}  // namespace

const Element& Extension::square_of(std::size_t size) const {
  return squares_[static_cast<std::size_t>(std::countr_zero(size)) - 1];
}

Element Extension::adjoin(Element square) {
  squares_.push_back(std::move(square));
  return joined({}, {{1, 0}}, std::size_t{1} << (squares_.size() - 1));
}

Element Extension::add(const Element& a, const Element& b) {
  Element sum = a.size() < b.size() ? b : a;
  const Element& other = a.size() < b.size() ? a : b;
  for (std::size_t i = 0; i < other.size(); ++i) sum[i] = sum[i] + other[i];
  return sum;
}

Element Extension::multiply(const Element& a, const Element& b) const {
  if (a.size() < b.size()) return multiply(b, a);
  Element product(a.size()), scratch(b.size() > 1 ? 3 * a.size() : 0);
  multiply(a, b, product, scratch);
  return product;
}

/// a0 + a1 t times b0 + b1 t is a0 b0 + a1 b1 t^2 + (a0 b1 + a1 b0) t.
void Extension::multiply(std::span<const Residue> a, std::span<const Residue> b, std::span<Residue> product,
                         std::span<Residue> scratch) const {
  if (a.size() < b.size()) return multiply(b, a, product, scratch);
  if (b.size() == 1) {
    for (std::size_t i = 0; i < a.size(); ++i) product[i] = a[i] * b[0];
    return;
  }
  const std::size_t half = a.size() / 2;
  const auto a0 = a.first(half), a1 = a.last(half);
  const auto low = product.first(half), high = product.last(half);
  if (b.size() < a.size()) {
    multiply(a0, b, low, scratch);
    multiply(a1, b, high, scratch);
    return;
  }
  const auto b0 = b.first(half), b1 = b.last(half);
  const auto part = scratch.first(half), other = scratch.subspan(half, half), rest = scratch.subspan(2 * half);
  const auto add_to = [](std::span<Residue> sum, std::span<const Residue> term) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] + term[i];
  };
  multiply(a0, b0, low, rest);
  multiply(a1, b1, part, rest);
  multiply(part, square_of(a.size()), other, rest);
  add_to(low, other);
  multiply(a0, b1, high, rest);
  multiply(a1, b0, part, rest);
  add_to(high, part);
}

Element Extension::conjugate_product(const Element& a) const {
  const Element a0 = lower_half(a), a1 = upper_half(a);
  Element product = add(multiply(a0, a0), opposite(multiply(multiply(a1, a1), square_of(a.size()))));
  product.resize(a.size() / 2);
  return product;
}

Residue Extension::norm(const Element& a) const { return a.size() == 1 ? a[0] : norm(conjugate_product(a)); }

std::optional<Element> Extension::inverse(const Element& a) const {
  if (a.size() == 1) return a[0].is_zero() ? std::nullopt : std::optional(Element{symbolic::inverse(a[0])});
  const std::optional<Element> below = inverse(conjugate_product(a));
  if (!below) return std::nullopt;
  return multiply(joined(lower_half(a), opposite(upper_half(a)), a.size() / 2), *below);
}

}  // namespace clearloci::symbolic
