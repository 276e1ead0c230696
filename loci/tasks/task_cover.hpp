// What searches that cover a task over two lengths and its margin with cells have in common.
// Private to loci/tasks/.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/interval.hpp"
#include "loci/tasks/cover_proof.hpp"
#include "loci/tasks/task_region.hpp"

namespace clearloci::loci {

inline double size_of(const TaskRegion& region, double margin) {
  return std::max({region.upper()[0] - region.lower()[0], region.upper()[1] - region.lower()[1], margin});
}

/// Doubles place the task and its margin to rounding, a few operations of 2^-53 each, many times over; a hair more
/// covers it.
inline double hair_of(const TaskRegion& region, double margin) {
  constexpr double rounding_of_places = 0x1p-46;
  return rounding_of_places *
         (size_of(region, margin) + std::max(std::abs(region.upper()[0]), std::abs(region.upper()[1])));
}

/// A pose of the cell that belongs to the task or its margin.
inline std::optional<core::Point2> pose_within(const TaskRegion& region, double margin, const core::Interval& x,
                                               const core::Interval& y) {
  const core::Point2 middle = {x.middle(), y.middle()}, base = region.closest(middle);
  const double far = std::hypot(middle[0] - base[0], middle[1] - base[1]);
  if (far <= margin * (1 - 1e-9)) return middle;
  const double part = far > 0 ? (1 - 1e-6) * margin / far : 0.0;  // the very edge of the margin says nothing
  const core::Point2 at = {base[0] + part * (middle[0] - base[0]), base[1] + part * (middle[1] - base[1])};
  if (!x.contains(at[0]) || !y.contains(at[1])) return std::nullopt;
  return at;
}

inline void leave_open(CoverProof& proof, const core::Interval& x, const core::Interval& y) {
  proof.leave_open({{x.lower(), x.upper()}, {y.lower(), y.upper()}});
}

}  // namespace clearloci::loci
