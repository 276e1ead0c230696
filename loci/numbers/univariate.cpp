#include "loci/numbers/univariate.hpp"

#include <flint/fmpz_poly.h>
#include <flint/fmpz_poly_factor.h>

#include <algorithm>

#include "core/errors.hpp"
#include "core/thread_end.hpp"

namespace clearloci::loci {
namespace {

using core::Integer;
using core::Rational;

/// Drops leading zeros, divides by the content, makes the leading coefficient positive.
void make_primitive(Univariate& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  if (p.empty()) return;
  Integer content = 0;
  for (const Integer& c : p) content = gcd(content, c);
  if (p.back() < 0) content = -content;
  for (Integer& c : p) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), content.get_mpz_t());
}

/// A polynomial of FLINT's that frees itself.
class FlintPoly {
 public:
  explicit FlintPoly(const Univariate& p) {
    core::call_at_thread_end<flint_cleanup>();
    fmpz_poly_init2(poly_, static_cast<slong>(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i) fmpz_poly_set_coeff_mpz(poly_, static_cast<slong>(i), p[i].get_mpz_t());
  }
  ~FlintPoly() { fmpz_poly_clear(poly_); }
  FlintPoly(const FlintPoly&) = delete;
  FlintPoly& operator=(const FlintPoly&) = delete;

  fmpz_poly_struct* get() { return poly_; }
  const fmpz_poly_struct* get() const { return poly_; }

  Univariate univariate() const {
    Univariate p(static_cast<std::size_t>(fmpz_poly_length(poly_)));
    for (std::size_t i = 0; i < p.size(); ++i) fmpz_poly_get_coeff_mpz(p[i].get_mpz_t(), poly_, static_cast<slong>(i));
    return p;
  }

 private:
  fmpz_poly_t poly_;
};

Univariate derivative(const Univariate& p) {
  Univariate d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(p[i] * static_cast<unsigned long>(i));
  make_primitive(d);
  return d;
}

/// p(x + by), of the same length.
Univariate shifted(const Univariate& p, const Integer& by) {
  FlintPoly moved(p);
  fmpz_t step;
  fmpz_init_set_readonly(step, by.get_mpz_t());
  fmpz_poly_taylor_shift(moved.get(), moved.get(), step);
  fmpz_clear_readonly(step);
  Univariate result = moved.univariate();
  result.resize(p.size());
  return result;
}

int variations(const Univariate& p) {
  int count = 0, last = 0;
  for (const Integer& c : p) {
    const int sign = sgn(c);
    if (sign == 0) continue;
    if (last != 0 && sign != last) ++count;
    last = sign;
  }
  return count;
}

/// Descartes' bound of the number of roots strictly between: exact where it is 0 or 1.
int descartes_bound(const Univariate& p, const Rational& lower, const Rational& upper) {
  if (p.empty()) return 0;
  // x = (start + width y) / unit in whole numbers; then the roots in (0, 1) moved to the positive numbers.
  const Integer unit = lcm(lower.get_den(), upper.get_den());
  const Integer start = lower.get_num() * (unit / lower.get_den());
  const Integer width = upper.get_num() * (unit / upper.get_den()) - start;
  const auto scale_by_powers = [](Univariate& list, const Integer& base) {
    Integer power = 1;
    for (Integer& c : list) {
      c *= power;
      power *= base;
    }
  };
  Univariate scaled = p;
  std::reverse(scaled.begin(), scaled.end());
  scale_by_powers(scaled, unit);
  std::reverse(scaled.begin(), scaled.end());
  scaled = shifted(scaled, start);
  scale_by_powers(scaled, width);
  std::reverse(scaled.begin(), scaled.end());
  return variations(shifted(scaled, 1));
}

/// Powers of a denominator, one after the other: of a power of two they are shifts.
class Powers {
 public:
  explicit Powers(const Integer& base) : base_(base), bits_(mpz_sizeinbase(base.get_mpz_t(), 2) - 1) {
    is_shift_ = mpz_scan1(base.get_mpz_t(), 0) == bits_;
  }
  /// sum + c times the next power.
  void add(Integer& sum, const Integer& c) {
    if (is_shift_) {
      mpz_mul_2exp(power_.get_mpz_t(), c.get_mpz_t(), shift_);
      sum += power_;
      shift_ += bits_;
    } else {
      mpz_addmul(sum.get_mpz_t(), c.get_mpz_t(), power_.get_mpz_t());
      power_ *= base_;
    }
  }

