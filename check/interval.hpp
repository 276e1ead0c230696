// Intervals by MPFI: every result encloses whatever its arguments may be. The only arithmetic of check/, and the only
// place of the repository in which MPFI shows. Private to check/.
#pragma once

#include <mpfi.h>
// mpfi_io.h is not needed: nothing is printed.

#include <algorithm>
#include <utility>
#include <vector>

#include "core/rational.hpp"

namespace clearloci::check {

/// Precisions, in bits: of cells, where 128 leave rounding out of account, and of the tests of identities.
inline constexpr mpfr_prec_t cell_bits = 128, identity_bits = 1024;

/// Numbers of cells are made and dropped by the million: what is dropped is kept for the next one, thread by thread.
class CellNumbers {
 public:
  ~CellNumbers() {
    for (__mpfi_struct& number : kept_) mpfi_clear(&number);
  }
  static void init(mpfi_ptr number, mpfr_prec_t bits) {
    if (bits != cell_bits || mine().kept_.empty()) return mpfi_init2(number, bits), void();
    *number = mine().kept_.back();
    mine().kept_.pop_back();
  }
  static void drop(mpfi_ptr number) {
    if (mpfi_get_prec(number) == cell_bits && mine().kept_.size() < 4096)
      mine().kept_.push_back(*number);
    else
      mpfi_clear(number);
  }

 private:
  static CellNumbers& mine() {
    static thread_local CellNumbers numbers;
    return numbers;
  }
  std::vector<__mpfi_struct> kept_;
};

class Interval {
 public:
  explicit Interval(mpfr_prec_t bits = cell_bits) : Interval(Uninitialised{bits}) { mpfi_set_ui(value_, 0); }
  Interval(double value, mpfr_prec_t bits) : Interval(Uninitialised{bits}) { mpfi_set_d(value_, value); }
  Interval(double lower, double upper, mpfr_prec_t bits) : Interval(Uninitialised{bits}) {
    mpfi_interv_d(value_, lower, upper);
  }
  Interval(const core::Rational& value, mpfr_prec_t bits) : Interval(Uninitialised{bits}) {
    mpfi_set_q(value_, value.get_mpq_t());
  }
  Interval(const Interval& other) : Interval(Uninitialised{other.bits()}) { mpfi_set(value_, other.value_); }
  /// What is moved from may only be assigned to or destroyed.
  Interval(Interval&& other) noexcept : value_{*other.value_} { other.owns_ = false; }
  Interval& operator=(const Interval& other) {
    if (this == &other) return *this;
    if (!owns_ || bits() != other.bits()) return *this = Interval(other);
    mpfi_set(value_, other.value_);
    return *this;
  }
  Interval& operator=(Interval&& other) noexcept {
    std::swap(*value_, *other.value_);
    std::swap(owns_, other.owns_);
    return *this;
  }
  ~Interval() {
    if (owns_) CellNumbers::drop(value_);
  }

  mpfr_prec_t bits() const { return mpfi_get_prec(value_); }
  mpfi_ptr get() { return value_; }
  mpfi_srcptr get() const { return value_; }

  /// Outwards.
  double lower() const { return mpfr_get_d(&value_->left, MPFR_RNDD); }
  double upper() const { return mpfr_get_d(&value_->right, MPFR_RNDU); }
  double middle() const { return mpfi_get_d(value_); }
  double width() const { return upper() - lower(); }
  /// +1, -1; 0: it contains 0, or is no number.
  int sign() const {
    if (mpfi_nan_p(value_) != 0) return 0;
    return mpfr_sgn(&value_->left) > 0 ? 1 : mpfr_sgn(&value_->right) < 0 ? -1 : 0;
  }
  bool is_finite() const { return mpfi_bounded_p(value_) != 0; }
  bool is_zero() const { return mpfi_is_zero(value_) != 0; }
  bool contains_zero() const { return sign() == 0; }
  /// Every number of it is at most 0; at least 0.
  bool below() const { return mpfi_nan_p(value_) == 0 && mpfr_sgn(&value_->right) < 0; }

 private:
  struct Uninitialised {
    mpfr_prec_t bits;
  };
  explicit Interval(Uninitialised u) { CellNumbers::init(value_, u.bits); }

