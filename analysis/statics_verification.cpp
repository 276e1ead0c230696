#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "analysis/framed.hpp"
#include "analysis/group_sheets.hpp"
#include "analysis/idle_efforts.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/pose_displacement.hpp"
#include "analysis/pose_fit.hpp"
#include "analysis/side_names.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/verification.hpp"
#include "core/errors.hpp"
#include "loci/tasks/tasks.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/notes.hpp"
#include "numeric/least_load.hpp"
#include "numeric/task_witness.hpp"
#include "symbolic/pose_statics.hpp"

namespace clearloci {
namespace {

using core::Task;
using core::TaskDemand;
using loci::pose::Doubt;
using loci::pose::NearPose;
using PoseAt = loci::pose::Pose;  // core::Pose is an answer
using loci::pose::PoseCell;
using loci::pose::PoseMetric;
using loci::pose::PoseRegion;
using loci::pose::PoseSuspect;
using mechanism::Mechanism;

/// Of the margin and of least reactions, to how much of themselves they are proven, and the cells that this may take.
constexpr double margin_accuracy = 0.05, least_accuracy = 0.1;
constexpr long cells_of_a_margin = 250'000, cells_of_least = 60'000;
/// Of each place or scale that a fit tries: beside a locus in six coordinates a proof may take all that it is given.
constexpr long cells_of_a_trial = 60'000;

/// Metrics that margins are told in: what grows together.
struct Metrics {
  PoseMetric asked;                  ///< that of the task's margin
  std::optional<PoseMetric> angles;  ///< where angles are apart from lengths
  bool is_angle = false;             ///< of `asked`: rad
};

Metrics metrics_of(const Mechanism& mechanism, const Task& task, const WidenedTask& widened) {
  Metrics metrics{widened.metric(mechanism, task), {}, false};
  bool any_angle = false, any_length = false;
  for (const mechanism::Coordinate& c : mechanism.coordinates) (c.angle ? any_angle : any_length) = true;
  metrics.is_angle = !any_length && !task.angle_length;
  if (!any_angle || !any_length || task.angle_length) return metrics;
  metrics.angles.emplace(PoseMetric{std::vector<double>(metrics.asked.weights.size(), 1.0), {}});
  for (const mechanism::Coordinate& c : mechanism.coordinates) metrics.angles->grows.push_back(c.angle);
  metrics.angles->grows.resize(metrics.asked.grows.size(), false);
  return metrics;
}

class StaticsVerifier {
 public:
  StaticsVerifier(const Mechanism& mechanism, const Task& task, const LociRequest& request)
      : mechanism_(mechanism),
        task_(task),
        request_(request_of(task, request)),
        widened_(mechanism, task),
        metrics_(metrics_of(mechanism, task, widened_)),
        region_(task.shape, metrics_.asked, widened_.beside()),
        margin_(core::to_double(task.margin)),
        sides_(requested_modes(mechanism, request_).front()) {
    side_names(mechanism, sides_);  // there is one for every dyad
    for (const Mechanism& load : widened_.loads()) models_.push_back(numeric::compile(load));
    constexpr std::size_t poses = 24;
    std::vector<PoseAt> samples = region_.samples();
    if (samples.size() > poses) samples.erase(samples.begin() + 1, samples.end() - (poses - 1));
    std::vector<numeric::NumericModel> models = models_;
    for (numeric::NumericModel& beside : models_beside_efforts(widened_.loads().front()))
      models.push_back(std::move(beside));
    const std::vector<TaskDemand> demands =
        loaded_demands(models, sides_, demands_of(mechanism, request_), samples, notes_);
    demands_ = demands;
    witness_.emplace(witness_for(demands));
    std::vector<const Mechanism*> list;
    for (const Mechanism& load : widened_.loads()) list.push_back(&load);
    statics_ = symbolic::pose_statics(list, sides_, demands);
    cover_groups();
    cell_.emplace(statics_);
  }

