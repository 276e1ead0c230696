// The poses of a task with its margin, over any coordinates, and how cells that cover them are cut until each of them
// is shown to hold a claim. Private to check/.
//
// The task's metric weighs the coordinates; the margin grows over some of them. A polygon is across two lengths, and
// over every other coordinate a range:  distance^2 = distance across^2 + sum of squares of what is left to the ranges.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "core/rational.hpp"

namespace clearloci::check {

/// Lower and upper end of every coordinate.
using Cell = std::vector<std::array<double, 2>>;

/// In m and rad.
struct ClaimedShape {
  std::string name;                                 ///< "box", "ball", "circle", "path", "polygon"
  std::vector<std::vector<core::Rational>> points;  ///< opposite corners; the centre; corners
  std::array<std::size_t, 2> across = {0, 1};       ///< of a polygon
  std::vector<core::Rational> above;  ///< of a polygon over more than two coordinates: sizes of the ranges
  core::Rational radius, margin;

  /// Every point has one number a coordinate, and the numbers are those of a shape.
  bool is_shape(std::size_t coordinates) const;
};

class TaskRegion {
 public:
  /// Required: is_shape(). `grows`: over which coordinates the margin does.
  TaskRegion(ClaimedShape shape, std::vector<double> weights, std::vector<bool> grows);

  /// A cell that holds the task and its margin.
  Cell whole() const;
  /// No pose of the cell is within reach of the task, for certain. Coordinates behind the task's do not count.
  bool is_apart(const Cell& cell) const;

 private:
  double reach() const;
  double rounding() const;
  double to_box(const Cell& cell, const std::vector<bool>& counts) const;
  double to_polygon(const Cell& cell) const;
  double to_segments(const Cell& cell) const;
  double distance(const std::vector<double>& p, const std::vector<double>& a, const std::vector<double>& b) const;

  ClaimedShape shape_;
  std::vector<double> weights_;
  std::vector<bool> grows_;
  std::vector<std::vector<double>> points_;
  Cell sides_;  ///< of a box, and of a polygon over the coordinates that it is not across
};

/// The doubles next to it on either side.
std::array<double, 2> around(const core::Rational& value);

/// "x 1 to 2, y 0 to 1".
std::string described(const Cell& cell, const std::vector<std::string>& names);

/// Whether a claim holds all over a cell; of where it does not, `spreads` tells what each coordinate does to it.
using Holds = std::function<bool(const Cell& cell, std::vector<double>& spreads)>;

/// Cuts the whole until `holds` is true in every cell that is not apart, and returns how many these are. Throws
/// FalseClaim where cells become too small or too many, core::LimitReached where the deadline comes first.
std::size_t covered(const Cell& whole, const std::vector<std::string>& names,
                    const std::function<bool(const Cell&)>& is_apart, const Holds& holds, const Deadline& deadline);

}  // namespace clearloci::check
