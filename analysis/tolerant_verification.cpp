#include <algorithm>
#include <cmath>

#include "analysis/design_task.hpp"
#include "analysis/framed.hpp"
#include "analysis/take_ups.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/verification.hpp"
#include "core/enclosure.hpp"
#include "core/errors.hpp"
#include "numeric/pose_error.hpp"
#include "numeric/task_witness.hpp"

namespace clearloci {
namespace {

using core::Point2;
using loci::DesignFailure;
using numeric::Bounded;

constexpr int cells_of_a_margin = 40'000;
/// What ends the margin is told apart to this part of the task.
constexpr double margin_accuracy = 1e-4;
/// The largest pose error is bounded this close, relatively.
constexpr double error_accuracy = 1e-3;

/// What doubles leave open of a pose error, relatively, away from singularities.
constexpr double rounding_of_pose_errors = 1e-9;

class Tolerant {
 public:
  Tolerant(const mechanism::Mechanism& mechanism, const core::Task& task, const VerifyRequest& request)
      : mechanism_(mechanism),
        request_(request.loci),
        depth_(request.depth),
        task_(mechanism, {}, task, request.loci),
        judge_(task_.judge()) {
    for (const mechanism::Mechanism& load : task_.loads()) loads_.push_back(numeric::compile(load));
    for (const mechanism::Mechanism& direction : task_.directions()) directions_.push_back(numeric::compile(direction));
  }

  void decide(Verification& result) {
    const auto designs = task_.box({});
    if (!designs)
      throw core::InputError({task_.task().file}, "a link has no length above zero within the tolerances",
                             "make the tolerances smaller");
    loci::SearchBudget budget = loci::budget_of_task;
    budget.deadline = request_.deadline;
    if (request_.progress) request_.progress(0, "proof");
    const loci::DesignProof proof = judge_->judge(*designs, task_.margin(), loci::Refuting::one, budget);
    result.verdict = proof.verdict;
    result.open.reset();
    result.witness.reset();
    result.margin.reset();
    result.cells = proof.cost.cells;
    if (result.verified() && depth_ == VerifyDepth::verdict) return;
    if (result.verified()) {
      if (request_.progress) request_.progress(0, "margin");
      budget = {.most_cells = cells_of_a_margin, .deadline = request_.deadline};
      result.margin = judge_->clearance(*designs, task_.margin(), widest_margin(mechanism_, task_.margin()),
                                        margin_accuracy, budget);
      if (task_.task().pose_error)  // proven where the verdict is, whether this bound comes closer or not
        result.pose_error = std::min(core::to_double(*task_.task().pose_error),
                                     judge_->greatest_displacement(*designs, error_accuracy, budget).upper());
      return;
    }
    if (result.verdict == core::Verdict::undecided) {
      result.witness = at_a_sample(*designs);
      if (result.witness)
        result.verdict = core::Verdict::refuted;
      else
        result.open = open_part(proof);
      return;
    }
    result.witness = witness_of(*proof.failure);
    if (result.witness) return;
    result.verdict = core::Verdict::undecided;
    result.notes.push_back("enclosures refute the task (" + task_.reason(*proof.failure) +
                           "), but no witness was found that the numeric solution confirms");
  }

 private:
  std::optional<core::TaskWitness> witness_of(const DesignFailure& failure) {
    if (failure.kind == DesignFailure::Kind::displaced) return displaced_at(failure);
    if (!failure.watched) return confirmed(failure.at, failure.parameters);
    // The sign changes between two poses and two designs: first the design changes, then the pose.
    const std::size_t w = *failure.watched;
    const auto& from = failure.other_parameters;
    const auto& to = failure.parameters;
    const int sign = judge_->sign_at(w, failure.other, from);
    const auto design = [&](double t) {
      std::vector<double> witness;
      for (std::size_t p = 0; p < from.size(); ++p) witness.push_back(t == 1 ? to[p] : from[p] + t * (to[p] - from[p]));
      return witness;
    };
    if (judge_->sign_at(w, failure.other, to) != sign)
      return between(w, sign, [&](double t) { return std::pair(failure.other, design(t)); });
    const core::Polyline way = task_.region().way(failure.other, failure.at, task_.margin());
    for (std::size_t i = 1; i < way.size(); ++i) {
      if (judge_->sign_at(w, way[i], to) == sign) continue;
      const Point2 &a = way[i - 1], &b = way[i];
      return between(w, sign, [&](double t) {
        return std::pair(t == 1 ? b : Point2{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])}, to);
      });
    }
    return std::nullopt;
  }

