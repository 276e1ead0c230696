#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "analysis/framed.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/singular_modes.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/verification.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "loci/curves/curves.hpp"
#include "loci/tasks/tasks.hpp"
#include "loci/zones/zones.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/write_task.hpp"
#include "numeric/line_witness.hpp"
#include "numeric/take_up.hpp"
#include "numeric/task_witness.hpp"
#include "symbolic/task_conditions.hpp"

namespace clearloci {
namespace {

using core::Point2;
using core::Quantity;
using core::Task;
using core::TaskDemand;
using core::Verdict;
using numeric::TaskFailure;

constexpr int cells_of_a_margin = 40'000;

int sign(const numeric::Bounded& value) { return value.value > value.error ? 1 : value.value < -value.error ? -1 : 0; }

/// The limits among the causes of a boundary, which are separated by "; ".
std::string limits_in(const std::string& causes) {
  std::string limits;
  for (std::size_t from = 0; from < causes.size();) {
    const std::size_t end = std::min(causes.find("; ", from), causes.size());
    const std::string cause = causes.substr(from, end - from);
    if (cause.starts_with(mechanism::limit_cause))
      limits += (limits.empty() ? "" : "; ") + cause.substr(mechanism::limit_cause.size());
    from = end + 2;
  }
  return limits;
}

/// One load: the mechanism under it.
struct LoadCase {
  explicit LoadCase(mechanism::Mechanism loaded) : mechanism(std::move(loaded)), model(numeric::compile(mechanism)) {}
  mechanism::Mechanism mechanism;
  numeric::NumericModel model;
};

std::vector<LoadCase> load_cases(const mechanism::Mechanism& mechanism, const Task& task) {
  std::vector<LoadCase> cases;
  for (mechanism::Mechanism& loaded : under_loads_of(task, mechanism)) cases.emplace_back(std::move(loaded));
  return cases;
}

/// Where roots depend on one another: the sheet that holds the task. A fold that the task meets bounds it.
TracedProblem on_sheet_of(const Task& task, TracedProblem traced) {
  if (traced.sheets.empty()) return traced;
  const core::Polyline samples = loci::TaskRegion(task.shape).samples();
  const auto holds = [&](const TracedSheet& sheet) {
    return std::any_of(samples.begin(), samples.end(), [&](const Point2& at) {
      return loci::is_on_sheet(sheet.problem.tower, sheet.problem.modes.front(), at);
    });
  };
  auto sheet = std::find_if(traced.sheets.begin(), traced.sheets.end(), holds);
  if (sheet == traced.sheets.end()) sheet = traced.sheets.begin();
  return {std::move(sheet->problem), std::move(sheet->map)};
}

class TowerVerifier {
 public:
  TowerVerifier(const mechanism::Mechanism& mechanism, const Task& task, const LociRequest& request)
      : mechanism_(mechanism),
        task_(task),
        request_(request_of(task, request)),
        cases_(load_cases(mechanism, task)),
        sides_(requested_modes(mechanism, request_).front()),
        demands_(demands_of(mechanism, request_)),
        conditions_(symbolic::task_conditions(mechanisms(), demands_, {}, {},
                                              loaded_beside_efforts(cases_.front().mechanism, sides_, demands_,
                                                                    usual_poses(loci::TaskRegion(task.shape))))),
        mode_(mode_of(sides_, names_of(conditions_.tower))) {
    for (const TaskDemand& never : conditions_.never_loaded)
      std::erase_if(demands_, [&](const TaskDemand& demand) {
        return demand.joint == never.joint && demand.quantity == never.quantity;
      });
  }

  /// The task where it lies, or moved: the verdict, and where it is asked for and the task verified the margin.
  Verification decide(const Task& task, VerifyDepth depth) const {
    const loci::TaskRegion region(task.shape);
    const double margin = core::to_double(task.margin);
    const numeric::TaskWitness judge = witness_for(region);
    Verification result;
    result.task = task;
    result.mode = mode_;
    progress("proof");
    const loci::CoverProof proof = prove(region, margin, judge, result.witness);
    result.verdict = proof.verdict;
    result.cells = proof.cost.cells;
    if (result.verdict == Verdict::undecided) result.open = open_part(proof);
    if (result.verified() && depth != VerifyDepth::verdict) {
      progress("margin");
      prove_margin(region, margin, result);
    }
    return result;
  }

