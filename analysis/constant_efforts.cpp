#include "analysis/constant_efforts.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "analysis/effort_chooser.hpp"
#include "analysis/effort_patterns.hpp"
#include "analysis/effort_system.hpp"
#include "analysis/loci.hpp"
#include "analysis/preload_judges.hpp"
#include "analysis/smaller_efforts.hpp"
#include "analysis/task_demands.hpp"
#include "core/rational.hpp"

namespace clearloci {
namespace {

using core::Rational;
using core::Verdict;
using PoseAt = loci::pose::Pose;

constexpr double unbounded = std::numeric_limits<double>::infinity();
/// Efforts that are tried keep within so many times what poses ask for.
constexpr std::array<double, 8> sizes_tried = {1.006, 1.02, 1.05, 1.1, 1.2, 1.5, 3, unbounded};
constexpr int most_tries = 40;
/// Both sides of the smallest size are to be so near each other.
constexpr double near_enough = 1.008;
constexpr std::size_t first_poses = 24;

/// One pattern, and the rows of the poses that were looked at.
struct Looked {
  SignPattern signs;
  std::vector<EffortInequality> rows = {};
  std::vector<loci::pose::EffortColumns> places = {};  ///< of the same poses
  core::PreloadPattern told = {};
  std::vector<Rational> value = {};
  std::string words = {};
};

class ConstantSearch {
 public:
  ConstantSearch(const Model& model, const std::vector<WantedEffort>& wanted, const Task& task,
                 const VerifyRequest& request, const std::vector<core::StudyCell>* by_ranges)
      : model_(model),
        task_(task),
        request_(request),
        by_ranges_(by_ranges),
        system_(model.content().mechanism, wanted, task, sides_of(model, task, request),
                request_of(task, request.loci)) {
    const std::size_t n = model.content().mechanism.coordinates.size();
    poses_ = loci::pose::PoseRegion(task.shape, {std::vector<double>(n, 1.0), std::vector<bool>(n, true)}).samples();
  }

  ConstantEfforts run() {
    ConstantEfforts answer;
    std::size_t first = 0;
    std::optional<SignPatterns> patterns;
    for (; first < poses_.size() && !patterns; ++first)
      patterns = sign_patterns(system_, system_.places(poses_[first]));
    if (!patterns) return answer;
    answer.complete = true;
    for (SignPattern& signs : patterns->possible) {
      Looked trial{.signs = std::move(signs)};
      trial.told.size = {0, unbounded};
      trial.rows = system_.rows_of_efforts(trial.signs);
      asked_for_.clear();
      const std::size_t stride = std::max<std::size_t>(1, poses_.size() / first_poses);
      // The middle and the corners, and some of the others.
      for (std::size_t i = 0; i < poses_.size(); i += i < first_poses / 2 ? 1 : stride) add(trial, poses_[i]);
      if (by_ranges_) look_at_ranges(trial);
      if (trial.told.verdict == Verdict::undecided) look_from_both_sides(trial);
      trial.told.signs.assign(trial.signs.begin(), trial.signs.end());
      answer.patterns.push_back(std::move(trial.told));
      answer.values.push_back(std::move(trial.value));
      answer.words.push_back(std::move(trial.words));
    }
    for (const auto& [signs, exclusion] : patterns->impossible) {
      core::PreloadPattern& pattern = answer.patterns.emplace_back();
      pattern.signs.assign(signs.begin(), signs.end());
      pattern.verdict = Verdict::refuted;
      pattern.size = {unbounded, unbounded};
      tell_rows(system_, exclusion, pattern);
      answer.values.emplace_back();
      answer.words.push_back(exclusion_words(system_, exclusion));
    }
    answer.cells = tries_;
    return answer;
  }

 private:
  static DyadSides sides_of(const Model& model, const Task& task, const VerifyRequest& request) {
    return requested_modes(model.content().mechanism, request_of(task, request.loci)).front();
  }

  bool out_of_time() const {
    return request_.loci.deadline && std::chrono::steady_clock::now() > *request_.loci.deadline;
  }

