#include "analysis/preload_judges.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "analysis/effort_patterns.hpp"
#include "analysis/effort_system.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/proven_cells.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/widened_task.hpp"
#include "core/enclosure.hpp"
#include "loci/tasks/tasks.hpp"
#include "mechanism/read_task.hpp"
#include "numeric/model.hpp"
#include "symbolic/pose_statics.hpp"

namespace clearloci {
namespace {

using core::Task;
using core::Verdict;
using loci::pose::Doubt;
using loci::pose::PoseCell;
using loci::pose::PoseRegion;
using loci::pose::PoseSuspect;
using mechanism::Mechanism;
using mechanism::ParameterRange;

/// The patterns of signs that are possible, with what some poses ask of each.
class PatternRows {
 public:
  /// The system must outlive them.
  PatternRows(const EffortSystem& system, const Task& task) {
    const std::size_t n = system.mechanism().coordinates.size();
    const PoseRegion region(task.shape, {std::vector<double>(n, 1.0), std::vector<bool>(n, true)});
    const std::vector<loci::pose::Pose> samples = region.samples();
    constexpr std::size_t most_patterns = 16, most_poses = 32;
    std::optional<SignPatterns> found;
    for (std::size_t i = 0; i < samples.size() && !found; ++i) found = sign_patterns(system, system.places(samples[i]));
    if (!found || found->possible.size() > most_patterns) return;
    const std::size_t stride = (samples.size() + most_poses - 1) / most_poses;
    for (const SignPattern& signs : found->possible) {
      std::vector<EffortInequality>& rows = patterns_.emplace_back(system.rows_of_efforts(signs));
      for (std::size_t i = 0; i < samples.size(); i += i < most_poses / 2 ? 1 : stride)
        for (const loci::pose::Pose& place : system.places(samples[i]))
          if (const auto load_rows = system.rows(place, signs))
            rows.insert(rows.end(), load_rows->begin(), load_rows->end());
    }
  }

  /// Why no effort of a box has any of the patterns; empty where some may have. Rows that rule out a pattern say
  /// nothing of what vanishes there, unless the reaction has neither sign; the end of a range of efforts is where
  /// the nearest fails.
  std::string failing(const std::vector<core::Interval>& box) const {
    std::vector<const EffortInequality*> failed;
    for (const std::vector<EffortInequality>& rows : patterns_) {
      const std::size_t before = failed.size();
      for (const EffortInequality& row : rows)
        if (all_fail(row, box)) failed.push_back(&row);
      if (failed.size() == before) return {};
    }
    if (failed.empty()) return {};
    std::set<std::pair<std::string, int>> signs;
    for (const EffortInequality* row : failed) signs.emplace(row->reaction, row->sign);
    const EffortInequality* nearest = nullptr;
    std::pair<bool, double> least;
    for (const EffortInequality* row : failed) {
      const bool has_sign = !row->bound && !signs.contains({row->reaction, -row->sign});
      const std::pair<bool, double> key = {has_sign, distance_beyond(*row, box)};
      if (nearest == nullptr || key < least) nearest = row, least = key;
    }
    const EffortInequality& first = *nearest;
    const std::string joint = first.reaction.substr(first.reaction.find('_') + 1);
    if (first.bound) return joint + " beyond its bounds";
    return (first.reaction.front() == 'f' ? "contact lost in " : "backlash in ") + joint;
  }

 private:
  std::vector<std::vector<EffortInequality>> patterns_;  ///< none where they are not known
};

std::vector<core::Interval> intervals_of(const std::vector<ExactRange>& efforts) {
  std::vector<core::Interval> box;
  for (const ExactRange& range : efforts) box.push_back(core::range_of(range.first, range.second));
  return box;
}

std::vector<ParameterRange> ranges_of(const std::vector<WantedEffort>& wanted) {
  std::vector<ParameterRange> ranges;
  for (const WantedEffort& effort : wanted) ranges.push_back({effort.parameter, effort.lower, effort.upper});
  return ranges;
}

class DesignPreload : public PreloadJudge {
 public:
  DesignPreload(const Mechanism& mechanism, const std::vector<WantedEffort>& wanted, const Task& task,
                const LociRequest& request)
      : task_(mechanism, ranges_of(wanted), task, request),
        judge_(task_.judge()),
        system_(mechanism, wanted, task, requested_modes(mechanism, request_of(task, request)).front(),
                request_of(task, request)),
        rows_(system_, task),
        deadline_(request.deadline) {}

