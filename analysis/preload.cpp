#include "analysis/preload.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "analysis/constant_efforts.hpp"
#include "analysis/effort_choice.hpp"
#include "analysis/pose_efforts.hpp"
#include "analysis/pose_tensions.hpp"
#include "analysis/preload_judges.hpp"
#include "analysis/preload_law.hpp"
#include "analysis/proven_cells.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/wanted_efforts.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "core/shown_units.hpp"
#include "loci/search/search.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci {
namespace {

using core::Rational;
using mechanism::Mechanism;
using Status = core::StudyDesign::Status;

/// Boxes are cut down to this part of each range.
const Rational finest(1, 1 << 18);
/// Ranges that are looked at.
constexpr long most_ranges = 4'000;
/// Cells of the statics that are looked at in all ranges. A force of several components that vanishes at single poses
/// is proven to fail for no range, however small.
constexpr long most_cells = 300'000;
/// Ranges of more than this part of the whole are looked at first, the widest before the others.
constexpr double wide = 1.0 / 64;

/// The size of the smallest preload of a range.
double least_size(const WantedEffort& wanted, const ExactRange& range) {
  return core::to_double(abs(nearest_to_none(range.first, range.second))) * wanted.size_of_one;
}

/// With this part of the time that is left: what comes after is to have some, too.
VerifyRequest in_part_of_time(VerifyRequest request, double part) {
  if (std::optional<std::chrono::steady_clock::time_point>& deadline = request.loci.deadline) {
    const auto now = std::chrono::steady_clock::now();
    if (now < *deadline)
      deadline = now + std::chrono::duration_cast<std::chrono::steady_clock::duration>(part * (*deadline - now));
  }
  return request;
}

/// Ranges of one effort, each proven as a whole or cut in halves; after the wide ones those of the smallest size first.
class PreloadSearch {
 public:
  PreloadSearch(const Mechanism& mechanism, WantedEffort wanted, const Task& task, const VerifyRequest& request)
      : wanted_(std::move(wanted)),
        units_(mechanism.units),
        request_(request),
        judge_(preload_judge(mechanism, {wanted_}, task, request.loci)),
        own_gap_(own_gap(mechanism, wanted_.joint, request_of(task, request.loci))) {}

  core::PreloadAnswer run() {
    push({wanted_.lower, wanted_.upper});
    loci::SearchMeter meter({.most_cells = most_ranges, .deadline = request_.loci.deadline});
    while (!left_.empty()) {
      const SizedRange part = left_.take();
      const bool over = !meter.begin();
      const BoxVerdict verdict = over ? BoxVerdict{} : judged(part.range);
      cells_of_statics_ += verdict.cells;
      if (cells_of_statics_ > most_cells) meter.stop();
      const Status status = status_of(verdict.verdict);
      if (status == Status::undecided && !over && !is_finest(part.range)) {
        const Rational middle = (part.range.first + part.range.second) / 2;
        push({part.range.first, middle});
        push({middle, part.range.second});
        continue;
      }
      decided(part, status, verdict.reason);
      if (request_.loci.progress) request_.loci.progress(0, "preload");
    }
    answer_.cells = meter.cost().cells;
    return finished();
  }

 private:
  struct SizedRange {
    double size = 0;
    ExactRange range;
  };

  /// Of the free actuator's own backlash, then of all else.
  BoxVerdict judged(const ExactRange& range) {
    if (own_gap_) {
      const double from = core::to_double(range.first), to = core::to_double(range.second), least = own_gap_->to;
      if (-least <= from && to <= least && (least > 0 || (from == 0 && to == 0)))
        return {core::Verdict::refuted, "backlash in " + wanted_.joint};
      if (is_within_own_gap(*own_gap_, from, to)) return {};
    }
    return judge_->judge({range}, is_finest(range) || in_earnest(range));
  }

  void push(const ExactRange& range) {
    const double size = least_size(wanted_, range);
    const double part = part_of_all(range);
    left_.push({size, range}, part > wide ? -part : size);
  }

  /// Much is spent on some ranges that are not the finest: else large ranges of little reserve would be cut to dust.
  bool in_earnest(const ExactRange& range) const {
    constexpr int every = 4;
    const double part = part_of_all(range);
    return part < 1 && std::ilogb(part) % every == 0;
  }

  double part_of_all(const ExactRange& range) const {
    return core::to_double((range.second - range.first) / (wanted_.upper - wanted_.lower));
  }

  bool is_finest(const ExactRange& range) const {
    return range.second - range.first <= finest * (wanted_.upper - wanted_.lower);
  }

