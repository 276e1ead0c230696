#include "analysis/preload_judges.hpp"

#include <optional>
#include <utility>

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

class DesignPreload : public PreloadJudge {
 public:
  DesignPreload(const Mechanism& mechanism, const std::vector<ParameterRange>& wanted, const Task& task,
                const LociRequest& request)
      : task_(mechanism, wanted, task, request), judge_(task_.judge()), deadline_(request.deadline) {}

  BoxVerdict judge(const std::vector<ExactRange>& efforts, bool finest) override {
    const auto box = task_.box(efforts);
    if (!box) return {};
    loci::DesignEffort effort = finest ? effort_of_finest_cells : effort_of_coarse_cells;
    effort.deadline = deadline_;
    const loci::DesignProof proof = judge_->judge(*box, task_.margin(), loci::Refuting::all, effort);
    return {proof.verdict, proof.failure ? task_.reason(*proof.failure) : std::string()};
  }

 private:
  DesignTask task_;
  std::unique_ptr<loci::DesignJudge> judge_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

/// With the efforts as coordinates beside those of the pose. All efforts of a box fail where at two poses of the task
/// a reaction has opposite signs for each of them.
class StaticsPreload : public PreloadJudge {
 public:
  StaticsPreload(const Mechanism& mechanism, const std::vector<ParameterRange>& wanted, const Task& task,
                 const LociRequest& request)
      : wanted_(wanted),
        task_(task),
        request_(request_of(task, request)),
        widened_(mechanism, with_efforts(mechanism, wanted, task)),
        margin_(core::to_double(task.margin)) {
    metric_.weights.assign(mechanism.coordinates.size(), 1);
    metric_.grows.assign(mechanism.coordinates.size(), true);
    for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c) {
      const bool angle = mechanism.coordinates[c].angle;
      if (angle && task.angle_length) metric_.weights[c] = core::to_double(*task.angle_length);
      any_length_ = any_length_ || !angle;
    }
    for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c)
      metric_.grows[c] = !mechanism.coordinates[c].angle || task.angle_length || !any_length_;
    metric_.weights.insert(metric_.weights.end(), widened_.beside().lower.size(), 1);
    metric_.grows.insert(metric_.grows.end(), widened_.beside().lower.size(), false);
    const DyadSides sides = requested_modes(mechanism, request_).front();
    std::vector<numeric::NumericModel> models;
    std::vector<const Mechanism*> loads;
    for (const Mechanism& own : widened_.loads()) {
      models.push_back(numeric::compile(own));
      loads.push_back(&own);
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
    const loci::pose::PoseBeside beside = widened_.beside_with(ranges);
    const PoseRegion region(task_.shape, metric_, beside);
    BoxVerdict verdict;
    const auto all_fail = [&](const PoseSuspect& suspect) {
      if (!suspect.other || suspect.kind != Doubt::demand) return false;
      verdict.reason = turned(suspect, beside);
      return !verdict.reason.empty();
    };
    for (const auto& [first, second] : turning_poses_)
      if (all_fail({Doubt::demand, first.second, first.first, second})) return {Verdict::refuted, verdict.reason};
    constexpr long coarse = 2'000, fine = 40'000;
    const loci::pose::PoseEffort effort{.most_cells = finest ? fine : coarse, .deadline = request_.deadline};
    verdict.verdict = loci::pose::prove_poses(statics_, region, margin_, all_fail, effort).verdict;
    return verdict;
  }

 private:
  static Task with_efforts(const Mechanism& mechanism, const std::vector<ParameterRange>& wanted, Task task) {
    for (const ParameterRange& own : wanted) {
      const core::Rational value = mechanism::parameter_named(mechanism, own.name)->value;
      task.tolerances.push_back({own.name, own.lower - value, own.upper - value});
    }
    return task;
  }

  /// The sign of a demand of one component at a pose of the task, for all that is beside it; 0: not one.
  int sign_at(const loci::pose::Pose& pose, int demand, const loci::pose::PoseBeside& beside) {
    const std::size_t poses = metric_.weights.size() - beside.lower.size();
    core::RationalPose place;
    for (std::size_t c = 0; c < poses; ++c) place.emplace_back(pose[c]);
    const auto pieces = PoseRegion(core::TaskBox{place, place}, metric_, beside).pieces(0);
    int sign = 0;
    for (const loci::pose::PosePiece& piece : pieces) {
      int own = 0;
      switch (cell_->enter(piece.chart, piece.box)) {
        case PoseCell::State::proven:
          if (const auto at = cell_->at(piece.chart.at(loci::pose::middle_of(piece.box))))
            own = sign_of(*at, static_cast<std::size_t>(demand));
          break;
        case PoseCell::State::in_doubt: {
          const PoseCell::Known known = cell_->known();
          if (static_cast<std::size_t>(demand) < known.signs.size())
            own = known.signs[static_cast<std::size_t>(demand)];
          break;
        }
        case PoseCell::State::outside:
          break;
      }
      if (own == 0 || (sign != 0 && own != sign)) return 0;
      sign = own;
    }
    return sign;
  }

  /// Under all loads.
  static int sign_of(const PoseCell::At& at, std::size_t demand) {
    int sign = 0;
    for (const std::vector<double>& components : at.components[demand]) {
      if (components.size() != 1 || components[0] == 0) return 0;
      const int own = components[0] > 0 ? 1 : -1;
      if (sign != 0 && own != sign) return 0;
      sign = own;
    }
    return sign;
  }

  /// Which reaction turns between two poses, whatever the efforts; empty where that is not certain.
  std::string turned(const PoseSuspect& suspect, const loci::pose::PoseBeside& beside) {
    if (statics_.demands[static_cast<std::size_t>(suspect.demand)].demand.quantity == core::Quantity::f) return {};
    const int here = sign_at(suspect.at, suspect.demand, beside);
    if (here == 0 || sign_at(*suspect.other, suspect.demand, beside) != -here) return {};
    constexpr std::size_t kept = 32;
    if (turning_poses_.size() < kept) turning_poses_.push_back({{suspect.at, suspect.demand}, *suspect.other});
    const core::TaskDemand& demand = statics_.demands[static_cast<std::size_t>(suspect.demand)].demand;
    const bool effort = demand.quantity == core::Quantity::M || demand.quantity == core::Quantity::F;
    return (effort ? "backlash in " : "contact lost in ") + demand.joint;
  }

  std::vector<ParameterRange> wanted_;
  Task task_;
  LociRequest request_;
  WidenedTask widened_;
  loci::pose::PoseMetric metric_;
  bool any_length_ = false;
  double margin_ = 0;
  core::PoseStatics statics_;
  std::optional<PoseCell> cell_;
  /// Between which a demand was seen to turn for all efforts of some box: tried first of the next.
  std::vector<std::pair<std::pair<loci::pose::Pose, int>, loci::pose::Pose>> turning_poses_;
};

}  // namespace

std::unique_ptr<PreloadJudge> preload_judge(const Mechanism& mechanism, const std::vector<ParameterRange>& wanted,
                                            const Task& task, const LociRequest& request) {
  const bool spatial = mechanism.space == mechanism::Space::spatial;
  if (mechanism::is_plane(mechanism) && !(spatial && (task.loads || !task.loads_within.empty())))
    return std::make_unique<DesignPreload>(mechanism, wanted, task, request);
  return std::make_unique<StaticsPreload>(mechanism, wanted, task, request);
}

}  // namespace clearloci
