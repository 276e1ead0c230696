// That no efforts of free actuators keep a task clear of every locus (docs/background/method.md section 15). A reaction
// of one component that never vanishes keeps its sign all over the task, so that efforts belong to a pattern of signs.
// Of each pattern there are rows
//     sign (a + B lambda) - least >= 0,    a + B lambda the reaction at a pose of the task under a load of its ranges
// and multipliers y > 0 with  sum y_i (sign_i (a_i + B_i lambda) - least_i) < 0  for all lambda within the ranges.
// Private to check/.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/rational.hpp"

namespace clearloci::check {

struct Refutation {
  struct Row {
    std::string reaction;  ///< "M_A1"
    int sign = 1;
    bool bound = false;                ///< of a bound of the model's: `sign` is its side
    std::vector<core::Rational> at;    ///< the pose; empty: of a free effort itself
    std::vector<core::Rational> load;  ///< what the loads differ by, part by part of loads_within
    core::Rational multiplier;
  };
  struct Pattern {
    std::map<std::string, int> signs;  ///< of some reactions; those of others may be either
    std::vector<std::string> joints;   ///< whose efforts are lambda: motors, and cables that the others follow
    std::vector<Row> rows;
  };
  std::vector<std::string> joints;                    ///< of free efforts, and cables
  std::vector<std::array<core::Rational, 2>> ranges;  ///< of each, N or N m
  /// Efforts may vary with the pose, and with the load: then rows are of one pose, and of one load.
  bool controlled = false, knows_load = false;
  std::vector<Pattern> patterns;
};

}  // namespace clearloci::check