  void add(Looked& trial, const PoseAt& pose) const {
    for (const PoseAt& place : system_.places(pose)) {
      if (const auto rows = system_.rows(place, trial.signs))
        trial.rows.insert(trial.rows.end(), rows->begin(), rows->end());
      if (auto columns = system_.columns(place)) trial.places.push_back(std::move(*columns));
    }
  }

  /// Sizes between what poses ask for and the smallest that verifies, until both are near each other.
  void look(Looked& trial) {
    std::size_t level = 0;
    int at_level = 0;
    double failed = 0;  // the largest size within which what was tried fails
    for (int i = 0; i < most_tries && !out_of_time(); ++i) {
      if (!ask(trial)) return;
      const double needed = std::max(trial.told.size[0], least_size());
      if (trial.told.size[1] <= near_enough * needed) return;
      const bool found = trial.told.size[1] < unbounded;
      if (!found && level == sizes_tried.size()) return;
      const double within =
          found ? std::sqrt(std::max(needed, failed) * trial.told.size[1]) : needed * sizes_tried[level];
      const auto efforts = deep_within(trial, within);
      const double before = trial.told.size[1];
      const std::optional<PoseAt> failing = efforts ? tried(trial, *efforts) : std::nullopt;
      if (trial.told.size[1] < before) continue;
      constexpr int tries_of_level = 3;
      if (failing) add(trial, *failing);
      if (failing && ++at_level < tries_of_level) continue;
      failed = std::max(failed, within);
      if (found && trial.told.size[1] <= near_enough * failed) return;
      ++level;
      at_level = 0;
    }
  }

  void look_from_both_sides(Looked& trial) {
    look(trial);
    look_below(trial);
  }

  /// What pins ask for beyond the rows, where both sides are apart.
  void look_below(Looked& trial) {
    auto& [least, most] = trial.told.size;
    if (trial.told.verdict != Verdict::verified || most <= near_enough * std::max(least, least_size())) return;
    if (!judge_) judge_ = preload_judge(model_.content().mechanism, system_.wanted(), task_, request_.loci);
    std::vector<PoseAt> poses = asked_for_;
    poses.insert(poses.end(), poses_.begin(), poses_.begin() + std::min<std::ptrdiff_t>(9, std::ssize(poses_)));
    least = size_below_which_all_fail(system_, trial.rows, poses, *judge_, least, most / near_enough, most,
                                      request_.loci.deadline);
  }

  /// What the rows ask for: whether some efforts meet them.
  bool ask(Looked& trial) const {
    if (const auto none = excluded(system_, trial.rows)) {
      trial.told.verdict = Verdict::refuted;
      trial.told.size = {unbounded, unbounded};
      tell_rows(system_, *none, trial.told);
      trial.words = exclusion_words(system_, *none);
      return false;
    }
    const auto smallest = smallest_efforts(system_, trial.rows);
    if (smallest && smallest->size > trial.told.size[0]) {
      trial.told.size[0] = smallest->size;
      tell_rows(system_, smallest->below, trial.told);
    }
    return smallest.has_value();
  }

  /// Of one effort whose ranges are known: those of its parts that meet the rows.
  void look_at_ranges(Looked& trial) {
    trial.told.size = {unbounded, unbounded};
    if (const auto none = excluded(system_, trial.rows)) {
      trial.told.verdict = Verdict::refuted;
      tell_rows(system_, *none, trial.told);
      trial.words = exclusion_words(system_, *none);
      return;
    }
    double low = -system_.largest(0), high = system_.largest(0);
    for (const EffortInequality& row : trial.rows) {
      const double slope = row.slope.front().value, end = -row.offset.value / slope;
      if (slope > 0) low = std::max(low, end);
      if (slope < 0) high = std::min(high, end);
    }
    const double size_of_one = system_.wanted().front().size_of_one;
    for (const core::StudyCell& cell : *by_ranges_) {
      const double from = std::max(low, cell.lower.front()), to = std::min(high, cell.upper.front());
      if (from > to || cell.status == core::StudyDesign::Status::infeasible) continue;
      const double nearest = from > 0 ? from : to < 0 ? to : 0, size = std::abs(nearest) * size_of_one;
      trial.told.size[0] = std::min(trial.told.size[0], size);
      const bool whole = low <= cell.lower.front() && cell.upper.front() <= high;
      if (cell.status != core::StudyDesign::Status::feasible || !whole || size >= trial.told.size[1]) continue;
      trial.told.size[1] = size;
      trial.told.verdict = Verdict::verified;
      trial.told.value = {nearest};
      trial.value = {Rational(nearest)};
    }
    if (trial.told.verdict == Verdict::undecided && trial.told.size[0] == unbounded) {
      trial.told.verdict = Verdict::refuted;  // range by range, not by rows
      return;
    }
    if (const auto smallest = smallest_efforts(system_, trial.rows)) tell_rows(system_, smallest->below, trial.told);
    if (trial.told.verdict == Verdict::undecided) trial.told.size[1] = unbounded;
  }

