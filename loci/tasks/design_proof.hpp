// Whether designs keep clear of every locus over a task: boxes of poses and designs that cover the task, its margin and
// what designs are asked for are cut until each is proven (task_cell.hpp). A cut goes along the coordinate that the
// function in doubt depends on most, so that parameters are cut only where poses alone do not help.
//
// Designs that fail are told by single poses: a pose out of reach for all of them, a reaction too small for all of
// them, or a function that has one sign, for certain, at one pose of the task and the other at another: the task is
// connected, so that in between it vanishes, or the mechanism cannot follow.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "loci/tasks/cover_proof.hpp"
#include "loci/tasks/task_cell.hpp"
#include "loci/tasks/task_region.hpp"

namespace clearloci::loci {

/// A pose at which designs fail, and why: of every design asked for, or of one.
struct DesignFailure {
  enum class Kind { unreachable, singular, vanishing, too_small, displaced };
  Kind kind = Kind::unreachable;
  int condition = -1;  ///< where reactions vanish or are too small
  core::Point2 at{};
  std::vector<double> parameters = {};  ///< of a design at which it does, where not all do
  /// Where a sign changes: which (TaskCell::watched), the pose and the design at the other end.
  std::optional<std::size_t> watched = {};
  core::Point2 other{};
  std::vector<double> other_parameters = {};
  /// Of a displacement the load: the part of the range, and the factors of the directions of the balls.
  double load = 0;
  std::vector<double> load_factors = {};
};

struct DesignProof : CoverProof {
  std::optional<DesignFailure> failure = {};  ///< where refuted
};

inline constexpr SearchBudget budget_of_designs = {.most_cells = 20'000, .most_cells_in_vain = 5'000};

/// Of some designs `verified` speaks of all. `refuted` speaks of all, or of at least one.
enum class Refuting { all, one };

/// The range of every parameter that designs differ in.
using DesignBox = std::vector<core::Interval>;

/// From parameters to the tower's coordinates behind x and y.
struct DesignVariables {
  std::vector<std::vector<std::size_t>> parameters;  ///< of each variable: those that it depends on
  std::function<core::Interval(std::size_t variable, const DesignBox& parameters)> enclosure;
};

/// The clearances that the conditions' take-ups take up, and what they may come to.
struct DesignClearances {
  std::vector<std::vector<std::size_t>> parameters = {};  ///< of each take-up: those that its clearances depend on
  std::function<core::Interval(std::size_t take_up, const DesignBox& parameters)> enclosure = {};
  double most_displaced = std::numeric_limits<double>::infinity();  ///< m, of the end effector
};

class DesignJudge {
 public:
  /// The arguments must outlive the judge. One a thread.
  DesignJudge(const core::TaskConditions& conditions, const core::WorkingMode& mode, const TaskRegion& region,
              DesignVariables variables, std::vector<core::LoadBall> balls = {}, DesignClearances clearances = {});

  DesignProof judge(const DesignBox& designs, double margin, Refuting refuting,
                    const SearchBudget& budget = budget_of_designs);

  /// How far around the task everything holds that holds in it, m, proven: to `accuracy` of itself and of the task's
  /// size. Requires that the designs are verified with the margin `from`.
  double clearance(const DesignBox& designs, double from, double limit, double accuracy, const SearchBudget& budget);

  /// An enclosure of the least size that some conditions' reactions have over the task, N or N m, to `accuracy` of
  /// itself. Requires that the designs are verified.
  core::Interval least_size(const DesignBox& designs, const std::vector<int>& conditions, double accuracy,
                            const SearchBudget& budget) {
    return extreme_size(designs, conditions, accuracy, budget, true);
  }
  /// Likewise the greatest.
  core::Interval greatest_size(const DesignBox& designs, const std::vector<int>& conditions, double accuracy,
                               const SearchBudget& budget) {
    return extreme_size(designs, conditions, accuracy, budget, false);
  }

  /// Likewise how far the end effector is displaced at most, m. Requires clearances.
  core::Interval greatest_displacement(const DesignBox& designs, double accuracy, const SearchBudget& budget);

  /// The share of some poses of the task at which one of the designs fails, or has another sign than at most others.
  double violation(const DesignBox& designs);

  /// The sign of a watched function at a pose of one design; 0: not decided, or not in reach.
  int sign_at(std::size_t watched, const core::Point2& pose, const std::vector<double>& parameters);
  /// What the tower's coordinates are there.
  std::vector<core::Interval> coordinates(const core::Point2& pose, const std::vector<double>& parameters) const;

 private:
  using Box = std::vector<core::Interval>;  ///< x, y, then the parameters
  struct Seen {
    core::Point2 at{};
    std::vector<double> parameters;
    int sign = 0;
  };
  TaskCell::State enter(const Box& box);
  std::vector<core::Interval> clearances_of(const DesignBox& parameters) const;
  /// All poses within `reach` of the task's box, and all designs.
  Box over_designs(const DesignBox& designs, double reach) const;
  /// The coordinate of the box along which a cut helps most; -1: none is worth it.
  int cut(const Box& box);
  /// Looks at one pose of all the designs, or of one in their middle, then of one that is nearer to failing.
  std::optional<DesignFailure> at(const core::Point2& pose, const DesignBox& designs, bool one);
  std::optional<DesignFailure> looked_at(const core::Point2& pose, const DesignBox& designs,
                                         std::vector<double> parameters);
  DesignBox corner_of(const core::Point2& pose, const DesignBox& designs);
  core::Interval extreme_size(const DesignBox& designs, const std::vector<int>& conditions, double accuracy,
                              const SearchBudget& budget, bool least);
  /// `size`: of what was entered last. To `accuracy` of itself.
  core::Interval extreme(const DesignBox& designs, const std::function<core::Interval()>& size, double accuracy,
                         const SearchBudget& budget, bool least);

  TaskCell cell_;
  const TaskRegion& region_;
  DesignVariables variables_;
  DesignClearances clearances_;
  core::Polyline samples_;
  std::vector<Seen> seen_;  ///< a group each
  Box box_, in_tower_;
};

}  // namespace clearloci::loci