  static Status status_of(core::Verdict verdict) {
    return verdict == core::Verdict::verified  ? Status::feasible
           : verdict == core::Verdict::refuted ? Status::infeasible
                                               : Status::undecided;
  }

  void decided(const SizedRange& part, Status status, const std::string& reason) {
    core::StudyCell& cell = cells_.emplace_back();
    cell.status = status;
    cell.reason = reason;
    cell.lower.push_back(core::to_double(part.range.first));
    cell.upper.push_back(core::to_double(part.range.second));
    if (status == Status::undecided) least_open_ = std::min(least_open_, part.size);
    if (status == Status::feasible && (!smallest_ || part.size < smallest_->size)) smallest_ = part;
  }

  core::PreloadAnswer finished() {
    constexpr double none = std::numeric_limits<double>::infinity();
    const double found = smallest_ ? smallest_->size : none;
    answer_.size = {std::min(least_open_, found), found};
    answer_.ranges = joined_ranges(cells_);
    if (smallest_) answer_.value = {core::to_double(smallest())};
    return std::move(answer_);
  }

 public:
  const std::vector<core::StudyCell>& cells() const { return cells_; }
  /// Ranges that are neither proven to verify nor to fail, but for those at the ends of others.
  std::vector<std::string> undecided() const {
    std::vector<core::StudyCell> open = cells_;
    std::erase_if(open, [](const core::StudyCell& cell) { return cell.status != Status::undecided; });
    std::sort(open.begin(), open.end(), [](const auto& a, const auto& b) { return a.lower[0] < b.lower[0]; });
    std::vector<std::array<double, 2>> joined;
    for (const core::StudyCell& cell : open) {
      if (joined.empty() || cell.lower[0] > joined.back()[1]) joined.push_back({cell.lower[0], cell.lower[0]});
      joined.back()[1] = cell.upper[0];
    }
    constexpr double at_an_end = 1.0 / 256;
    const double least = at_an_end * core::to_double(wanted_.upper - wanted_.lower);
    const std::string unit = wanted_.force ? "N" : "N m";
    std::vector<std::string> words;
    for (const auto& [from, to] : joined)
      if (to - from > least)
        words.push_back(wanted_.joint + " from " + core::told(from, unit, units_, 4) + " to " +
                        core::told(to, unit, units_, 4) + " is not decided; --preload decides single efforts");
    return words;
  }
  /// The smallest that was found, of few digits: all of its range verify.
  Rational smallest() const {
    const ExactRange& range = smallest_->range;
    if (range.first <= 0 && range.second >= 0) return 0;
    return core::simplest_rational_near((range.first + range.second) / 2, (range.second - range.first) / 2);
  }

 private:
  WantedEffort wanted_;
  core::Units units_;
  const VerifyRequest& request_;
  std::unique_ptr<PreloadJudge> judge_;
  std::optional<numeric::EffortGap> own_gap_;
  loci::BoxSearch<SizedRange> left_{loci::SearchOrder::least_key_first};
  std::vector<core::StudyCell> cells_;
  long cells_of_statics_ = 0;
  std::optional<SizedRange> smallest_;
  double least_open_ = std::numeric_limits<double>::infinity();  ///< of what is not decided, the smallest size
  core::PreloadAnswer answer_;
};

/// What is known of constant preloads, and the smallest that verifies.
struct ConstantAnswer {
  core::PreloadAnswer answer;
  std::vector<Rational> smallest = {};
  std::vector<std::string> words = {};      ///< why all fail
  std::vector<std::string> undecided = {};  ///< ranges that are neither proven to verify nor to fail
};

/// Ranges of one effort, and patterns of any number.
ConstantAnswer constant_answer(const Model& model, const std::vector<WantedEffort>& wanted, const Task& task,
                               const VerifyRequest& request) {
  constexpr double none = std::numeric_limits<double>::infinity();
  ConstantAnswer answer;
  answer.answer.size = {0, none};
  std::vector<core::StudyCell> cells;
  if (wanted.size() == 1) {
    // The search knows efforts that are given: those that are looked for are open in it.
    const VerifyRequest of_ranges = in_part_of_time(request, 0.5);
    PreloadSearch search(model.content().mechanism, wanted.front(), task, of_ranges);
    answer.answer = search.run();
    if (answer.answer.value) answer.smallest = {search.smallest()};
    cells = search.cells();
    answer.undecided = search.undecided();
  }
  const ConstantEfforts patterns =
      constant_efforts(model, wanted, task, in_part_of_time(request, 0.6), wanted.size() == 1 ? &cells : nullptr);
  double least = patterns.complete ? none : 0;
  for (std::size_t i = 0; i < patterns.patterns.size(); ++i) {
    const core::PreloadPattern& pattern = patterns.patterns[i];
    least = std::min(least, pattern.size[0]);
    constexpr double smaller = 0.99;
    const double beside = answer.answer.value && wanted.size() == 1 ? smaller : 1;
    if (pattern.verdict == core::Verdict::verified && pattern.size[1] < beside * answer.answer.size[1]) {
      answer.answer.size[1] = pattern.size[1];
      answer.answer.value = pattern.value;
      answer.smallest = patterns.values[i];
    }
    if (!patterns.words[i].empty()) answer.words.push_back(patterns.words[i]);
  }
  answer.answer.size[0] = std::min(std::max(answer.answer.size[0], least), answer.answer.size[1]);
  answer.answer.cells += patterns.cells;
  answer.answer.patterns = patterns.patterns;
  for (const WantedEffort& each : wanted) {
    answer.answer.joints.push_back(each.joint);
    answer.answer.forces.push_back(each.force);
    answer.answer.lower.push_back(core::to_double(each.lower));
    answer.answer.upper.push_back(core::to_double(each.upper));
  }
  return answer;
}

}  // namespace

