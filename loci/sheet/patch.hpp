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
  /// Those that vanish there, once for every power of the distance: a root of a dyad on a dyad carries the squared
  /// distance of the one below as a factor.
  std::vector<int> roots;
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

  Chart() = default;  ///< the plane
  Chart(Side side, int star, const Star& at, const std::array<core::Rational, 4>& rectangle);

  core::Point2 to_plane(double p, double q) const;
  Cell to_plane(const Cell& cell) const;
  /// The place in this chart's coordinates, if it surely lies in the chart.
  std::optional<Cell> from_plane(const Cell& place) const;
  /// A cell that holds the part of the place that lies in the chart; none: there is no such part.
  std::optional<Cell> share_of(const Cell& place) const;

  /// A straight line in (u, X / u, Y / u, roots...), (X, Y) = P - A, in the chart's coordinates (u, t, roots...).
  core::StraightLine in_chart(const core::StraightLine& polar) const;

 private:
  /// x = a + u depth and y = b + u (middle + t half), for a chart on the right or left; x and y exchanged for others.
  struct Frame {
    Interval a, b, depth, middle, half;
    double a_, b_, depth_, middle_, half_;
    core::Rational exact_depth, exact_middle, exact_half;
  };
  bool along_x() const { return side == Side::right || side == Side::left; }
  Frame frame_{};
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

 private:
  /// In (u, X / u, Y / u, roots...), those of the star divided by their powers of u, common powers of u taken out.
  struct AtStar {
    int star = -1;
    std::vector<core::StraightLine> squares, functions;
  };
  const AtStar& at_star(int star);

  core::RootTower tower_;
  std::vector<SheetFunction> functions_;
  std::vector<Star> stars_;
  std::vector<AtStar> known_;
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
