#include "symbolic/ring.hpp"

#include <flint/fmpq_mpoly_factor.h>
#include <flint/nmod_mpoly_factor.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "clearloci/work_limit.hpp"
#include "core/errors.hpp"
#include "core/thread_end.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;

/// A FLINT rational that frees itself.
class Fmpq {
 public:
  Fmpq() { fmpq_init(value_); }
  explicit Fmpq(const Rational& value) : Fmpq() { fmpq_set_mpq(value_, value.get_mpq_t()); }
  ~Fmpq() { fmpq_clear(value_); }
  Fmpq(const Fmpq&) = delete;
  Fmpq& operator=(const Fmpq&) = delete;
  fmpq* get() { return value_; }
  Rational rational() const {
    Rational result;
    fmpq_get_mpq(result.get_mpq_t(), value_);
    return result;
  }

 private:
  fmpq_t value_;
};

std::vector<ulong> exponents_of(const Poly& p, slong term) {
  std::vector<ulong> exponents(static_cast<std::size_t>(p.ring().size()));
  fmpq_mpoly_get_term_exp_ui(exponents.data(), p.raw(), term, p.ring().context());
  return exponents;
}

/// Terms of a polynomial times the bits of its longest coefficient, from which on its image modulo a prime costs next
/// to nothing beside its own factorisation.
constexpr std::size_t worth_an_image = 100000;

/// Terms of a polynomial whose discriminant is no longer than what its factorisation makes.
constexpr std::size_t short_enough = 200;

/// Terms of which the square is a product like any other.
constexpr slong short_square = 24;

/// Whether FLINT multiplies it with itself as if it had all terms: it does where that takes far fewer of them than
/// there are products, and then halves gain nothing.
bool has_dense_square(const fmpz_mpoly_struct* p, const fmpz_mpoly_ctx_struct* context) {
  constexpr double products_a_term = 32;
  std::vector<slong> degrees(static_cast<std::size_t>(context->minfo->nvars));
  fmpz_mpoly_degrees_si(degrees.data(), p, context);
  double terms = 1;
  for (const slong degree : degrees) terms *= 2 * static_cast<double>(degree) + 1;
  return static_cast<double>(p->length) * static_cast<double>(p->length) > products_a_term * terms;
}

/// (u + v)^2 = u^2 + v^2 + 2 u v with half of the terms in each: products of two terms are formed once, not twice.
void square(fmpz_mpoly_t result, const fmpz_mpoly_struct* p, const fmpz_mpoly_ctx_struct* context) {
  if (p->length <= short_square) {
    fmpz_mpoly_mul(result, p, p, context);
    return;
  }
  const slong half = p->length / 2, words = mpoly_words_per_exp(p->bits, context->minfo);
  fmpz_mpoly_struct u = *p, v = *p;  // read alone
  u.length = half;
  v.coeffs += half;
  v.exps += words * half;
  v.length -= half;
  fmpz_mpoly_t part;
  fmpz_mpoly_init(part, context);
  fmpz_mpoly_mul(result, &u, &v, context);
  fmpz_mpoly_scalar_mul_ui(result, result, 2, context);
  square(part, &u, context);
  fmpz_mpoly_add(result, result, part, context);
  square(part, &v, context);
  fmpz_mpoly_add(result, result, part, context);
  fmpz_mpoly_clear(part, context);
}

/// A number for a variable, the same in every run.
ulong scattered(slong variable, ulong prime) {
  nmod_t modulus;
  nmod_init(&modulus, prime);
  return nmod_pow_ui(1000003, static_cast<ulong>(variable) + 2, modulus);
}

