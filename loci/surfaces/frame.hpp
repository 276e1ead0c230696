// The box of three free coordinates and its charts (core/angle_chart.hpp), scaled to the unit cube. Private to
// loci/surfaces.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/locus_factor.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::surface {

using Point = std::array<double, 3>;
using Box = std::array<core::Interval, 3>;
using Vector = std::array<core::Interval, 3>;

inline Vector way(const Point& from, const Point& to) {
  return {core::Interval(to[0]) - core::Interval(from[0]), core::Interval(to[1]) - core::Interval(from[1]),
          core::Interval(to[2]) - core::Interval(from[2])};
}
inline core::Interval product(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector cross_product(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The unit cube's image: of lengths in m, of angles in rad.
struct Frame {
  Point lower{}, upper{};
  std::array<bool, 3> angle{};

  double width(std::size_t i) const { return upper[i] - lower[i]; }
  Point place(const Point& unit) const;
};

/// Of all charts of one mechanism together.
Frame frame_of(const std::vector<const core::LocusProblem*>& charts);

/// Whether two charts have a seam in common.
bool are_neighbours(const core::LocusProblem& a, const core::LocusProblem& b);

/// Of a coordinate; null where it is a length.
const std::optional<core::AngleChart>* chart_of(const core::LocusProblem& problem, std::size_t i);
/// m or rad, of a value of the polynomials' variable.
double coordinate_at(const core::LocusProblem& problem, std::size_t i, const core::Rational& variable);
/// The variable of the polynomials, and how much it moves with the coordinate.
double variable_at(const core::LocusProblem& problem, std::size_t i, double coordinate, double& slope);

}  // namespace clearloci::loci::surface