Verification verify_preloaded(const Model& model, const Task& task, const VerifyRequest& request) {
  std::vector<WantedEffort> given;
  std::vector<Rational> efforts;
  for (const auto& [name, effort] : task.preload)
    for (const mechanism::Joint& joint : model.content().mechanism.joints) {
      if (joint.name != name || !joint.free_effort) continue;
      given.push_back({name, joint.free_effort->parameter, mechanism::traits(joint).actuator == core::Quantity::F});
      efforts.push_back(effort);
    }
  Task plain = task;
  plain.preload.clear();
  Verification result = verify(with_efforts(model, given, efforts), plain, request);
  result.task.preload = task.preload;
  return result;
}

Verification verify_with_preload(const Model& model, const Task& task, const VerifyRequest& request) {
  const Mechanism& mechanism = model.content().mechanism;
  const std::vector<WantedEffort> wanted = wanted_efforts(model, task, request);
  if (request.fit != TaskFit::none)
    throw core::InputError({task.file},
                           "the task is to be moved, and the effort of " + named_efforts(wanted) + " is free",
                           "give it by --preload, or leave --fit out");
  if (task.controlled_preload) {
    if (only_tensions_are_free(mechanism)) return verify_with_choices(model, task, request);
    if (wanted.size() > 1 || task.knows_load) return verify_with_choices(model, task, request);
    Verification law = verify_with_law(model, task, request);
    return law.verdict == core::Verdict::undecided ? verify_with_choices(model, task, request) : law;
  }
  ConstantAnswer answer = constant_answer(model, wanted, task, request);
  const bool found = answer.answer.value.has_value();
  std::vector<Rational> efforts = answer.smallest;
  if (!found)
    for (const WantedEffort& each : wanted) efforts.push_back(nearest_to_none(each.lower, each.upper));
  Verification result = verify(with_efforts(model, wanted, efforts), task, request);
  if (found && result.verdict == core::Verdict::undecided && !task.pose_error) {
    result.verdict = core::Verdict::verified;
    result.open.reset();
    result.notes.push_back("the task is verified with " + named_efforts(wanted) +
                           " by the proof that chose it; its margin and least reactions were not found in time");
  } else if (!found && answer.answer.size[0] < std::numeric_limits<double>::infinity()) {
    result.verdict = core::Verdict::undecided;
    result.witness.reset();
    result.notes.emplace_back("no preload was found that verifies, and not all are proven to fail");
  } else if (!found) {
    result.notes.push_back(
        "no constant preload of " + named_efforts(wanted) +
        " within these ranges verifies the task: each fails, proven" +
        (only_tensions_are_free(mechanism)
             ? "; with other cables held constant it is not known, --preload CABLE=TENSION chooses them"
             : ""));
    constexpr std::size_t most_notes = 12;
    answer.words.resize(std::min(answer.words.size(), most_notes));
    result.notes.insert(result.notes.end(), answer.words.begin(), answer.words.end());
  }
  result.notes.insert(result.notes.end(), answer.undecided.begin(), answer.undecided.end());
  result.preload = std::move(answer.answer);
  return result;
}

}  // namespace clearloci
