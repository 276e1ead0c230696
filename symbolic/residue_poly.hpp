// Polynomials modulo the prime 2^61 - 1: images of those with rational coefficients, which may have thousands of
// digits. A thin, value-semantic coat over FLINT's nmod_mpoly. Private to symbolic/.
#pragma once

#include <flint/nmod_mpoly.h>

#include <vector>

#include "symbolic/ring.hpp"

namespace clearloci::symbolic {

class ResidueRing {
 public:
  explicit ResidueRing(int variables);
  ~ResidueRing();
  ResidueRing(const ResidueRing&) = delete;
  ResidueRing& operator=(const ResidueRing&) = delete;

  const nmod_mpoly_ctx_struct* context() const { return context_; }

 private:
  nmod_mpoly_ctx_t context_;
};

/// With the functions of Poly, which mean the same.
class ResiduePoly {
 public:
  explicit ResiduePoly(const ResidueRing& ring, const core::Rational& value = 0);
  /// Of a polynomial in as many variables.
  ResiduePoly(const ResidueRing& ring, const Poly& p);
  static ResiduePoly variable(const ResidueRing& ring, int index);
  ResiduePoly(const ResiduePoly& other);
  ResiduePoly(ResiduePoly&& other) noexcept;
  ResiduePoly& operator=(ResiduePoly other) noexcept;
  ~ResiduePoly();

  const ResidueRing& ring() const { return *ring_; }

  ResiduePoly& operator+=(const ResiduePoly& other);
  ResiduePoly& operator*=(const ResiduePoly& other);
  friend ResiduePoly operator+(const ResiduePoly& a, const ResiduePoly& b);
  friend ResiduePoly operator-(const ResiduePoly& a, const ResiduePoly& b);
  friend ResiduePoly operator*(const ResiduePoly& a, const ResiduePoly& b);

  bool is_zero() const;
  bool is_constant() const;
  int degree(int variable) const;
  int degree(const std::vector<int>& variables) const;
  double weighted_degree(const std::vector<double>& weights) const;
  bool depends_on(int variable) const { return degree(variable) > 0; }
  bool divides(const ResiduePoly& divisor, ResiduePoly& quotient) const;
  std::vector<ResiduePoly> coefficients(int variable) const;

  friend ResiduePoly gcd(const ResiduePoly& a, const ResiduePoly& b);

 private:
  const ResidueRing* ring_;
  mutable nmod_mpoly_t value_;
};

}  // namespace clearloci::symbolic