  /// The sheet of the groups around the task and its margin, up to three coordinates over the whole box.
  void cover_groups() {
    if (mechanism_.groups.empty()) return;
    PoseAt lower, upper;
    const auto add = [&](std::size_t c, double low, double high) {
      if (lower.size() <= c) {
        lower.push_back(low);
        upper.push_back(high);
      }
      lower[c] = std::min(lower[c], low);
      upper[c] = std::max(upper[c], high);
    };
    const std::size_t coordinates = region_.coordinates();
    for (const loci::pose::PosePiece& piece : region_.pieces(margin_))
      for (std::size_t c = 0; c < coordinates; ++c) {
        double low = piece.chart.base[c], high = low;
        for (std::size_t p = 0; p < piece.box.size(); ++p) {
          const double a = piece.chart.ways[p][c] * piece.box[p][0], b = piece.chart.ways[p][c] * piece.box[p][1];
          low += std::min(a, b);
          high += std::max(a, b);
        }
        add(c, low, high);
      }
    constexpr std::size_t whole = 3;
    const auto& all = mechanism_.coordinates;
    for (std::size_t c = 0; c < all.size(); ++c) {
      const double reach = coordinates <= whole ? core::to_double(all[c].upper - all[c].lower) : upper[c] - lower[c];
      // A margin is looked for beyond the task.
      if (coordinates <= whole)
        add(c, core::to_double(all[c].lower) - 0.05 * reach, core::to_double(all[c].upper) + 0.05 * reach);
      else
        add(c, lower[c] - 0.25 * reach, upper[c] + 0.25 * reach);
    }
    clearloci::cover_groups(mechanism_, lower, upper, request_.deadline, statics_, notes_);
  }

  /// The task elsewhere, or larger or smaller.
  void place(const core::TaskShape& shape) {
    task_.shape = shape;
    region_ = PoseRegion(shape, metrics_.asked, widened_.beside());
    witness_.emplace(witness_for(demands_));
  }

  /// Whether nothing changes its sign or is too small between a few poses of a shape: the first, its middle and
  /// corners, and some of the others.
  bool looks_good(const core::TaskShape& shape) {
    constexpr std::size_t first_looks = 9, looks = 12;
    if (request_.deadline && std::chrono::steady_clock::now() >= *request_.deadline) return false;
    std::vector<PoseAt> poses = PoseRegion(shape, metrics_.asked, widened_.beside()).samples();
    const auto first = cell_->at(poses.front());
    if (!first) return false;
    const std::size_t stride = (poses.size() + looks - 1) / looks;
    for (std::size_t i = 0; i < poses.size(); i += i < first_looks ? 1 : stride) {
      if (!is_alike(*first, poses[i], {Doubt::singularity, -1, poses[i]})) return false;
      for (std::size_t d = 0; d < statics_.demands.size(); ++d)
        if (!is_alike(*first, poses[i], {Doubt::demand, static_cast<int>(d), poses[i]})) return false;
    }
    return true;
  }

  /// From a shape to the nearest locus found.
  double room(const core::TaskShape& shape) const {
    if (request_.deadline && std::chrono::steady_clock::now() >= *request_.deadline) return 0;
    const std::vector<NearPose> near = near_loci(PoseRegion(shape, metrics_.asked, widened_.beside()));
    return near.empty() ? std::numeric_limits<double>::infinity() : near.front().distance;
  }

