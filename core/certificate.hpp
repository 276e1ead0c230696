// What a trace leaves behind for someone else to check (certificates.md): plain data, no proof of its own.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "clearloci/zones.hpp"
#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"
#include "core/task.hpp"
#include "core/task_conditions.hpp"

namespace clearloci::inline core {

/// A node of a tree of cells, in preorder: a cut into a lower and an upper half, or a leaf with a claim.
struct CellNode {
  enum class Kind : std::uint8_t {
    cut,   ///< at `at` across `axis`; the lower half follows, then the upper one
    free,  ///< the function has no zero on the mode's sheet over the cell, or the sheet has no place over it
    /// Every value of the variable `axis` (0, 1, or 2 + j for root j) is taken at most once on the curve in the cell,
    /// which has `ends` ends there: on the cell's sides and where it meets the workspace's boundary.
    graph,
    open,  ///< nothing is claimed
  };
  Kind kind = Kind::open;
  int axis = 0;
  double at = 0;
  int ends = 0;
};

/// The zeros of one function on one working mode's sheet over a rectangle at least as large as the box.
struct SheetClaim {
  int mode = 0;  ///< of the problem
  FactorRole role = FactorRole::reaction;
  std::string name;                ///< LocusFactor::expression
  StraightLine function;           ///< over (coordinates..., s1...sm) of the whole tower
  std::vector<int> at_zero;        ///< roots that are zero there: the curve is part of their Q_j = 0
  std::array<double, 4> domain{};  ///< x0, x1, y0, y1
  std::vector<CellNode> cells;
};

/// A factor that was traced in a mode, but not proven on its sheet.
struct OpenClaim {
  int mode = 0, factor = 0;  ///< of the problem
};

/// Filled by the adaptive engine where it is asked for.
struct Certificate {
  LocusProblem problem;            ///< that was solved
  std::vector<SheetClaim> sheets;  ///< of every factor and mode that was proven on the sheets
  std::vector<OpenClaim> open;
  LocusMap map;             ///< that was traced
  std::vector<Zone> zones;  ///< that were cut
  std::vector<ZonedMode> zoned_modes;
  /// A free coordinate of the mechanism file is from + scale times the one that all of the above speaks of.
  std::array<Rational, 2> from{};
  Rational scale = 1;
};

/// A task over any coordinates that was verified: what is claimed of it, for someone else to prove anew.
struct TaskCertificate {
  std::vector<std::string> coordinates;
  Task task;               ///< of any shape but a mesh
  std::vector<int> sides;  ///< of the working mode, one a dyad or slider
  struct Range {
    std::string parameter;
    Rational lower, upper;
  };
  std::vector<Range> parameters;  ///< that vary: SI
  std::vector<TaskDemand> demands;
};

/// Loci or zones over one coordinate: what is claimed of them, for someone else to prove anew. SI.
struct RangeCertificate {
  std::string coordinate;
  /// An interval without loci.
  struct Free {
    std::string zone;  ///< of which it is; empty of loci
    Rational from, to;
    int assembly_mode = 0;                         ///< of zones
    std::vector<std::pair<Vanishing, int>> signs;  ///< of zones
    std::vector<Vanishing> too_small = {};         ///< smaller than their least size, and not zero
  };
  struct Mode {
    std::vector<int> sides;           ///< one a dyad or slider
    std::vector<TaskDemand> demands;  ///< what does not vanish in the intervals
    std::vector<Free> free;
    std::vector<IsolatedPoint> points;
    std::vector<std::array<Rational, 2>> open;
  };
  std::vector<Mode> modes;
};

}  // namespace clearloci::inline core
