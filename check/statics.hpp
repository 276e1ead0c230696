// The equations of a planar mechanism at a pose, in intervals, derived from the model alone: closure point by point
// (docs/method.md section 1), then A w = -w_e, three rows a link (docs/notation.md). Private to check/.
//
//   dyad B on A, P:   D = |P - A|^2,  k = a^2 - b^2 + D,  Q = 4 a^2 D - k^2,  B = A + (k (P - A) +- sqrt(Q) J (P - A))
//   / (2 D) slider S on Q, C: U = u . u,  p = u . (C - Q),  Q = l^2 U - (u x (C - Q))^2,  S = Q + (p +- sqrt(Q)) u / U
// x and y are seen in the frame of the mechanism, where it has one.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "check/interval.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::check {

/// One sign a dyad or slider, in the file's order.
using Sides = std::vector<int>;

struct Posture {
  std::vector<std::array<Interval, 2>> points;
  /// Q of every dyad and slider; then, of every limit, what is left to its lower and its upper end where it has one.
  std::vector<Interval> squares;
  /// What the closure divides by: D of a dyad, |AB|^2 of an offset; and the squared lengths of the axes of guides, by
  /// which the unknowns along them and across are measured; and those of springs.
  std::vector<Interval> divisors;
};

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
