#include "loci/modular_gcd.hpp"

#include <cstdint>

#include "core/errors.hpp"

namespace clearloci::loci {
namespace {

using core::Integer;

/// Coefficients modulo a prime below 2^31, from the constant term up, the last one not 0; empty: zero.
using Residues = std::vector<std::uint64_t>;

std::uint64_t residue(const Integer& value, std::uint64_t prime) {
  return mpz_fdiv_ui(value.get_mpz_t(), static_cast<unsigned long>(prime));
}

std::uint64_t power(std::uint64_t base, std::uint64_t exponent, std::uint64_t prime) {
  std::uint64_t result = 1;
  for (; exponent > 0; exponent /= 2, base = base * base % prime)
    if (exponent % 2 == 1) result = result * base % prime;
  return result;
}

std::uint64_t inverse(std::uint64_t value, std::uint64_t prime) { return power(value, prime - 2, prime); }

Residues residues(const Univariate& p, std::uint64_t prime) {
  Residues result;
  for (const Integer& c : p) result.push_back(residue(c, prime));
  while (!result.empty() && result.back() == 0) result.pop_back();
  return result;
}

/// Monic.
Residues gcd_modulo(Residues a, Residues b, std::uint64_t prime) {
  while (!b.empty()) {
    const std::uint64_t lead = inverse(b.back(), prime);
    while (a.size() >= b.size()) {
      const std::uint64_t factor = prime - a.back() * lead % prime;
      const std::size_t shift = a.size() - b.size();
      for (std::size_t i = 0; i < b.size(); ++i) a[shift + i] = (a[shift + i] + factor * b[i]) % prime;
      while (!a.empty() && a.back() == 0) a.pop_back();
    }
    std::swap(a, b);
  }
  const std::uint64_t lead = inverse(a.back(), prime);
  for (std::uint64_t& c : a) c = c * lead % prime;
  return a;
}

bool divides(const Univariate& divisor, Univariate p) {
  while (p.size() >= divisor.size()) {
    if (!mpz_divisible_p(p.back().get_mpz_t(), divisor.back().get_mpz_t())) return false;
    const Integer factor = p.back() / divisor.back();
    const std::size_t shift = p.size() - divisor.size();
    for (std::size_t i = 0; i < divisor.size(); ++i) p[shift + i] -= factor * divisor[i];
    while (!p.empty() && p.back() == 0) p.pop_back();
  }
  return p.empty();
}

/// The multiple of the common divisor with a known leading coefficient, modulo the product of the primes so far.
class Reconstruction {
 public:
  bool empty() const { return image_.empty(); }
  std::size_t size() const { return image_.size(); }

  void start() {
    image_.clear();
    modulus_ = 1;
  }

  /// False where the new prime changes nothing: then the coefficients are likely found.
  bool join(const Residues& image, std::uint64_t prime) {
    if (image_.empty()) image_.resize(image.size());
    const std::uint64_t inverse_modulus = inverse(residue(modulus_, prime), prime);
    bool changed = false;
    for (std::size_t i = 0; i < image.size(); ++i) {
      const std::uint64_t missing = (image[i] + prime - residue(image_[i], prime)) % prime * inverse_modulus % prime;
      if (missing == 0) continue;
      changed = true;
      // Of the two numbers next to 0 the nearer one.
      const Integer step(static_cast<unsigned long>(missing));
      image_[i] += modulus_ * (2 * missing > prime ? Integer(step - static_cast<unsigned long>(prime)) : step);
    }
    modulus_ *= static_cast<unsigned long>(prime);
    return changed;
  }

  Univariate primitive() const {
    Integer content = 0;
    for (const Integer& c : image_) content = gcd(content, c);
    if (image_.back() < 0) content = -content;
    Univariate result = image_;
    for (Integer& c : result) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), content.get_mpz_t());
    return result;
  }

 private:
  Univariate image_;
  Integer modulus_ = 1;
};

}  // namespace

Univariate modular_gcd(const Univariate& a, const Univariate& b) {
  core::ensure(!a.empty() && !b.empty(), "polynomials that are not zero");
  const Integer lead = gcd(a.back(), b.back());
  Reconstruction found;
  Integer prime = Integer(1) << 30;
  while (true) {
    mpz_nextprime(prime.get_mpz_t(), prime.get_mpz_t());
    const std::uint64_t p = prime.get_ui();
    const std::uint64_t lead_residue = residue(lead, p);
    if (lead_residue == 0) continue;
    Residues image = gcd_modulo(residues(a, p), residues(b, p), p);
    // Never of less degree than the common divisor; of more modulo a few primes.
    if (image.size() == 1) return {Integer(1)};
    if (!found.empty() && image.size() > found.size()) continue;
    if (!found.empty() && image.size() < found.size()) found.start();
    for (std::uint64_t& c : image) c = c * lead_residue % p;
    if (found.join(image, p)) continue;
    Univariate divisor = found.primitive();
    if (divides(divisor, a) && divides(divisor, b)) return divisor;
  }
}

}  // namespace clearloci::loci