/// Whether the image in two variables, or in one where they are the same, modulo a prime and with numbers for the
/// others, keeps both degrees and is irreducible.
bool is_irreducible_on_plane(const fmpz_mpoly_struct* p, const fmpz_mpoly_ctx_struct* whole,
                             const std::array<slong, 2>& plane, ulong prime) {
  const slong variables = fmpz_mpoly_ctx_nvars(whole);
  nmod_mpoly_ctx_t residues;
  nmod_mpoly_ctx_init(residues, 2, ORD_LEX, prime);
  nmod_mpoly_t image;
  nmod_mpoly_init(image, residues);
  std::vector<ulong> exponents(static_cast<std::size_t>(variables)), numbers(exponents.size());
  for (slong v = 0; v < variables; ++v) numbers[static_cast<std::size_t>(v)] = scattered(v, prime);
  fmpz_t coefficient;
  fmpz_init(coefficient);
  for (slong term = 0; term < fmpz_mpoly_length(p, whole); ++term) {
    fmpz_mpoly_get_term_exp_ui(exponents.data(), p, term, whole);
    fmpz_mpoly_get_term_coeff_fmpz(coefficient, p, term, whole);
    ulong residue = fmpz_fdiv_ui(coefficient, prime);
    for (slong v = 0; v < variables; ++v) {
      const auto i = static_cast<std::size_t>(v);
      if (exponents[i] > 0 && v != plane[0] && v != plane[1])
        residue = nmod_mul(residue, nmod_pow_ui(numbers[i], exponents[i], residues->mod), residues->mod);
    }
    const std::array<ulong, 2> kept = {exponents[static_cast<std::size_t>(plane[0])],
                                       plane[0] == plane[1] ? 0 : exponents[static_cast<std::size_t>(plane[1])]};
    if (residue != 0) nmod_mpoly_push_term_ui_ui(image, residue, kept.data(), residues);
  }
  fmpz_clear(coefficient);
  nmod_mpoly_sort_terms(image, residues);
  nmod_mpoly_combine_like_terms(image, residues);
  bool irreducible =
      nmod_mpoly_degree_si(image, 0, residues) == fmpz_mpoly_degree_si(p, plane[0], whole) &&
      (plane[0] == plane[1] || nmod_mpoly_degree_si(image, 1, residues) == fmpz_mpoly_degree_si(p, plane[1], whole));
  nmod_mpoly_factor_t parts;
  nmod_mpoly_factor_init(parts, residues);
  irreducible = irreducible && nmod_mpoly_factor(parts, image, residues) != 0 &&
                nmod_mpoly_factor_length(parts, residues) == 1 && nmod_mpoly_factor_get_exp_si(parts, 0, residues) == 1;
  nmod_mpoly_factor_clear(parts, residues);
  nmod_mpoly_clear(image, residues);
  nmod_mpoly_ctx_clear(residues);
  return irreducible;
}

/// True is certain; false says nothing. Irreducible polynomials with long coefficients are the slow ones to factor,
/// since lifted factors recombine to nothing.
///
/// Of two factors either both hold the variable x, and every image that keeps its degrees is a product; or one holds
/// another variable v and not x, and the image in x and v is.
bool is_seen_irreducible(const fmpz_mpoly_struct* p, const Ring& ring) {
  const fmpz_mpoly_ctx_struct* const whole = ring.context()->zctx;
  const auto bits = static_cast<std::size_t>(std::abs(fmpz_mpoly_max_bits(p)));
  if (bits * static_cast<std::size_t>(fmpz_mpoly_length(p, whole)) < worth_an_image) return false;
  std::vector<slong> held;
  for (slong v = 0; v < ring.size(); ++v)
    if (fmpz_mpoly_degree_si(p, v, whole) > 0) held.push_back(v);
  const auto x = std::min_element(held.begin(), held.end(), [&](slong a, slong b) {
    return fmpz_mpoly_degree_si(p, a, whole) < fmpz_mpoly_degree_si(p, b, whole);
  });
  // The largest below 2^62: most images of an irreducible polynomial are irreducible modulo a large prime.
  constexpr std::array<ulong, 2> primes = {4611686018427387847, 4611686018427387817};
  return std::all_of(held.begin(), held.end(), [&](slong v) {
    if (v == *x && held.size() > 1) return true;
    return std::any_of(primes.begin(), primes.end(), [&](ulong prime) {
      return is_irreducible_on_plane(p, whole, {*x, v}, prime);
    });
  });
}

}  // namespace

Ring::Ring(std::vector<std::string> names) : names_(std::move(names)) {
  core::call_at_thread_end<flint_cleanup>();
  fmpq_mpoly_ctx_init(context_, static_cast<slong>(names_.size()), ORD_LEX);
}