  BoxVerdict judge(const std::vector<ExactRange>& efforts, bool finest) override {
    const auto box = task_.box(efforts);
    if (!box) return {};
    loci::SearchBudget budget = finest ? budget_of_finest_cells : budget_of_coarse_cells;
    budget.deadline = deadline_;
    const loci::DesignProof proof = judge_->judge(*box, task_.margin(), loci::Refuting::all, budget);
    if (proof.verdict == Verdict::undecided)
      if (const std::string reason = rows_.failing(intervals_of(efforts)); !reason.empty())
        return {Verdict::refuted, reason};
    return {proof.verdict, proof.failure ? task_.reason(*proof.failure) : std::string()};
  }

 private:
  DesignTask task_;
  std::unique_ptr<loci::DesignJudge> judge_;
  EffortSystem system_;
  PatternRows rows_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

/// With the efforts as coordinates beside those of the pose. All efforts of a box fail where at two poses of the task
/// a reaction has opposite signs for each of them, or at one an effort is beyond its bound or a reaction too small.
class StaticsPreload : public PreloadJudge {
 public:
  StaticsPreload(const Mechanism& mechanism, const std::vector<WantedEffort>& wanted, const Task& task,
                 const LociRequest& request)
      : wanted_(ranges_of(wanted)),
        task_(task),
        request_(request_of(task, request)),
        system_(mechanism, wanted, task, requested_modes(mechanism, request_).front(), request_),
        rows_(system_, task),
        widened_(mechanism, with_efforts(mechanism, wanted_, task)),
        metric_(widened_.metric(mechanism, task)),
        margin_(core::to_double(task.margin)) {
    const DyadSides sides = requested_modes(mechanism, request_).front();
    std::vector<numeric::NumericModel> models;
    std::vector<const Mechanism*> loads;
    for (const Mechanism& load : widened_.loads()) {
      models.push_back(numeric::compile(load));
      loads.push_back(&load);
    }
    std::vector<std::string> notes;
    const std::vector<core::TaskDemand> demands =
        loaded_demands(models, sides, demands_of(mechanism, request_),
                       PoseRegion(task.shape, metric_, widened_.beside()).samples(), notes);
    statics_ = symbolic::pose_statics(loads, sides, demands);
    cell_.emplace(statics_);
  }

  BoxVerdict judge(const std::vector<ExactRange>& efforts, bool finest) override {
    Ranges ranges;
    for (std::size_t i = 0; i < wanted_.size(); ++i)
      ranges[wanted_[i].name] = core::range_of(efforts[i].first, efforts[i].second);
    const PoseRegion region(task_.shape, metric_, widened_.beside_with(ranges));
    std::string reason = rows_.failing(intervals_of(efforts));
    if (!reason.empty()) return {Verdict::refuted, reason};
    const auto all_fail = [&](const PoseSuspect& suspect) {
      reason = suspect.kind == Doubt::demand ? failing(suspect, ranges) : std::string();
      return !reason.empty();
    };
    for (const PoseSuspect& suspect : turning_)
      if (all_fail(suspect)) return {Verdict::refuted, reason};
    std::vector<loci::pose::Pose> too_small;
    const std::vector<PoseSuspect> unlike = unlike_samples(region, too_small);
    for (const PoseSuspect& suspect : unlike)
      if (all_fail(suspect)) return {Verdict::refuted, reason};
    for (const loci::pose::Pose& pose : too_small)
      if (reason = all_too_small(pose, ranges); !reason.empty()) return {Verdict::refuted, reason};
    if (!unlike.empty() || !too_small.empty()) return {};  // the box as a whole does not verify
    constexpr long coarse = 2'000, fine = 40'000;
    const loci::SearchBudget budget{.most_cells = finest ? fine : coarse, .deadline = request_.deadline};
    const loci::CoverProof proof = loci::pose::prove_poses(statics_, region, margin_, all_fail, budget);
    return {proof.verdict, reason, proof.cost.cells};
  }

