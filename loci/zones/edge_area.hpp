// The area between a curved edge and its chords. For a chord of length h on a curve of curvature kappa it is
// kappa h^3 / 12 (1 + O(h^2)); arcs of circles are exact.
#pragma once

#include "core/locus_map.hpp"

namespace clearloci::loci {

struct EdgeArea {
  double area = 0;   ///< m^2, positive where the curve runs to the right of its chords
  double error = 0;  ///< estimate, from the same with every second vertex
};

/// Between a polyline's chords and its curve, of the given closed form.
EdgeArea area_beside_chords(const core::Polyline& points, const core::ClosedForm& form);

}  // namespace clearloci::loci
