// Which parts are too many, and which too few: the equilibrium of all links, A w = 0, at a sampled posture. What a
// vector of the null space of A loads braces against itself without any load; what one of the null space of A^T moves
// is held by no motor (principle of virtual work). For messages: no result rests on it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

struct Redundancy {
  std::vector<std::string> motors;  ///< any one of them can be left out, and the rest still holds the mechanism
  std::vector<std::string> rods;    ///< links between two pins or balls that nothing drives, the same
  std::vector<std::string> joints;  ///< all joints that brace against each other
  std::vector<std::string> loose;   ///< links that move while every motor stands still
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
