// The box of parameters cut into cells of which the same is proven for every design (method.md section 12).
// Private to studies/.
#pragma once

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

/// The largest box around the file's design, of those that grow alike on all sides and then side by side, that is
/// proven; none where the design itself is not.
std::optional<core::StudyCell> proven_tolerances(const StudyProblem& problem);

}  // namespace clearloci