Ring::~Ring() { fmpq_mpoly_ctx_clear(context_); }

int Ring::index(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
}

Poly::Poly(const Ring& ring, const Rational& value) : ring_(&ring) {
  core::call_at_thread_end<flint_cleanup>();
  fmpq_mpoly_init(value_, ring.context());
  if (value != 0) fmpq_mpoly_set_fmpq(value_, Fmpq(value).get(), ring.context());
}

Poly Poly::variable(const Ring& ring, int index) {
  Poly result(ring);
  fmpq_mpoly_gen(result.value_, index, ring.context());
  return result;
}

Poly::Poly(const Poly& other) : ring_(other.ring_) {
  fmpq_mpoly_init(value_, ring_->context());
  fmpq_mpoly_set(value_, other.value_, ring_->context());
}

Poly::Poly(Poly&& other) noexcept : ring_(other.ring_) {
  fmpq_mpoly_init(value_, ring_->context());
  fmpq_mpoly_swap(value_, other.value_, ring_->context());
}

Poly& Poly::operator=(Poly other) noexcept {
  std::swap(ring_, other.ring_);
  std::swap(*value_, *other.value_);
  return *this;
}

Poly::~Poly() { fmpq_mpoly_clear(value_, ring_->context()); }

Poly& Poly::operator+=(const Poly& other) {
  fmpq_mpoly_add(value_, value_, other.value_, ring_->context());
  return *this;
}

Poly& Poly::operator-=(const Poly& other) {
  fmpq_mpoly_sub(value_, value_, other.value_, ring_->context());
  return *this;
}

Poly& Poly::operator*=(const Poly& other) {
  core::WorkLimit::check();
  fmpq_mpoly_mul(value_, value_, other.value_, ring_->context());
  return *this;
}

// Into a new polynomial: copies of long coefficients take as long as their sum.
Poly operator+(const Poly& a, const Poly& b) {
  Poly result(*a.ring_);
  fmpq_mpoly_add(result.value_, a.value_, b.value_, a.ring_->context());
  return result;
}

Poly operator-(const Poly& a, const Poly& b) {
  Poly result(*a.ring_);
  fmpq_mpoly_sub(result.value_, a.value_, b.value_, a.ring_->context());
  return result;
}

Poly operator*(const Poly& a, const Poly& b) {
  core::WorkLimit::check();
  Poly result(*a.ring_);
  fmpq_mpoly_mul(result.value_, a.value_, b.value_, a.ring_->context());
  return result;
}

Poly Poly::operator-() const { return scaled(-1); }

Poly Poly::scaled(const Rational& factor) const {
  Poly result(*ring_);
  fmpq_mpoly_scalar_mul_fmpq(result.value_, value_, Fmpq(factor).get(), ring_->context());
  return result;
}

Poly Poly::pow(unsigned exponent) const {
  Poly result(*ring_);
  core::ensure(fmpq_mpoly_pow_ui(result.value_, value_, exponent, ring_->context()) != 0, "a power that fits memory");
  return result;
}

Poly Poly::squared() const {
  core::WorkLimit::check();
  if (is_zero() || has_dense_square(value_->zpoly, ring_->context()->zctx)) return *this * *this;
  Poly result(*ring_);
  fmpq_mul(result.value_->content, value_->content, value_->content);
  square(result.value_->zpoly, value_->zpoly, ring_->context()->zctx);  // of a primitive one: primitive
  return result;
}

bool Poly::operator==(const Poly& other) const { return fmpq_mpoly_equal(value_, other.value_, ring_->context()) != 0; }

Poly Poly::in(const Ring& ring) const {
  Poly result(ring);
  fmpq_mpoly_set(result.value_, value_, ring.context());
  return result;
}

bool Poly::is_zero() const { return fmpq_mpoly_is_zero(value_, ring_->context()) != 0; }

bool Poly::is_constant() const { return fmpq_mpoly_is_fmpq(value_, ring_->context()) != 0; }

Rational Poly::constant() const {
  Fmpq value;
  fmpq_mpoly_get_fmpq(value.get(), value_, ring_->context());
  return value.rational();
}

std::size_t Poly::length() const { return static_cast<std::size_t>(fmpq_mpoly_length(value_, ring_->context())); }

