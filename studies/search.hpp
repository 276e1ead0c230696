// The best design by an optimiser: NLopt's controlled random search, then its subplex method from the best found. Where
// a design fails, how much of the task it fails leads the way. Private to studies/.
#pragma once

#include "studies/study_judge.hpp"

namespace clearloci {

/// Sets designs (the history, an index an evaluation), best, front and complete. One search at a time in a process.
void search(const StudyProblem& problem, const StudyOptions& options, core::StudyResult& result);

}  // namespace clearloci
