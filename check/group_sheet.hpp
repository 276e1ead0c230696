// The assembly of a mechanism's groups that its file means, over the poses of a task: cells that cover them, in each of
// which the groups close once (check/group_cell.hpp). It is one function of the pose and that of the file's postures:
//  - from the pose of the postures straight ways of cells lead to a pose of the task, each with the solution of the
//    one before where they meet;
//  - wherever two cells of the task meet they have one solution at a pose, and so wherever they meet, as both are
//    continuous and J is regular.
// Private to check/.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "check/group_cell.hpp"
#include "check/task_region.hpp"

namespace clearloci::check {

/// The coordinates and the parameters that vary over a cell; `offsets` outlives them.
PoseVariables variables_over(const std::vector<std::string>& names, const Cell& cell, Jet::Offsets& offsets);

/// Poses at which the assembly of the file is shown, with its enclosure there: of one working mode, and of the
/// parameters as they are.
using GroupPlaces = std::vector<std::pair<std::vector<Interval>, std::vector<Interval>>>;

class GroupSheet {
 public:
  struct Part {
    Cell cell;
    GroupCell groups;
  };

  /// `names`: of the coordinates, then of the parameters that vary. The way starts at one of the poses `shown`, or at
  /// that of the postures; its end is added to them. Throws FalseClaim where it is not shown, core::LimitReached where
  /// the deadline comes first.
  GroupSheet(const mechanism::Mechanism& m, const std::vector<int>& sides, std::vector<std::string> names,
             const Cell& whole, const std::vector<double>& pose, const std::function<bool(const Cell&)>& is_apart,
             const Deadline& deadline, GroupPlaces& shown);

  const std::vector<Part>& parts() const { return parts_; }

  /// The solution over a cell within a part: of the same assembly. Of other cells nothing, and `spreads`.
  std::optional<GroupCell> over(const Part& part, const PoseVariables& variables, const Jet::Offsets& offsets,
                                std::vector<double>& spreads) const;

 private:
  std::vector<double> nearest(const std::vector<double>& at) const;
  void follow(const std::vector<double>& pose, GroupPlaces& shown);
  /// Along the straight way between two poses; nothing where it is not shown to have no dead centre.
  std::optional<std::vector<Interval>> followed(const std::vector<Interval>& from, const std::vector<Interval>& to,
                                                std::vector<Interval> here) const;
  std::optional<GroupCell> between(const std::vector<Interval>& from, const std::vector<Interval>& to,
                                   const std::array<double, 2>& part, const std::vector<double>& near) const;
  void cover(const Cell& whole, const std::function<bool(const Cell&)>& is_apart, const Deadline& deadline);
  void join(const std::function<bool(const Cell&)>& is_apart) const;
  void reach(const std::vector<double>& pose) const;

  const mechanism::Mechanism& m_;
  const std::vector<int>& sides_;
  std::vector<std::string> names_;
  std::vector<Interval> at_pose_;  ///< the solution at `pose`, of the parameters as they are
  /// Places of the sheet as far as they are known, to start from; nothing rests on them.
  std::vector<std::pair<std::vector<double>, std::vector<double>>> known_;
  std::vector<double> widths_;
  std::vector<Part> parts_;
};

}  // namespace clearloci::check
