// The adaptive engine: every factor of a problem traced on the sheet of each mode, both cores at work.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "loci/curves/arc_orders.hpp"
#include "loci/curves/engine.hpp"
#include "loci/curves/trace_sheet.hpp"

namespace clearloci::loci {

/// One factor in one mode.
struct SheetShare {
  int factor = 0;  ///< of the problem
  int mode = 0;    ///< of the problem
  sheet::SheetTrace traced;
  bool settled = false;  ///< its curves are known from elsewhere
};

/// The algebra of a problem's curves, as far as it is known already where the problem is traced again.
std::shared_ptr<const CurveAlgebras> curve_algebras(const core::LocusProblem& problem, const TraceOptions& options);

/// Traces every factor that has curves, except those whose curves nobody wants, in every mode. Shares come in the order
/// of modes, then factors. `settled_after`: by factor, the cells after which another engine settles it sooner; 0: none.
std::vector<SheetShare> trace_on_sheets(const core::LocusProblem& problem, const TraceOptions& options,
                                        const CurveAlgebras& algebras, const std::vector<int>& settled_after = {});

/// Appends the curves, points and notes of shares that are not settled to the map. Shares of factors that have a curve
/// in common belong together: a curve carries everything that vanishes on it.
void add_sheet_loci(const core::LocusProblem& problem, const std::vector<SheetShare>& shares,
                    const CurveAlgebras& algebras, core::LocusMap& map);

}  // namespace clearloci::loci
