// Parts of cells: with e_p in [-1, 1] along every parameter p of a cell, the poses with  way . e > beyond.  Convex, so
// that each hangs together, and their sizes and common faces are known.
#pragma once

#include <array>
#include <vector>

#include "loci/numbers/numbers.hpp"
#include "loci/sheet/pose_chart.hpp"

namespace clearloci::loci::pose {

struct HalfSpace {
  std::array<double, Affine::noises> way{};  ///< sizes add up to 1 at most; up to three are not zero
  double beyond = 1;

  /// The part with small entries of `way` taken for their worst: what is left has a size to 1e-9. Not larger.
  static HalfSpace within(const std::array<double, Affine::noises>& way, double beyond);

  bool empty() const { return !(beyond < 1); }
};

/// The share of its cell, 0 to 1; rounded to 1e-9.
double share_of(const HalfSpace& part);

/// The smallest box around a part of a cell.
PoseBox box_around(const HalfSpace& part, const PoseBox& cell);

/// A pose well inside. Required: not empty.
Pose inner_pose(const HalfSpace& part, const PoseBox& cell);

/// way . e - beyond at a pose; above 0 in the part.
double height(const HalfSpace& part, const PoseBox& cell, const std::array<double, 3>& pose);
/// What of a height may be rounding.
double height_slack(const PoseBox& cell);

using Polygon = std::vector<std::array<double, 3>>;

/// A box of at most two extents that are not a single value, corner after corner; of fewer coordinates than three the
/// others are 0.
Polygon corners_of(const PoseBox& face);
/// The convex polygon's part where the height is above `least` or, with `inside` false, below it.
Polygon clipped(const Polygon& polygon, const HalfSpace& part, const PoseBox& cell, double least, bool inside);
/// Where the part ends inside its cell: over three coordinates a polygon, seen from outside of the part
/// counter-clockwise, over two a segment. Empty where it does not.
Polygon cut_of(const HalfSpace& part, const PoseBox& cell);

}  // namespace clearloci::loci::pose
