// Which parts are too many, and which too few: the equilibrium of all links, A w = 0, at a sampled posture. What a
// vector of the null space of A loads braces against itself without any load; what one of the null space of A^T moves
// is held by no motor (principle of virtual work). For messages: no result rests on it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/dependence.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// A unit reaction that a joint can bear, of `from` on `to`: a force at a point, or a couple.
struct BorneReaction {
  JointIndex joint = 0;
  bool motor = false;
  LinkIndex from = ground, to = ground;
  PointIndex at = 0;
  std::array<double, 3> force{}, couple{};
};

/// One a column of the unknowns of every joint; nothing where an axis is not known in this pose.
std::optional<std::vector<BorneReaction>> reactions_at(const Mechanism& mechanism, const std::vector<double>& pose);

/// Force and moment balances of every link, in lengths of the mechanism's size. A row is a freedom of a link too: it
/// moves where a vector of the left null space is not zero.
Matrix balances_of(const Mechanism& mechanism, const std::vector<BorneReaction>& columns,
                   const std::vector<std::array<double, 3>>& places);

/// Whether a link only passes a force on from one pin to another.
bool is_rod(const Mechanism& mechanism, LinkIndex link);

struct Redundancy {
  std::vector<std::string> motors;  ///< any one of them can be left out, and the rest still holds the mechanism
  std::vector<std::string> rods;    ///< links between two pins or balls that nothing drives, the same
  std::vector<std::string> joints;  ///< all joints that brace against each other
  std::vector<std::string> loose;   ///< links that move although every motor stands still
};

/// Nothing where no posture was found, or where all depends on the posture.
std::optional<Redundancy> redundancy(const Mechanism& mechanism);

/// What is wrong and how to mend it, to follow on the count of what is too many or too few.
struct Advice {
  std::string problem, mend;
};
Advice too_many(const Mechanism& mechanism, std::size_t count);
Advice too_few(const Mechanism& mechanism);
/// Where the numbers agree: a part moves freely and another is held twice.
Advice misplaced(const Mechanism& mechanism);

}  // namespace clearloci::mechanism
