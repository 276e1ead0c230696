// Constant efforts, pattern by pattern of signs: the smallest that verify a task, proven from both sides
// (docs/guide/preload.md, docs/background/method.md section 15).
//     rows at some poses -> the smallest size that meets them -> efforts a little larger -> verify(), which proves them
//     or gives a pose, whose rows are added
// Private to analysis/.
#pragma once

#include <vector>

#include "analysis/wanted_efforts.hpp"
#include "clearloci/study.hpp"

namespace clearloci {

struct ConstantEfforts {
  std::vector<core::PreloadPattern> patterns;
  std::vector<std::vector<core::Rational>> values;  ///< one a pattern: efforts that verify, or none
  std::vector<std::string> words;                   ///< one a pattern: why it fails, where it is refuted
  bool complete = false;                            ///< whether no other pattern is possible: proven
  long cells = 0;                                   ///< efforts that were tried
};

/// `by_ranges`: of one effort, parts of its range that verify as a whole, fail as a whole
/// or are undecided: nothing is tried then. Throws as verify().
ConstantEfforts constant_efforts(const Model& model, const std::vector<WantedEffort>& wanted, const Task& task,
                                 const VerifyRequest& request, const std::vector<core::StudyCell>* by_ranges = nullptr);

}  // namespace clearloci