  /// And what the traced loci say.
  Verification verify(const Task& task) {
    const loci::TaskRegion region(task.shape);
    const numeric::TaskWitness judge = witness_for(region);
    Verification result = decide(task, VerifyDepth::everything);
    // Loci that touch the task without crossing it are not met by subdivision, but by tracing.
    if (result.verdict == Verdict::undecided &&
        refuted_by_loci(region, core::to_double(task.margin), judge, result.witness)) {
      result.verdict = Verdict::refuted;
      result.open.reset();
    }
    // What the proof met may lie outside the box, where nothing is traced.
    if (const auto traced = nearest(region);
        traced && (!result.nearest || traced->distance <= (1 + 1e-3) * result.nearest->distance))
      result.nearest = traced;
    // What was met is known to a part of its distance, the margin is proven.
    if (result.nearest && result.margin) result.nearest->distance = std::max(result.nearest->distance, *result.margin);
    return result;
  }

  bool proven(const Task& task) const {
    const loci::TaskRegion region(task.shape);
    std::optional<TaskWitness> ignored;
    return prove(region, core::to_double(task.margin), witness_for(region), ignored).verdict == Verdict::verified;
  }

  /// The loci under each load, traced once by an effort; fewer where the deadline came first.
  void trace(TraceEffort effort) {
    const bool is_traced = traced_ && (effort_ == TraceEffort::full || effort == TraceEffort::sketch);
    if (is_traced || !notes_.empty()) return;
    effort_ = effort;
    std::vector<TracedProblem> all;
    for (const LoadCase& one : cases_) {
      all.push_back(on_sheet_of(task_, trace_problem(one.mechanism, request_, {}, effort)));
      if (!all.back().map.out_of_time) continue;
      notes_.emplace_back("the loci could not be traced within the time limit");
      return;
    }
    traced_ = std::move(all);
  }
  const std::optional<std::vector<TracedProblem>>& traced() const { return traced_; }
  TraceEffort effort() const { return effort_; }
  const std::vector<std::string>& notes() const { return notes_; }
  const DyadSides& sides() const { return sides_; }
  const LociRequest& request() const { return request_; }

  /// None unless assembled, bearing enough, and every couple on one side all over the range of loads.
  loci::SignatureAt signature() const {
    const loci::TaskRegion region(task_.shape);
    return [this, judge = witness_for(region)](const Point2& at) -> std::optional<std::vector<int>> {
      if (judge.failure(at, false)) return std::nullopt;
      const numeric::NumericModel& model = cases_.front().model;
      const numeric::BoundedNumerators n = numeric::bounded_numerators(model, at, sides_);
      std::vector<int> signs = {sign(n.determinant)};
      for (const TaskDemand& demand : demands_)
        for (std::size_t k = 0; k < n.values.size(); ++k) {
          const mechanism::Unknown& unknown = model.unknowns[k];
          if (unknown.quantity == demand.quantity &&
              mechanism_.joints[static_cast<std::size_t>(unknown.joint)].name == demand.joint)
            signs.push_back(sign(n.values[k]));
          if (unknown.quantity != Quantity::N ||
              mechanism_.joints[static_cast<std::size_t>(unknown.joint)].name != demand.joint)
            continue;
          const auto j = static_cast<std::size_t>(unknown.joint);
          for (const auto& [end, side] : mechanism::guide_end_signs)
            if (demand.quantity == end)
              signs.push_back(
                  sign(numeric::components(n, {static_cast<int>(k), numeric::joint_columns(model)[j].tilt, -1,
                                               side / numeric::joint_clearances(mechanism_)[j].half_length})
                           .front()));
        }
      return signs;
    };
  }

 private:
  std::vector<const mechanism::Mechanism*> mechanisms() const {
    std::vector<const mechanism::Mechanism*> list;
    for (const LoadCase& one : cases_) list.push_back(&one.mechanism);
    return list;
  }

