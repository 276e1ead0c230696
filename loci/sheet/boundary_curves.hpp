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

/// A rational point of a circle at which the square of another root, `upper`, vanishes too, which stands on the
/// circle's: where a dyad stands on another one and both are stretched or folded.
struct NestedMeeting {
  BoundaryCurve lower;
  int upper = 0;
  std::array<core::Rational, 2> at;
  bool by_root = false;  ///< Q_k changes with s_j in first order
  bool along = false;    ///< and with the way along the circle
};

/// Those that stand on one other root alone.
std::vector<NestedMeeting> nested_meetings(const core::RootTower& tower);

}  // namespace clearloci::loci::sheet
