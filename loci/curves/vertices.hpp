// Polylines along proven stretches: vertices on the curve, chords within the tolerance, steps as long as that allows.
#pragma once

#include <vector>

#include "core/locus_map.hpp"
#include "loci/curves/curve_graph.hpp"

namespace clearloci::loci::sheet {

/// A stretch in the direction of travel.
struct Leg {
  const Stretch* stretch;
  bool forward;
};

struct PlacedArc {
  core::Polyline points;
  double length = 0;
  std::vector<PlaneCell> open =
      {};  ///< around chords longer than the tolerance of which it is not known how near they are
};

/// A point of the curve between the ends of consecutive legs.
core::Point2 point_inside(const CurveGraph& graph, const std::vector<Leg>& legs, double size);

/// Along consecutive legs. Each step is as long as a chord that stays within `tolerance` allows (a chord of length h
/// deviates kappa h^2 / 8), measured against points of the curve between its ends.
PlacedArc place_vertices(const CurveGraph& graph, const core::WorkingMode& mode, const std::vector<Leg>& legs,
                         double tolerance, double size);

}  // namespace clearloci::loci::sheet