  void progress(const char* stage) const {
    if (request_.progress) request_.progress(0, stage);
  }

  numeric::TaskWitness witness_for(const loci::TaskRegion& region) const {
    numeric::WitnessLoads loads;
    for (const LoadCase& one : cases_) loads.ends.push_back(&one.model);
    return {std::move(loads), sides_, demands_, usual_poses(region), numeric::TaskWitness::Rounding::of_plane};
  }

  loci::RefutedAt refuted_at(const loci::TaskRegion& region, const numeric::TaskWitness& judge,
                             std::optional<TaskWitness>& witness) const {
    return [this, &region, &judge, &witness](const Point2& at, bool closely) {
      if (!judge.failure(at, closely)) return false;
      const std::vector<numeric::Bounded> place(at.begin(), at.end());
      witness = described(at, judge.failures(place, closely), region.signed_distance(at));
      return true;
    };
  }

  loci::CoverProof prove(const loci::TaskRegion& region, double margin, const numeric::TaskWitness& judge,
                         std::optional<TaskWitness>& witness) const {
    loci::SearchBudget budget = loci::budget_of_task;
    budget.deadline = request_.deadline;
    return loci::prove_task(conditions_, mode_, region, margin, refuted_at(region, judge, witness), budget);
  }

  bool refuted_by_loci(const loci::TaskRegion& region, double margin, const numeric::TaskWitness& judge,
                       std::optional<TaskWitness>& witness) {
    trace(TraceEffort::full);
    if (!traced_) return false;
    core::Polyline suspects;
    for (const TracedProblem& one : *traced_) {
      const core::WorkingMode mode = mode_of(sides_, one.map.tower);
      if (const auto found = loci::nearest_locus(one.problem, one.map, mode, region)) suspects.push_back(found->at);
      for (const core::IsolatedPoint& point : one.map.isolated_points)
        if (point.mode == mode) suspects.push_back({point.at[0], point.at[1]});
    }
    return loci::refuted_near(conditions_, mode_, region, margin, refuted_at(region, judge, witness), suspects);
  }

  /// Of couples in N m, where the mechanism is seen in a frame.
  core::Rational unit() const { return mechanism_.frame ? mechanism_.frame->scale : core::Rational(1); }

  TaskWitness described(const Point2& at, const std::vector<TaskFailure>& failures, double distance) const {
    using Kind = TaskFailure::Kind;
    const TaskFailure& first = failures.front();
    TaskWitness witness = told_failure(mechanism_, cases_.front().model, list_of(at), sides_, first);
    witness.distance = std::max(0.0, distance);
    if (first.kind != Kind::vanishing && first.kind != Kind::too_small) return witness;
    std::vector<core::Vanishing>& reactions = first.kind == Kind::vanishing ? witness.vanishing : witness.too_small;
    for (std::size_t i = 1; i < failures.size(); ++i)
      if (failures[i].kind == first.kind && failures[i].load == first.load)
        reactions.push_back({failures[i].demand.joint, failures[i].demand.quantity, 1});
    const Quantity q = first.demand.quantity;
    if (first.kind == Kind::too_small && (q == Quantity::M || q == Quantity::T)) {
      *witness.size *= core::to_double(unit());
      *witness.least *= unit();
    }
    if (task_.loads) witness.load = load_between(*task_.loads, first.load);
    return witness;
  }

  /// From the traced loci. Under a range of loads they are those of its ends, and the loads between have others.
  std::optional<NearestOfTask> nearest(const loci::TaskRegion& region) {
    if (task_.loads) return std::nullopt;
    trace(TraceEffort::sketch);
    if (!traced_) return std::nullopt;
    const TracedProblem& one = traced_->front();
    const core::LocusMap& map = one.map;
    const auto found = loci::nearest_locus(one.problem, map, mode_of(sides_, map.tower), region);
    if (!found) return std::nullopt;
    NearestOfTask nearest;
    nearest.at = list_of(found->at);
    nearest.distance = found->distance;
    if (found->curve >= 0) {
      const core::LocusCurve& curve = map.curves[static_cast<std::size_t>(found->curve)];
      nearest.curve = curve.id;
      nearest.kind = curve.kind;
      nearest.vanishing = curve.vanishing;
      if (curve.kind == core::LocusKind::workspace_boundary) nearest.limit = limits_in(curve.cause);
    } else {
      const core::IsolatedPoint& point = map.isolated_points[static_cast<std::size_t>(found->point)];
      nearest.isolated = true;
      nearest.kind = point.kind;
      nearest.vanishing = point.vanishing;
    }
    return nearest;
  }

