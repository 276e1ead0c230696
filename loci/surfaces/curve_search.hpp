// Common zeros of two functions, a curve, or of three, points, on a working mode's sheet over three coordinates: boxes
// are cut until a cell is proven to hold none, or of a curve one whose stretches are functions of one coordinate (or of
// a root beside the workspace boundary) each, so that they are strung between the cell's faces in the order of that
// coordinate. Private to loci/surfaces.
#pragma once

#include <functional>
#include <vector>

#include "core/locus_map.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::space {

struct SearchLimits {
  int least_depth = 3;              ///< halvings of the box before a cell is taken for good
  int most_depth = 10;              ///< after so many it is left undecided
  long most_cells = 60000;          ///< and half as many besides in which |A| may vanish
  double tolerance = 1e-5;          ///< of chords, in the coordinates as they are
  std::function<bool()> stop = {};  ///< asked now and then; true: throws core::LimitReached
};

/// What vanishes together, and what else tells where to look.
struct Equations {
  std::vector<sheet::SheetFunction> system;       ///< two, or three
  std::vector<sheet::SheetFunction> also;         ///< cells where one of these has no zero are left out
  std::vector<sheet::SheetFunction> determinant;  ///< the factors of |A|
};

/// Where a curve meets a face of a cell, or the workspace boundary in it.
struct Crossing {
  std::vector<double> at;  ///< in all dimensions of its cell
  core::ArcEnd end = core::ArcEnd::none;
};

/// A polyline in the variables of the chart.
struct ChartArc {
  bool closed = false;
  std::array<core::ArcEnd, 2> ends = {core::ArcEnd::none, core::ArcEnd::none};
  bool certified = false;
  std::vector<SpacePoint> points;  ///< a closed one repeats its first point
};

struct ChartPoint {
  SpacePoint at{};
};

struct UndecidedCell {
  SpaceCell cell;
  bool near_singularity = false;  ///< |A| may vanish in it, or in cells with which it hangs together
};

struct FoundCurves {
  std::vector<ChartArc> arcs;  ///< without those on which |A| vanishes
  std::vector<UndecidedCell> undecided;
  bool gave_up = false;  ///< cells away from |A| = 0 were too many
};

struct FoundPoints {
  std::vector<ChartPoint> points;  ///< each proven, with |A| that does not vanish
  std::vector<UndecidedCell> undecided;
  bool gave_up = false;
};

/// `problem`: of one chart. Throws core::LimitReached.
FoundCurves find_curves(const core::LocusProblem& problem, const core::WorkingMode& mode, const Equations& equations,
                        const SearchLimits& limits);
FoundPoints find_points(const core::LocusProblem& problem, const core::WorkingMode& mode, const Equations& equations,
                        const SearchLimits& limits);

/// To rounding, at some points.
bool vanishes_along(const core::LocusProblem& problem, const core::WorkingMode& mode,
                    const sheet::SheetFunction& function, const ChartArc& arc);

/// The coordinates of a point of a chart: m, rad.
SpacePoint placed(const core::LocusProblem& problem, const SpacePoint& variables);

}  // namespace clearloci::loci::space