  template <class Place>
  std::optional<core::TaskWitness> between(std::size_t watched, int sign, const Place& place) {
    double low = 0, high = 1;
    for (int i = 0; i < 100 && high - low > 0; ++i) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      const auto [pose, design] = place(middle);
      (judge_->sign_at(watched, pose, design) == sign ? low : high) = middle;
    }
    for (const double t : {high, low, 0.5 * (low + high)}) {
      const auto [pose, design] = place(t);
      if (auto found = confirmed(pose, design)) return found;
    }
    return std::nullopt;
  }

  /// A pose among samples of the task at which the design in the middle fails, under the loads that are worst there:
  /// the proof refutes with loads that it comes upon, and does not look for these.
  std::optional<core::TaskWitness> at_a_sample(const loci::DesignBox& designs) {
    std::vector<double> middle;
    for (const core::Interval& parameter : designs) middle.push_back(parameter.middle());
    for (const Point2& pose : task_.region().samples())
      if (auto found = confirmed(pose, middle)) return found;
    return std::nullopt;
  }

  numeric::TaskWitness& witness(const std::vector<double>& parameters) {
    if (witness_) return *witness_;
    numeric::WitnessLoads loads;
    for (const numeric::NumericModel& model : loads_) loads.ends.push_back(&model);
    for (const numeric::NumericModel& model : directions_) loads.directions.push_back(&model);
    loads.balls = task_.balls();
    // Radii were rounded up for the proof; a witness is within what was asked.
    for (core::LoadBall& ball : loads.balls) ball.radius *= 1 - 0x1p-50;
    std::vector<std::vector<double>> usual;
    for (const Point2& pose : task_.region().samples()) {
      std::vector<double>& at = usual.emplace_back();
      for (const Bounded& value : bounded(pose, parameters)) at.push_back(value.value);
    }
    return witness_.emplace(std::move(loads), task_.sides(), task_.demands(), usual,
                            numeric::TaskWitness::Rounding::of_plane);
  }

  std::vector<Bounded> bounded(const Point2& pose, const std::vector<double>& parameters) const {
    std::vector<Bounded> at;
    for (const core::Interval& coordinate : judge_->coordinates(pose, parameters))
      at.emplace_back(coordinate.middle(), 0.5 * coordinate.width());
    return at;
  }

  std::optional<core::TaskWitness> confirmed(const Point2& pose, const std::vector<double>& parameters) {
    const double distance = task_.region().signed_distance(pose);
    if (distance > 0 && distance >= task_.margin() && distance > 0x1p-48 * (1 + std::hypot(pose[0], pose[1])))
      return std::nullopt;
    const auto found = witness(parameters).failures(bounded(pose, parameters), true);
    return found.empty() ? std::nullopt : std::optional(described(pose, parameters, found));
  }

  /// A design whose end effector is displaced too far at a pose, under a load.
  std::optional<core::TaskWitness> displaced_at(const DesignFailure& failure) const {
    Ranges values_of_design;
    for (std::size_t p = 0; p < failure.parameters.size(); ++p)
      values_of_design[task_.design().varied[p]] = core::Interval(failure.parameters[p]);
    mechanism::Mechanism open = with_clearances(task_.design(), task_.loads().front(), values_of_design);
    const auto number = [](double value) { return core::Expression::number(core::Rational(value)); };
    core::TaskWitness told;
    if (const auto& range = task_.task().loads) {
      told.load = load_between(*range, failure.load);
      for (std::size_t c = 0; c < 2; ++c) open.loads.front().force[c] = number(told.load[c]);
    }
    if (!changed_by_balls(open, failure.load_factors)) return std::nullopt;
    const numeric::NumericModel model = numeric::compile(open);
    const numeric::Posture posture = numeric::posture(model, values(failure.at, failure.parameters), task_.sides());
    if (!posture.reachable()) return std::nullopt;
    const double size = numeric::pose_accuracy(model, posture).least_distance;
    if (!(size > core::to_double(*task_.task().pose_error) * (1 + rounding_of_pose_errors))) return std::nullopt;
    told.kind = core::TaskWitness::Kind::displaced;
    told.at = list_of(failure.at);
    told.distance = std::max(0.0, task_.region().signed_distance(failure.at));
    told.size = size;
    told.most = task_.task().pose_error;
    for (std::size_t p = 0; p < failure.parameters.size(); ++p)
      told.design.emplace_back(task_.design().varied[p], failure.parameters[p]);
    for (const core::LoadWithin& within : task_.task().loads_within)
      if (within.force > 0 || within.couple > 0) told.loads.push_back(load_at(posture, within.load, model.mechanism));
    return told;
  }

  /// Adds to loads what these factors of the balls' directions are. False: to one that is written as a vector.
  bool changed_by_balls(mechanism::Mechanism& open, const std::vector<double>& factors) const {
    const auto add = [](core::Expression& to, double what) {
      to = core::Expression::apply(core::Expression::Kind::add, {to, core::Expression::number(core::Rational(what))});
    };
    auto factor = factors.begin();
    for (const core::LoadWithin& within : task_.task().loads_within) {
      mechanism::Load& load = open.loads[within.load];
      if (within.force > 0) {
        if (load.force.size() != 2) return false;
        for (core::Expression& part : load.force) add(part, *factor++);
      }
      if (within.couple > 0) add(load.couple, *factor++);
    }
    return true;
  }

  core::TaskWitness described(const Point2& pose, const std::vector<double>& parameters,
                              const std::vector<numeric::TaskFailure>& found) const {
    using Kind = numeric::TaskFailure::Kind;
    const numeric::TaskFailure& first = found.front();
    core::TaskWitness told = told_failure(mechanism_, loads_.front(), values(pose, parameters), task_.sides(), first);
    told.limit.clear();  // those of the file's own design are told
    told.at = list_of(pose);
    told.distance = std::max(0.0, task_.region().signed_distance(pose));
    for (std::size_t p = 0; p < parameters.size(); ++p)
      told.design.emplace_back(task_.design().varied[p], parameters[p]);
    if (first.kind != Kind::vanishing && first.kind != Kind::too_small) return told;
    add_loads(told, first, parameters);
    return told;
  }

  void add_loads(core::TaskWitness& told, const numeric::TaskFailure& found,
                 const std::vector<double>& parameters) const {
    const double t = found.load;
    if (const auto& range = task_.task().loads) told.load = load_between(*range, t);
    // The file's loads at this design.
    const numeric::Posture posture =
        numeric::posture(loads_.front(), values({told.at[0], told.at[1]}, parameters), task_.sides());
    auto change = found.changes.begin();
    for (const core::LoadWithin& within : task_.task().loads_within) {
      if (!(within.force > 0) && !(within.couple > 0)) continue;
      core::WitnessLoad load{within.load, {0, 0}, {0}};
      if (posture.reachable()) load = load_at(posture, within.load, loads_.front().mechanism);
      if (!told.load.empty() && within.load == 0) load.force = told.load;
      for (std::size_t c = 0; c < 2 && within.force > 0; ++c) load.force[c] += *change++;
      if (within.couple > 0) load.couple[0] += *change++;
      told.loads.push_back(load);
    }
  }

  std::vector<double> values(const Point2& pose, const std::vector<double>& parameters) const {
    std::vector<double> list;
    for (const Bounded& value : bounded(pose, parameters)) list.push_back(value.value);
    return list;
  }

  const mechanism::Mechanism& mechanism_;
  const LociRequest& request_;
  VerifyDepth depth_;
  DesignTask task_;
  std::unique_ptr<loci::DesignJudge> judge_;
  std::vector<numeric::NumericModel> loads_, directions_;
  std::optional<numeric::TaskWitness> witness_;
};

}  // namespace

bool is_tolerant(const core::Task& task) {
  return !task.tolerances.empty() || !task.loads_within.empty() || task.pose_error;
}

void decide_tolerant(const mechanism::Mechanism& mechanism, const core::Task& task, const VerifyRequest& request,
                     Verification& result) {
  // What the file's own design fails, the task fails.
  result.task = task;
  if (result.verdict == core::Verdict::refuted) return;
  result.zone = result.verified() ? result.zone : "";
  // Tolerances are of the file's parameters: moved alone, its lengths keep their units.
  if (const auto scaled = framed(mechanism, Scaling::none, mechanism::Parameters::kept)) {
    Tolerant(scaled->mechanism, in_frame(task, scaled->frame), request).decide(result);
    move_from_frame(result.witness, result.open, mechanism, scaled->frame);
  } else {
    Tolerant(mechanism, task, request).decide(result);
  }
  if (!result.verified()) result.zone.clear();
}

}  // namespace clearloci
