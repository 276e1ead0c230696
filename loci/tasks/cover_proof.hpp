// What cells that cover a task prove of it.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "clearloci/verify.hpp"
#include "loci/search/search.hpp"

namespace clearloci::loci {

struct CoverProof {
  core::Verdict verdict = core::Verdict::undecided;
  SearchCost cost;
  std::size_t open = 0;              ///< cells that stayed open
  std::vector<double> lower, upper;  ///< the box around the poses of these

  /// Of a cell, by the ranges of its coordinates.
  void leave_open(const std::vector<std::array<double, 2>>& poses) {
    const bool first = open++ == 0;
    lower.resize(poses.size());
    upper.resize(poses.size());
    for (std::size_t c = 0; c < poses.size(); ++c) {
      lower[c] = first ? poses[c][0] : std::min(lower[c], poses[c][0]);
      upper[c] = first ? poses[c][1] : std::max(upper[c], poses[c][1]);
    }
  }
};

}  // namespace clearloci::loci
