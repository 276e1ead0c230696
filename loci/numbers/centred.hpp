// Mean-value forms: what is known of a quantity over a box of coordinates,
//     over       an enclosure over the box
//     middle     one at its middle m
//     slopes     one of each partial derivative over the box
// so that it lies in  middle + sum slopes_c (box_c - m_c)  as well (method.md section 12). Sums, products, quotients
// and roots of such quantities are such quantities, and what cancels between them does so before the box's width
// counts.
#pragma once

#include <vector>

#include "core/interval.hpp"

namespace clearloci::loci {

struct Centred {
  core::Interval over, middle;
  std::vector<core::Interval> slopes;
  bool smooth = true;  ///< false: nothing is known but `over`

  /// box_c - m_c.
  using Offsets = std::vector<core::Interval>;

  static Centred constant(const core::Interval& value, std::size_t coordinates) {
    return {value, value, std::vector<core::Interval>(coordinates, core::Interval(0.0))};
  }
  static Centred rough(const core::Interval& over, std::size_t coordinates) {
    Centred centred = constant(over, coordinates);
    centred.smooth = false;
    return centred;
  }

  Centred& tighten(const Offsets& offsets) {
    if (!smooth) return *this;
    core::Interval centred = middle;
    for (std::size_t c = 0; c < slopes.size(); ++c)
      if (offsets[c].lower() != 0 || offsets[c].upper() != 0) centred = centred + slopes[c] * offsets[c];
    over = meet(over, centred);
    middle = meet(middle, over);
    return *this;
  }
};

namespace centred {

template <class Slope>
Centred combined(const Centred& a, const Centred& b, const core::Interval& over, const core::Interval& middle,
                 const Slope& slope) {
  Centred result{over, middle, a.slopes, a.smooth && b.smooth};
  if (result.smooth)
    for (std::size_t c = 0; c < a.slopes.size(); ++c) result.slopes[c] = slope(a.slopes[c], b.slopes[c]);
  return result;
}

inline Centred sum(const Centred& a, const Centred& b) {
  return combined(a, b, a.over + b.over, a.middle + b.middle, [](const auto& x, const auto& y) { return x + y; });
}

inline Centred product(const Centred& a, const Centred& b) {
  return combined(a, b, a.over * b.over, a.middle * b.middle,
                  [&](const auto& x, const auto& y) { return x * b.over + y * a.over; });
}

inline Centred scaled(const core::Interval& by, Centred a) {
  a.over = by * a.over;
  a.middle = by * a.middle;
  for (core::Interval& slope : a.slopes) slope = by * slope;
  return a;
}

inline Centred square(const Centred& a) {
  return combined(a, a, squared(a.over), squared(a.middle),
                  [&](const auto& x, const auto&) { return core::Interval(2.0) * x * a.over; });
}

/// 1 / a. Required: 0 is not in a.over.
inline Centred reciprocal(const Centred& a) {
  const core::Interval over = inverse(a.over);
  const core::Interval by = -squared(over);
  return combined(a, a, over, inverse(a.middle), [&](const auto& x, const auto&) { return by * x; });
}

/// Required: a.over > 0.
inline Centred root(const Centred& a) {
  const core::Interval over = square_root(a.over);
  const core::Interval by = inverse(core::Interval(2.0) * over);
  return combined(a, a, over, square_root(a.middle), [&](const auto& x, const auto&) { return by * x; });
}

}  // namespace centred

}  // namespace clearloci::loci
