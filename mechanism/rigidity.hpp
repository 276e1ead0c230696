// Rigid means rigid: the points of a link keep their distances and turns of its triangles (in space of its tetrahedra).
// Most are held by the way the points are built: an elbow is a length away from its bases. Others are held only where
// the mechanism stands on one side of a fold, such as those of a parallelogram that can flip; there this side alone is
// the mechanism. What has to be held is told from sampled postures of the file's working mode, of points with closed
// forms to 256 bits; symbolic/rigid_sheets proves it sheet by sheet, and whoever builds a posture holds it to rounding.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

struct HeldDistance {
  LinkIndex link = 0;
  PointIndex first = 0, second = 0;
  double length = 0;      ///< m, to rounding
  bool by_sides = false;  ///< a point of it is built by a root: it may hold on one side of a fold alone
};

/// Of three points in the plane, and of four in space.
struct HeldTurn {
  LinkIndex link = 0;
  std::vector<PointIndex> points;
  double size = 0;  ///< twice the signed area, m^2, or six times the volume, m^3
};

/// What no construction holds by itself.
struct HeldByLinks {
  std::vector<HeldDistance> distances;
  std::vector<HeldTurn> turns;

  bool empty() const { return distances.empty() && turns.empty(); }
};

/// A posture that is off by this part of a length or of a turn bends a link: far more than rounding makes, far less
/// than any motion.
inline constexpr double bending = 1e-8;

/// Nothing of what changes with the variables of an open design.
HeldByLinks held_by_links(const Mechanism& mechanism);

/// Whether a posture bends no link, to `bending`.
bool keeps(const HeldDistance& held, const std::vector<std::array<double, 3>>& points);
bool keeps(const HeldTurn& held, const std::vector<std::array<double, 3>>& points);
bool keeps(const HeldByLinks& held, const std::vector<std::array<double, 3>>& points);

/// "distance C1-Q1 of the rigid link rod2".
std::string words_of(const Mechanism& mechanism, const HeldDistance& held);
/// "side of C1, B1 and Q1 in the rigid link rod2".
std::string words_of(const Mechanism& mechanism, const HeldTurn& held);

}  // namespace clearloci::mechanism
