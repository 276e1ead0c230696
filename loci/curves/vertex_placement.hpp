// Vertices along an edge of the arrangement: on the curve to rounding, as far apart as the chord tolerance lets them.
#pragma once

#include "loci/curves/curve_arrangement.hpp"
#include "loci/curves/plane_curve.hpp"

namespace clearloci::loci {

/// From the edge's `from` to its `to`, both included. Every vertex is the exact root at its x (correct to 1e-16 of the
/// box); chords deviate by at most `tolerance`.
core::Polyline place_vertices(const CurveArrangement& arrangement, int edge, const PlaneCurve& curve, double tolerance);

/// The arc of a circle through `start`, `via` and `end` in this order (all on it); a whole turn from `start` where it
/// is closed. Equal chords, as few as the tolerance allows.
core::Polyline circle_arc(const core::Point2& centre, double radius, const core::Point2& start, const core::Point2& via,
                          const core::Point2& end, bool closed, double tolerance);

}  // namespace clearloci::loci
