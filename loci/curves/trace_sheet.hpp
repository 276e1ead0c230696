// The adaptive engine: one curve of one working mode, traced on the mode's sheet with proven topology.
//
// The box is subdivided into cells that are proven free of the curve or to meet it in graphs over a local coordinate;
// crossings with cell edges, the box and the workspace boundary are isolated by Krawczyk's operator; sorted along the
// coordinate they bound the pieces of curve in the cell (method.md section 8).
#pragma once

#include <functional>
#include <vector>

#include "core/certificate.hpp"
#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

/// Another sheet polynomial at whose zeros arcs are cut, e.g. |A| with the label direct_singularity.
struct Cutter {
  SheetFunction sheet;
  core::ArcEnd label = core::ArcEnd::direct_singularity;
  bool keep = false;  ///< arcs are wanted only where the sheet is not negative
};

struct SheetTraceOptions {
  double tolerance = 1e-5;  ///< chord deviation
  /// Which of several plane curves a point of the sheet curve lies on, where it is made of several; may be empty.
  std::function<int(const core::Point2&)> colour;
  /// Whether a plane curve is wanted as ends and a point between only, its vertices being known in closed form.
  std::vector<bool> closed_form;
  /// The side of the box that a plane curve is a part of: 0 to 3 for x0, x1, y0, y1; -1: none, as where nothing is
  /// said.
  std::vector<int> along_side;
  /// Of the whole tower: where the sheet is not smooth besides its cones, and corners that the curve passes.
  std::vector<Star> special;
  int most_cells = 150000;  ///< budget of cells a patch
  /// Another engine takes a curve whose budget is spent: nothing more is made of it here.
  bool whole_or_nothing = false;
  bool sketch = false;         ///< the budget is not extended, and what is left open not tried again with other cuts
  std::function<bool()> stop;  ///< true: finish with what is known, stopped = true
  bool certificate = false;    ///< fill in SheetTrace::claims
  /// Where what does not depend on the tolerance is looked up and kept; may be null. Required: of one `colour` all that
  /// is traced of one function.
  KnownSearches* searches = nullptr;
};

/// A rectangle of the plane.
struct Region {
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

struct TracedArc {
  core::Arc arc;
  int colour = 0;
  core::Point2 inner{};  ///< a point between the ends
};

struct SheetTrace {
  std::vector<TracedArc> arcs;
  std::vector<core::Point2> isolated_points;  ///< where an undecided cell has the curve in one point to all appearance
  bool certified = true;                      ///< topology proven: no undecided cell
  bool stopped = false;                       ///< by SheetTraceOptions::stop
  std::vector<Region> undecided;
  std::vector<core::SheetClaim> claims;  ///< without mode and role
};

/// Whether a branch of N = 0 on the mode's sheet reaches a star of the whole tower. `box`: x0, x1, y0, y1.
bool reaches(const core::RootTower& tower, const core::WorkingMode& mode, const SheetFunction& sheet, const Star& star,
             const std::array<double, 4>& box);

/// All of N = 0 in the closed box and the mode's workspace. Ends at a side of the box lie on it; a curve that touches a
/// side from inside is not cut there, and one that only touches the box from outside has no arc. What cannot be told
/// apart within 1e-10 of a place where curve and side touch counts as one point.
SheetTrace trace_sheet(const core::RootTower& tower, const core::WorkingMode& mode,
                       const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper,
                       const SheetFunction& sheet, const std::vector<Cutter>& cutters = {},
                       const SheetTraceOptions& options = {});

}  // namespace clearloci::loci::sheet
