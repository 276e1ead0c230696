// The largest circle inside a face, polished from a Voronoi vertex of the polylines to the curves themselves.
#pragma once

#include <vector>

#include "core/locus_map.hpp"
#include "loci/curves/curves.hpp"

namespace clearloci::loci {

/// A curve as an obstacle.
struct Obstacle {
  const core::Polyline* line = nullptr;
  const CurveProjection* curve = nullptr;  ///< null: the polyline is the curve
};

/// Polishing moves a centre by no more than this, relative to the radius.
inline constexpr double farthest_polished = 0.3;

/// Newton's method on the three (or more) curves that the circle touches. `tolerance`: chord deviation of the lines.
/// The result holds no point of an obstacle; it is the circle given, made smaller, where Newton leads nowhere.
core::Circle polished(const core::Circle& start, const std::vector<Obstacle>& obstacles, const core::Polyline& points,
                      double tolerance);

}  // namespace clearloci::loci