 private:
  static Task with_efforts(const Mechanism& mechanism, const std::vector<ParameterRange>& wanted, Task task) {
    for (const ParameterRange& range : wanted) {
      const core::Rational value = mechanism::parameter_named(mechanism, range.name)->value;
      task.tolerances.push_back({range.name, range.lower - value, range.upper - value});
    }
    return task;
  }

  /// Of every demand of one component two samples of a region between which it turns, those farthest from zero.
  /// `too_small`: where a reaction is smaller than it has to be.
  std::vector<PoseSuspect> unlike_samples(const PoseRegion& region, std::vector<loci::pose::Pose>& too_small) {
    struct Extreme {
      double size = 0;
      loci::pose::Pose at;
    };
    std::vector<std::array<Extreme, 2>> extremes(statics_.demands.size());
    for (loci::pose::Pose pose : region.samples()) {
      pose = widened_.settled(std::move(pose));
      const auto at = cell_->at(pose);
      if (!at) continue;
      for (std::size_t d = 0; d < extremes.size(); ++d) {
        const double size = PoseCell::size_of(at->components[d]);
        const bool small = size < core::to_double(statics_.demands[d].demand.least);
        if (small && (too_small.empty() || too_small.back() != pose)) too_small.push_back(pose);
        const int sign = sign_of(*at, d);
        if (sign == 0) continue;
        if (Extreme& extreme = extremes[d][sign > 0 ? 0 : 1]; extreme.at.empty() || size > extreme.size)
          extreme = {size, pose};
      }
    }
    std::vector<PoseSuspect> unlike;
    for (std::size_t d = 0; d < extremes.size(); ++d)
      if (statics_.demands[d].demand.bound) {
        if (!extremes[d][1].at.empty()) unlike.push_back({Doubt::demand, static_cast<int>(d), extremes[d][1].at});
      } else if (!extremes[d][0].at.empty() && !extremes[d][1].at.empty())
        unlike.push_back({Doubt::demand, static_cast<int>(d), extremes[d][0].at, extremes[d][1].at});
    return unlike;
  }

  /// The sign of a demand of one component at a pose, a load and a design, for all efforts of a box; 0: not one.
  int sign_at(const loci::pose::Pose& somewhere, int demand, const Ranges& efforts) {
    const loci::pose::Pose pose = widened_.settled(somewhere);
    Ranges ranges = efforts;
    for (const auto& [name, value] : widened_.design(pose)) ranges.emplace(name, core::Interval(value));
    loci::pose::PoseBeside beside = widened_.beside_with(ranges);
    const std::size_t poses = metric_.weights.size() - beside.lower.size();
    beside.balls.clear();
    for (std::size_t i = widened_.variables(); i < beside.lower.size(); ++i)
      beside.lower[i] = beside.upper[i] = pose[poses + i];
    core::RationalPose place;
    for (std::size_t c = 0; c < poses; ++c) place.emplace_back(pose[c]);
    int sign = 0;
    for (const loci::pose::PosePiece& piece :
         PoseRegion(core::TaskBox{place, place}, metric_, std::move(beside)).pieces(0)) {
      const int sign_here = sign_in(piece, static_cast<std::size_t>(demand));
      if (sign_here == 0 || (sign != 0 && sign_here != sign)) return 0;
      sign = sign_here;
    }
    return sign;
  }