 private:
  const Integer& base_;
  mp_bitcnt_t bits_, shift_ = 0;
  bool is_shift_;
  Integer power_ = 1;
};

Univariate linear_factor(const Rational& root) { return {-root.get_num(), root.get_den()}; }

}  // namespace

Univariate univariate(const core::Polynomial& p) {
  core::ensure(p.variables == 1, "a polynomial in one variable");
  Univariate result;
  if (p.is_zero()) return result;
  const core::Polynomial whole = core::primitive_part(p);
  result.assign(static_cast<std::size_t>(core::degree_in(whole, 0)) + 1, Integer(0));
  for (const core::Term& term : whole.terms)
    result[static_cast<std::size_t>(term.exponents[0])] = term.coefficient.get_num();
  return result;
}

Univariate greatest_common_divisor(Univariate a, Univariate b) {
  make_primitive(a);
  make_primitive(b);
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  FlintPoly common(a);
  const FlintPoly other(b);
  fmpz_poly_gcd(common.get(), common.get(), other.get());
  return common.univariate();
}

Univariate exact_quotient(const Univariate& a, const Univariate& b) {
  core::ensure(!b.empty() && a.size() >= b.size(), "a divisor");
  const FlintPoly whole(a), divisor(b);
  FlintPoly quotient({});
  core::ensure(fmpz_poly_divides(quotient.get(), whole.get(), divisor.get()) != 0, "a division without rest");
  Univariate result = quotient.univariate();
  make_primitive(result);
  return result;
}

Univariate square_free_part(const Univariate& p) {
  if (p.size() <= 2) return p;
  const Univariate common = greatest_common_divisor(p, derivative(p));
  return common.size() <= 1 ? p : exact_quotient(p, common);
}

std::vector<Univariate> irreducible_factors(const Univariate& p) {
  const FlintPoly whole(p);
  fmpz_poly_factor_t found;
  fmpz_poly_factor_init(found);
  fmpz_poly_factor(found, whole.get());
  std::vector<Univariate> factors;
  for (slong i = 0; i < found->num; ++i) {
    Univariate factor(static_cast<std::size_t>(fmpz_poly_length(found->p + i)));
    for (std::size_t k = 0; k < factor.size(); ++k)
      fmpz_poly_get_coeff_mpz(factor[k].get_mpz_t(), found->p + i, static_cast<slong>(k));
    factors.push_back(std::move(factor));
  }
  fmpz_poly_factor_clear(found);
  for (Univariate& factor : factors) make_primitive(factor);
  return factors;
}

int sign_at(const Univariate& p, const Rational& x) {
  // Numerator of p(n/d): Horner over the integers.
  Integer sum = 0;
  Powers powers(x.get_den());
  for (auto c = p.rbegin(); c != p.rend(); ++c) {
    sum *= x.get_num();
    powers.add(sum, *c);
  }
  return sgn(sum);
}

std::vector<RealRoot> real_roots(Univariate p, const Rational& lower, const Rational& upper) {
  core::ensure(!p.empty(), "a polynomial that is not zero");
  std::vector<RealRoot> roots;
  const auto take_exact = [&](const Rational& x) {
    if (p.size() <= 1 || sign_at(p, x) != 0) return;
    p = exact_quotient(p, linear_factor(x));
    roots.push_back({linear_factor(x), x, x});
  };
  take_exact(lower);
  if (lower < upper) take_exact(upper);
  // Roots at the ends of pending intervals are divided out: no end is a root of what is left.
  std::vector<std::pair<Rational, Rational>> pending = {{lower, upper}};
  while (!pending.empty()) {
    const auto [from, to] = pending.back();
    pending.pop_back();
    if (from >= to || p.size() <= 1) continue;
    const int bound = descartes_bound(p, from, to);
    if (bound == 0) continue;
    if (bound == 1) {
      roots.push_back({p, from, to});
      continue;
    }
    const Rational middle = (from + to) / 2;
    take_exact(middle);
    pending.emplace_back(middle, to);
    pending.emplace_back(from, middle);
  }
  // Isolating intervals meet in their ends at most, and an end is a root only where it is an exact one.
  std::sort(roots.begin(), roots.end(),
            [](const RealRoot& a, const RealRoot& b) { return a.lower + a.upper < b.lower + b.upper; });
  return roots;
}

void narrow(RealRoot& root) {
  if (root.exact()) return;
  const Rational middle = (root.lower + root.upper) / 2;
  const int sign = sign_at(root.polynomial, middle);
  if (sign == 0)
    root.lower = root.upper = middle;
  else
    (sign == sign_at(root.polynomial, root.lower) ? root.lower : root.upper) = middle;
}

