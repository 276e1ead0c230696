// The best of some designs. Private to studies/.
#pragma once

#include "clearloci/study.hpp"
#include "studies/study_judge.hpp"

namespace clearloci {

/// Whether one list of goals is at least as good as another in all, and better in one.
bool dominates(const std::vector<double>& a, const std::vector<double>& b, const std::vector<core::StudyGoal>& goals);

/// Sets `best`, by the first goal, and with several goals `front`, of feasible designs.
void choose(const StudyProblem& problem, core::StudyResult& result);

}  // namespace clearloci
