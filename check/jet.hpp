// What is known of a function of a pose over a cell of poses: its values, its value at the cell's middle m, and its
// slopes over the cell, one a coordinate. The values are met with the mean-value form
//     f(m) + sum slope_c (X_c - m_c)
// after every step. Private to check/.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "check/interval.hpp"

namespace clearloci::check {

class Jet {
 public:
  /// X_c - m_c of the cell's coordinates; it outlives the jets over the cell.
  using Offsets = std::vector<Interval>;

  /// The same at every pose.
  explicit Jet(const Interval& constant) : value_(constant), middle_(constant) {}
  Jet() : Jet(Interval()) {}
  /// The coordinate `c` of a cell.
  Jet(const Interval& over, const Offsets& offsets, std::size_t c)
      : value_(over), middle_(middle_of(over)), slopes_(offsets.size(), Interval(over.bits())), offsets_(&offsets) {
    slopes_[c] = Interval(1.0, over.bits());
  }
  /// A function that is known by these; it is at most as wide as they are.
  Jet(Interval value, Interval middle, std::vector<Interval> slopes, const Offsets& offsets)
      : value_(std::move(value)), middle_(std::move(middle)), slopes_(std::move(slopes)), offsets_(&offsets) {
    met();
  }
  /// The same over a cell of more coordinates, on those behind its own of which it does not depend.
  Jet over(const Offsets& longer) const {
    if (is_constant()) return *this;
    Jet result = *this;
    result.slopes_.resize(longer.size(), Interval(value_.bits()));
    result.offsets_ = &longer;
    return result;
  }

  const Interval& value() const { return value_; }
  const Interval& middle() const { return middle_; }
  bool is_constant() const { return slopes_.empty(); }
  /// Of a constant: none.
  const std::vector<Interval>& slopes() const { return slopes_; }
  int sign() const { return value_.sign(); }
  bool is_zero() const { return is_constant() && value_.is_zero(); }

  friend Jet operator+(const Jet& a, const Jet& b) {
    return combined(a, b, a.value_ + b.value_, a.middle_ + b.middle_, [](const Interval* p, const Interval* q) {
      return p && q ? *p + *q : p ? *p : *q;
    });
  }
  friend Jet operator-(const Jet& a, const Jet& b) {
    return combined(a, b, a.value_ - b.value_, a.middle_ - b.middle_, [](const Interval* p, const Interval* q) {
      return p && q ? *p - *q : p ? *p : -*q;
    });
  }
  friend Jet operator*(const Jet& a, const Jet& b) {
    if (a.is_zero()) return a;
    if (b.is_zero()) return b;
    return combined(a, b, a.value_ * b.value_, a.middle_ * b.middle_, [&](const Interval* p, const Interval* q) {
      return p && q ? *p * b.value_ + a.value_ * *q : p ? *p * b.value_ : a.value_ * *q;
    });
  }
  friend Jet operator-(const Jet& a) { return Jet() - a; }
  friend Jet operator/(const Jet& a, const Jet& b) { return a * inverse(b); }
  friend Jet inverse(const Jet& a) {
    const Interval one(1.0, a.value_.bits());
    const Interval interval = one / a.value_;
    return a.through(interval, one / a.middle_, -squared(interval));
  }
  friend Jet squared(const Jet& a) {
    return a.through(squared(a.value_), squared(a.middle_), Interval(2.0, a.value_.bits()) * a.value_);
  }
  /// Required for slopes: above 0 all over the cell.
  friend Jet root_of(const Jet& a) {
    const Interval root = root_of(a.value_);
    return a.through(root, root_of(a.middle_), Interval(0.5, root.bits()) / root);
  }
  friend Jet cosine_of(const Jet& a) {
    return a.through(cosine_of(a.value_), cosine_of(a.middle_), -sine_of(a.value_));
  }
  friend Jet sine_of(const Jet& a) { return a.through(sine_of(a.value_), sine_of(a.middle_), cosine_of(a.value_)); }
  /// Of the ways (x, y), from the x axis.
  friend Jet angle_of(const Jet& y, const Jet& x) {
    const Interval slope = angle_slope(y.value_, x.value_);
    return combined(y, x, angle_of(y.value_, x.value_), angle_of(y.middle_, x.middle_),
                    [&](const Interval* p, const Interval* q) {
                      Interval sum(slope.bits());
                      if (p) sum = sum + x.value_ * *p;
                      if (q) sum = sum - y.value_ * *q;
                      return sum * slope;
                    });
  }

 private:
  Jet(Interval value, Interval middle) : value_(std::move(value)), middle_(std::move(middle)) {}

  /// A function of two with slopes made of theirs; a null pointer stands for 0, not both are.
  template <class Slope>
  static Jet combined(const Jet& a, const Jet& b, Interval value, Interval middle, const Slope& slope) {
    const mpfr_prec_t bits = value.bits();
    Jet result(std::move(value), std::move(middle));
    const Jet& longer = a.is_constant() ? b : a;
    result.offsets_ = longer.offsets_;
    result.slopes_.reserve(longer.slopes_.size());
    for (std::size_t c = 0; c < longer.slopes_.size(); ++c) {
      const Interval *const p = slope_of(a, c), *const q = slope_of(b, c);
      result.slopes_.push_back(p == nullptr && q == nullptr ? Interval(bits) : slope(p, q));
    }
    return result.met();
  }

  /// None where it is 0.
  static const Interval* slope_of(const Jet& a, std::size_t c) {
    return a.is_constant() || a.slopes_[c].is_zero() ? nullptr : &a.slopes_[c];
  }

  Jet through(Interval value, Interval middle, const Interval& slope) const {
    Jet result(std::move(value), std::move(middle));
    result.offsets_ = offsets_;
    result.slopes_.reserve(slopes_.size());
    for (const Interval& interval : slopes_) result.slopes_.push_back(interval.is_zero() ? interval : interval * slope);
    return result.met();
  }

  Jet& met() {
    if (slopes_.empty()) return *this;
    Interval centred = middle_;
    for (std::size_t c = 0; c < slopes_.size(); ++c)
      if (!slopes_[c].is_zero() && !(*offsets_)[c].is_zero()) centred = centred + slopes_[c] * (*offsets_)[c];
    if (centred.is_finite()) value_ = value_.is_finite() ? meet(value_, centred) : centred;
    return *this;
  }

  Interval value_, middle_;
  std::vector<Interval> slopes_;
  const Offsets* offsets_ = nullptr;
};

}  // namespace clearloci::check
