// Zones over one to three coordinates by cells (method.md section 13): the box is cut into cells that are proven free
// of every locus (pose_cell.hpp), proven out of reach, or left in doubt. Free cells that share a face are one zone, for
// certain: their sum is a bound of its size from inside. Cells in doubt that touch it, and those that touch them, bound
// it from outside.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "loci/pose/pose_cell.hpp"

namespace clearloci::loci::pose {

struct CellZone {
  double at_least = 0, at_most = 0;        ///< products of the coordinates' units
  Pose lower, upper;                       ///< of the box around its cells
  Pose sample;                             ///< the middle of its largest cell
  std::set<std::pair<Doubt, int>> bounds;  ///< what is in doubt in the cells beside it
  bool at_side = false;                    ///< it touches the side of the box
  /// Other zones that touch the same cells in doubt: unless a sign differs they may be one.
  std::set<std::size_t> beside;
  std::vector<std::array<Pose, 2>> cells;  ///< lower and upper corner
  /// Over three coordinates, the faces of its cells towards what is no part of it, as corners in a circle seen from
  /// outside counter-clockwise.
  std::vector<std::array<std::array<double, 3>, 4>> faces;
};

struct CellZones {
  std::vector<CellZone> zones;  ///< largest first
  double outside = 0;           ///< proven to be out of reach
  double in_doubt = 0;          ///< neither that nor in a zone
  long cells = 0;
  bool out_of_time = false;
};

struct CellZoneEffort {
  long most_cells = 300'000;
  double finest = 0x1p-32;   ///< as a part of the box
  double least_part = 1e-4;  ///< of the box: smaller groups of free cells count as in doubt
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
};

CellZones cell_zones(const core::PoseStatics& statics, const Pose& lower, const Pose& upper,
                     const CellZoneEffort& effort = {});

}  // namespace clearloci::loci::pose
