// Intervals of doubles, rounded outwards without touching the rounding mode:
//     fl(a op b) = (a op b)(1 + e), |e| <= 2^-53, so widening a result r by |r| 2^-52 + 2^-1000 on either side encloses
// the true one, underflow included. A bound that overflowed is infinite and stands for a finite value: 0 times it is 0.
// A sum of such bounds may be no number, which bounds nothing: the ends are infinite to whoever asks for them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace clearloci::inline core {

/// [-negated_lower, upper]: with the lower bound negated both ends are rounded upwards, in one vector register.
class Interval {
 public:
  Interval() : Interval(0.0) {}
  Interval(double value) : Interval(value, value) {}  // NOLINT: a number is a thin interval
  Interval(double lower, double upper) { set(-lower, upper); }

  double lower() const { return -end(0); }
  double upper() const { return end(1); }
  double middle() const { return 0.5 * (lower() + upper()); }
  double width() const { return upper() - lower(); }
  /// Largest absolute value.
  double magnitude() const { return std::max(std::abs(lower()), std::abs(upper())); }
  /// Smallest absolute value.
  double mignitude() const { return std::max({0.0, lower(), -upper()}); }
  bool contains(double value) const { return lower() <= value && value <= upper(); }
  bool contains_zero() const { return end(0) >= 0 && end(1) >= 0; }
  /// +1 or -1 where the sign is proven, else 0.
  int sign() const { return lower() > 0 ? 1 : upper() < 0 ? -1 : 0; }

  /// The middle and all that is no further from it than the magnitudes of two intervals together.
  friend Interval around(const Interval& middle, const Interval& first, const Interval& second);
  /// What both contain; the caller knows that they meet (both enclose one quantity).
  friend Interval meet(const Interval& a, const Interval& b);

#if defined(__SSE2__)
  friend Interval operator+(const Interval& a, const Interval& b) { return outward(_mm_add_pd(a.ends_, b.ends_)); }
  friend Interval operator-(const Interval& a, const Interval& b) {
    return outward(_mm_add_pd(a.ends_, _mm_shuffle_pd(b.ends_, b.ends_, 1)));
  }
  friend Interval operator-(const Interval& a) { return Interval(_mm_shuffle_pd(a.ends_, a.ends_, 1)); }
  friend Interval operator*(const Interval& a, const Interval& b) {
    const __m128d straight = _mm_mul_pd(a.ends_, b.ends_);
    const __m128d crossed = _mm_mul_pd(a.ends_, _mm_shuffle_pd(b.ends_, b.ends_, 1));
    if (_mm_movemask_pd(_mm_cmpunord_pd(straight, crossed)) != 0) return overflowed(a, b);
    return product(straight, crossed);
  }
  friend Interval around(const Interval& middle, const Interval& first, const Interval& second) {
    const __m128d a = known(first.ends_), b = known(second.ends_);
    const __m128d one = _mm_max_pd(a, _mm_shuffle_pd(a, a, 1)), other = _mm_max_pd(b, _mm_shuffle_pd(b, b, 1));
    return outward(_mm_add_pd(outward(_mm_add_pd(one, other)).ends_, middle.ends_));
  }
  friend Interval meet(const Interval& a, const Interval& b) {
    const __m128d ends = _mm_min_pd(known(a.ends_), known(b.ends_));
    // Where rounding leaves nothing, the lower end.
    const __m128d lower = _mm_xor_pd(_mm_set1_pd(-0.0), _mm_unpacklo_pd(ends, ends));
    return Interval(_mm_move_sd(_mm_max_pd(ends, lower), ends));
  }

