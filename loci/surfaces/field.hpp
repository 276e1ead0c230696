// A factor over three free coordinates as a function on the box, in one working mode.
//
// The box is scaled to the unit cube, so that metres and radians weigh alike: p_i = lower_i + u_i (upper_i - lower_i).
// Where a coordinate is an angle, its charts (core/angle_chart.hpp) are joined: at every point the chart that holds it
// is evaluated, with the signs of the charts made equal across their seams.
//
// Beyond the workspace boundary Q_j = 0 the function goes on with s_j of the other sign, |s_j| = √|Q_j|: a surface that
// ends on the boundary goes on smoothly then, to where the other sheet has it. Private to loci/surfaces.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/locus_factor.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/sheet/sheet.hpp"
#include "loci/surfaces/frame.hpp"

namespace clearloci::loci::surface {

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

class Field {
 public:
  /// A function a chart, in its tower's variables, and the sign by which it is multiplied there.
  struct ChartPart {
    const core::LocusProblem* problem = nullptr;
    sheet::SheetFunction function;
    int sign = 1;
  };

  Field(const std::vector<ChartPart>& parts, core::WorkingMode mode);

  const Frame& frame() const { return frame_; }
  int roots() const { return static_cast<int>(mode_.size()); }

  /// The function, beyond the boundary as it goes on there.
  double value(const Point& unit);
  /// The same of many, side by side.
  std::vector<double> values(const std::vector<Point>& units);
  /// Q_j, with earlier roots as they go on where their squares are negative.
  double square(const Point& unit, int root);
  std::vector<double> squares(const std::vector<Point>& units, int root);
  /// Every Q_j >= 0.
  bool inside(const Point& unit);
  /// Value and gradient, in unit coordinates; a root whose square is not positive counts as constant.
  double gradient(const Point& unit, Point& slopes);
  double square_gradient(const Point& unit, int root, Point& slopes);
  /// What `gradient` and `inside` tell of a point.
  struct Sight {
    double value = 0;
    Point slopes{};
    bool inside = false;
  };
  std::vector<Sight> look_at(const std::vector<Point>& units);
  /// The function with a root held at 0.
  double gradient_on_rim(const Point& unit, int root, Point& slopes);

  /// With intervals, rounded outwards.
  Proof examine(const Box& unit) { return examine(std::vector{unit}).front(); }
  /// Side by side.
  std::vector<Proof> examine(const std::vector<Box>& units);

  /// A function that on the surface has the sign of a Q_j which may vanish in a box, and is smooth: Q_j itself where
  /// the function does not depend on s_j, else minus the function at s_j = 0, times the sign of its slope by s_j.
  struct Clip {
    int root = 0;
    bool held = false;  ///< the latter
    core::Interval value;
    Vector gradient;
    int times = 1;  ///< that sign, of the latter
  };
  /// The function over a box as one chart has it, by unit coordinates. Its slope along a vector v is
  ///     gradient . v + steep . v / (2 |s|),   0 < |s| <= reach,
  /// with the root s that may vanish in the box and on which the function depends; there is one at most.
  struct Over {
    core::Interval value;
    Vector gradient;
    std::optional<Vector> steep;
    double reach = 0;
    bool known = true;        ///< false: all but the value is not, for several such roots are about
    std::vector<Clip> clips;  ///< one a root that may vanish in the box

    /// Proven: it rises along a vector at every place of the box.
    bool rises(const Vector& way) const;
    /// Proven: (slopes x normal) . (way x normal) > 0, so that it rises along the part of `way` across the normal.
    bool rises_across(const Vector& normal, const Vector& way) const;
  };
  /// Of every chart that meets the box.
  std::vector<Over> over(const Box& unit) { return over(std::vector{unit}).front(); }
  /// Side by side. `signs`: none, or one a box: where the function has that sign all over it, its value is all that has
  /// to be known.
  std::vector<std::vector<Over>> over(const std::vector<Box>& units, const std::vector<int>& signs = {});
  /// Which boxes the function has these signs all over, by plain enclosures.
  std::vector<bool> keeps_signs(const std::vector<Box>& units, const std::vector<int>& signs);
  /// Q_j over boxes, in every chart.
  std::vector<core::Interval> squares_over(const std::vector<Box>& units, int root);
  /// The surface lies on Q_j = 0, and does not end there.
  void lie_on(std::optional<int> root) { lies_on_ = root; }

 private:
  struct Chart {
    Chart(const ChartPart& part, const core::WorkingMode& mode);

    /// Of a coordinate's range, cut to the chart.
    core::Interval variable_over(std::size_t i, const core::Interval& coordinate) const;

