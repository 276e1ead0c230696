// Zones over one to three coordinates by cells (method.md section 13): the box is cut into cells that are proven free
// of every locus (pose_cell.hpp), proven out of reach, or left in doubt, but for the parts of it that are known to lie
// on either side of a single locus. Free cells and parts that share some of a face are one zone, for certain: their sum
// is a bound of its size from inside. What is in doubt beside it, and what hangs together with that and may have its
// signs, bounds it from outside.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::pose {

struct CellZone {
  double at_least = 0, at_most = 0;        ///< products of the coordinates' units
  Pose lower, upper;                       ///< of the box around it
  Pose sample;                             ///< well inside its largest cell or part of one
  std::set<std::pair<Doubt, int>> bounds;  ///< what is in doubt beside it
  bool at_side = false;                    ///< it touches the side of the box
  /// Over one coordinate, what is in doubt at its lower and its upper end.
  std::array<std::set<std::pair<Doubt, int>>, 2> at_ends;
  std::set<std::size_t> perhaps;  ///< other zones of its signs that only what is in doubt parts from it
  /// The outside of its cells and parts: over three coordinates convex polygons, counter-clockwise from outside, over
  /// two segments.
  std::vector<Polygon> faces;
};

struct CellZones {
  std::vector<CellZone> zones;  ///< largest first
  double outside = 0;           ///< proven to be out of reach
  double in_doubt = 0;          ///< neither that nor in a zone
  long cells = 0;
  bool out_of_time = false;
  /// In the middles of a grid of effort.raster cells along each coordinate, the first fastest: the zone by its place in
  /// `zones` from 1 on, 0 in doubt, -1 out of reach.
  std::vector<int> raster;
};

struct CellZoneEffort {
  long most_cells = 300'000;
  double enough_doubt = 1e-3;  ///< of the box: where less is in doubt no more cells are cut
  double finest = 0x1p-32;     ///< as a part of the box
  double least_part = 1e-4;    ///< of the box: smaller groups of free cells count as in doubt
  std::vector<int> raster = {};
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
};

CellZones cell_zones(const core::PoseStatics& statics, const Pose& lower, const Pose& upper,
                     const CellZoneEffort& effort = {});

}  // namespace clearloci::loci::pose