  mpfi_t value_;
  bool owns_ = true;
};

inline mpfr_prec_t finer_bits(const Interval& a, const Interval& b) { return std::max(a.bits(), b.bits()); }
inline Interval operator+(const Interval& a, const Interval& b) {
  Interval r(finer_bits(a, b));
  mpfi_add(r.get(), a.get(), b.get());
  return r;
}
inline Interval operator-(const Interval& a, const Interval& b) {
  Interval r(finer_bits(a, b));
  mpfi_sub(r.get(), a.get(), b.get());
  return r;
}
inline Interval operator*(const Interval& a, const Interval& b) {
  Interval r(finer_bits(a, b));
  mpfi_mul(r.get(), a.get(), b.get());
  return r;
}
inline Interval operator/(const Interval& a, const Interval& b) {
  Interval r(finer_bits(a, b));
  mpfi_div(r.get(), a.get(), b.get());
  return r;
}
inline Interval operator-(const Interval& a) {
  Interval r(a.bits());
  mpfi_neg(r.get(), a.get());
  return r;
}
inline Interval inverse(const Interval& a) {
  Interval r(a.bits());
  mpfi_inv(r.get(), a.get());
  return r;
}
inline Interval squared(const Interval& a) {
  Interval r(a.bits());
  mpfi_sqr(r.get(), a.get());
  return r;
}
/// Whether ways (x, y) may lie where their angles are cut, on the negative x axis.
inline bool crosses_cut(const Interval& y, const Interval& x) {
  return y.sign() == 0 && mpfr_cmp_si(&x.get()->left, 0) <= 0;
}
/// Of the ways (x, y) from the x axis, in [-pi, pi].
inline Interval angle_of(const Interval& y, const Interval& x) {
  Interval r(y.bits());
  if (crosses_cut(y, x)) {
    mpfi_const_pi(r.get());
    mpfr_neg(&r.get()->left, &r.get()->right, MPFR_RNDD);
  } else {
    mpfi_atan2(r.get(), y.get(), x.get());
  }
  return r;
}
/// 1 / (x^2 + y^2), with which the angle changes; the whole line where it may jump.
inline Interval angle_slope(const Interval& y, const Interval& x) {
  Interval r(y.bits());
  if (crosses_cut(y, x)) {
    mpfr_set_inf(&r.get()->left, -1);
    mpfr_set_inf(&r.get()->right, 1);
  } else {
    r = squared(x) + squared(y);
    mpfi_inv(r.get(), r.get());
  }
  return r;
}
/// Of the numbers that have one: what is below 0 is left out.
inline Interval root_of(const Interval& a) {
  Interval r(a);
  if (mpfi_nan_p(r.get()) != 0) return r;
  if (mpfr_sgn(&r.get()->left) < 0) mpfr_set_zero(&r.get()->left, 1);
  if (mpfr_sgn(&r.get()->right) < 0) mpfr_set_zero(&r.get()->right, 1);
  mpfi_sqrt(r.get(), r.get());
  return r;
}
inline Interval cosine_of(const Interval& a) {
  Interval r(a.bits());
  mpfi_cos(r.get(), a.get());
  return r;
}
inline Interval sine_of(const Interval& a) {
  Interval r(a.bits());
  mpfi_sin(r.get(), a.get());
  return r;
}
/// The numbers of both; `b` where they have none in common.
inline Interval meet(const Interval& a, const Interval& b) {
  Interval r(a.bits());
  mpfi_intersect(r.get(), a.get(), b.get());
  return mpfi_is_empty(r.get()) != 0 ? b : r;
}
inline bool disjoint(const Interval& a, const Interval& b) {
  return mpfr_less_p(&a.get()->right, &b.get()->left) != 0 || mpfr_less_p(&b.get()->right, &a.get()->left) != 0;
}
/// Its middle as an interval without width.
inline Interval middle_of(const Interval& a) {
  Interval r(a.bits());
  mpfr_t m;
  mpfr_init2(m, a.bits());
  mpfi_mid(m, a.get());
  mpfi_set_fr(r.get(), m);
  mpfr_clear(m);
  return r;
}
/// a lies in the interior of b.
inline bool inside(const Interval& a, const Interval& b) { return mpfi_is_strictly_inside(a.get(), b.get()) > 0; }
inline bool contains(const Interval& b, const Interval& a) { return mpfi_is_inside(a.get(), b.get()) > 0; }

}  // namespace clearloci::check
