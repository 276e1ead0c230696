// The halves of ranges, and of boxes of ranges.
#pragma once

#include <array>
#include <vector>

#include "core/interval.hpp"

namespace clearloci::loci {

inline std::array<core::Interval, 2> halves_of(const core::Interval& range) {
  return {core::Interval(range.lower(), range.middle()), core::Interval(range.middle(), range.upper())};
}

inline std::array<std::array<double, 2>, 2> halves_of(const std::array<double, 2>& range) {
  const double middle = 0.5 * (range[0] + range[1]);
  return {{{range[0], middle}, {middle, range[1]}}};
}

/// Of a box of ranges those along one of them.
template <class Range>
std::array<std::vector<Range>, 2> halves_of(const std::vector<Range>& box, std::size_t along) {
  std::array<std::vector<Range>, 2> halves = {box, box};
  for (std::size_t half = 0; half < 2; ++half) halves[half][along] = halves_of(box[along])[half];
  return halves;
}

}  // namespace clearloci::loci