int Poly::degree(int variable) const {
  return static_cast<int>(fmpq_mpoly_degree_si(value_, variable, ring_->context()));
}

int Poly::total_degree() const { return static_cast<int>(fmpq_mpoly_total_degree_si(value_, ring_->context())); }

int Poly::degree(const std::vector<int>& variables) const {
  if (std::none_of(variables.begin(), variables.end(), [this](int variable) { return depends_on(variable); })) return 0;
  std::vector<double> weights(static_cast<std::size_t>(ring_->size()), 0.0);
  for (const int variable : variables) weights[static_cast<std::size_t>(variable)] = 1;
  return static_cast<int>(weighted_degree(weights));
}

double Poly::weighted_degree(const std::vector<double>& weights) const {
  double largest = 0;
  std::vector<ulong> exponents(static_cast<std::size_t>(ring_->size()));
  for (slong term = 0; term < static_cast<slong>(length()); ++term) {
    fmpq_mpoly_get_term_exp_ui(exponents.data(), value_, term, ring_->context());
    double sum = 0;
    for (std::size_t v = 0; v < weights.size(); ++v) sum += weights[v] * static_cast<double>(exponents[v]);
    largest = std::max(largest, sum);
  }
  return largest;
}

bool Poly::divides(const Poly& divisor, Poly& quotient) const {
  core::WorkLimit::check();
  return fmpq_mpoly_divides(quotient.value_, value_, divisor.value_, ring_->context()) != 0;
}

Poly Poly::exact_quotient(const Poly& divisor) const {
  Poly quotient(*ring_);
  core::ensure(divides(divisor, quotient), "an exact division");
  return quotient;
}

std::vector<Poly> Poly::coefficients(int variable) const {
  const auto highest = static_cast<std::size_t>(std::max(degree(variable), 0));
  if (highest == 0) return {1, *this};
  std::vector<Poly> result(highest + 1, Poly(*ring_));
  // Whole coefficients under the common content: a fraction for every term would be reduced again and again.
  const fmpz_mpoly_ctx_struct* const whole = ring_->context()->zctx;
  for (Poly& part : result) fmpq_set(part.value_->content, value_->content);
  std::vector<ulong> exponents(static_cast<std::size_t>(ring_->size()));
  fmpz_t coefficient;
  fmpz_init(coefficient);
  for (slong term = 0; term < static_cast<slong>(length()); ++term) {
    fmpz_mpoly_get_term_exp_ui(exponents.data(), value_->zpoly, term, whole);
    const ulong power = std::exchange(exponents[static_cast<std::size_t>(variable)], 0);
    fmpz_mpoly_get_term_coeff_fmpz(coefficient, value_->zpoly, term, whole);
    // Terms of one power keep their order when the power is taken out, so pushing keeps each list sorted.
    fmpz_mpoly_push_term_fmpz_ui(result[power].value_->zpoly, coefficient, exponents.data(), whole);
  }
  fmpz_clear(coefficient);
  for (Poly& part : result) fmpq_mpoly_reduce(part.value_, ring_->context());
  return result;
}

Poly Poly::at(int variable, const Rational& value) const {
  Poly result(*ring_);
  Fmpq number(value);
  core::ensure(fmpq_mpoly_evaluate_one_fmpq(result.value_, value_, variable, number.get(), ring_->context()) != 0,
               "a polynomial with a number put in");
  return result;
}

Poly Poly::primitive() const {
  if (is_zero()) return *this;
  Poly result(*ring_);
  Fmpq content;
  fmpq_mpoly_content(content.get(), value_, ring_->context());
  fmpq_mpoly_scalar_div_fmpq(result.value_, value_, content.get(), ring_->context());
  Fmpq leading;
  fmpq_mpoly_get_term_coeff_fmpq(leading.get(), result.value_, 0, ring_->context());
  return sgn(leading.rational()) < 0 ? -result : result;
}

Poly Poly::derivative(int variable) const {
  Poly result(*ring_);
  fmpq_mpoly_derivative(result.value_, value_, variable, ring_->context());
  return result;
}

