// A sheet cut into patches on which it is smooth.
//
// Where a dyad's lengths are equal, Q = 4 a^2 D - k^2 has a factor D = |P - A|^2: at P = A the sheet s^2 = Q has the
// point of a cone, and every numerator vanishes there with some power of the distance. Such a point, a *star*, is blown
// up: a rectangle around it is cut into four triangles, each with polar coordinates (u, t),
//     P = A + u (E(t) - A),  E(t) on the triangle's outer side,  u in [0, 1], t in [-1, 1],  s_j = u sigma_j,
// in which sigma_j^2 = Q_j / u^2 is smooth, and the function, divided by its power of u, has simple zeros at u = 0:
// the directions in which branches reach the star.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/locus_map.hpp"
#include "loci/sheet/zero_search.hpp"

namespace clearloci::loci::sheet {

struct Star {
  core::Rational x, y;
  std::vector<int> roots;  ///< those whose square has a double zero there
};

/// The double zeros of root squares at rational points of the plane where a denominator of the tower vanishes.
std::vector<Star> stars(const core::RootTower& tower);

/// The coordinates (p, q) of a patch: the plane itself, or the triangle over one side of a star's rectangle.
struct Chart {
  enum class Side { plane, right, top, left, bottom };
  Side side = Side::plane;
  int star = -1;
  core::Rational origin_x, origin_y;        ///< A
  std::array<core::Rational, 4> rectangle;  ///< x0, x1, y0, y1 around A

  core::Point2 to_plane(double p, double q) const;
  Cell to_plane(const Cell& cell) const;
  /// The place in this chart's coordinates, if it surely lies in the chart.
  std::optional<Cell> from_plane(const Cell& place) const;
  /// A cell that holds the part of the place that lies in the chart; none: there is no such part.
  std::optional<Cell> share_of(const Cell& place) const;
};

/// The tower and functions written in a chart's coordinates, without the common powers of u.
struct ChartedSheet {
  core::RootTower tower;
  std::vector<SheetFunction> functions;
};
ChartedSheet charted(const core::RootTower& tower, const std::vector<SheetFunction>& functions, const Chart& chart,
                     const std::vector<Star>& stars);

/// p / divisor where that is a polynomial; none: not divisible.
std::optional<core::Polynomial> exact_quotient(const core::Polynomial& p, const core::Polynomial& divisor);

/// The functions without the tower's denominators as factors, which say nothing about the curve.
core::Polynomial without_denominators(core::Polynomial function, const core::RootTower& tower);

/// A rectangle of the plane with rectangles around its stars cut out.
struct Partition {
  std::vector<Star> stars;
  std::vector<std::array<double, 4>> holes;  ///< x0, x1, y0, y1, one a star
  std::array<double, 4> domain{};            ///< at least the wanted box, larger where a star is near its edge
  std::vector<Chart> charts;                 ///< the plane first, then four a star
};
/// `bases`: points that no rectangle may come near unless it is their own; those of a whole tower make the partitions
/// of its parts agree on the rectangles they have in common.
Partition partition(const core::RootTower& tower, const std::array<double, 4>& box,
                    const std::vector<core::Point2>& bases);

/// The points of the plane where a denominator of the tower vanishes.
std::vector<core::Point2> bases(const core::RootTower& tower);

inline Partition partition(const core::RootTower& tower, const std::array<double, 4>& box) {
  return partition(tower, box, bases(tower));
}

/// The part of the domain outside the holes, as rectangles.
std::vector<Cell> outside_holes(const Partition& partition);

}  // namespace clearloci::loci::sheet