  Verification verify(VerifyDepth depth, loci::SearchBudget budget = loci::pose::budget_of_poses) {
    Verification result;
    result.task = task_;
    result.notes = mechanism::notes_of(mechanism_);
    result.notes.insert(result.notes.end(), notes_.begin(), notes_.end());
    progress("search");
    const std::vector<NearPose> near = near_loci(region_);
    progress("proof");
    const auto refuted = [&](const PoseSuspect& suspect) {
      result.witness = confirmed(suspect);
      return result.witness.has_value();
    };
    // On one side of a fold links are rigid or bend all over it, and no proof leads across: one pose tells which.
    if (refuted({Doubt::workspace, -1, region_.samples().front()}) || fails_under_a_load(result)) {
      result.verdict = core::Verdict::refuted;
      return result;
    }
    for (const NearPose& pose : near)
      if (pose.distance <= margin_ && refuted({pose.kind, pose.demand, pose.at})) {
        result.verdict = core::Verdict::refuted;
        return result;
      }
    budget.deadline = request_.deadline;
    const loci::CoverProof proof = loci::pose::prove_poses(statics_, region_, margin_, refuted, budget);
    result.verdict = proof.verdict;
    result.cells = proof.cost.cells;
    if (result.verdict == core::Verdict::undecided) result.open = open_part(proof, widened_);
    if (result.verified() && task_.pose_error) {
      progress("pose error");
      judge_displacement(mechanism_, task_, widened_, sides_, region_, request_.deadline, result);
    }
    // Where a witness is in the task, one that is farther off is not the nearest.
    if (result.verdict != core::Verdict::refuted) tell_nearest(near, result);
    if (result.verified() && depth != VerifyDepth::verdict) measure(near, depth, result);
    return result;
  }

 private:
  void progress(const char* stage) const {
    if (request_.progress) request_.progress(0, stage);
  }

  numeric::TaskWitness witness_for(const std::vector<TaskDemand>& demands) const {
    numeric::WitnessLoads loads;
    for (const numeric::NumericModel& model : models_) loads.ends.push_back(&model);
    return {std::move(loads), sides_, demands, region_.samples(), numeric::TaskWitness::Rounding::of_coordinates};
  }

  core::TaskWitness told(const PoseAt& at, const numeric::TaskFailure& failure) const {
    using Kind = numeric::TaskFailure::Kind;
    core::TaskWitness witness = told_failure(mechanism_, models_.front(), at, sides_, failure);
    witness.at = widened_.pose_of(at);
    witness.distance = region_.distance(at);
    witness.design = widened_.design(at);
    const bool of_reaction = failure.kind == Kind::vanishing || failure.kind == Kind::too_small;
    if (!of_reaction && failure.kind != Kind::beyond_bound) return witness;
    if (models_.size() > 1) witness.load = load_between(*task_.loads, failure.load);
    add_loads(at, failure.load, witness);
    return witness;
  }

  /// What loads are that may differ.
  void add_loads(const PoseAt& at, double t, core::TaskWitness& told) const {
    const auto posture = [&](const numeric::NumericModel& model) { return numeric::posture(model, at, sides_); };
    const numeric::Posture first = posture(models_.front()), last = posture(models_.back());
    if (!first.reachable() || !last.reachable()) return;
    const auto between = [t](std::vector<double>& a, const std::vector<double>& b) {
      for (std::size_t c = 0; c < a.size(); ++c) a[c] = (1 - t) * a[c] + t * b[c];
    };
    for (const core::LoadWithin& within : task_.loads_within) {
      core::WitnessLoad load = load_at(first, within.load, mechanism_);
      const core::WitnessLoad other = load_at(last, within.load, mechanism_);
      between(load.force, other.force);
      between(load.couple, other.couple);
      told.loads.push_back(std::move(load));
    }
  }

  std::optional<core::TaskWitness> fails_at(const PoseAt& somewhere, int demand) const {
    const PoseAt at = widened_.settled(somewhere);
    if (!(region_.distance(at) <= margin_ + region_.hair())) return std::nullopt;
    const auto failure = witness_->failure_of(at, demand);
    return failure ? std::optional(told(at, *failure)) : std::nullopt;
  }

  /// At samples of the task, under the loads that take most of a demand.
  bool fails_under_a_load(Verification& result) {
    if (task_.loads_within.empty()) return false;
    constexpr std::size_t most = 64;
    const auto count = static_cast<std::ptrdiff_t>(mechanism_.coordinates.size());
    std::set<PoseAt> poses;  // whatever the loads
    for (const PoseAt& sample : region_.samples()) {
      if (poses.size() >= most || !poses.insert({sample.begin(), sample.begin() + count}).second) continue;
      for (std::size_t d = 0; d < statics_.demands.size(); ++d) {
        if (request_.deadline && std::chrono::steady_clock::now() >= *request_.deadline) return false;
        result.witness = confirmed_under_a_load({Doubt::demand, static_cast<int>(d), sample});
        if (result.witness) return true;
      }
    }
    return false;
  }