  /// Cells look for what ends the margin, also outside the box and under every load of a range.
  void prove_margin(const loci::TaskRegion& region, double wanted, Verification& result) const {
    const loci::TaskClearance clearance =
        loci::proven_clearance(conditions_, mode_, region, wanted, widest_margin(mechanism_, wanted),
                               {.most_cells = cells_of_a_margin, .deadline = request_.deadline});
    result.margin = clearance.margin;
    if (!clearance.at) return;
    NearestOfTask nearest;
    nearest.at = list_of(*clearance.at);
    nearest.distance = region.signed_distance(*clearance.at);
    nearest.kind = clearance.kind;
    // Of the last cell that stayed open: it is within its size of what bounds it.
    constexpr double near = 1e-3;
    if (clearance.kind == core::LocusKind::workspace_boundary)
      nearest.limit = limit_at(mechanism_, cases_.front().model, *clearance.at, sides_, near);
    if (clearance.condition >= 0) {
      const core::TaskCondition& condition = conditions_.conditions[static_cast<std::size_t>(clearance.condition)];
      nearest.vanishing = condition.reactions;
      const Quantity q = condition.reactions.front().quantity;
      nearest.kind = condition.least > 0                    ? core::LocusKind::margin
                     : q == Quantity::M || q == Quantity::F ? core::LocusKind::backlash
                                                            : core::LocusKind::contact_loss;
    }
    result.nearest = nearest;
  }

