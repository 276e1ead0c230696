// Polynomials over Q with named variables: a thin, value-semantic coat over FLINT's fmpq_mpoly.
// Private to symbolic/: FLINT must not show in headers that other folders include.
#pragma once

#include <flint/fmpq_mpoly.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/polynomial.hpp"

namespace clearloci::symbolic {

class Poly;

/// Q[v0, v1, ...] in lexicographic order, v0 first.
class Ring {
 public:
  explicit Ring(std::vector<std::string> names);
  ~Ring();
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  int size() const { return static_cast<int>(names_.size()); }
  const std::vector<std::string>& names() const { return names_; }
  const std::string& name(int variable) const { return names_[static_cast<std::size_t>(variable)]; }
  /// Index of a variable; -1 if there is none of that name.
  int index(const std::string& name) const;

  const fmpq_mpoly_ctx_struct* context() const { return context_; }

 private:
  std::vector<std::string> names_;
  mutable fmpq_mpoly_ctx_t context_;
};

/// One irreducible factor and its multiplicity.
struct PolyFactor;

class Poly {
 public:
  explicit Poly(const Ring& ring, const core::Rational& value = 0);
  static Poly variable(const Ring& ring, int index);
  Poly(const Poly& other);
  Poly(Poly&& other) noexcept;
  Poly& operator=(Poly other) noexcept;
  ~Poly();

  const Ring& ring() const { return *ring_; }

  Poly& operator+=(const Poly& other);
  Poly& operator-=(const Poly& other);
  Poly& operator*=(const Poly& other);
  friend Poly operator+(const Poly& a, const Poly& b);
  friend Poly operator-(const Poly& a, const Poly& b);
  friend Poly operator*(const Poly& a, const Poly& b);
  Poly operator-() const;
  Poly scaled(const core::Rational& factor) const;
  Poly pow(unsigned exponent) const;
  /// Of a long polynomial in little more than half of the time of a product.
  Poly squared() const;
  /// Also of rings of the same variables.
  bool operator==(const Poly& other) const;
  /// The same in another ring of the same variables.
  Poly in(const Ring& ring) const;

  bool is_zero() const;
  bool is_constant() const;
  /// Requires is_constant().
  core::Rational constant() const;
  std::size_t length() const;
  int degree(int variable) const;
  int total_degree() const;
  /// The largest sum of the exponents of some variables; 0 for the zero polynomial.
  int degree(const std::vector<int>& variables) const;
  /// The largest sum of the exponents of all variables, each times its weight.
  double weighted_degree(const std::vector<double>& weights) const;
  bool depends_on(int variable) const { return degree(variable) > 0; }

  /// The quotient if `divisor` divides exactly; false otherwise, leaving `quotient` unspecified.
  bool divides(const Poly& divisor, Poly& quotient) const;
  /// The exact quotient; ensures that there is one.
  Poly exact_quotient(const Poly& divisor) const;

  /// With a number in the place of a variable.
  Poly at(int variable, const core::Rational& value) const;

  /// Coefficients c_0, c_1, ... of the powers of one variable.
  std::vector<Poly> coefficients(int variable) const;

  /// Coprime integer coefficients, leading one positive.
  Poly primitive() const;
  Poly derivative(int variable) const;

  /// All irreducible factors, primitive, in a deterministic order; `constant` takes the rest. The zero polynomial has
  /// none and constant 0.
  std::vector<PolyFactor> factors(core::Rational& constant) const;

  friend Poly gcd(const Poly& a, const Poly& b);

  /// The square root, up to sign, of a polynomial that is the square of another; false if it is none.
  bool square_root(Poly& root) const;

  /// As plain data in the listed variables; no other may occur.
  core::Polynomial plain(const std::vector<int>& variables) const;
  /// As plain data in all variables of the ring.
  core::Polynomial plain() const;

  fmpq_mpoly_struct* raw() { return value_; }
  const fmpq_mpoly_struct* raw() const { return value_; }

 private:
  /// The last one of which the polynomial has this degree; -1 where there is none.
  int variable_of_degree(int wanted) const;
  /// An irreducible factor that is linear or quadratic in some variable, of multiplicity 1, is divided out; nothing
  /// where there is none to be had quickly. Required: no constant.
  std::optional<PolyFactor> take_low_factor();
  /// Both factors of a polynomial in the square of some variable that is f(v) f(-v) with f irreducible and quadratic in
  /// it, as norms of two mirrored circles are; none where it is not seen to be.
  std::vector<PolyFactor> mirrored_factors() const;

  const Ring* ring_;
  mutable fmpq_mpoly_t value_;
};

struct PolyFactor {
  Poly poly;
  int multiplicity = 1;
};

/// By degree, then by the terms: an order that depends on nothing but the factors.
void sort_factors(std::vector<PolyFactor>& factors);

}  // namespace clearloci::symbolic