  /// Whether a suspect fails for certain, under its own loads or under those that take most of the demand.
  std::optional<core::TaskWitness> confirmed(const PoseSuspect& suspect) {
    if (auto found = confirmed_as_it_is(suspect)) return found;
    if (task_.loads_within.empty() || suspect.kind != Doubt::demand) return std::nullopt;
    return confirmed_under_a_load(suspect);
  }

  /// Under the loads in balls that bring a demand nearest to zero, of which its components are affine functions, and
  /// between these and the loads in the middle.
  std::optional<core::TaskWitness> confirmed_under_a_load(const PoseSuspect& suspect) {
    const std::vector<core::LoadBall>& balls = widened_.beside().balls;
    const std::size_t poses = mechanism_.coordinates.size();
    PoseAt middle = widened_.settled(suspect.at);
    for (const core::LoadBall& ball : balls)
      std::fill_n(middle.begin() + static_cast<std::ptrdiff_t>(poses + ball.first), ball.count, 0.0);
    using Loads = std::vector<std::vector<double>>;
    const auto loads_at = [&](const PoseAt& pose) {
      const auto here = cell_->at(pose);
      return here ? std::optional<Loads>(here->components[static_cast<std::size_t>(suspect.demand)]) : std::nullopt;
    };
    const auto ends = loads_at(middle);
    if (!ends) return std::nullopt;
    Loads directions;
    std::vector<core::LoadBall> parts;
    for (const core::LoadBall& ball : balls) {
      parts.push_back({directions.size(), ball.count, ball.radius});
      for (std::size_t k = 0; k < ball.count; ++k) {
        PoseAt pose = middle;
        pose[poses + ball.first + k] = ball.radius;
        const auto under = loads_at(pose);
        if (!under) return std::nullopt;
        std::vector<double>& direction = directions.emplace_back();
        for (std::size_t c = 0; c < ends->front().size(); ++c)
          direction.push_back((under->front()[c] - ends->front()[c]) / ball.radius);
      }
    }
    const numeric::LeastLoad least = numeric::least_load(*ends, directions, parts);
    PoseAt worst = middle;
    for (std::size_t b = 0; b < balls.size(); ++b) {
      double square = 0;
      for (std::size_t k = 0; k < parts[b].count; ++k) square += std::pow(least.changes[parts[b].first + k], 2);
      // A single component is taken as far as it goes: beyond zero, that its sign tells.
      const double further = ends->front().size() == 1 && square > 0 ? balls[b].radius / std::sqrt(square) : 1;
      for (std::size_t k = 0; k < parts[b].count; ++k)
        worst[poses + balls[b].first + k] = further * least.changes[parts[b].first + k];
    }
    return confirmed_as_it_is({Doubt::demand, suspect.demand, widened_.settled(std::move(worst)), std::move(middle)});
  }

  /// Whether a suspect fails for certain; with another pose, between the two.
  std::optional<core::TaskWitness> confirmed_as_it_is(const PoseSuspect& suspect) {
    if (auto found = fails_at(suspect.at, suspect.demand)) return found;
    if (!suspect.other) return std::nullopt;
    const std::vector<PoseAt> way = region_.way(*suspect.other, suspect.at);
    const auto reference = cell_->at(*suspect.other);
    if (!reference) return std::nullopt;
    for (std::size_t i = 1; i < way.size(); ++i)
      if (!is_alike(*reference, way[i], suspect)) return between(*reference, way[i - 1], way[i], suspect);
    return std::nullopt;
  }

  /// Whether what is suspected has the sign at a pose that it has at the reference.
  bool is_alike(const PoseCell::At& reference, const PoseAt& pose, const PoseSuspect& suspect) {
    const auto now = cell_->at(pose);
    if (!now) return false;
    if (suspect.kind == Doubt::singularity) return now->determinant == reference.determinant;
    const auto d = static_cast<std::size_t>(suspect.demand);
    for (std::size_t load = 0; load < now->components[d].size(); ++load) {
      double together = 0;
      for (std::size_t k = 0; k < now->components[d][load].size(); ++k)
        together += now->components[d][load][k] * reference.components[d][load][k];
      if (together <= 0) return false;
    }
    return true;
  }

