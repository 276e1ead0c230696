// The path of a trajectory as a curve by its length: straight lines and arcs that round the corners, or a smooth curve
// through the waypoints. Lengths are those of the free coordinates (m; rad where a coordinate is an angle).
#pragma once

#include <variant>
#include <vector>

#include "mechanism/trajectory.hpp"
#include "numeric/motion_law.hpp"

namespace clearloci::numeric {

using Place = std::vector<double>;

struct LinePiece {
  Place from, direction;  ///< unit direction
};

/// from centre: radius (cos φ e1 + sin φ e2), φ = s/radius.
struct ArcPiece {
  Place centre, e1, e2;
  double radius = 0;
};

/// a + b u + c u² + d u³ over u in [0, 1], natural cubic splines between stops.
struct CubicPiece {
  Place a, b, c, d;
};

struct PathPiece {
  std::variant<LinePiece, ArcPiece, CubicPiece> shape;
  double start = 0;  ///< length of the path where the piece begins
  double length = 0;
};

struct CompiledPath {
  std::vector<PathPiece> pieces;
  std::vector<double> stops;        ///< lengths at which the path stops: its beginning, ..., its end
  std::vector<int> stop_waypoints;  ///< the waypoints there; the first again at the end of a closed path
  double length() const { return stops.back(); }
};

/// Throws core::InputError where a corner has neither a radius nor a stop, or where radii do not fit their segments.
CompiledPath compile(const mechanism::Trajectory& trajectory);

/// The free coordinates at a length along the path, on the given piece or its continuation.
std::vector<Series> place_at(const CompiledPath& path, std::size_t piece, const Series& length);

}  // namespace clearloci::numeric
