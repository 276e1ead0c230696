// Reactions of a planar mechanism at a pose, or in a cell of poses, in intervals: the equations of pose_equations.hpp,
// solved. x and y are seen in the frame of the mechanism, where it has one. Private to check/.
#pragma once

#include <optional>
#include <vector>

#include "check/interval.hpp"
#include "check/pose_equations.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::check {

/// One sign a dyad or slider, in the file's order.
using Sides = std::vector<int>;

using Posture = PostureOf<Interval>;

/// None: some Q or what is left to a limit is negative for certain, or a divisor may be zero.
std::optional<Posture> posture(const mechanism::Mechanism& m, const Sides& sides, const Interval& x, const Interval& y);

/// How many squares of a posture are those of limits.
std::size_t limit_ends(const mechanism::Mechanism& m);

/// What may vanish: the unknowns of A w = -w_e, and behind them what the two ends of each guide's contact bear.
std::vector<mechanism::Unknown> reactions_of(const mechanism::Mechanism& m);

struct Solution {
  std::vector<Interval> reactions;  ///< in the order of reactions_of
  Interval determinant;             ///< |A|
};

/// By elimination with pivots that are not zero. None: |A| may be zero.
std::optional<Solution> solve(const mechanism::Mechanism& m, const Posture& posture, const Interval& x,
                              const Interval& y);

}  // namespace clearloci::check
