#include "studies/pareto.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci {
namespace {

bool better(double a, double b, const core::StudyGoal& goal) { return goal.maximise ? a > b : a < b; }

}  // namespace

bool dominates(const std::vector<double>& a, const std::vector<double>& b, const std::vector<core::StudyGoal>& goals) {
  bool any = false;
  for (std::size_t g = 0; g < goals.size(); ++g) {
    if (better(b[g], a[g], goals[g])) return false;
    any = any || better(a[g], b[g], goals[g]);
  }
  return any;
}

void choose(const StudyProblem& problem, core::StudyResult& result) {
  const std::vector<core::StudyGoal>& goals = problem.study().goals;
  if (goals.empty()) return;
  struct Candidate {
    std::size_t place;
    std::vector<double> values;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < result.designs.size(); ++i) {
    const core::StudyDesign& design = result.designs[i];
    if (design.status != core::StudyDesign::Status::feasible) continue;
    Candidate candidate{i, {}};
    for (const core::StudyGoal& goal : goals) candidate.values.push_back(problem.goal(goal, design));
    if (std::none_of(candidate.values.begin(), candidate.values.end(), [](double v) { return std::isnan(v); }))
      candidates.push_back(std::move(candidate));
  }
  // Best in the first goal first, so that what dominates comes before what it dominates.
  std::stable_sort(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
    for (std::size_t g = 0; g < goals.size(); ++g)
      if (a.values[g] != b.values[g]) return better(a.values[g], b.values[g], goals[g]);
    return false;
  });
  if (candidates.empty()) return;
  result.best = candidates.front().place;
  if (goals.size() < 2) return;
  std::vector<const Candidate*> front;
  // A search may come to a design twice.
  const auto same = [&](const Candidate& a, const Candidate& b) {
    return result.designs[a.place].values == result.designs[b.place].values;
  };
  for (const Candidate& contender : candidates)
    if (std::none_of(front.begin(), front.end(), [&](const Candidate* other) {
          return dominates(other->values, contender.values, goals) || same(*other, contender);
        }))
      front.push_back(&contender);
  for (const Candidate* candidate : front) result.front.push_back(candidate->place);
}

}  // namespace clearloci
