#include "analysis/preload.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <queue>
#include <string>
#include <utility>

#include "analysis/pose.hpp"
#include "analysis/preload_judges.hpp"
#include "analysis/proven_cells.hpp"
#include "analysis/task_demands.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "core/task.hpp"
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

/// A free effort without a value, and where it is looked for.
struct Wanted {
  std::string joint, parameter;
  bool force = false;
  Rational lower = {}, upper = {};
  double size_of_one = 1;  ///< what an effort of 1 N or 1 N m counts
};

Rational nearest_to_none(const Rational& lower, const Rational& upper) {
  return lower > 0 ? lower : upper < 0 ? upper : Rational();
}

/// The size of the smallest preload of a box.
double least_size(const std::vector<Wanted>& wanted, const std::vector<ExactRange>& ranges) {
  double size = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const Rational least = abs(nearest_to_none(ranges[i].first, ranges[i].second));
    size = std::max(size, core::to_double(least) * wanted[i].size_of_one);
  }
  return size;
}

Model with_efforts(const Model& model, const std::vector<Wanted>& wanted, const std::vector<Rational>& efforts) {
  std::vector<Model::Value> values;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    values.emplace_back(wanted[i].parameter,
                        "(" + core::to_string(efforts[i]) + ")" + (wanted[i].force ? " N" : " N m"));
  return model.with(values);
}

/// The mechanism under its loads, and with each part of a load that a task lets differ as much larger as it may be.
std::vector<Mechanism> under_larger_loads(const Mechanism& mechanism, const Task& task) {
  std::vector<Mechanism> all = {mechanism};
  if (task.loads)
    for (Mechanism& own : under_loads_of(task, mechanism)) all.push_back(std::move(own));
  const auto add = [&](std::size_t load, const Rational& by, const auto& part_of) {
    Mechanism own = mechanism;
    core::Expression& part = part_of(own.loads[load]);
    part = core::Expression::apply(core::Expression::Kind::add, {part, core::Expression::number(by)});
    all.push_back(std::move(own));
  };
  for (const core::LoadWithin& within : task.loads_within) {
    for (std::size_t c = 0; c < mechanism.loads[within.load].force.size() && within.force > 0; ++c)
      add(within.load, within.force, [c](mechanism::Load& load) -> core::Expression& { return load.force[c]; });
    if (within.couple > 0)
      add(within.load, within.couple, [](mechanism::Load& load) -> core::Expression& { return load.couple; });
  }
  return all;
}

/// Beyond which effort no reaction changes its sign at some poses of the task, times eight: reactions are linear in it.
Rational range_without_bounds(const Model& model, const std::vector<Wanted>& wanted, std::size_t own, const Task& task,
                              const VerifyRequest& request) {
  std::vector<Rational> efforts(wanted.size(), 0);
  const std::vector<Mechanism> without =
      under_larger_loads(with_efforts(model, wanted, efforts).content().mechanism, task);
  efforts[own] = 1;
  const Model with_one = with_efforts(model, wanted, efforts);
  PoseRequest asked;
  asked.working_mode = requested_modes(model.content().mechanism, request.loci).front();
  const auto reactions_of = [&](const Mechanism& some, const core::RationalPose& at) {
    std::vector<double> list;
    const Pose pose = solve_pose(some, at, asked);
    if (pose.unreachable.empty() && pose.beyond_limit.empty())
      for (const core::JointReaction& joint : pose.reactions)
        for (const core::ReactionComponent& part : joint.components) list.push_back(part.value);
    return list;
  };
  const std::array<core::RationalPose, 2> corners = core::bounds(task.shape);
  double most = 1;
  for (const auto& [first, second] : {std::pair{1, 1}, {1, 3}, {2, 2}, {3, 1}, {3, 3}}) {
    core::RationalPose at;
    for (std::size_t c = 0; c < corners[0].size(); ++c)
      at.push_back(corners[0][c] + (corners[1][c] - corners[0][c]) * (c % 2 == 0 ? first : second) / 4);
    const std::vector<double> one = reactions_of(with_one.content().mechanism, at);
    const std::vector<double> none = reactions_of(without.front(), at);
    constexpr double no_bound = 1e9;
    for (const Mechanism& larger : without) {
      const std::vector<double> reached = reactions_of(larger, at);
      if (none.size() != one.size() || none.size() != reached.size()) continue;
      for (std::size_t r = 0; r < none.size(); ++r)
        if (const double effort = std::abs(reached[r] / (one[r] - none[r])); effort < no_bound)
          most = std::max(most, effort);
    }
  }
  return Rational(8 * std::exp2(std::ceil(std::log2(most))));
}

