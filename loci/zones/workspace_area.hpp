// The workspace of a mode without a graph of curves: by the signs of the roots' squares alone, which says whether the
// zones that were found cover it.
#pragma once

#include <optional>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {

/// Decides for poses whether the mode reaches them.
class ModeWorkspace {
 public:
  ModeWorkspace(const core::RootTower& tower, const core::WorkingMode& mode);
  /// Every Q_j > 0, or some Q_j < 0, proven; none: on the boundary to rounding, or a point where a leg's ends meet.
  std::optional<bool> holds(const core::Point2& at);
  /// The first answer that one of the points gives; false where none does.
  bool holds_one_of(const core::Polyline& points);

 private:
  sheet::SheetProgram program_;
  sheet::PointSign sign_;
  int roots_;
};

struct AreaBounds {
  double least = 0, most = 0;  ///< of the coordinates' units, m^2 where both are lengths

  /// Whether an area of faces is between them, but for what curved sides may hide of it.
  bool allow(double area) const { return area >= (1 - slack) * least && area <= (1 + slack) * most; }

  static constexpr double slack = 1e-5;  ///< relative: what the boundary's curved sides may hide of an area
};

/// Bounds on the area of the poses in the box that the mode reaches, proven by enclosures of the roots' squares over
/// cells. They are as close as some ten thousand cells make them.
AreaBounds workspace_area(const core::LocusProblem& problem, const core::WorkingMode& mode);

}  // namespace clearloci::loci
