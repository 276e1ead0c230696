#include "loci/numbers/square_free.hpp"

#include <flint/fmpz_mpoly_factor.h>

#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/thread_end.hpp"

namespace clearloci::loci {
namespace {

/// FLINT's structures for one call, which free themselves.
class SquareFree {
 public:
  explicit SquareFree(const core::Polynomial& p) : variables_(static_cast<std::size_t>(p.variables)) {
    core::call_at_thread_end<flint_cleanup>();
    fmpz_mpoly_ctx_init(context_, p.variables, ORD_LEX);
    fmpz_mpoly_init(value_, context_);
    fmpz_mpoly_factor_init(parts_, context_);
    fmpz_init(coefficient_);
  }
  ~SquareFree() {
    fmpz_clear(coefficient_);
    fmpz_mpoly_factor_clear(parts_, context_);
    fmpz_mpoly_clear(value_, context_);
    fmpz_mpoly_ctx_clear(context_);
  }
  SquareFree(const SquareFree&) = delete;
  SquareFree& operator=(const SquareFree&) = delete;

  core::Polynomial of(const core::Polynomial& p) {
    const core::Polynomial whole = core::primitive_part(p);
    std::vector<ulong> exponents(variables_);
    for (const core::Term& term : whole.terms) {
      for (std::size_t v = 0; v < variables_; ++v) exponents[v] = static_cast<ulong>(term.exponents[v]);
      fmpz_set_mpz(coefficient_, term.coefficient.get_num_mpz_t());
      fmpz_mpoly_push_term_fmpz_ui(value_, coefficient_, exponents.data(), context_);
    }
    fmpz_mpoly_sort_terms(value_, context_);
    core::ensure(fmpz_mpoly_factor_squarefree(parts_, value_, context_) != 0, "factors without squares");
    fmpz_mpoly_one(value_, context_);
    for (slong i = 0; i < fmpz_mpoly_factor_length(parts_, context_); ++i)
      fmpz_mpoly_mul(value_, value_, parts_->poly + i, context_);
    core::Polynomial product{p.variables, {}};
    for (slong i = 0; i < fmpz_mpoly_length(value_, context_); ++i) {
      fmpz_mpoly_get_term_exp_ui(exponents.data(), value_, i, context_);
      fmpz_mpoly_get_term_coeff_fmpz(coefficient_, value_, i, context_);
      core::Term term{std::vector<int>(variables_), {}};
      for (std::size_t v = 0; v < variables_; ++v) term.exponents[v] = static_cast<int>(exponents[v]);
      core::Integer number;
      fmpz_get_mpz(number.get_mpz_t(), coefficient_);
      term.coefficient = number;
      product.terms.push_back(std::move(term));
    }
    return core::primitive_part(product);
  }

 private:
  std::size_t variables_;
  fmpz_mpoly_ctx_t context_;
  fmpz_mpoly_t value_;
  fmpz_mpoly_factor_t parts_;
  fmpz_t coefficient_;
};

}  // namespace

core::Polynomial square_free(const core::Polynomial& p) {
  core::ensure(!p.is_zero(), "a polynomial that is not zero");
  return SquareFree(p).of(p);
}

}  // namespace clearloci::loci