std::vector<Wanted> wanted_efforts(const Model& model, const Task& task, const VerifyRequest& request) {
  const Mechanism& mechanism = model.content().mechanism;
  std::vector<const mechanism::Joint*> joints;
  for (const mechanism::JointIndex j : mechanism::joints_without_preload(mechanism))
    joints.push_back(&mechanism.joints[static_cast<std::size_t>(j)]);
  std::vector<Wanted> wanted;
  for (const mechanism::Joint* joint : joints)
    wanted.push_back(
        {joint->name, joint->free_effort->parameter, mechanism::traits(*joint).actuator == core::Quantity::F});
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    Wanted& own = wanted[i];
    if (const auto& within = joints[i]->free_effort->within) {
      own.lower = within->first;
      own.upper = within->second;
      own.size_of_one = 1 / core::to_double(std::max(abs(own.lower), abs(own.upper)));
    } else {
      own.upper = range_without_bounds(model, wanted, i, task, request);
      own.lower = -own.upper;
    }
  }
  return wanted;
}

/// Boxes of efforts, of which those of the smallest size come first, each proven as a whole or cut in halves.
class PreloadSearch {
 public:
  PreloadSearch(const Mechanism& mechanism, std::vector<Wanted> wanted, const Task& task, const VerifyRequest& request)
      : wanted_(std::move(wanted)),
        request_(request),
        judge_(preload_judge(mechanism, ranges_of(wanted_), task, request.loci)) {}

  /// Of one effort all boxes are decided. Of several each is first tried alone, then all together among smaller ones.
  core::PreloadAnswer run() {
    std::vector<ExactRange> whole, none;
    for (const Wanted& own : wanted_) {
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
      const BoxVerdict verdict = over ? BoxVerdict{} : judge_->judge(box.ranges, is_finest(box.ranges));
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

  static std::vector<mechanism::ParameterRange> ranges_of(const std::vector<Wanted>& wanted) {
    std::vector<mechanism::ParameterRange> ranges;
    for (const Wanted& own : wanted) ranges.push_back({own.parameter, own.lower, own.upper});
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
    for (const Wanted& own : wanted_) {
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

  std::vector<Wanted> wanted_;
  const VerifyRequest& request_;
  std::unique_ptr<PreloadJudge> judge_;
  std::priority_queue<Box> queue_;
  std::vector<core::StudyCell> cells_;
  std::optional<Box> smallest_;
  double least_open_ = std::numeric_limits<double>::infinity();  ///< of what is not decided, the smallest size
  core::PreloadAnswer answer_;
};

std::string named_efforts(const std::vector<Wanted>& wanted) {
  std::string names;
  for (const Wanted& own : wanted) names += (names.empty() ? "" : ", ") + own.joint;
  return names;
}

}  // namespace

Verification verify_preloaded(const Model& model, const Task& task, const VerifyRequest& request) {
  std::vector<Wanted> given;
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
  const std::vector<Wanted> wanted = wanted_efforts(model, task, request);
  if (request.fit != TaskFit::none)
    throw core::InputError({task.file},
                           "the task is to be moved, and the effort of " + named_efforts(wanted) + " is free",
                           "give it by --preload, or leave --fit out");
  // The search knows efforts that are given: those that are looked for are open in it.
  PreloadSearch search(mechanism, wanted, task, request);
  core::PreloadAnswer answer = search.run();
  const bool found = answer.value.has_value();
  std::vector<Rational> efforts;
  for (const Wanted& own : wanted) efforts.push_back(nearest_to_none(own.lower, own.upper));
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