    const core::LocusProblem* problem;
    sheet::SheetProgram program;
    sheet::SheetProgram::Registers<double> at;
    sheet::SheetProgram::Registers<sheet::Batch> beside;
    sheet::SheetProgram::Registers<sheet::IntervalBatch> over;
    Point lower{}, upper{};  ///< of the coordinates: m, rad
    Point least{}, most{};   ///< of their variables
    int sign;
  };
  /// The chart that holds a place, or the nearest.
  Chart& chart_at(const Point& place);
  Chart& enter(const Point& unit, int held = -1);
  Point reduced(Chart& chart, int held);
  /// Sets coordinates and roots of at most Batch::size places of a chart; `scales`: as scale_.
  void enter(Chart& chart, const std::vector<Point>& places, std::vector<Point>& scales);
  /// Visits the points a batch at a time, with the chart that holds them, their places among them all and their scales,
  /// once their roots are there.
  template <class Visit>
  void each_batch(const std::vector<Point>& units, const Visit& visit);

  /// A box in a chart, enclosed with others side by side.
  struct Lane {
    std::size_t box = 0;                   ///< of those asked about
    Box variables{};                       ///< of the coordinates
    bool outside = false;                  ///< no pose of the mode in it
    std::vector<core::Interval> roots{};   ///< over the box
    std::vector<bool> rising{};            ///< which of them may be 0 in it
    std::vector<core::Interval> slopes{};  ///< by the program's variables, then with the roots reduced to the others
    core::Interval mean_value = 0;         ///< the function's, by its mean-value form
    int sign = 0;                          ///< that it is asked for; 0: none
    int steep = -1;                        ///< a root that may be 0 and on which the function depends
    std::vector<Vector> clip_slopes{};     ///< of an Over's clips, by the variables
  };
  using Lanes = std::vector<Lane>;  ///< at most IntervalBatch::size
  /// Those boxes that meet the chart, as many at a time as go side by side.
  std::vector<Lanes> lanes_of(const Chart& chart, const std::vector<Box>& places) const;
  /// Sets coordinates and roots.
  void enter(Chart& chart, Lanes& lanes);
  void differentiate(Chart& chart, Lanes& lanes);
  static void reduce(const Chart& chart, const Lane& lane_values, std::size_t lane,
                     std::vector<core::Interval>& slopes);
  void take_mean_values(Chart& chart, Lanes& lanes);
  /// `signs`: what is proven of the function where a lane is free of zeros.
  std::vector<Proof> examine(Chart& chart, Lanes& lanes, std::vector<int>& signs);
  Box place_of(const Box& unit) const;
  static bool meets(const Chart& chart, const Box& place);
  /// By a unit coordinate instead of its variable.
  core::Interval by_unit(std::size_t i, const core::Interval& slope, const core::Interval& variable) const;
  Vector by_unit(const Vector& slopes, const Box& variables, double times) const;

  /// Sets the coordinates, to their middles if so.
  static void set_variables(Chart& chart, const Lanes& lanes, bool middles = false);
  /// Sets the coordinates, and makes room for the roots.
  void begin(Chart& chart, Lanes& lanes) const;
  /// Sets coordinates and roots, these as they go on beyond the boundary; `roots` of those that may vanish reach to 0.
  void enter_with_beyond(Chart& chart, Lanes& lanes);
  /// Sets roots that may vanish as they are over all of the boxes, the others by the coordinates that are set. `held`:
  /// steep ones at 0.
  void set_roots(Chart& chart, const Lanes& lanes, bool held);
  /// With signs that are asked for.
  std::vector<Over> over(Chart& chart, Lanes& lanes);
  /// Of Q_j by the coordinates' variables; nothing where it depends on another root that may vanish.
  std::optional<Vector> square_slopes(const Chart& chart, const Lanes& lanes, std::size_t lane, int root) const;
  /// What differentiate() tells of a lane: all but its values and the clips at steep roots.
  void take_slopes(const Chart& chart, Lanes& lanes, std::size_t lane, Over& over) const;
  void add_held_clips(Chart& chart, Lanes& lanes, std::vector<Over>& overs);
  void narrow_clips(Chart& chart, const Lanes& lanes, std::vector<Over>& overs);

  Frame frame_;
  core::WorkingMode mode_;
  std::optional<int> lies_on_;
  std::vector<std::unique_ptr<Chart>> charts_;
  std::vector<double> gradient_;  ///< of variables, being reduced to the coordinates
  Point scale_{};                 ///< of the last point entered: d variable / d unit coordinate
};

}  // namespace clearloci::loci::surface
