// Where traced arcs pass the lines of a grid. A polyline deviates from its curve by up to `reach`, so a curve can meet
// a line only where the line is within `reach` of the polyline: those stretches are kept beside the crossings proper.
#pragma once

#include <span>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::numeric {

/// Positions along one axis: node i stands at origin + i · step.
struct GridAxis {
  double origin = 0;
  double step = 1;
  int nodes = 0;

  double at(int node) const { return origin + node * step; }
};

/// Lines y = rows.at(j) and x = columns.at(i).
struct Grid {
  GridAxis x, y;
};

/// The stretch [low, high] of a line that a polyline's segment comes near. `at`: where the segment crosses the line.
struct Passage {
  double low = 0, high = 0;
  double at = 0;
  bool crosses = false;
  int curve = 0;
};

struct GridPassages {
  std::vector<std::vector<Passage>> rows;     ///< on y = y.at(j), positions are x, in ascending order of `low`
  std::vector<std::vector<Passage>> columns;  ///< on x = x.at(i), positions are y
};

/// Passages of the curves whose numbers are given. A vertex on a line counts as above it, so that a chain of segments
/// crosses a line as often as it changes sides.
GridPassages find_passages(const Grid& grid, const std::vector<core::LocusCurve>& curves, std::span<const int> numbers,
                           double reach);

}  // namespace clearloci::numeric