  int sign_in(const loci::pose::PosePiece& piece, std::size_t demand) {
    switch (cell_->enter(piece.chart, piece.box)) {
      case PoseCell::State::proven:
        if (const auto at = cell_->at(piece.chart.at(loci::pose::middle_of(piece.box)))) return sign_of(*at, demand);
        return 0;
      case PoseCell::State::in_doubt: {
        const PoseCell::Known sides_known = cell_->known();
        const bool has_sign = statics_.demands[demand].components.size() == 1 && demand < sides_known.signs.size();
        return has_sign ? std::clamp(sides_known.signs[demand], -1, 1) : 0;
      }
      case PoseCell::State::outside:
        // The pose can be assembled: some effort is beyond its bound in all of the cell, be it this one or another.
        if (statics_.demands[demand].demand.bound)
          if (const auto at = cell_->at(piece.chart.at(loci::pose::middle_of(piece.box))))
            return std::min(0, sign_of(*at, demand));
        break;
    }
    return 0;
  }

  /// Under all loads.
  static int sign_of(const PoseCell::At& at, std::size_t demand) {
    int sign = 0;
    for (const std::vector<double>& components : at.components[demand]) {
      if (components.size() != 1 || components[0] == 0) return 0;
      const int effort_sign = components[0] > 0 ? 1 : -1;
      if (sign != 0 && effort_sign != sign) return 0;
      sign = effort_sign;
    }
    return sign;
  }

  /// Which reaction bears less than it has to at a pose, whatever the free efforts.
  std::string all_too_small(const loci::pose::Pose& at, const Ranges& efforts) const {
    std::vector<std::array<double, 2>> box;
    for (const ParameterRange& parameter_range : wanted_) {
      const core::Interval& range = efforts.at(parameter_range.name);
      box.push_back({range.lower(), range.upper()});
    }
    const core::TaskDemand* const demand = system_.too_small(widened_.pose_of(at), box);
    if (demand == nullptr) return {};
    return (demand->quantity == core::Quantity::M ? "min_couple in " : "min_force in ") + demand->joint;
  }

  /// Which reaction turns between two poses, or which effort is beyond its bound at one, whatever the free efforts;
  /// empty where that is not certain.
  std::string failing(const PoseSuspect& suspect, const Ranges& efforts) {
    const core::TaskDemand& demand = statics_.demands[static_cast<std::size_t>(suspect.demand)].demand;
    if (demand.least > 0)
      if (std::string reason = all_too_small(suspect.at, efforts); !reason.empty()) return reason;
    if (!demand.bound && !suspect.other) return {};
    const int here = sign_at(suspect.at, suspect.demand, efforts);
    const bool fails = demand.bound ? here < 0 : here != 0 && sign_at(*suspect.other, suspect.demand, efforts) == -here;
    if (!fails) return {};
    constexpr std::size_t kept = 32;
    if (turning_.size() < kept) turning_.push_back(suspect);
    if (demand.bound) return demand.joint + " beyond its bounds";
    const bool effort = demand.quantity == core::Quantity::M || demand.quantity == core::Quantity::F;
    return (effort ? "backlash in " : "contact lost in ") + demand.joint;
  }

  std::vector<ParameterRange> wanted_;
  Task task_;
  LociRequest request_;
  EffortSystem system_;
  PatternRows rows_;
  WidenedTask widened_;
  loci::pose::PoseMetric metric_;
  double margin_ = 0;
  core::PoseStatics statics_;
  std::optional<PoseCell> cell_;
  std::vector<PoseSuspect> turning_;  ///< whose demand turned for all efforts of some box: tried first of the next
};

}  // namespace

std::unique_ptr<PreloadJudge> preload_judge(const Mechanism& mechanism, const std::vector<WantedEffort>& wanted,
                                            const Task& task, const LociRequest& request) {
  const bool spatial = mechanism.space == mechanism::Space::spatial;
  if (mechanism::is_plane(mechanism) && !mechanism::has_effort_bounds(mechanism) &&
      !(spatial && (task.loads || !task.loads_within.empty())))
    return std::make_unique<DesignPreload>(mechanism, wanted, task, request);
  return std::make_unique<StaticsPreload>(mechanism, wanted, task, request);
}

}  // namespace clearloci