void narrow_by(RealRoot& root, int bits) {
  int won = 0, sure = 2;  // bits; those that the next step is to win
  const int below = root.exact() ? 0 : sign_at(root.polynomial, root.lower);
  const auto halve = [&] {
    const Rational middle = (root.lower + root.upper) / 2;
    const int sign = sign_at(root.polynomial, middle);
    if (sign == 0) root.lower = root.upper = middle;
    if (sign != 0) (sign == below ? root.lower : root.upper) = middle;
    ++won;
  };
  while (won < bits && !root.exact()) {
    const Rational width = root.upper - root.lower, middle = root.lower + width / 2;
    // The value at n / d times d^degree, the slope times d^(degree - 1): whole numbers.
    Integer value = 0, slope = 0;
    Powers powers(middle.get_den());
    for (auto c = root.polynomial.rbegin(); c != root.polynomial.rend(); ++c) {
      slope *= middle.get_num();
      slope += value;
      value *= middle.get_num();
      powers.add(value, *c);
    }
    // A part of the interval about Newton's place, with ends on a grid of it. Its share of the width, not reduced: from
    // the middle on, 1 / 2 - value / (slope * denominator * width).
    const Integer half = slope * middle.get_den() * width.get_num(), whole = 2 * half,
                  share = half - 2 * value * width.get_den();
    if (sgn(share) * sgn(whole) <= 0 || mpz_cmpabs(share.get_mpz_t(), whole.get_mpz_t()) >= 0) {
      halve();
      continue;
    }
    const int step = std::min(sure, bits - won + 1);
    Integer nearest;
    mpz_mul_2exp(nearest.get_mpz_t(), share.get_mpz_t(), static_cast<mp_bitcnt_t>(step));
    mpz_fdiv_q(nearest.get_mpz_t(), nearest.get_mpz_t(), whole.get_mpz_t());
    Rational part = width;
    mpq_div_2exp(part.get_mpq_t(), part.get_mpq_t(), static_cast<mp_bitcnt_t>(step));
    const auto sign_on = [&](const Rational& x) {
      return x <= root.lower ? below : x >= root.upper ? -below : sign_at(root.polynomial, x);
    };
    Rational lower = root.lower + part * nearest, upper = lower + part;
    int at_lower = sign_on(lower), at_upper = sign_on(upper);
    if (at_lower == -below) {  // in the part before, if Newton is right
      upper = lower, at_upper = at_lower;
      lower -= part, at_lower = sign_on(lower);
    } else if (at_upper == below) {
      lower = upper, at_lower = at_upper;
      upper += part, at_upper = sign_on(upper);
    }
    if (at_lower == 0) {
      root.lower = root.upper = lower;
    } else if (at_upper == 0) {
      root.lower = root.upper = upper;
    } else if (at_lower == below && at_upper == -below) {
      root.lower = std::max(root.lower, lower), root.upper = std::min(root.upper, upper);
      won += step;
      sure *= 2;
    } else {
      sure = std::max(2, sure / 2);
      halve();
    }
  }
}

int sign_at(const Univariate& q, RealRoot& root) {
  if (q.empty()) return 0;
  if (root.exact()) return sign_at(q, root.lower);
  const Univariate common = greatest_common_divisor(root.polynomial, q);
  if (common.size() > 1 && sign_at(common, root.lower) != sign_at(common, root.upper)) return 0;
  while (!root.exact() && descartes_bound(q, root.lower, root.upper) != 0) narrow(root);
  return sign_at(q, (root.lower + root.upper) / 2);
}

std::vector<Univariate> coprime_base(const std::vector<Univariate>& polynomials) {
  std::vector<Univariate> base;
  for (Univariate p : polynomials) {
    std::vector<Univariate> refined;
    for (Univariate& old : base) {
      if (old == p) p = {Integer(1)};  // its roots are there already
      const Univariate common = p.size() > 1 ? greatest_common_divisor(p, old) : Univariate{Integer(1)};
      if (common.size() > 1) {
        p = exact_quotient(p, common);
        old = exact_quotient(old, common);
        refined.push_back(common);
      }
      if (old.size() > 1) refined.push_back(std::move(old));
    }
    if (p.size() > 1) refined.push_back(std::move(p));
    base = std::move(refined);
  }
  return base;
}

}  // namespace clearloci::loci
