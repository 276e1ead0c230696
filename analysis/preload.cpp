#include "analysis/preload.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <queue>
#include <string>
#include <utility>

#include "analysis/pose_efforts.hpp"
#include "analysis/pose_tensions.hpp"
#include "analysis/preload_judges.hpp"
#include "analysis/preload_law.hpp"
#include "analysis/proven_cells.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/tension_verification.hpp"
#include "analysis/wanted_efforts.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci {
namespace {

using core::Rational;
using mechanism::Mechanism;
using Status = core::StudyDesign::Status;

/// Boxes are cut down to this part of each range.
const Rational finest(1, 1 << 18);
/// That are looked at, of one effort and of several.
constexpr long cells_of_one = 4'000, cells_of_several = 2'000;

/// The size of the smallest preload of a box.
double least_size(const std::vector<WantedEffort>& wanted, const std::vector<ExactRange>& ranges) {
  double size = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const Rational least = abs(nearest_to_none(ranges[i].first, ranges[i].second));
    size = std::max(size, core::to_double(least) * wanted[i].size_of_one);
  }
  return size;
}

/// Boxes of efforts, of which those of the smallest size come first, each proven as a whole or cut in halves.
class PreloadSearch {
 public:
  PreloadSearch(const Mechanism& mechanism, std::vector<WantedEffort> wanted, const Task& task,
                const VerifyRequest& request)
      : wanted_(std::move(wanted)),
        request_(request),
        judge_(preload_judge(mechanism, ranges_of(wanted_), task, request.loci)) {
    for (const WantedEffort& own : wanted_)
      own_gaps_.push_back(own_gap(mechanism, own.joint, request_of(task, request.loci).min_couple));
  }

  /// Of one effort all boxes are decided. Of several each is first tried alone, then all together among smaller ones.
  core::PreloadAnswer run() {
    std::vector<ExactRange> whole, none;
    for (const WantedEffort& own : wanted_) {
      whole.emplace_back(own.lower, own.upper);
      const Rational least = nearest_to_none(own.lower, own.upper);
      none.emplace_back(least, least);
    }
    const bool one = wanted_.size() == 1;
    for (std::size_t i = 0; i < wanted_.size() && !one; ++i) {
      std::vector<ExactRange> alone = none;
      alone[i] = whole[i];
      search(std::move(alone), {.cells = cells_of_one, .all = false});
    }
    least_open_ = std::numeric_limits<double>::infinity();
    cells_.clear();
    search(std::move(whole), {.cells = one ? cells_of_one : cells_of_several, .all = one});
    return finished();
  }

 private:
  struct Box {
    double size = 0;
    std::vector<ExactRange> ranges;
    bool operator<(const Box& other) const { return size > other.size; }  // the smallest on top
  };

  struct Extent {
    long cells = 0;    ///< that may be looked at
    bool all = false;  ///< also what is larger than the smallest that was found
  };

  void search(std::vector<ExactRange> whole, const Extent& extent) {
    queue_ = {};
    push(std::move(whole));
    for (long cells = 0; !queue_.empty(); ++cells) {
      const Box box = queue_.top();
      queue_.pop();
      if (!extent.all && smallest_ && box.size >= smallest_->size) return;
      const bool over = cells >= extent.cells || out_of_time();
      const BoxVerdict verdict = over ? BoxVerdict{} : judged(box.ranges);
      answer_.cells += over ? 0 : 1;
      const Status status = status_of(verdict.verdict);
      if (status == Status::undecided && !over && !is_finest(box.ranges)) {
        cut(box.ranges);
        continue;
      }
      decided(box, status, verdict.reason);
      if (status == Status::undecided) least_open_ = std::min(least_open_, box.size);
      if (status == Status::feasible && (!smallest_ || box.size < smallest_->size)) smallest_ = box;
      if (request_.loci.progress) request_.loci.progress(0, "preload");
    }
  }

