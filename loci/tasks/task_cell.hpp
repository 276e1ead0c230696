// What can be said of a task's conditions over one cell, by enclosures (method.md section 12).
//
// Coordinates are those of the tower: x, y, then the variables of an open design (mechanism/open_design.hpp). Loads. A
// ball of loads adds r u, |u| <= 1, along its two directions and m v, |v| <= 1, along that of its couple, to every
// load:
//     w = (N + r (u_x N_x + u_y N_y) + m v N_c) / D
// It keeps |w| > least for all u, v if some n has  n.N - r |(n.N_x, n.N_y)| - m |n.N_c| > least |n| |D|.
//
// The displacement of the end effector by the clearances that its joints take up (method.md section 6): by virtual work
// the reactions w^u = N^u / D to a unit force on it along u turn a take-up into a displacement along u,
//     e_u = - sum_J rho_J (f_J^u . f_J) / |f_J| - sum_J delta_J M_J^u sign(M_J)
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/locus_map.hpp"
#include "core/task_conditions.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {

/// What a task asks beyond its conditions.
struct TaskExtent {
  std::vector<core::LoadBall> balls = {};
  /// m, that the end effector may be displaced over a proven cell; not asked for where the conditions have no take-ups.
  double most_displaced = std::numeric_limits<double>::infinity();
};

class TaskCell {
 public:
  TaskCell(const core::TaskConditions& conditions, const core::WorkingMode& mode, TaskExtent extent = {});
  TaskCell(const TaskCell&) = delete;
  TaskCell& operator=(const TaskCell&) = delete;

  /// `outside`: no pose of the cell is within reach, for certain, of no design. The others: not proven, for what is
  /// named was not excluded.
  enum class State { proven, outside, boundary, singular, unmet };
  struct Judgement {
    State state = State::outside;
    int unmet = -1;  ///< where the state is `unmet`: the first condition that was not proven
  };

  // ---- Of several cells of poses

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

  // ---- Of one cell of poses and designs; what follows is told of the one entered last

  /// `clearances`: of each of the conditions' take-ups the clearances of its joints together: m, and rad of what turns.
  State enter(std::span<const core::Interval> box, std::vector<core::Interval> clearances = {});
  /// Parts of the loads that the last cell was looked at under, one by one.
  int parts_of_loads() const { return parts_of_loads_; }
  bool has_many_loads() const { return conditions_.loads > 1 || !extent_.balls.empty(); }
  /// Where the state is `unmet`: the first condition that was not proven; -1: the end effector is displaced too far.
  int unmet() const { return unmet_; }

  /// Where nothing was proven: how much of the variation of the functions in doubt each coordinate makes. After
  /// enter().
  const std::vector<double>& spreads();
  /// Likewise of each clearance; empty where they are not in doubt. After spreads().
  const std::vector<double>& clearance_spreads() const { return clearance_spreads_; }

  /// Where nothing was proven: the way along each coordinate, -1, 0 or +1, on which what is in doubt first comes nearer
  /// to failing. A guess, for where to look.
  const std::vector<int>& downhill();
  /// Likewise of each clearance. After downhill().
  const std::vector<int>& clearances_downhill() const { return clearances_downhill_; }

  /// A condition that every pose and design of the box fails, for certain: it is too small, or vanishes under some
  /// load; -1: none is known. Where the state is neither `outside` nor `boundary`.
  int failed() const;
  /// Some of a task's loads: the part t of the range, and a factor of every direction.
  struct Loads {
    core::Interval t;
    std::vector<core::Interval> factors;
  };
  /// A load, if one is found, under which all designs of the box are displaced farther than they may in all its poses.
  std::optional<Loads> displaced_too_far();

  /// What changes its sign nowhere in a task that verifies: the factors of |A|, what reactions have in common, scalar
  /// reactions. +1 and -1 are certain.
  std::size_t watched() const { return watched_.size(); }
  int sign(std::size_t watched) const { return value(watched_[watched].function).sign(); }
  /// Of conditions(); -1: of |A|.
  int condition_of(std::size_t watched) const { return watched_[watched].condition; }
  /// Watched functions of one group have one sign in common: a reaction under both ends of a range of loads.
  int group_of(std::size_t watched) const { return watched_[watched].group; }
  int groups() const { return groups_; }

  /// The least, or the greatest, that a condition's reactions bear under any load, N or N m: an enclosure of it over
  /// the box. Required: |A| has a sign.
  core::Interval size_of(int condition, bool least);

