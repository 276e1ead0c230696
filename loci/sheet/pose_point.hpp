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
  };

  /// `statics` must outlive it. One a thread.
  explicit PosePoint(const core::PoseStatics& statics);

  /// Nothing where the pose cannot be assembled or A cannot be inverted.
  std::optional<At> at(const std::vector<double>& pose);

 private:
  bool run(const std::vector<double>& pose);
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