  /// Of the free actuators' own backlash, then of all else.
  BoxVerdict judged(const std::vector<ExactRange>& ranges) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (!own_gaps_[i]) continue;
      const double from = core::to_double(ranges[i].first), to = core::to_double(ranges[i].second),
                   least = own_gaps_[i]->to;
      if (-least <= from && to <= least && (least > 0 || (from == 0 && to == 0)))
        return {core::Verdict::refuted, "backlash in " + wanted_[i].joint};
      if (from < least && to > -least) return {};
      if (least == 0 && from <= 0 && to >= 0) return {};
    }
    return judge_->judge(ranges, is_finest(ranges));
  }

  static std::vector<mechanism::ParameterRange> ranges_of(const std::vector<WantedEffort>& wanted) {
    std::vector<mechanism::ParameterRange> ranges;
    for (const WantedEffort& own : wanted) ranges.push_back({own.parameter, own.lower, own.upper});
    return ranges;
  }

  bool out_of_time() const {
    return request_.loci.deadline && std::chrono::steady_clock::now() > *request_.loci.deadline;
  }

  void push(std::vector<ExactRange> ranges) {
    const double size = least_size(wanted_, ranges);
    queue_.push({size, std::move(ranges)});
  }

  Rational part(std::size_t i, const std::vector<ExactRange>& ranges) const {
    return (ranges[i].second - ranges[i].first) / (wanted_[i].upper - wanted_[i].lower);
  }

  bool is_finest(const std::vector<ExactRange>& ranges) const {
    for (std::size_t i = 0; i < ranges.size(); ++i)
      if (part(i, ranges) > finest) return false;
    return true;
  }

  void cut(std::vector<ExactRange> ranges) {
    std::size_t widest = 0;
    for (std::size_t i = 1; i < ranges.size(); ++i)
      if (part(i, ranges) > part(widest, ranges)) widest = i;
    const ExactRange own = ranges[widest];
    const Rational middle = (own.first + own.second) / 2;
    ranges[widest] = {own.first, middle};
    push(ranges);
    ranges[widest] = {middle, own.second};
    push(std::move(ranges));
  }

  static Status status_of(core::Verdict verdict) {
    return verdict == core::Verdict::verified  ? Status::feasible
           : verdict == core::Verdict::refuted ? Status::infeasible
                                               : Status::undecided;
  }

  void decided(const Box& box, Status status, const std::string& reason) {
    core::StudyCell& cell = cells_.emplace_back();
    cell.status = status;
    cell.reason = reason;
    for (const ExactRange& own : box.ranges) {
      cell.lower.push_back(core::to_double(own.first));
      cell.upper.push_back(core::to_double(own.second));
    }
  }

  core::PreloadAnswer finished() {
    for (const WantedEffort& own : wanted_) {
      answer_.joints.push_back(own.joint);
      answer_.forces.push_back(own.force);
      answer_.lower.push_back(core::to_double(own.lower));
      answer_.upper.push_back(core::to_double(own.upper));
    }
    answer_.size = {std::min(least_open_, smallest_ ? smallest_->size : std::numeric_limits<double>::infinity()),
                    smallest_ ? smallest_->size : std::numeric_limits<double>::infinity()};
    if (wanted_.size() == 1) answer_.ranges = joined_ranges(cells_);
    if (smallest_) {
      answer_.value.emplace();
      for (const ExactRange& own : smallest_->ranges) answer_.value->push_back(core::to_double(short_value(own)));
    }
    return std::move(answer_);
  }

 public:
  /// The smallest that was found, of few digits: all of its box verify.
  std::vector<Rational> smallest() const {
    std::vector<Rational> values;
    for (const ExactRange& own : smallest_->ranges) values.push_back(short_value(own));
    return values;
  }

 private:
  static Rational short_value(const ExactRange& range) {
    if (range.first <= 0 && range.second >= 0) return 0;
    return core::simplest_rational_near((range.first + range.second) / 2, (range.second - range.first) / 2);
  }

  std::vector<WantedEffort> wanted_;
  const VerifyRequest& request_;
  std::unique_ptr<PreloadJudge> judge_;
  std::vector<std::optional<numeric::EffortGap>> own_gaps_;
  std::priority_queue<Box> queue_;
  std::vector<core::StudyCell> cells_;
  std::optional<Box> smallest_;
  double least_open_ = std::numeric_limits<double>::infinity();  ///< of what is not decided, the smallest size
  core::PreloadAnswer answer_;
};

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
  if (task.controlled_preload)
    return only_tensions_are_free(mechanism) ? verify_with_tensions(model, task, request)
                                             : verify_with_law(model, task, request);
  // The search knows efforts that are given: those that are looked for are open in it.
  PreloadSearch search(mechanism, wanted, task, request);
  core::PreloadAnswer answer = search.run();
  const bool found = answer.value.has_value();
  std::vector<Rational> efforts;
  for (const WantedEffort& own : wanted) efforts.push_back(nearest_to_none(own.lower, own.upper));
  if (found) efforts = search.smallest();
  Verification result = verify(with_efforts(model, wanted, efforts), task, request);
  if (!found && answer.size[0] < std::numeric_limits<double>::infinity()) {
    result.verdict = core::Verdict::undecided;
    result.witness.reset();
    result.notes.emplace_back("no preload was found that verifies, and not all are proven to fail");
  } else if (!found) {
    result.notes.emplace_back("no constant preload within these ranges verifies the task: each fails, proven");
  }
  result.preload = std::move(answer);
  return result;
}

}  // namespace clearloci
