// Poses by parameters: q = base + sum_j ways[j] s_j, s in a box.
#pragma once

#include <array>
#include <vector>

namespace clearloci::loci::pose {

using Pose = std::vector<double>;
using PoseBox = std::vector<std::array<double, 2>>;  ///< lower, upper of every parameter

struct PoseChart {
  Pose base;
  std::vector<Pose> ways;

  Pose at(const std::vector<double>& parameters) const {
    Pose q = base;
    for (std::size_t j = 0; j < ways.size(); ++j)
      for (std::size_t i = 0; i < q.size(); ++i) q[i] += ways[j][i] * parameters[j];
    return q;
  }
};

inline std::vector<double> middle_of(const PoseBox& box) {
  std::vector<double> middle;
  for (const auto& [low, high] : box) middle.push_back(low + 0.5 * (high - low));
  return middle;
}

}  // namespace clearloci::loci::pose
