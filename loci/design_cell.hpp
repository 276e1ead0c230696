// What can be said of a task's conditions over a box of poses and designs, by enclosures (method.md section 12).
//
// Coordinates are those of the tower: x, y, then the variables of an open design (mechanism/open_design.hpp). Loads. A
// ball of loads adds r u, |u| <= 1, along its two directions and m v, |v| <= 1, along that of its couple, to every
// load:
//     w = (N + r (u_x N_x + u_y N_y) + m v N_c) / D
// It keeps |w| > least for all u, v if some n has  n.N - r |(n.N_x, n.N_y)| - m |n.N_c| > least |n| |D|.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/locus_map.hpp"
#include "core/task_conditions.hpp"
#include "loci/sheet/sheet_program.hpp"

namespace clearloci::loci {

class DesignCell {
 public:
  DesignCell(const core::TaskConditions& conditions, const core::WorkingMode& mode, std::vector<core::LoadBall> balls);
  DesignCell(const DesignCell&) = delete;
  DesignCell& operator=(const DesignCell&) = delete;

  int coordinates() const { return program_.coordinates(); }

  /// As TaskCell::State: `outside` for certain in no pose and no design of the box; the others are not proven.
  enum class State { proven, outside, boundary, singular, unmet };
  State enter(std::span<const sheet::Interval> box);
  /// Where the state is `unmet`: the first condition that was not proven.
  int unmet() const { return unmet_; }

  /// Where nothing was proven: how much of the variation of the functions in doubt each coordinate makes. After
  /// enter().
  const std::vector<double>& spreads();

  /// Where nothing was proven: the way along each coordinate, -1, 0 or +1, on which what is in doubt first comes nearer
  /// to failing. A guess, for where to look.
  const std::vector<int>& downhill();

  /// A condition that every pose and design of the box fails, for certain: it is too small, or vanishes under some
  /// load; -1: none is known. Where the state is neither `outside` nor `boundary`.
  int failed() const;

  /// What changes its sign nowhere in a task that verifies: the factors of |A|, what reactions have in common, scalar
  /// reactions. +1 and -1 are certain.
  std::size_t watched() const { return watched_.size(); }
  int sign(std::size_t watched) const { return value(watched_[watched].function).sign(); }
  /// Of conditions(); -1: of |A|.
  int condition_of(std::size_t watched) const { return watched_[watched].condition; }
  /// Watched functions of one group have one sign in common: a reaction under both ends of a range of loads.
  int group_of(std::size_t watched) const { return watched_[watched].group; }
  int groups() const { return groups_; }

  /// Enclosures of what a condition's reactions bear over the box, N or N m, under every load: not less than, not more
  /// than. Required: |A| has a sign.
  sheet::Interval size_of(int condition);

 private:
  struct Watched {
    int function = -1, condition = -1, group = 0;
  };
  const sheet::Interval& value(int function) const { return over_.value(function); }
  /// Whether some load of the balls makes a vector too small, or nothing, for certain.
  bool brought_down(const core::TaskCondition& condition, const std::vector<int>& parts,
                    const sheet::Interval& asked) const;
  bool nonzero(int function);
  bool holds(int condition);
  bool holds(const core::TaskCondition& condition, const sheet::Interval& least, bool with_slopes);
  sheet::Interval combined(const std::vector<std::pair<sheet::Interval, int>>& sum, bool with_slopes);
  /// What the balls take away from n.N at most, at least.
  sheet::Interval reach_of_balls(const core::TaskCondition& condition, const std::vector<double>& n, bool with_slopes);
  void differentiate();
  const std::vector<sheet::Interval>& slopes(int function);
  double middle_value(int function) const;
  void doubt(int function);

  const core::TaskConditions& conditions_;
  std::vector<core::LoadBall> balls_;
  sheet::SheetProgram program_;
  core::WorkingMode mode_;
  sheet::SheetProgram::Registers<sheet::Interval> over_, at_middle_;
  std::vector<sheet::Interval> box_;
  std::vector<sheet::Interval> least_;  ///< of every condition
  std::vector<Watched> watched_;
  int groups_ = 0;
  bool differentiated_ = false;
  std::vector<double> middle_;
  std::vector<sheet::Interval> half_inverse_, gradient_;
  std::vector<std::vector<sheet::Interval>> slopes_;
  std::vector<bool> has_slopes_;
  std::vector<int> in_doubt_;  ///< functions; a root's square as -1 - j
  std::vector<double> spreads_;
  std::vector<std::pair<double, int>> falls_;  ///< a sum of functions that is to stay positive
  std::vector<int> downhill_;
  int unmet_ = -1;
};

}  // namespace clearloci::loci
