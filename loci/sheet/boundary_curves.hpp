// Where a root's square vanishes: of dyads on fixed points circles, of blocks on fixed rails lines. Where lines and
// circles meet, exactly.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/root_tower.hpp"

namespace clearloci::loci::sheet {

/// A circle around (x, y), or the line normal[0] x + normal[1] y = level.
struct BoundaryCurve {
  int root = 0;
  bool is_line = false;
  core::Rational x, y, radius_squared;
  std::array<core::Rational, 2> normal;
  core::Rational level;

  /// Across the curve at a point of it, of any length.
  std::array<core::Rational, 2> normal_at(const std::array<core::Rational, 2>& at) const;
};

/// Two such curves that meet at foot +- sqrt(rise) way.
struct BoundaryMeeting {
  BoundaryCurve first, second;
  std::array<core::Rational, 2> foot, way;
  core::Rational rise;    ///< not negative
  bool touching = false;  ///< at the foot

  /// Those with rational coordinates: one or two or none.
  std::vector<std::array<core::Rational, 2>> rational_points() const;
};

/// Where two lines or circles meet; nothing where they do not, or are concentric or parallel.
std::optional<BoundaryMeeting> meeting_of(const BoundaryCurve& a, const BoundaryCurve& b);

std::vector<BoundaryMeeting> boundary_meetings(const core::RootTower& tower);

}  // namespace clearloci::loci::sheet