  std::optional<core::TaskWitness> between(const PoseCell::At& reference, const PoseAt& from, const PoseAt& to,
                                           const PoseSuspect& suspect) {
    const auto at = [&](double t) {
      PoseAt pose = from;
      for (std::size_t c = 0; c < pose.size(); ++c) pose[c] = t == 1 ? to[c] : from[c] + t * (to[c] - from[c]);
      return widened_.settled(std::move(pose));
    };
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (is_alike(reference, at(middle), suspect) ? low : high) = middle;
    }
    for (const double t : {high, low})
      for (const int demand : {suspect.demand, -1})
        if (auto found = fails_at(at(t), demand)) return found;
    // Where doubles do not tell that it is zero: its sign is certain a little to both sides. Nothing tells so across
    // poses that are out of reach, at which a reaction may jump: there the boundary is looked for instead.
    for (double apart = 0x1p-50; apart < 1; apart *= 4) {
      const double before = std::max(0.0, low - apart), behind = std::min(1.0, high + apart);
      if (!region_.holds_way(at(before), at(behind), margin_)) break;
      if (!cell_->at(at(high))) {
        if (auto found = fails_at(at(behind), -1)) return found;
        if (auto found = fails_at(at(before), -1)) return found;
        continue;
      }
      for (const int demand : {suspect.demand, -1})
        if (witness_->differs(at(before), at(behind), demand)) {
          using Kind = numeric::TaskFailure::Kind;
          numeric::TaskFailure failure{demand < 0 ? Kind::singular : Kind::vanishing};
          if (demand >= 0) failure.demand = witness_->demands()[static_cast<std::size_t>(demand)];
          return told(at(high), failure);
        }
    }
    return std::nullopt;
  }

  void tell_nearest(const std::vector<NearPose>& near, Verification& result) const {
    if (near.empty()) return;
    const NearPose& first = near.front();
    core::NearestOfTask nearest;
    nearest.at = widened_.pose_of(first.at);
    nearest.distance = first.distance;
    nearest.kind = first.kind == Doubt::workspace     ? core::LocusKind::workspace_boundary
                   : first.kind == Doubt::singularity ? core::LocusKind::direct_singularity
                                                      : core::LocusKind::contact_loss;
    // All that vanish there together.
    constexpr double together = 1e-6;
    bool gravest = false;
    for (const NearPose& other : near) {
      if (first.kind != Doubt::demand || other.kind != Doubt::demand) continue;
      if (other.distance > first.distance + together * (1 + first.distance)) continue;
      const TaskDemand& demand = statics_.demands[static_cast<std::size_t>(other.demand)].demand;
      // A force and a bound of it may be 0 together.
      const core::Vanishing what{demand.joint, demand.quantity, 1};
      if (std::find(nearest.vanishing.begin(), nearest.vanishing.end(), what) == nearest.vanishing.end())
        nearest.vanishing.push_back(what);
      const core::LocusKind kind = locus_kind_of(demand);
      nearest.kind = gravest ? std::min(nearest.kind, kind) : kind;
      gravest = true;
    }
    result.nearest = nearest;
  }

  std::vector<NearPose> near_loci(const PoseRegion& region) const {
    return loci::pose::near_loci(statics_, region, limit_of(region.metric(), {}));
  }

  double limit_of(const PoseMetric& metric, const std::vector<NearPose>& near) const {
    const double limit = widest_margin(mechanism_, margin_, &metric);
    return near.empty() ? limit : std::min(limit, near.front().distance);
  }