void sort_factors(std::vector<PolyFactor>& factors) {
  if (factors.size() < 2) return;
  std::vector<std::pair<int, PolyFactor*>> by_degree;  // each asked for once: all terms are looked at
  for (PolyFactor& factor : factors) by_degree.emplace_back(factor.poly.total_degree(), &factor);
  std::sort(by_degree.begin(), by_degree.end(), [](const auto& a, const auto& b) {
    return a.first != b.first
               ? a.first < b.first
               : fmpq_mpoly_cmp(a.second->poly.raw(), b.second->poly.raw(), a.second->poly.ring().context()) > 0;
  });
  std::vector<PolyFactor> sorted;
  sorted.reserve(factors.size());
  for (const auto& [degree, factor] : by_degree) sorted.push_back(std::move(*factor));
  factors = std::move(sorted);
}

int Poly::variable_of_degree(int wanted) const {
  for (int variable = ring_->size() - 1; variable >= 0; --variable)
    if (degree(variable) == wanted) return variable;
  return -1;
}

std::optional<PolyFactor> Poly::take_low_factor() {
  // Linear in some variable, as most of ours are: irreducible but for what its two coefficients share.
  if (const int variable = variable_of_degree(1); variable >= 0) {
    const std::vector<Poly> parts = coefficients(variable);
    Poly shared = gcd(parts[0], parts[1]);
    PolyFactor factor{exact_quotient(shared).primitive(), 1};
    *this = std::move(shared);
    return factor;
  }
  // Quadratic, as circles are: a product only where the discriminant is a square.
  const int variable = length() <= short_enough ? variable_of_degree(2) : -1;
  if (variable < 0) return std::nullopt;
  const std::vector<Poly> parts = coefficients(variable);
  Poly shared = gcd(gcd(parts[2], parts[1]), parts[0]), root(*ring_);
  if ((parts[1] * parts[1] - (parts[0] * parts[2]).scaled(4)).square_root(root)) return std::nullopt;
  PolyFactor factor{exact_quotient(shared).primitive(), 1};
  *this = std::move(shared);
  return factor;
}

std::vector<PolyFactor> Poly::mirrored_factors() const {
  if (length() > short_enough) return {};
  const Poly whole = primitive();
  for (int v = ring_->size() - 1; v >= 0; --v) {
    if (degree(v) != 4) continue;
    const std::vector<Poly> parts = whole.coefficients(v);
    if (!parts[1].is_zero() || !parts[3].is_zero()) continue;
    // +-(a v^2 + b v + c) (a v^2 - b v + c) = +-(a^2 v^4 + (2 a c - b^2) v^2 + c^2), whole numbers by Gauss's lemma.
    Poly a(*ring_), b(*ring_), c(*ring_), root(*ring_);
    for (const auto& [sign, side] : {std::pair(1, 1), {1, -1}, {-1, 1}, {-1, -1}}) {
      if (!parts[4].scaled(sign).square_root(a) || !parts[0].scaled(sign).square_root(c)) continue;
      c = c.scaled(side);
      const Poly ac = a * c, squared = ac.scaled(2) - parts[2].scaled(sign);
      if (squared.is_zero() || !squared.square_root(b) || !gcd(gcd(a, b), c).is_constant()) continue;
      if ((squared - ac.scaled(4)).square_root(root)) continue;  // each is a product of two
      const Poly x = variable(*ring_, v), even = a * x * x + c, odd = b * x;
      return {{(even + odd).primitive(), 1}, {(even - odd).primitive(), 1}};
    }
  }
  return {};
}