  /// Efforts that verify, where they are smaller than those before.
  void take(Looked& trial, const std::vector<Rational>& efforts) const {
    double size = 0;
    std::vector<double> values;
    for (std::size_t k = 0; k < efforts.size(); ++k) {
      values.push_back(core::to_double(efforts[k]));
      size = std::max(size, std::abs(values.back()) * system_.wanted()[k].size_of_one);
    }
    if (size >= trial.told.size[1]) return;
    trial.told.verdict = Verdict::verified;
    trial.told.size[1] = size;
    trial.told.value = std::move(values);
    trial.value = efforts;
  }

  /// Verifies, or the pose of a witness whose rows the efforts do not meet.
  std::optional<PoseAt> tried(Looked& trial, const std::vector<Rational>& efforts) {
    ++tries_;
    if (request_.loci.progress) request_.loci.progress(0, "preload");
    VerifyRequest asked = request_;
    asked.depth = VerifyDepth::verdict;
    const Verification result = verify(with_efforts(model_, system_.wanted(), efforts), task_, asked);
    if (result.verified()) {
      take(trial, efforts);
      return std::nullopt;
    }
    if (!result.witness || result.witness->at.size() != poses_.front().size()) return std::nullopt;
    for (const PoseAt& seen : asked_for_)
      if (seen == result.witness->at) return std::nullopt;
    asked_for_.push_back(result.witness->at);
    return result.witness->at;
  }

  double least_size() const {
    double size = unbounded;
    for (std::size_t k = 0; k < system_.wanted().size(); ++k)
      size = std::min(size, system_.largest(k) * system_.wanted()[k].size_of_one);
    return 1e-4 * size;
  }

  /// Of efforts within a size some deep within all that is asked for, of few digits.
  std::optional<std::vector<Rational>> deep_within(const Looked& trial, double size) const {
    const auto choice = deep_choice(system_, trial.places, trial.signs, false, size);
    return choice ? std::optional(of_few_digits(choice->efforts.front())) : std::nullopt;
  }

  std::vector<Rational> of_few_digits(const std::vector<double>& at) const {
    std::vector<Rational> efforts;
    for (std::size_t k = 0; k < at.size(); ++k) {
      constexpr double digits = 2e-4;
      const double near = at[k];
      efforts.push_back(near == 0 ? Rational(0)
                                  : core::simplest_rational_near(Rational(near), Rational(digits * std::abs(near))));
      efforts.back() = std::clamp(efforts.back(), system_.wanted()[k].lower, system_.wanted()[k].upper);
    }
    return efforts;
  }

  const Model& model_;
  Task task_;
  const VerifyRequest& request_;
  const std::vector<core::StudyCell>* by_ranges_;
  EffortSystem system_;
  std::unique_ptr<PreloadJudge> judge_;  ///< made where it is asked
  std::vector<PoseAt> poses_, asked_for_;
  long tries_ = 0;
};

}  // namespace

ConstantEfforts constant_efforts(const Model& model, const std::vector<WantedEffort>& wanted, const Task& task,
                                 const VerifyRequest& request, const std::vector<core::StudyCell>* by_ranges) {
  return ConstantSearch(model, wanted, task, request, by_ranges).run();
}

}  // namespace clearloci