 private:
  explicit Interval(__m128d ends) : ends_(ends) {}
  /// Infinite where they are no numbers: the second of two where the first is none.
  static __m128d known(__m128d ends) { return _mm_min_pd(ends, _mm_set1_pd(std::numeric_limits<double>::infinity())); }
  static Interval outward(__m128d ends) {
    const __m128d size = _mm_andnot_pd(_mm_set1_pd(-0.0), ends);
    const __m128d error = _mm_add_pd(_mm_mul_pd(size, _mm_set1_pd(0x1p-52)), _mm_set1_pd(0x1p-1000));
    return Interval(_mm_add_pd(ends, error));
  }
  /// Of all four products of ends, which are numbers.
  static Interval product(__m128d straight, __m128d crossed) {
    const __m128d sign = _mm_set1_pd(-0.0);
    const __m128d upper = _mm_max_pd(straight, _mm_xor_pd(crossed, sign));
    const __m128d lower = _mm_max_pd(crossed, _mm_xor_pd(straight, sign));
    return outward(_mm_max_pd(_mm_unpacklo_pd(lower, upper), _mm_unpackhi_pd(lower, upper)));
  }
  static Interval overflowed(const Interval& a, const Interval& b) {
    const __m128d x = known(a.ends_), y = known(b.ends_);
    const __m128d straight = _mm_mul_pd(x, y), crossed = _mm_mul_pd(x, _mm_shuffle_pd(y, y, 1));
    return product(_mm_and_pd(straight, _mm_cmpord_pd(straight, straight)),
                   _mm_and_pd(crossed, _mm_cmpord_pd(crossed, crossed)));
  }
  void set(double negated_lower, double upper) { ends_ = _mm_set_pd(upper, negated_lower); }
  double end(int which) const {
    const __m128d ends = known(ends_);
    return which == 0 ? _mm_cvtsd_f64(ends) : _mm_cvtsd_f64(_mm_unpackhi_pd(ends, ends));
  }
  __m128d ends_;
#else
  friend Interval operator+(const Interval& a, const Interval& b) {
    return outward(a.ends_[0] + b.ends_[0], a.ends_[1] + b.ends_[1]);
  }
  friend Interval operator-(const Interval& a, const Interval& b) {
    return outward(a.ends_[0] + b.ends_[1], a.ends_[1] + b.ends_[0]);
  }
  friend Interval operator-(const Interval& a) { return Interval(-a.upper(), -a.lower()); }
  friend Interval operator*(const Interval& a, const Interval& b) {
    const double ll = product(a.lower(), b.lower()), lu = product(a.lower(), b.upper());
    const double ul = product(a.upper(), b.lower()), uu = product(a.upper(), b.upper());
    return outward(-std::min({ll, lu, ul, uu}), std::max({ll, lu, ul, uu}));
  }
  friend Interval around(const Interval& middle, const Interval& first, const Interval& second) {
    const double by = first.magnitude() + second.magnitude();
    const Interval reach = outward(by, by);
    return outward(middle.ends_[0] + reach.ends_[1], middle.ends_[1] + reach.ends_[1]);
  }
  friend Interval meet(const Interval& a, const Interval& b) {
    const double lower = std::max(a.lower(), b.lower());
    return {lower, std::max(lower, std::min(a.upper(), b.upper()))};
  }

 private:
  static double product(double a, double b) {
    const double exact = a * b;
    return std::isnan(exact) ? 0.0 : exact;
  }
  static double outward(double end) {
    const double bound = end + (std::abs(end) * 0x1p-52 + 0x1p-1000);
    return std::isnan(bound) ? std::numeric_limits<double>::infinity() : bound;
  }
  static Interval outward(double negated_lower, double upper) {
    Interval result;
    result.set(outward(negated_lower), outward(upper));
    return result;
  }
  void set(double negated_lower, double upper) { ends_[0] = negated_lower, ends_[1] = upper; }
  double end(int which) const { return ends_[which]; }
  double ends_[2];
#endif
};

/// The smallest interval containing both.
inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lower(), b.lower()), std::max(a.upper(), b.upper())};
}

inline bool disjoint(const Interval& a, const Interval& b) { return a.upper() < b.lower() || b.upper() < a.lower(); }

/// `a` in the interior of `b`.
inline bool inside(const Interval& a, const Interval& b) { return b.lower() < a.lower() && a.upper() < b.upper(); }

inline Interval squared(const Interval& a) {
  const double low = a.mignitude(), high = a.magnitude();
  const Interval least = Interval(low) * Interval(low);
  const Interval most = Interval(high) * Interval(high);
  return {std::max(0.0, least.lower()), most.upper()};
}

/// 1/a. Where 0 is in `a` nothing is known of it: a stand-in for the whole line, small enough that products of a few of
/// them stay finite.
inline Interval inverse(const Interval& a) {
  constexpr double unbounded = 1e50;
  if (a.contains_zero()) return {-unbounded, unbounded};
  const double lower = 1.0 / a.upper(), upper = 1.0 / a.lower();
  return {lower - std::abs(lower) * 0x1p-52, upper + std::abs(upper) * 0x1p-52};
}

/// Whether ways (x, y) may lie on the cut of their angles, the negative x axis with the origin.
inline bool crosses_cut(const Interval& y, const Interval& x) { return x.lower() <= 0 && y.contains_zero(); }

/// Of the ways (x, y) from the x axis. Off the cut the least and the largest are at corners, for the ways of one angle
/// are a ray.
inline Interval angle_of(const Interval& y, const Interval& x) {
  constexpr double pi = 3.14159265358979323846;
  constexpr double error = 0x1p-50;  // eight times what the library promises of its arc tangent
  if (crosses_cut(y, x)) return {-pi - error, pi + error};
  double lower = pi, upper = -pi;
  for (const double b : {y.lower(), y.upper()})
    for (const double a : {x.lower(), x.upper()}) {
      const double angle = std::atan2(b, a);
      lower = std::min(lower, angle);
      upper = std::max(upper, angle);
    }
  return {lower - (std::abs(lower) * error + 0x1p-1000), upper + (std::abs(upper) * error + 0x1p-1000)};
}

/// 1 / (x^2 + y^2), with which the angle changes; where it may jump, nothing is known of that.
inline Interval angle_slope(const Interval& y, const Interval& x) {
  return crosses_cut(y, x) ? inverse(Interval(0.0)) : inverse(squared(x) + squared(y));
}

/// Square roots of the non-negative part of `a`; required: a.upper() >= 0.
inline Interval square_root(const Interval& a) {
  const double lower = std::sqrt(std::max(0.0, a.lower())), upper = std::sqrt(a.upper());
  return {std::max(0.0, lower - lower * 0x1p-52), upper + upper * 0x1p-52 + 0x1p-1000};
}

}  // namespace clearloci::inline core
