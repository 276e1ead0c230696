// What can be said of a task's conditions over one cell of poses, by enclosures (task_proof.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/locus_map.hpp"
#include "core/task_conditions.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {

class TaskCell {
 public:
  TaskCell(const core::TaskConditions& conditions, const core::WorkingMode& mode);
  TaskCell(const TaskCell&) = delete;
  TaskCell& operator=(const TaskCell&) = delete;

  enum class State { proven, outside, boundary, singular, unmet };

  /// `outside`: no pose of the cell is within reach, for certain. The others: not proven, for what is named was not
  /// excluded.
  struct Judgement {
    State state = State::outside;
    int unmet = -1;  ///< where the state is `unmet`: the first condition that was not proven
  };

  /// Lies in value + slopes . (p - middle) over a cell.
  struct Bound {
    core::Interval value;
    std::array<core::Interval, 2> slopes;
  };
  /// What was not proven all over a cell: it may fail only where none of `any` is positive.
  struct Unproven {
    Judgement what;
    std::vector<Bound> any;
    /// It does fail where any[0] is not positive; with `either_side`, somewhere between places where it is negative and
    /// others where its opposite, any[1], is. False: perhaps not.
    bool sharp = false, either_side = false;
  };
  /// Where poses of a cell may fail: only where one of `unproven` does. `anywhere`: no bounds are known.
  struct Doubt {
    bool anywhere = true;
    core::Point2 middle{};
    std::vector<Unproven> unproven;
  };

  /// Of each cell, given by its ranges of x and y. Enclosures are computed for several side by side; what is told of
  /// one does not depend on the others. `doubts`: also where cells may fail that are not proven.
  std::vector<Judgement> judge(const std::vector<std::array<core::Interval, 2>>& cells,
                               std::vector<Doubt>* doubts = nullptr);
  Judgement judge(const core::Interval& x, const core::Interval& y) { return judge({std::array{x, y}}).front(); }

 private:
  /// sum weight_i f_i.
  using Sum = std::vector<std::pair<core::Interval, int>>;

  std::optional<Judgement> look(sheet::SheetCell& cell, bool inside, bool has_slopes);
  bool nonzero(int function);
  bool holds(const core::TaskCondition& condition);
  /// A lower bound of sum weight_i f_i over the cell is positive.
  bool positive(const Sum& sum, bool with_slopes);
  /// Of the cell that is looked at, slopes included.
  Doubt doubt();
  /// False: no bounds are known.
  bool add_bounds(const core::TaskCondition& condition, const Judgement& what, Doubt& doubt);
  /// Of sum weight_i f_i > 0, or with `either_side` of it not being zero.
  void add_bounds(const Sum& sum, const Judgement& what, bool either_side, Doubt& doubt) const;
  /// Of the square of a lifted root.
  Bound square_bound(int lifted) const;
  bool positive(const Bound& bound) const;
  /// Sums that are positive under every load where a condition is met, n.w - least |n| D for the n that is likeliest to
  /// tell. Null where there is none. Valid until the next call.
  const std::vector<Sum>* sums_of(const core::TaskCondition& condition, bool with_slopes);
  /// False: slopes are not there.
  bool differentiate();
  void take_values(const std::vector<int>& functions, std::vector<double>& list) const;

  const core::TaskConditions& conditions_;
  sheet::SheetProgram program_;
  sheet::SheetCells side_by_side_;
  std::vector<core::Interval> least_;  ///< of every condition
  std::vector<Sum> sums_;
  std::vector<double> ends_[2];
  // Of the cell that is looked at:
  sheet::SheetCell* cell_ = nullptr;
  bool has_slopes_ = false, differentiated_ = false, wants_slopes_ = false;
};

/// The conditions at single poses, in doubles with enclosed roundings: what leads the search for a pose that fails.
class TaskPoint {
 public:
  TaskPoint(const core::TaskConditions& conditions, const core::WorkingMode& mode);
  TaskPoint(const TaskPoint&) = delete;
  TaskPoint& operator=(const TaskPoint&) = delete;

  /// False: out of reach, or so close to its boundary that nothing can be told.
  bool enter(const core::Point2& at);

  /// What changes its sign only where the task fails: |A|'s factors, what forces have in common, couples under either
  /// load, and of forces under a range of loads the area that their two ends span, where it may pass through zero.
  std::size_t watched() const { return watched_.size(); }
  /// +1, -1; 0 where it is not decided, or says nothing.
  int sign(std::size_t watched) const;

  /// A step towards a pose and a load at which a force vanishes, by Newton's method of least squares. `load`: t, moved
  /// too where there is a range. False: none.
  bool step(int condition, core::Point2& at, double& load);

 private:
  struct Watched {
    int function = -1;   ///< a sign of its own, or
    int condition = -1;  ///< the area of this one's ends
  };

  const core::TaskConditions& conditions_;
  sheet::SheetProgram program_;
  sheet::SheetCell cell_;
  std::vector<Watched> watched_;
};

}  // namespace clearloci::loci
