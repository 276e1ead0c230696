#include "studies/prove.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "analysis/model.hpp"
#include "analysis/proven_cells.hpp"
#include "core/errors.hpp"

namespace clearloci {
namespace {

using core::Rational;
using core::StudyDesign;
using Status = StudyDesign::Status;

constexpr loci::SearchBudget of_tolerances = {.most_cells = 40'000, .most_cells_in_vain = 2'000};

}  // namespace

CellTree::CellTree(const core::Study& study) : study_(study) {
  int halvings = 0;
  for (Rational part = 1; part > study.method.finest; part /= 2) ++halvings;
  total_ = static_cast<std::size_t>(halvings) * study.vary.size();
  if (total_ > 62)
    throw core::InputError({study.file}, "the cells would be too many to be numbered",
                           "prove to a coarser part, or vary fewer parameters");
}

std::vector<ExactRange> CellTree::ranges(std::uint64_t path) const {
  std::vector<ExactRange> ranges;
  for (const core::StudyParameter& parameter : study_.vary) ranges.emplace_back(parameter.lower, parameter.upper);
  const int bits = 63 - std::countl_zero(path);
  for (int level = 0; level < bits; ++level) {
    // All are halved in turn.
    ExactRange& range = ranges[static_cast<std::size_t>(level) % ranges.size()];
    const Rational middle = (range.first + range.second) / 2;
    ((path >> (bits - 1 - level)) & 1U ? range.first : range.second) = middle;
  }
  return ranges;
}

bool CellTree::is_finest(std::uint64_t path) const {
  return static_cast<std::size_t>(63 - std::countl_zero(path)) >= total_;
}

CellJudge::CellJudge(const StudyProblem& problem) : problem_(problem), tree_(problem.study()) {
  for (const auto& task : problem.tasks()) judges_.push_back(task->judge());
}

StudyDesign CellJudge::judge(std::uint64_t path) {
  StudyDesign cell;
  cell.index = path;
  const std::vector<ExactRange> ranges = tree_.ranges(path);
  const StudyProblem::Kept kept = problem_.kept(ranges);
  if (kept == StudyProblem::Kept::none) {
    cell.status = Status::left_out;
    cell.reason = "keep";
    return cell;
  }
  const loci::SearchBudget& budget = tree_.is_finest(path) ? budget_of_finest_cells : budget_of_coarse_cells;
  bool all = kept == StudyProblem::Kept::all;
  for (std::size_t t = 0; t < judges_.size(); ++t) {
    const DesignTask& task = *problem_.tasks()[t];
    const auto box = task.box(ranges);
    if (!box) {
      all = false;  // some lengths, or all, are not above zero
      continue;
    }
    const loci::DesignProof proof = judges_[t]->judge(*box, task.margin(), loci::Refuting::all, budget);
    if (proof.verdict == core::Verdict::refuted) {
      cell.status = Status::infeasible;
      cell.reason = task.reason(*proof.failure);
      cell.task = t;
      return cell;
    }
    all = all && proof.verdict == core::Verdict::verified;
  }
  if (all) cell.status = Status::feasible;
  return cell;
}

bool CellJudge::proven(const std::vector<ExactRange>& ranges) {
  if (problem_.kept(ranges) != StudyProblem::Kept::all) return false;
  for (std::size_t t = 0; t < judges_.size(); ++t) {
    const DesignTask& task = *problem_.tasks()[t];
    const auto box = task.box(ranges);
    if (!box ||
        judges_[t]->judge(*box, task.margin(), loci::Refuting::one, of_tolerances).verdict != core::Verdict::verified)
      return false;
  }
  return true;
}

double BestProven::bound(const std::vector<ExactRange>& ranges) const {
  const core::Interval values = problem_.goal_over(goal_, ranges);
  return goal_.maximise ? -values.upper() : values.lower();
}

double BestProven::value(const std::vector<Rational>& design) const {
  std::vector<ExactRange> point;
  for (const Rational& value : design) point.emplace_back(value, value);
  const core::Interval values = problem_.goal_over(goal_, point);
  return goal_.maximise ? -values.lower() : values.upper();
}

void BestProven::add_feasible(const std::vector<ExactRange>& ranges) {
  std::vector<std::vector<Rational>> designs(1);
  for (const auto& [low, high] : ranges) designs.front().push_back((low + high) / 2);
  for (std::size_t corner = 0; corner < std::size_t{1} << ranges.size(); ++corner) {
    std::vector<Rational>& design = designs.emplace_back();
    for (std::size_t i = 0; i < ranges.size(); ++i)
      design.push_back((corner >> i & 1) != 0 ? ranges[i].second : ranges[i].first);
  }
  for (std::vector<Rational>& design : designs)
    if (const double found = value(design); found < found_) {
      found_ = found;
      best_ = std::move(design);
    }
}

bool BestProven::may_be_better(const std::vector<ExactRange>& ranges) const {
  std::vector<ExactRange> all;
  for (const core::StudyParameter& parameter : problem_.study().vary)
    all.emplace_back(parameter.lower, parameter.upper);
  const core::Interval whole = problem_.goal_over(goal_, all);
  const double tolerance = core::to_double(problem_.study().method.finest) * (whole.upper() - whole.lower());
  return bound(ranges) < found_ - tolerance;
}

void BestProven::add_left(const std::vector<ExactRange>& ranges) { least_ = std::min(least_, bound(ranges)); }

void BestProven::tell(core::StudyResult& result) const {
  if (best_.empty()) return;
  core::StudyDesign best;
  best.status = Status::feasible;
  for (const Rational& value : best_) best.values.push_back(core::to_double(value));
  result.designs = {best};
  result.best = 0;
  const double least = std::min(least_, found_);
  result.best_goal = goal_.maximise ? std::array<double, 2>{-least, -found_} : std::array<double, 2>{least, found_};
}

std::optional<core::StudyCell> proven_tolerances(const StudyProblem& problem) {
  const core::Study& study = problem.study();
  std::vector<Rational> centre;
  for (const core::StudyParameter& study_parameter : study.vary)
    for (const mechanism::Parameter& parameter : problem.model().content().mechanism.parameters)
      if (parameter.name == study_parameter.name) centre.push_back(parameter.value);
  for (std::size_t i = 0; i < centre.size(); ++i)
    if (centre[i] < study.vary[i].lower || centre[i] > study.vary[i].upper) return std::nullopt;
  // Parts of the ways to the ends of the ranges, in 256ths.
  constexpr int parts = 256;
  std::vector<std::array<int, 2>> grown(centre.size(), {0, 0});
  const auto ranges = [&] {
    std::vector<ExactRange> list;
    for (std::size_t i = 0; i < centre.size(); ++i)
      list.emplace_back(centre[i] - (centre[i] - study.vary[i].lower) * grown[i][0] / parts,
                        centre[i] + (study.vary[i].upper - centre[i]) * grown[i][1] / parts);
    return list;
  };
  CellJudge judge(problem);
  if (!judge.proven(ranges())) return std::nullopt;
  // The most that is proven, by bisection: of what is larger nothing is known.
  const auto grow = [&](const std::vector<int*>& sides) {
    int low = *sides.front(), high = parts + 1;
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      for (int* side : sides) *side = middle;
      (judge.proven(ranges()) ? low : high) = middle;
    }
    for (int* side : sides) *side = low;
  };
  std::vector<int*> all;
  for (auto& range : grown)
    for (int& side : range) all.push_back(&side);
  grow(all);
  for (int* side : all) grow({side});
  core::StudyCell cell;
  cell.status = Status::feasible;
  for (const ExactRange& range : ranges()) {
    cell.lower.push_back(core::to_double(range.first));
    cell.upper.push_back(core::to_double(range.second));
  }
  return cell;
}

}  // namespace clearloci
