// The box of parameters cut into cells of which the same is proven for every design (method.md section 12).
// Private to studies/.
#pragma once

#include <limits>
#include <vector>

#include "studies/study_judge.hpp"

namespace clearloci {

/// Cells by their path: 1 is the whole box, the halves of p are 2 p and 2 p + 1. Parameters are halved in turn.
class CellTree {
 public:
  explicit CellTree(const core::Study& study);

  std::vector<ExactRange> ranges(std::uint64_t path) const;
  /// Cut no further.
  bool is_finest(std::uint64_t path) const;

 private:
  const core::Study& study_;
  std::size_t total_ = 0;  ///< halvings down to the finest
};

/// One a thread.
class CellJudge {
 public:
  explicit CellJudge(const StudyProblem& problem);

  /// `index` is the cell's path. Undecided cells that are not the finest are to be cut.
  core::StudyDesign judge(std::uint64_t path);

  /// Whether all designs of a box are verified and kept.
  bool proven(const std::vector<ExactRange>& ranges);

 private:
  const StudyProblem& problem_;
  CellTree tree_;
  std::vector<std::unique_ptr<loci::DesignJudge>> judges_;
};

/// The best design of a proof with a goal over several parameters, and what no design can be better than.
class BestProven {
 public:
  explicit BestProven(const StudyProblem& problem) : problem_(problem), goal_(problem.study().goals.front()) {}

  /// All designs of a cell are feasible: its corners and its middle are looked at.
  void add_feasible(const std::vector<ExactRange>& ranges);
  /// Whether a cell may have a design that is better by more than the tolerance: the finest part of what the goal is
  /// over all designs.
  bool may_be_better(const std::vector<ExactRange>& ranges) const;
  /// Of a cell that is left as it is, without being proven to be infeasible.
  void add_left(const std::vector<ExactRange>& ranges);
  /// Of the cells that were left, single designs: the best of those that are proven to be feasible.
  void judge_single_designs(CellJudge& judge);
  /// The best, and the goal's values that it is proven to be between: the best possible, and its own.
  void tell(core::StudyResult& result) const;

 private:
  double value(const std::vector<core::Rational>& design) const;
  /// What no design of a cell is better than; smaller is better.
  double bound(const std::vector<ExactRange>& ranges) const;

  const StudyProblem& problem_;
  const core::StudyGoal& goal_;
  std::vector<std::vector<ExactRange>> left_;
  std::vector<core::Rational> best_;
  double found_ = std::numeric_limits<double>::infinity(), least_ = std::numeric_limits<double>::infinity();
};

/// The largest box around the file's design, of those that grow alike on all sides and then side by side, that is
/// proven; none where the design itself is not.
std::optional<core::StudyCell> proven_tolerances(const StudyProblem& problem);

}  // namespace clearloci