  /// How far the end effector is displaced at most under any load, m: an enclosure of it over the box. Required:
  /// take-ups with their clearances, and |A| has a sign.
  core::Interval displacement();
  /// spreads() are of the displacement from now on, whatever else is in doubt.
  void doubt_displacement() { displacement_in_doubt_ = true; }
  bool doubts_displacement() const { return displacement_in_doubt_; }

 private:
  /// sum weight_i f_i.
  using Sum = std::vector<std::pair<core::Interval, int>>;
  struct Watched {
    int function = -1, condition = -1, group = 0;
  };

  void watch_signs();
  /// Nothing where slopes are wanted that are not there.
  std::optional<Judgement> look(sheet::SheetCell& cell, bool inside, bool has_slopes);
  const core::Interval& value(int function) const { return cell_->value(function); }
  double middle_value(int function) const;
  void take_values(const std::vector<int>& functions, std::vector<double>& list) const;
  /// False: slopes are not there.
  bool differentiate();
  bool nonzero(int function);
  bool holds(const core::TaskCondition& condition);
  /// An enclosure of sum weight_i f_i over the cell.
  core::Interval combined(const Sum& sum, bool with_slopes) const;
  /// Sums that are positive under every load where a condition is met, n.w - least |n| D for the n that is likeliest to
  /// tell. Null where there is none. Valid until the next call.
  const std::vector<Sum>* sums_of(const core::TaskCondition& condition, bool with_slopes);
  /// What the balls take away from n.N at most, at least.
  core::Interval reach_of_balls(const core::TaskCondition& condition, const std::vector<double>& n, bool with_slopes);

  /// Of the cell that is looked at, slopes included.
  Doubt doubt();
  /// False: no bounds are known.
  bool add_bounds(const core::TaskCondition& condition, const Judgement& what, Doubt& doubt);
  /// Of sum weight_i f_i > 0, or with `either_side` of it not being zero.
  void add_bounds(const Sum& sum, const Judgement& what, bool either_side, Doubt& doubt) const;
  /// Of the square of a lifted root.
  Bound square_bound(int lifted) const;
  bool positive(const Bound& bound) const;

  /// Whether some load of the balls makes a vector too small, or nothing, for certain.
  bool brought_down(const core::TaskCondition& condition, const std::vector<int>& parts,
                    const core::Interval& asked) const;
  /// Of the functions, for displacements.
  void enclose_centred();
  const Centred& centred(int function);
  Centred loaded(const core::TaskCondition& take_up, std::size_t part, const Loads& loads);
  std::vector<Centred> directions_taken(const core::TaskCondition& take_up, const Loads& loads);
  Centred squared_displacement(const Loads& loads);
  Loads all_loads() const;
  static Loads middle_of(const Loads& loads);
  std::vector<Loads> halves_of(const Loads& loads) const;
  std::optional<core::Interval> displacement_under(const Loads& loads);
  bool displaced_within(double most);
  /// A load that makes a reaction's size least: the part t of the range, what it comes to at the box's middle, and the
  /// factor of every direction.
  struct WorstLoad {
    double t = 0;
    std::vector<double> reaction, factors;
  };
  WorstLoad worst_load(const core::TaskCondition& condition) const;
  core::Interval least_size_of(const core::TaskCondition& condition, const core::Interval& share);
  core::Interval greatest_size_of(const core::TaskCondition& condition, const core::Interval& share);

  const core::TaskConditions& conditions_;
  TaskExtent extent_;
  sheet::SheetProgram program_;
  core::WorkingMode mode_;
  std::optional<sheet::SheetCells> side_by_side_;
  std::optional<sheet::SheetCell> alone_;
  std::vector<core::Interval> least_;  ///< of every condition
  std::vector<Watched> watched_;
  int groups_ = 0;
  std::vector<Sum> sums_;
  std::vector<double> ends_[2];
  // Of the cell that is looked at:
  sheet::SheetCell* cell_ = nullptr;
  bool has_slopes_ = false, differentiated_ = false, wants_slopes_ = false;
  // Of the cell that was entered:
  int unmet_ = -1;
  bool is_outside_ = false;
  std::vector<int> in_doubt_;                  ///< functions
  std::vector<std::pair<double, int>> falls_;  ///< a sum of functions that is to stay positive
  std::vector<double> spreads_, clearance_spreads_;
  std::vector<int> downhill_, clearances_downhill_;
  bool displacement_in_doubt_ = false;
  int parts_of_loads_ = 0;
  std::vector<core::Interval> clearances_, offsets_;
  std::vector<std::optional<Centred>> centred_;  ///< of the functions, as far as they are known
  Centred squared_;                              ///< of the displacement in doubt
  std::vector<core::Interval> per_clearance_;    ///< its derivatives
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
