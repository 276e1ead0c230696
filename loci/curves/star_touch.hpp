// A direction in which a curve reaches a star twice: at u = 0 the function has a double zero over t, and a slope along
// u. With both known exactly the curve is u = c (t - t0)^2 + ...: two branches that arrive side by side, as at a cusp
// (c > 0), or none (c < 0). Private to curves/.
#pragma once

#include <optional>
#include <vector>

#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

struct StarTouch {
  std::vector<Interval> enclosure;  ///< of u = 0, t and the roots
  bool enters = false;              ///< two branches arrive
};

/// The only zero at u = 0 in a range of t, if it is a double one in the direction there whose rise is the shortest
/// rational number; the roots there are square roots of rational numbers.
std::optional<StarTouch> star_touch(const Chart& chart, const ChartedSheet& sheet, const core::WorkingMode& mode,
                                    const Interval& t);

}  // namespace clearloci::loci::sheet
