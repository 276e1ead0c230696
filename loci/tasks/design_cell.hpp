// What can be said of a task's conditions over a box of poses and designs, by enclosures (method.md section 12).
//
// Coordinates are those of the tower: x, y, then the variables of an open design (mechanism/open_design.hpp). Loads. A
// ball of loads adds r u, |u| <= 1, along its two directions and m v, |v| <= 1, along that of its couple, to every
// load:
//     w = (N + r (u_x N_x + u_y N_y) + m v N_c) / D
// It keeps |w| > least for all u, v if some n has  n.N - r |(n.N_x, n.N_y)| - m |n.N_c| > least |n| |D|.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/locus_map.hpp"
#include "core/task_conditions.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {

//
// The displacement of the end effector by the clearances that its joints take up (method.md section 6): by virtual work
// the reactions w^u = N^u / D to a unit force on it along u turn a take-up into a displacement along u,
//     e_u = - sum_J rho_J (f_J^u . f_J) / |f_J| - sum_J delta_J M_J^u sign(M_J)

class DesignCell {
 public:
  /// `most_displaced`: m, that the end effector may be displaced over a proven box; not asked for where the conditions
  /// have no take-ups.
  DesignCell(const core::TaskConditions& conditions, const core::WorkingMode& mode, std::vector<core::LoadBall> balls,
             double most_displaced = std::numeric_limits<double>::infinity());
  DesignCell(const DesignCell&) = delete;
  DesignCell& operator=(const DesignCell&) = delete;

  int coordinates() const { return program_.coordinates(); }
  /// Parts of the loads that the last cell was looked at under, one by one.
  int parts_of_loads() const { return parts_of_loads_; }
  bool has_many_loads() const { return conditions_.loads > 1 || !balls_.empty(); }

  /// As TaskCell::State: `outside` for certain in no pose and no design of the box; the others are not proven.
  enum class State { proven, outside, boundary, singular, unmet };
  /// `clearances`: of each of the conditions' take-ups the clearances of its joints together: m, and rad of what turns.
  State enter(std::span<const core::Interval> box, std::vector<core::Interval> clearances = {});
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
  struct Watched {
    int function = -1, condition = -1, group = 0;
  };
  const core::Interval& value(int function) const { return over_.value(function); }
  /// Whether some load of the balls makes a vector too small, or nothing, for certain.
  bool brought_down(const core::TaskCondition& condition, const std::vector<int>& parts,
                    const core::Interval& asked) const;
  bool nonzero(int function);
  bool holds(int condition);
  bool holds(const core::TaskCondition& condition, const core::Interval& least, bool with_slopes);
  core::Interval combined(const std::vector<std::pair<core::Interval, int>>& sum, bool with_slopes);
  /// What the balls take away from n.N at most, at least.
  core::Interval reach_of_balls(const core::TaskCondition& condition, const std::vector<double>& n, bool with_slopes);
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
  void differentiate();
  const std::vector<core::Interval>& slopes(int function);
  double middle_value(int function) const;
  void doubt(int function);

  const core::TaskConditions& conditions_;
  std::vector<core::LoadBall> balls_;
  sheet::SheetProgram program_;
  core::WorkingMode mode_;
  sheet::SheetProgram::Registers<core::Interval> over_, at_middle_;
  std::vector<core::Interval> box_;
  std::vector<core::Interval> least_;  ///< of every condition
  std::vector<Watched> watched_;
  int groups_ = 0;
  bool differentiated_ = false;
  std::vector<double> middle_;
  std::vector<core::Interval> half_inverse_, gradient_;
  std::vector<std::vector<core::Interval>> slopes_;
  std::vector<bool> has_slopes_;
  std::vector<int> in_doubt_;  ///< functions; a root's square as -1 - j
  std::vector<double> spreads_;
  std::vector<std::pair<double, int>> falls_;  ///< a sum of functions that is to stay positive
  std::vector<int> downhill_;
  int unmet_ = -1;
  double most_displaced_;
  bool displacement_in_doubt_ = false;
  int parts_of_loads_ = 0;
  std::vector<core::Interval> clearances_, offsets_;
  std::vector<std::optional<Centred>> centred_;  ///< of the functions, as far as they are known
  Centred squared_;                              ///< of the displacement in doubt
  std::vector<core::Interval> per_clearance_;    ///< its derivatives
  std::vector<double> clearance_spreads_;
  std::vector<int> clearances_downhill_;
};

}  // namespace clearloci::loci