  /// The margins, and what reactions have at least.
  void measure(const std::vector<NearPose>& near, VerifyDepth depth, Verification& result) {
    loci::SearchBudget budget{.most_cells = cells_of_a_margin, .deadline = request_.deadline};
    progress("margin");
    const double pose_clearance =
        loci::pose::pose_clearance(statics_, region_, margin_, limit_of(metrics_.asked, near), margin_accuracy, budget);
    (metrics_.is_angle ? result.angle_margin : result.margin) = pose_clearance;
    if (metrics_.angles) {
      const PoseRegion turned(task_.shape, *metrics_.angles, widened_.beside());
      const std::vector<NearPose> nearer = near_loci(turned);
      result.angle_margin =
          loci::pose::pose_clearance(statics_, turned, 0, limit_of(*metrics_.angles, nearer), margin_accuracy, budget);
    }
    if (depth != VerifyDepth::everything) return;
    progress("least reactions");
    std::vector<double> met(statics_.demands.size(), std::numeric_limits<double>::infinity());
    for (const PoseAt& pose : region_.samples())
      if (const auto at = cell_->at(pose))
        for (std::size_t d = 0; d < met.size(); ++d) met[d] = std::min(met[d], PoseCell::size_of(at->components[d]));
    budget.most_cells = cells_of_least;
    const std::vector<double> proven = loci::pose::least_sizes(statics_, region_, met, least_accuracy, budget);
    for (std::size_t d = 0; d < met.size(); ++d) {
      const TaskDemand& demand = statics_.demands[d].demand;
      if (demand.bound) continue;
      const double least = std::max(proven[d], core::to_double(demand.least));
      result.least.push_back({{demand.joint, demand.quantity, 1}, std::min(least, met[d]), met[d]});
    }
  }

  const Mechanism& mechanism_;
  Task task_;
  LociRequest request_;
  WidenedTask widened_;
  Metrics metrics_;
  PoseRegion region_;
  double margin_;
  DyadSides sides_;
  std::vector<numeric::NumericModel> models_;
  std::vector<TaskDemand> demands_;
  std::optional<numeric::TaskWitness> witness_;
  core::PoseStatics statics_;
  std::optional<PoseCell> cell_;
  std::vector<std::string> notes_;
};

}  // namespace

Verification verify_by_statics(const Mechanism& mechanism, const Task& task, const VerifyRequest& request) {
  if (task.pose_error && std::none_of(mechanism.joints.begin(), mechanism.joints.end(),
                                      [](const mechanism::Joint& joint) { return joint.clearance.has_value(); }))
    throw core::InputError({mechanism.file}, "no joint has a clearance, so there is no pose error",
                           "write such as clearance: {radial: 10e-6} at a joint, or leave pose_error out");
  // Tolerances are of the file's parameters.
  const auto parameters = task.tolerances.empty() ? mechanism::Parameters::valued : mechanism::Parameters::kept;
  if (const std::optional<Framed> scaled = framed(mechanism, Scaling::none, parameters))
    return from_frame(verify_by_statics(scaled->mechanism, in_frame(task, scaled->frame), request), task, mechanism,
                      scaled->frame);
  if (request.fit == TaskFit::none) return StaticsVerifier(mechanism, task, request.loci).verify(request.depth);
  StaticsVerifier verifier(mechanism, task, request.loci);
  const PoseJudge judge{[&](const core::TaskShape& shape) {
                          verifier.place(shape);
                          return verifier.verify(VerifyDepth::verdict, {.most_cells = cells_of_a_trial}).verified();
                        },
                        [&](const core::TaskShape& shape) { return verifier.looks_good(shape); },
                        [&](const core::TaskShape& shape) { return verifier.room(shape); }};
  const std::optional<PlacedShape> placed = place_shape(mechanism, task, request.fit, judge);
  verifier.place(placed ? placed->shape : task.shape);
  Verification result = verifier.verify(request.depth);
  if (!placed)
    result.notes.emplace_back(
        request.fit == TaskFit::largest
            ? "no scale was found at which the task is verified; the verdict is that of the task as written"
            : "no place was found at which the task is verified; the verdict is that of the task as written");
  if (!placed) return result;
  result.moved_by = placed->by;
  result.scaled_by = placed->scale;
  return result;
}

}  // namespace clearloci
