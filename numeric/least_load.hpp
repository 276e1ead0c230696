// The load under which a demanded reaction is least, and whether it fails there, for certain.
//
// Between two loads a reaction is w(t) = (1 - t) a + t b, solved under either of them. |w(t)|^2 is a convex quadratic
// in t; its least value lies at t = -a.(b - a)/|b - a|^2, or at an end. With loads of balls on top, reactions are
// linear in them, too: |w + sum l_i w_i| over the balls is a convex problem, minimised along t and in each ball in
// turn, each by the singular values of its directions.
#pragma once

#include <optional>
#include <vector>

#include "numeric/task_witness.hpp"

namespace clearloci::numeric {

/// Components of a demanded reaction times |A|: under the ends of the loads and under each direction.
struct LoadedParts {
  std::vector<std::vector<Bounded>> ends, directions;
};

/// Where it is least: so far from the first end to the last, and what comes on top, of each direction.
struct LeastLoad {
  double t = 0;
  std::vector<double> changes;
};

/// The load between one or two ends and within the balls under which |w| is least; w under each end, and what a unit of
/// each direction adds to it.
LeastLoad least_load(const std::vector<std::vector<double>>& ends, const std::vector<std::vector<double>>& directions,
                     const std::vector<core::LoadBall>& balls);

/// The largest numerator.
double usual_numerator(const std::vector<BoundedNumerators>& under_loads);

/// Nothing where the reaction is large enough under every load, or doubles cannot tell. `usual`: a numerator's.
std::optional<TaskFailure> failure_under_least_load(const core::TaskDemand& demand, const LoadedParts& parts,
                                                    const std::vector<core::LoadBall>& balls,
                                                    const Bounded& determinant, double usual);

}  // namespace clearloci::numeric
