// Zeros of one function along a line and of two functions in cells, each proven to be one and to be there.
// Private to check/.
#pragma once

#include <utility>
#include <vector>

#include "check/plane.hpp"
#include "check/sheet.hpp"

namespace clearloci::check {

/// Where a zero is: a tiny box, and what the roots are there that are near 0.
struct Place {
  Interval x, y;
  std::vector<std::pair<int, Interval>> roots;

  core::Point2 at() const { return {x.middle(), y.middle()}; }
};

struct CommonZeros {
  std::vector<Place> zeros;
  std::vector<Rectangle> undecided;
  bool complete = true;  ///< false: not all cells were looked at
};

/// Common zeros of functions 0 and 1 in cells; of function 0 alone where the cells are segments, without width along
/// one axis. Zeros beyond a cell's sides may be among them. `size`: of the box. `most`: cells looked at, at most.
CommonZeros common_zeros(Sheet& sheet, std::vector<Rectangle> cells, double size, std::size_t most);

}  // namespace clearloci::check
