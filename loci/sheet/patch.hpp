// A sheet cut into patches on which it is smooth.
//
// Around a star (star.hpp) the sheet is blown up: a rectangle around it is cut into four pieces, each with coordinates
// (u, t) in which t runs along one of the rectangle's sides and u leads from the star to there along a curve on which
// coordinates shrink with their weights: for a cone
//     P = A + u (E(t) - A),  E(t) on the piece's outer side,  u in [0, 1], t in [-1, 1]
// Where a workspace boundary runs through a cone, a sector on either side of it, about the boundary's tangent, is cut
// out of the piece over that side. In the sector Y is the way along the tangent and X the way off it, 1 at its rim:
//     middle  Y = u, X = u^2 t                      a parabola either side of the tangent bounds it, at t = -1 and 1
//     wings   Y = u rho^2, X = +-u^2 rho^2          between that parabola, rho = 1, and the sector's rim, u = 1;
//                                                   rho = (1 + t) / 2
// The star is the side u = 0 of all pieces, and of a wing the side t = -1 too.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/locus_map.hpp"
#include "loci/sheet/plane_cell.hpp"
#include "loci/sheet/star.hpp"

namespace clearloci::loci::sheet {

/// The coordinates (p, q) of a patch: the plane itself, or the triangle over one side of a star's rectangle or a part
/// of that side.
struct Chart {
  enum class Side { plane, right, top, left, bottom };
  /// Before, in and beyond the sector about a tangent, in the sense in which t grows.
  enum class Part { whole, before, wing_before, middle, wing_beyond, beyond };
  Side side = Side::plane;
  Part part = Part::whole;
  int star = -1;
  core::Rational origin_x, origin_y;        ///< A
  std::array<core::Rational, 4> rectangle;  ///< x0, x1, y0, y1 around A

  Chart() = default;  ///< the plane
  Chart(Side side, int star, const Star& at, const std::array<core::Rational, 4>& rectangle);

  /// Its parts where the tangent of a boundary at the star meets the side well inside; else itself alone.
  std::vector<Chart> parts(const Star& at) const;
  bool is_wing() const { return part == Part::wing_before || part == Part::wing_beyond; }
  bool is_tangential() const { return is_wing() || part == Part::middle; }
  /// Whether a cell touches the star and reaches no farther from it than that, in the chart's coordinates.
  bool is_at_star(const PlaneCell& cell, double reach) const;
  /// By how much a root of the tower at a place of the chart is more than the chart's own.
  double scale_of_root(int root, const Star& at, double p, double q) const;
  /// Of directions at the star the one in a range of t whose rise is the shortest rational number.
  core::Rational shortest_direction(const Interval& t) const;
  bool operator==(const Chart& other) const;

  core::Point2 to_plane(double p, double q) const;
  PlaneCell to_plane(const PlaneCell& cell) const;
  /// The place in this chart's coordinates, if it surely lies in the chart.
  std::optional<PlaneCell> from_plane(const PlaneCell& place) const;
  /// A cell that holds the part of the place that lies in the chart; none: there is no such part.
  std::optional<PlaneCell> share_of(const PlaneCell& place) const;

  /// A straight line in (u, X', Y', roots...), of a wing in (u, X', Y', rho, roots...) (star.hpp), in the chart's
  /// coordinates (u, t, roots...).
  core::StraightLine in_chart(const core::StraightLine& polar) const;

 private:
  /// `a`, `b`: of the star, across the side and along it; the side's distance from the star, its middle and half
  /// length, of a wing's how far off the tangent it reaches; where it is sheared the tangent's slope.
  template <class T>
  struct Frame {
    T a, b, depth, middle, half, slope;
  };
  void take_numbers();
  bool along_x() const { return side == Side::right || side == Side::left; }
  /// From the star, across the side and along it.
  template <class T>
  std::array<T, 2> from_star(const Frame<T>& frame, const T& u, const T& t) const;
  /// u of a place so far from the star across the side and along it; below 0 where no place of the chart is.
  Interval distance(const Interval& deep, const Interval& wide) const;
  /// Where the curve from the star through the place meets the line of the side, counted from the star.
  Interval on_side(const Interval& u, const Interval& deep, const Interval& wide) const;
  /// Of a wing: the part of a place so far from the star, across the side and along it, that lies in the chart.
  std::optional<PlaneCell> share_of_wing(const Interval& deep, const Interval& wide) const;