  const mechanism::Mechanism& mechanism_;
  const Task& task_;
  LociRequest request_;
  std::vector<LoadCase> cases_;
  DyadSides sides_;
  std::vector<TaskDemand> demands_;
  core::TaskConditions conditions_;
  core::WorkingMode mode_;  ///< of the conditions' tower
  std::optional<std::vector<TracedProblem>> traced_;
  TraceEffort effort_ = TraceEffort::sketch;
  std::vector<std::string> notes_;
};

/// A way that was found as a number that people write: six digits of it in the file's unit.
core::Rational round_way(double way, const core::Units& units) {
  const core::Rational unit = mechanism::length_unit(units);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", way / core::to_double(unit));
  return core::rational_from_decimal(text.data()) * unit;
}

bool inside(const core::Zone& zone, const Point2& at) {
  return loci::inside_ring(zone.outer, at) && std::none_of(zone.holes.begin(), zone.holes.end(), [&](const auto& hole) {
           return loci::inside_ring(hole, at);
         });
}

bool all_certified(const core::LocusMap& map) {
  const auto certified = [](const auto& one) { return one.certified; };
  return std::all_of(map.curves.begin(), map.curves.end(), certified) &&
         std::all_of(map.isolated_points.begin(), map.isolated_points.end(), certified);
}

/// The loci and zones that the picture shows and the answer names. Under a range of loads they are those of the file's.
void add_zones(const mechanism::Mechanism& mechanism, TowerVerifier& verifier, Verification& result) {
  result.notes = verifier.notes();
  std::optional<TracedProblem> traced;
  if (result.task.loads && result.notes.empty())
    traced = on_sheet_of(result.task, trace_problem(mechanism, verifier.request(), {}, verifier.effort()));
  else if (verifier.traced())
    traced = verifier.traced()->front();
  if (traced && !traced->map.out_of_time) {
    const bool sketch = verifier.effort() == TraceEffort::sketch;
    result.map = loci::zones(traced->problem, std::move(traced->map), sketch).map;
    result.notes = result.map.loci.notes;
    if (sketch && !all_certified(result.map.loci))
      result.notes.emplace_back("the picture's loci are a sketch, not all of them certified; see clearloci loci");
  } else {
    result.map.loci = empty_map(mechanism);
    if (result.notes.empty()) result.notes.emplace_back("the loci could not be traced within the time limit");
  }
  if (!result.verified() || result.task.loads) return;
  const Point2 at = loci::TaskRegion(result.task.shape).samples().front();
  for (const core::Zone& zone : result.map.zones)
    if (inside(zone, at)) result.zone = zone.id;
}

}  // namespace

namespace {

/// The longest side of the box, m.
double extent(const mechanism::Mechanism& mechanism) {
  double longest = 0;
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates)
    longest = std::max(longest, core::to_double(coordinate.upper - coordinate.lower));
  return longest;
}

Verification placed_in_tower(const mechanism::Mechanism& mechanism, const Task& task, const VerifyRequest& request) {
  constexpr double half = 0.5, of_box = 1e-4;  // chords coarser than that would leave no place for a task beside them
  LociRequest fine = request.loci;
  fine.tolerance = std::min(fine.tolerance, of_box * extent(mechanism));
  TowerVerifier verifier(mechanism, task, fine);
  const auto way = [&](const Point2& by) {
    return core::RationalPose{round_way(by[0], mechanism.units), round_way(by[1], mechanism.units)};
  };
  const auto moved = [&](const Point2& by) {
    Task other = task;
    other.shape = core::moved(task.shape, way(by));
    return other;
  };
  const auto accept = [&](const loci::Fit& fit) { return verifier.proven(moved(fit.by)); };
  const auto pulse = [&] {
    if (fine.deadline && std::chrono::steady_clock::now() > *fine.deadline)
      throw core::LimitReached("the time limit was reached before a place for the task was found");
    if (fine.progress) fine.progress(half, "places");
  };
  verifier.trace(TraceEffort::full);
  if (!verifier.traced()) throw core::LimitReached("the loci could not be traced completely within the time limit");
  std::vector<const core::LocusMap*> maps;
  for (const TracedProblem& one : *verifier.traced()) maps.push_back(&one.map);
  const auto fit = loci::fit_task(maps, mode_of(verifier.sides(), maps.front()->tower), task.shape,
                                  core::to_double(task.margin), request.fit, verifier.signature(), accept, pulse);
  Verification result = verifier.verify(fit ? moved(fit->by) : task);
  add_zones(mechanism, verifier, result);
  result.mode = mode_of(verifier.sides(), result.map.loci.tower);
  if (fit)
    result.moved_by = way(fit->by);
  else
    result.notes.emplace_back(
        "no place was found at which the task is verified; the verdict is that of the task as written");
  return result;
}

}  // namespace

Verification verify_by_tower(const mechanism::Mechanism& mechanism, const Task& task, const VerifyRequest& request) {
  if (is_tolerant(task)) {
    Task nominal = task;
    nominal.tolerances.clear();
    nominal.loads_within.clear();
    nominal.pose_error.reset();
    Verification result = verify_by_tower(mechanism, nominal, request);
    decide_tolerant(mechanism, task, request, result);
    return result;
  }
  if (const std::optional<Framed> scaled = framed(mechanism)) {
    VerifyRequest inside = request;
    inside.loci = in_frame(request.loci, scaled->frame);
    return from_frame(verify_by_tower(scaled->mechanism, in_frame(task, scaled->frame), inside), task, mechanism,
                      scaled->frame);
  }
  require_regular(mechanism, requested_modes(mechanism, request.loci).front());
  if (request.fit != TaskFit::none) return placed_in_tower(mechanism, task, request);
  TowerVerifier verifier(mechanism, task, request.loci);
  Verification result =
      request.depth == VerifyDepth::everything ? verifier.verify(task) : verifier.decide(task, request.depth);
  if (request.depth == VerifyDepth::everything)
    add_zones(mechanism, verifier, result);
  else
    result.map.loci = empty_map(mechanism);  // the box and its units, for a picture without loci
  result.mode = mode_of(verifier.sides(), result.map.loci.tower);
  return result;
}

}  // namespace clearloci
