// Whether a pose fails a task, for certain, by reactions solved in floating point with bounds on their rounding errors:
// the witness without whom no task is called refuted. It knows the mechanism, not the enclosures or the curves.
//
// Between two loads a reaction is w(t) = (1 - t) a + t b, solved under either of them. |w(t)|^2 is a convex quadratic
// in t; its least value lies at t = -a.(b - a)/|b - a|^2, or at an end.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/task_conditions.hpp"
#include "numeric/reactions.hpp"

namespace clearloci::numeric {

struct TaskFailure {
  enum class Kind {
    unreachable,  ///< the mechanism does not reach the pose
    boundary,     ///< it does, but not one within rounding of it
    singular,     ///< |A| is zero, to rounding
    vanishing,    ///< the reaction is zero, to rounding
    too_small     ///< it is less than it has to be
  };
  Kind kind = Kind::unreachable;
  core::TaskDemand demand;  ///< of the last two kinds
  double load = 0;          ///< t
  double size = 0;          ///< of the reaction there, N or N m
};

/// The components of what is demanded, times |A|: two of a guide's contact as a whole, one of either end of it.
std::vector<Bounded> demanded_parts(const NumericModel& model, const core::TaskDemand& demand,
                                    const BoundedNumerators& numerators);

class TaskWitness {
 public:
  /// `loads`: the mechanism under the one load, or under the first and the last; must outlive the witness. `demands`:
  /// without those of reactions that are zero whatever the pose. `usual`: poses that say how large |A| is, and
  /// coordinates.
  TaskWitness(std::vector<const NumericModel*> loads, std::vector<int> mode, std::vector<core::TaskDemand> demands,
              std::span<const Point2> usual);

  /// Nothing where the pose is good, or doubles cannot tell. It stands for every pose within a few roundings of it.
  /// `closely`: also whether the boundary of the workspace passes through it.
  std::optional<TaskFailure> failure(const Point2& at, bool closely) const;

  /// All that fail there; one that has no demand, if any, alone.
  std::vector<TaskFailure> failures(const Point2& at, bool closely) const;

 private:
  std::vector<TaskFailure> some_failures(const Point2& at, bool closely, std::size_t most) const;
  bool reachable_at(const Point2& at) const;

  std::vector<const NumericModel*> loads_;
  std::vector<int> mode_;
  std::vector<core::TaskDemand> demands_;
  double usual_determinant_ = 0, extent_ = 0;  ///< extent: the largest coordinate of the usual poses
};

}  // namespace clearloci::numeric
