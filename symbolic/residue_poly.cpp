#include "symbolic/residue_poly.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "core/thread_end.hpp"
#include "symbolic/residue.hpp"

namespace clearloci::symbolic {

ResidueRing::ResidueRing(int variables) {
  core::call_at_thread_end<flint_cleanup>();
  nmod_mpoly_ctx_init(context_, variables, ORD_LEX, Residue::prime);
}

ResidueRing::~ResidueRing() { nmod_mpoly_ctx_clear(context_); }

ResiduePoly::ResiduePoly(const ResidueRing& ring, const core::Rational& value) : ring_(&ring) {
  nmod_mpoly_init(value_, ring.context());
  nmod_mpoly_set_ui(value_, residue(value), ring.context());
}

ResiduePoly::ResiduePoly(const ResidueRing& ring, const Poly& p) : ring_(&ring) {
  nmod_mpoly_init(value_, ring.context());
  const fmpz_mpoly_ctx_struct* const whole = p.ring().context()->zctx;
  core::ensure(p.ring().size() == nmod_mpoly_ctx_nvars(ring.context()), "a ring of as many variables");
  const fmpz_mpoly_struct* const terms = p.raw()->zpoly;
  const ulong below = fmpz_fdiv_ui(fmpq_denref(p.raw()->content), Residue::prime);
  core::ensure(below != 0, "a denominator that the prime does not divide");
  std::vector<ulong> exponents(static_cast<std::size_t>(p.ring().size()));
  for (slong term = 0; term < fmpz_mpoly_length(terms, whole); ++term) {
    const ulong coefficient = fmpz_fdiv_ui(terms->coeffs + term, Residue::prime);
    if (coefficient == 0) continue;
    fmpz_mpoly_get_term_exp_ui(exponents.data(), terms, term, whole);
    nmod_mpoly_push_term_ui_ui(value_, coefficient, exponents.data(), ring.context());
  }
  const Residue content =
      Residue{fmpz_fdiv_ui(fmpq_numref(p.raw()->content), Residue::prime), 0} * inverse(Residue{below, 0});
  nmod_mpoly_scalar_mul_ui(value_, value_, content.real, ring.context());
}

ResiduePoly ResiduePoly::variable(const ResidueRing& ring, int index) {
  ResiduePoly result(ring);
  nmod_mpoly_gen(result.value_, index, ring.context());
  return result;
}

ResiduePoly::ResiduePoly(const ResiduePoly& other) : ring_(other.ring_) {
  nmod_mpoly_init(value_, ring_->context());
  nmod_mpoly_set(value_, other.value_, ring_->context());
}

ResiduePoly::ResiduePoly(ResiduePoly&& other) noexcept : ring_(other.ring_) {
  nmod_mpoly_init(value_, ring_->context());
  nmod_mpoly_swap(value_, other.value_, ring_->context());
}

ResiduePoly& ResiduePoly::operator=(ResiduePoly other) noexcept {
  std::swap(ring_, other.ring_);
  std::swap(*value_, *other.value_);
  return *this;
}

ResiduePoly::~ResiduePoly() { nmod_mpoly_clear(value_, ring_->context()); }

ResiduePoly& ResiduePoly::operator+=(const ResiduePoly& other) {
  nmod_mpoly_add(value_, value_, other.value_, ring_->context());
  return *this;
}

ResiduePoly& ResiduePoly::operator*=(const ResiduePoly& other) {
  nmod_mpoly_mul(value_, value_, other.value_, ring_->context());
  return *this;
}

ResiduePoly operator+(const ResiduePoly& a, const ResiduePoly& b) {
  ResiduePoly result(*a.ring_);
  nmod_mpoly_add(result.value_, a.value_, b.value_, a.ring_->context());
  return result;
}

ResiduePoly operator-(const ResiduePoly& a, const ResiduePoly& b) {
  ResiduePoly result(*a.ring_);
  nmod_mpoly_sub(result.value_, a.value_, b.value_, a.ring_->context());
  return result;
}

ResiduePoly operator*(const ResiduePoly& a, const ResiduePoly& b) {
  ResiduePoly result(*a.ring_);
  nmod_mpoly_mul(result.value_, a.value_, b.value_, a.ring_->context());
  return result;
}

bool ResiduePoly::is_zero() const { return nmod_mpoly_is_zero(value_, ring_->context()) != 0; }

bool ResiduePoly::is_constant() const { return nmod_mpoly_is_ui(value_, ring_->context()) != 0; }

int ResiduePoly::degree(int variable) const {
  return static_cast<int>(nmod_mpoly_degree_si(value_, variable, ring_->context()));
}

int ResiduePoly::degree(const std::vector<int>& variables) const {
  std::vector<double> weights(static_cast<std::size_t>(nmod_mpoly_ctx_nvars(ring_->context())), 0.0);
  for (const int variable : variables) weights[static_cast<std::size_t>(variable)] = 1;
  return static_cast<int>(weighted_degree(weights));
}

double ResiduePoly::weighted_degree(const std::vector<double>& weights) const {
  double largest = 0;
  std::vector<ulong> exponents(static_cast<std::size_t>(nmod_mpoly_ctx_nvars(ring_->context())));
  for (slong term = 0; term < nmod_mpoly_length(value_, ring_->context()); ++term) {
    nmod_mpoly_get_term_exp_ui(exponents.data(), value_, term, ring_->context());
    double sum = 0;
    for (std::size_t v = 0; v < weights.size(); ++v) sum += weights[v] * static_cast<double>(exponents[v]);
    largest = std::max(largest, sum);
  }
  return largest;
}

bool ResiduePoly::divides(const ResiduePoly& divisor, ResiduePoly& quotient) const {
  // Of FLINT's ways the one that ends at the first term that does not fit: most divisions do not come out.
  if (divisor.is_zero()) return is_zero();
  return nmod_mpoly_divides_monagan_pearce(quotient.value_, value_, divisor.value_, ring_->context()) != 0;
}

std::vector<ResiduePoly> ResiduePoly::coefficients(int variable) const {
  const auto degree = static_cast<std::size_t>(std::max(this->degree(variable), 0));
  if (degree == 0) return {1, *this};
  std::vector<ResiduePoly> result(degree + 1, ResiduePoly(*ring_));
  std::vector<ulong> exponents(static_cast<std::size_t>(nmod_mpoly_ctx_nvars(ring_->context())));
  for (slong term = 0; term < nmod_mpoly_length(value_, ring_->context()); ++term) {
    nmod_mpoly_get_term_exp_ui(exponents.data(), value_, term, ring_->context());
    const ulong power = std::exchange(exponents[static_cast<std::size_t>(variable)], 0);
    // Terms of one power keep their order when the power is taken out, so pushing keeps each list sorted.
    nmod_mpoly_push_term_ui_ui(result[power].value_, nmod_mpoly_get_term_coeff_ui(value_, term, ring_->context()),
                               exponents.data(), ring_->context());
  }
  return result;
}

ResiduePoly gcd(const ResiduePoly& a, const ResiduePoly& b) {
  ResiduePoly result(*a.ring_);
  core::ensure(nmod_mpoly_gcd(result.value_, a.value_, b.value_, a.ring_->context()) != 0, "a gcd modulo a prime");
  return result;
}

}  // namespace clearloci::symbolic