  bool sheared_ = false, doubled_ = false;
  bool deep_is_along_ = true;  ///< where it is sheared: the way across the side is the one along the tangent
  core::Rational radius_, slope_radius_ = 0;  ///< of the star's coordinates, of the tangent's slope
  core::Rational exact_depth_, exact_middle_, exact_half_, exact_slope_;
  Frame<Interval> interval_{};
  Frame<double> double_{};
};

/// The tower and functions written in a chart's coordinates, without the common powers of u.
struct ChartedSheet {
  core::RootTower tower;
  std::vector<SheetFunction> functions;
};
/// A sheet for several charts: what the charts of one star have in common is computed once.
class Charting {
 public:
  Charting(const core::RootTower& tower, std::vector<SheetFunction> functions, const std::vector<Star>& stars);
  ChartedSheet in(const Chart& chart);

  /// Of the coordinates around a star.
  enum class Weights { own, tangential, both };

 private:
  /// In (u, X', Y', roots...), those of the star divided by their powers of u, common powers of u taken out.
  struct AtStar {
    int star = -1;
    Weights weights = Weights::own;
    std::vector<core::StraightLine> squares, functions;
  };
  const AtStar& at_star(const Chart& chart);

  core::RootTower tower_;
  std::vector<SheetFunction> functions_;
  std::vector<Star> stars_;
  std::vector<AtStar> known_;
};

ChartedSheet charted(const core::RootTower& tower, const std::vector<SheetFunction>& functions, const Chart& chart,
                     const std::vector<Star>& stars);

/// The functions without the tower's denominators as factors, which say nothing about the curve.
core::Polynomial without_denominators(core::Polynomial function, const core::RootTower& tower);

/// What lies beyond a side of a chart.
struct ChartBorder {
  enum class To {
    edge,   ///< nothing: of the plane
    star,   ///< the side is the star
    plane,  ///< the rectangle's side
    chart,  ///< another chart of the star
  };
  To to = To::edge;
  bool is_searched = true;            ///< zeros on a side between two charts of a star are searched from one of them
  int chart = -1, axis = 0, end = 0;  ///< of another chart: which side
};
using ChartBorders = std::array<ChartBorder, 4>;  ///< by side_of
inline std::size_t side_of(int axis, int end) { return 2 * static_cast<std::size_t>(axis) + (end > 0 ? 1 : 0); }

/// A rectangle of the plane with rectangles around its stars cut out.
struct Partition {
  std::vector<Star> stars;
  std::vector<std::array<double, 4>> holes;  ///< x0, x1, y0, y1, one a star
  std::array<double, 4> domain{};            ///< at least the wanted box, larger where a star is near its edge
  std::vector<Chart> charts;                 ///< the plane first, then those of each star: four or more
  std::vector<ChartBorders> borders;         ///< of the charts

  /// Of a chart: across an axis, at its lower (-1) or upper (1) end.
  const ChartBorder& border(int chart, int axis, int end) const {
    return borders[static_cast<std::size_t>(chart)][side_of(axis, end)];
  }
};

/// `bases`: points that no rectangle may come near unless it is their own; those of a whole tower make the partitions
/// of its parts agree on the rectangles they have in common. `special`: stars besides the cones of the tower. `skewed`:
/// rectangles that have their stars off the middle, so that their corners lie in other directions.
Partition partition(const core::RootTower& tower, const std::array<double, 4>& box, std::vector<core::Point2> bases,
                    const std::vector<Star>& special, bool skewed = false);

/// The points of the plane where a denominator of the tower vanishes.
std::vector<core::Point2> bases(const core::RootTower& tower);

inline Partition partition(const core::RootTower& tower, const std::array<double, 4>& box) {
  return partition(tower, box, bases(tower), touches(tower));
}

/// The part of the domain outside the holes, as rectangles.
std::vector<PlaneCell> outside_holes(const Partition& partition);

}  // namespace clearloci::loci::sheet
