// Zeros of one function along a line and of two functions in cells, each proven to be one and to be there.
// Private to check/.
#pragma once

#include <optional>
#include <vector>

#include "check/plane.hpp"
#include "check/sheet.hpp"

namespace clearloci::check {

/// Where a zero is: a tiny box.
struct Place {
  Interval x, y;
};

/// Zeros of function 0 on the segment from `from` to `to` of the line on which coordinate `axis` is `at`, in order.
/// None: they could not be told apart, or one is at an end.
std::optional<std::vector<Place>> zeros_on_segment(Sheet& sheet, int axis, double at, double from, double to);

/// Of function 0 at a point: +1, -1; 0: not known. None: outside the workspace.
std::optional<int> sign_at(Sheet& sheet, double x, double y);

struct CommonZeros {
  std::vector<Place> zeros;
  std::vector<Rectangle> undecided;
  bool complete = true;  ///< false: not all cells were looked at
};

/// Common zeros of functions 0 and 1 in cells. `most`: cells looked at, at most.
CommonZeros common_zeros(Sheet& sheet, std::vector<Rectangle> cells, double size, std::size_t most);

}  // namespace clearloci::check
