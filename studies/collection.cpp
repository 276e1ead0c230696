#include "studies/collection.hpp"

#include <algorithm>
#include <cmath>

#include "studies/signature.hpp"

namespace clearloci {
namespace {

using core::StudyDesign;

/// A run that is killed loses what it did since the last time it wrote.
constexpr std::chrono::milliseconds between_writes(250);

}  // namespace

Collection::Collection(const StudyProblem& problem, std::uint64_t total, const StudyOptions& options)
    : problem_(problem), options_(options), started_(Clock::now()), last_write_(started_) {
  progress_.total = total;
  if (options.table.empty()) return;
  const bool cells = problem.study().method.kind == core::StudyMethod::Kind::prove;
  table_.emplace(options.table, hash_of(signature(problem.model(), problem.study())),
                 cells ? 0 : problem.figures().size(), options.resume);
  designs_ = table_->take();
  for (StudyDesign& design : designs_) count(design);
  before_ = progress_.done;
}

std::vector<bool> Collection::known(std::uint64_t count) const {
  std::vector<bool> done(count, false);
  for (const StudyDesign& design : designs_)
    if (design.index < count) done[design.index] = true;
  return done;
}

void Collection::add(std::vector<StudyDesign> some) {
  for (StudyDesign& design : some) {
    if (table_) lines_ += table_line(design);
    count(design);
    designs_.push_back(std::move(design));
  }
  const Clock::time_point now = Clock::now();
  if (now - last_write_ < between_writes) return;
  last_write_ = now;
  write();
  if (!options_.progress) return;
  const double spent = std::chrono::duration<double>(now - started_).count();
  const auto done = static_cast<double>(progress_.done - before_);
  const double left = static_cast<double>(progress_.total) - static_cast<double>(progress_.done);
  progress_.seconds_left = done > 0 ? spent / done * std::max(0.0, left) : 0;
  options_.progress(progress_);
}

std::vector<StudyDesign> Collection::take() {
  write();
  std::stable_sort(designs_.begin(), designs_.end(),
                   [](const StudyDesign& one, const StudyDesign& two) { return one.index < two.index; });
  if (table_) table_->settle(designs_);
  return std::move(designs_);
}

void Collection::write() {
  if (table_ && !lines_.empty()) table_->append(lines_);
  lines_.clear();
}

void Collection::count(const StudyDesign& design) {
  ++progress_.done;
  if (design.status != StudyDesign::Status::feasible) return;
  ++progress_.feasible;
  const auto& goals = problem_.study().goals;
  if (goals.empty() || !goals.front().figure || design.figures.empty()) return;
  const double value = problem_.goal(goals.front(), design);
  if (std::isnan(value)) return;
  if (!progress_.best || (goals.front().maximise ? value > *progress_.best : value < *progress_.best))
    progress_.best = value;
}

}  // namespace clearloci
