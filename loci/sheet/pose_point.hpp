// |A|, the closures and the reactions that a task asks for, at single poses in floating point: where searches look.
// Nothing is proven here.
#pragma once

#include <optional>
#include <vector>

#include "core/pose_statics.hpp"

namespace clearloci::loci::pose {

class PosePoint {
 public:
  struct At {
    int determinant = 0;                                       ///< its sign
    double logarithm = 0;                                      ///< of its size
    std::vector<double> closures;                              ///< positive within the workspace, zero on its boundary
    std::vector<std::vector<std::vector<double>>> components;  ///< demand, load, component: N, N m
    int orientation = 1;                                       ///< the sign of the groups' det J
  };

  /// `statics` must outlive it. One a thread.
  explicit PosePoint(const core::PoseStatics& statics);

  /// Nothing where the pose cannot be assembled or A cannot be inverted.
  std::optional<At> at(const std::vector<double>& pose);
  /// The same by Newton's iteration from values of the groups' unknowns, which are improved. Also nothing where it does
  /// not converge quickly: these values belong to another posture, or to none.
  std::optional<At> at(const std::vector<double>& pose, core::BlockUnknowns& unknowns);

 private:
  bool within_limits() const;
  std::optional<At> solved();
  bool solve(At& result);
  double step(int index) const { return values_[index]; }

  const core::PoseStatics* statics_;
  std::size_t n_;
  core::PoseValues values_;
  std::vector<int> closures_;  ///< steps whose roots vary with the pose, and limits
  std::vector<double> matrix_;
  std::vector<std::vector<double>> solution_;  ///< load by load
};

}  // namespace clearloci::loci::pose
