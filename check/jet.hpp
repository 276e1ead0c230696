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
  Jet(const Interval& value, const Interval& middle, std::vector<Interval> slopes, const Offsets& offsets)
      : value_(value), middle_(middle), slopes_(std::move(slopes)), offsets_(&offsets) {
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
  Jet(const Interval& value, const Interval& middle) : value_(value), middle_(middle) {}

  /// A function of two with slopes made of theirs; a null pointer stands for 0, not both are.
  template <class Slope>
  static Jet combined(const Jet& a, const Jet& b, const Interval& value, const Interval& middle, const Slope& slope) {
    Jet result(value, middle);
    const Jet& longer = a.is_constant() ? b : a;
    result.offsets_ = longer.offsets_;
    for (std::size_t c = 0; c < longer.slopes_.size(); ++c)
      result.slopes_.push_back(
          slope(a.is_constant() ? nullptr : &a.slopes_[c], b.is_constant() ? nullptr : &b.slopes_[c]));
    return result.met();
  }

  Jet through(const Interval& value, const Interval& middle, const Interval& slope) const {
    Jet result(value, middle);
    result.offsets_ = offsets_;
    for (const Interval& interval : slopes_) result.slopes_.push_back(interval * slope);
    return result.met();
  }

  Jet& met() {
    if (slopes_.empty()) return *this;
    Interval centred = middle_;
    for (std::size_t c = 0; c < slopes_.size(); ++c) centred = centred + slopes_[c] * (*offsets_)[c];
    if (centred.is_finite()) value_ = value_.is_finite() ? meet(value_, centred) : centred;
    return *this;
  }

  Interval value_, middle_;
  std::vector<Interval> slopes_;
  const Offsets* offsets_ = nullptr;
};

}  // namespace clearloci::check