std::vector<PolyFactor> Poly::factors(Rational& constant) const {
  std::vector<PolyFactor> result;
  constant = 0;
  if (is_zero()) return result;
  if (is_constant()) {
    constant = this->constant();
    return result;
  }
  Poly rest = *this;
  while (!rest.is_constant()) {
    std::optional<PolyFactor> factor = rest.take_low_factor();
    if (!factor) break;
    result.push_back(std::move(*factor));
  }
  if (std::vector<PolyFactor> pair = rest.is_constant() ? std::vector<PolyFactor>{} : rest.mirrored_factors();
      !pair.empty()) {
    std::move(pair.begin(), pair.end(), std::back_inserter(result));
  } else if (!rest.is_constant() && is_seen_irreducible(rest.value_->zpoly, *ring_)) {
    result.push_back({rest.primitive(), 1});
  } else if (!rest.is_constant()) {
    fmpq_mpoly_factor_t factorisation;
    fmpq_mpoly_factor_init(factorisation, ring_->context());
    core::ensure(fmpq_mpoly_factor(factorisation, rest.value_, ring_->context()) != 0, "a factorisation over Q");
    for (slong i = 0; i < fmpq_mpoly_factor_length(factorisation, ring_->context()); ++i) {
      Poly base(*ring_);
      fmpq_mpoly_factor_get_base(base.value_, factorisation, i, ring_->context());
      const slong exponent = fmpq_mpoly_factor_get_exp_si(factorisation, i, ring_->context());
      result.push_back({base.primitive(), static_cast<int>(exponent)});
    }
    fmpq_mpoly_factor_clear(factorisation, ring_->context());
  }
  sort_factors(result);
  // The constant is what the primitive factors leave of the leading coefficient.
  Fmpq leading;
  fmpq_mpoly_get_term_coeff_fmpq(leading.get(), value_, 0, ring_->context());
  constant = leading.rational();
  for (const PolyFactor& factor : result) {
    Fmpq fraction;
    fmpq_mpoly_get_term_coeff_fmpq(fraction.get(), factor.poly.value_, 0, ring_->context());
    for (int i = 0; i < factor.multiplicity; ++i) constant /= fraction.rational();
  }
  return result;
}

Poly gcd(const Poly& a, const Poly& b) {
  core::WorkLimit::check();
  Poly result(*a.ring_);
  core::ensure(fmpq_mpoly_gcd(result.value_, a.value_, b.value_, a.ring_->context()) != 0, "a gcd over Q");
  return result.primitive();
}

bool Poly::square_root(Poly& root) const {
  // A number times a primitive polynomial whose first coefficient is positive: a square where both are. FLINT's root
  // gives up at the first term that does not fit, where factors of what is no square would all be found first.
  if (is_zero()) {
    root = *this;
    return true;
  }
  Fmpq content;
  fmpq_set(content.get(), value_->content);
  const Rational constant = content.rational();
  if (constant < 0 || !mpz_perfect_square_p(constant.get_num_mpz_t()) ||
      !mpz_perfect_square_p(constant.get_den_mpz_t())) {
    return false;
  }
  Poly found(*ring_);
  if (fmpz_mpoly_sqrt(found.value_->zpoly, value_->zpoly, ring_->context()->zctx) == 0) return false;
  fmpq_one(found.value_->content);
  root = found.scaled(Rational(sqrt(constant.get_num()), sqrt(constant.get_den())));
  return true;
}

core::Polynomial Poly::plain(const std::vector<int>& variables) const {
  core::Polynomial result;
  result.variables = static_cast<int>(variables.size());
  result.terms.reserve(length());
  Fmpq coefficient;
  for (slong term = 0; term < static_cast<slong>(length()); ++term) {
    const std::vector<ulong> exponents = exponents_of(*this, term);
    core::Term plain_term;
    plain_term.exponents.reserve(variables.size());
    ulong kept = 0;
    for (const int variable : variables) {
      plain_term.exponents.push_back(static_cast<int>(exponents[static_cast<std::size_t>(variable)]));
      kept += exponents[static_cast<std::size_t>(variable)];
    }
    core::ensure(kept == std::accumulate(exponents.begin(), exponents.end(), ulong{0}),
                 "a polynomial in the listed variables only");
    fmpq_mpoly_get_term_coeff_fmpq(coefficient.get(), value_, term, ring_->context());
    plain_term.coefficient = coefficient.rational();
    result.terms.push_back(std::move(plain_term));
  }
  std::sort(result.terms.begin(), result.terms.end(),
            [](const core::Term& a, const core::Term& b) { return a.exponents > b.exponents; });
  return result;
}

core::Polynomial Poly::plain() const {
  std::vector<int> all(static_cast<std::size_t>(ring_->size()));
  std::iota(all.begin(), all.end(), 0);
  return plain(all);
}

}  // namespace clearloci::symbolic
