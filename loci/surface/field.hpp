// A factor over three free coordinates as a function on the box, in one working mode.
//
// The box is scaled to the unit cube, so that metres and radians weigh alike: p_i = lower_i + u_i (upper_i - lower_i).
// Where a coordinate is an angle, its charts (core/angle_chart.hpp) are joined: at every point the chart that holds it
// is evaluated, with the signs of the charts made equal across their seams.
//
// Beyond the workspace boundary Q_j = 0 the function goes on with s_j = 0, continuously. Private to loci/surface.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/locus_factor.hpp"
#include "loci/sheet/sheet_program.hpp"

namespace clearloci::loci::surface {

using Point = std::array<double, 3>;
using Box = std::array<core::Interval, 3>;

/// The unit cube's image: of lengths in m, of angles in rad.
struct Frame {
  Point lower{}, upper{};
  std::array<bool, 3> angle{};

  double width(std::size_t i) const { return upper[i] - lower[i]; }
  Point place(const Point& unit) const;
};

/// Of all charts of one mechanism together.
Frame frame_of(const std::vector<const core::LocusProblem*>& charts);

/// What is proven of a cell.
struct Proof {
  bool outside = false;    ///< no pose of the mode in the cell
  bool zero_free = false;  ///< the function does not vanish in the cell within the workspace
  bool one_sheet = false;  ///< gradients at any two points of the cell have a positive scalar product
  bool rim = false;        ///< the workspace boundary may pass through the cell where the function depends on its root
};

/// Whether two functions of neighbouring charts are one function across their seam: +1 where they have the same sign at
/// all places compared, -1 the opposite, nothing where neither holds.
std::optional<int> sign_across_seam(const core::LocusProblem& a, const sheet::SheetFunction& of_a,
                                    const core::LocusProblem& b, const sheet::SheetFunction& of_b,
                                    const core::WorkingMode& mode);

/// Whether two charts have a seam in common.
bool are_neighbours(const core::LocusProblem& a, const core::LocusProblem& b);

class Field {
 public:
  /// A function a chart, in its tower's variables, and the sign by which it is multiplied there.
  struct Part {
    const core::LocusProblem* problem = nullptr;
    sheet::SheetFunction function;
    int sign = 1;
  };

  Field(const std::vector<Part>& parts, core::WorkingMode mode);

  const Frame& frame() const { return frame_; }
  int roots() const { return static_cast<int>(mode_.size()); }

  /// The function, beyond the boundary with the roots at 0.
  double value(const Point& unit);
  /// Q_j, with earlier roots at 0 where their squares are negative.
  double square(const Point& unit, int root);
  /// Every Q_j >= 0.
  bool inside(const Point& unit);
  /// Value and gradient, in unit coordinates; a root whose square is not positive counts as constant.
  double gradient(const Point& unit, Point& slopes);
  double square_gradient(const Point& unit, int root, Point& slopes);
  /// The function with a root held at 0.
  double gradient_on_rim(const Point& unit, int root, Point& slopes);

  /// With intervals, rounded outwards.
  Proof examine(const Box& unit);

  /// The function over a box as one chart has it, by unit coordinates.
  struct Over {
    core::Interval value;
    std::array<core::Interval, 3> gradient;
  };
  /// Of every chart that meets the box; nothing where the workspace boundary may pass through it.
  std::optional<std::vector<Over>> over(const Box& unit);

 private:
  struct Chart {
    Chart(const Part& part, const core::WorkingMode& mode);

    const core::LocusProblem* problem;
    sheet::SheetProgram program;
    sheet::SheetProgram::Registers<double> at;
    sheet::SheetProgram::Registers<core::Interval> over;
    Point lower{}, upper{};  ///< of the coordinates: m, rad
    int sign;
  };
  Chart& enter(const Point& unit, int held = -1);
  Point reduced(Chart& chart, int held);
  /// `sign`: proven of the function where the cell is free of zeros.
  Proof examine(Chart& chart, const Box& place, int& sign);
  void differentiate(Chart& chart, Proof& proof);
  Box place_of(const Box& unit) const;
  static bool meets(const Chart& chart, const Box& place);
  /// Sets coordinates and roots; returns the variables of the coordinates, nothing where no pose of the mode is.
  std::optional<Box> enter(Chart& chart, const Box& place);
  core::Interval mean_value(Chart& chart, const Box& variables);
  /// Of `enclosed_`: by a unit coordinate instead of its variable.
  core::Interval by_unit(std::size_t i, const core::Interval& variable) const;

  Frame frame_;
  core::WorkingMode mode_;
  std::vector<std::unique_ptr<Chart>> charts_;
  std::vector<double> gradient_;          ///< of variables, being reduced to the coordinates
  std::vector<core::Interval> roots_;     ///< over the cell being examined
  std::vector<bool> rising_;              ///< which of them may be 0 in it
  std::vector<core::Interval> enclosed_;  ///< likewise
  Point scale_{};                         ///< of the last point entered: d variable / d unit coordinate
};

}  // namespace clearloci::loci::surface
