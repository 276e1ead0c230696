#include "analysis/verification.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "analysis/flanks.hpp"
#include "analysis/idle_efforts.hpp"
#include "analysis/loci.hpp"
#include "analysis/model.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/preload.hpp"
#include "analysis/request_limits.hpp"
#include "analysis/side_names.hpp"
#include "analysis/task_demands.hpp"
#include "clearloci/handed_files.hpp"
#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/group_closing.hpp"
#include "mechanism/notes.hpp"
#include "mechanism/read_task.hpp"
#include "mechanism/written_unit.hpp"

namespace clearloci {
namespace {

using core::InputError;
using mechanism::Mechanism;

bool is_spatial(const Mechanism& mechanism) { return mechanism.space == mechanism::Space::spatial; }

/// The tower answers over two lengths, but for loads that vary in space or press on teeth and belts, bounds of efforts
/// and what it does not move or scale.
bool is_asked_of_tower(const Mechanism& mechanism, const Task& task, TaskFit fit) {
  if (!mechanism::is_plane(mechanism) || !mechanism.groups.empty() || mechanism::has_effort_bounds(mechanism))
    return false;
  if (meshes(mechanism) && !task.loads_within.empty()) return false;
  if (is_spatial(mechanism) && (task.loads || !task.loads_within.empty() || task.pose_error)) return false;
  return fit != TaskFit::largest && (fit == TaskFit::none || !is_tolerant(task));
}

/// What is not answered, and why: the one place.
void require_answerable(const Mechanism& mechanism, const Task& task, const VerifyRequest& request) {
  const auto refuse = [&](const std::string& what, const std::string& mend) {
    throw InputError({task.file}, what, mend);
  };
  if (request.loci.all_working_modes || request.loci.working_modes.size() > 1)
    throw InputError({.file = "--working-mode"}, "a task is verified in one working mode",
                     "give one side for each dyad");
  if (!task.pose_error) return;
  mechanism::require_closed_forms(mechanism, "pose_error is proven", "leave it out");
  if (request.fit != TaskFit::none)
    refuse("--fit does not move tasks with a pose_error", "leave out --fit, or the pose_error");
}

}  // namespace

std::string limit_at(const Mechanism& mechanism, const numeric::NumericModel& model, std::span<const double> at,
                     const DyadSides& sides, double passes) {
  const std::optional<numeric::LimitEnd> end = numeric::tightest_limit(model, at, sides);
  if (end && end->slack <= passes) return mechanism::words_of_end(mechanism, end->limit, end->upper);
  const auto unmet = numeric::bounded_numerators(model, at, sides).unmet;
  return unmet ? mechanism::words_of_mesh(mechanism.joints[static_cast<std::size_t>(*unmet)]) : std::string();
}

core::WitnessLoad load_at(const numeric::Posture& posture, std::size_t load, const Mechanism& mechanism) {
  const auto& at = posture.loads[load];
  if (mechanism.space == mechanism::Space::planar) return {load, {at.force[0], at.force[1]}, {at.couple[2]}};
  return {load, {at.force.begin(), at.force.end()}, {at.couple.begin(), at.couple.end()}};
}

double widest_margin(const mechanism::Mechanism& mechanism, double margin, const loci::pose::PoseMetric* metric) {
  for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c) {
    if (metric != nullptr && !metric->grows[c]) continue;
    const double side = core::to_double(mechanism.coordinates[c].upper - mechanism.coordinates[c].lower);
    margin += metric == nullptr ? side : metric->weights[c] * side;
  }
  return margin;
}

core::OpenTask open_part(const loci::CoverProof& proof) {
  using Reason = core::OpenTask::Reason;
  return {proof.open, proof.lower, proof.upper,
          proof.cost.out_of_time    ? Reason::time
          : proof.cost.out_of_cells ? Reason::cells
                                    : Reason::doubles};
}

core::OpenTask open_part(const loci::CoverProof& proof, const WidenedTask& widened) {
  core::OpenTask open = open_part(proof);
  open.lower = widened.pose_of(open.lower);
  open.upper = widened.pose_of(open.upper);
  return open;
}

core::TaskWitness told_failure(const Mechanism& mechanism, const numeric::NumericModel& model, std::vector<double> at,
                               const DyadSides& sides, const numeric::TaskFailure& failure) {
  using Kind = numeric::TaskFailure::Kind;
  using Told = core::TaskWitness::Kind;
  core::TaskWitness told;
  told.at = std::move(at);
  const std::vector<core::Vanishing> reaction = {{failure.demand.joint, failure.demand.quantity, 1}};
  switch (failure.kind) {
    case Kind::unreachable:
    case Kind::boundary:
      told.kind = failure.kind == Kind::boundary ? Told::boundary : Told::unreachable;
      told.limit = limit_at(mechanism, model, told.at, sides);
      break;
    case Kind::singular:
      told.kind = Told::singular;
      break;
    case Kind::vanishing:
      told.kind = Told::vanishing;
      told.vanishing = reaction;
      break;
    case Kind::too_small:
      told.kind = Told::too_small;
      told.too_small = reaction;
      told.size = failure.size;
      told.least = failure.demand.least;
      break;
    case Kind::beyond_bound:
      told.kind = Told::beyond_bound;
      told.beyond_bound = reaction;
      told.size = failure.size;
      (failure.demand.bound->side > 0 ? told.least : told.most) = failure.demand.bound->at;
      break;
  }
  return told;
}

namespace {

/// Whether a place that was found is better than another one, for what is looked for.
bool is_better(const Verification& a, const Verification& b, TaskFit fit) {
  if (a.verified() != b.verified()) return a.verified();
  if (fit == TaskFit::best) return a.margin.value_or(0) > b.margin.value_or(0);
  if (fit == TaskFit::largest) return a.scaled_by.value_or(0) > b.scaled_by.value_or(0);
  const auto way = [](const Verification& verification) {
    double square = 0;
    for (std::size_t c = 0; verification.moved_by && c < verification.moved_by->size(); ++c)
      square += std::pow(
          core::to_double((*verification.moved_by)[c]) * (verification.angles[c] && verification.task.angle_length
                                                              ? core::to_double(*verification.task.angle_length)
                                                              : 1),
          2);
    return square;
  };
  return way(a) < way(b);
}

/// Of a task that asks for a least size of reactions that bear nothing in any pose: it fails at each of its poses.
std::optional<Verification> refuted_as_unloaded(const Mechanism& mechanism, const Task& task,
                                                const VerifyRequest& request) {
  const LociRequest asked = request_of(task, request.loci);
  std::vector<TaskDemand> demands = demands_of(mechanism, asked);
  std::erase_if(demands, [](const TaskDemand& demand) { return demand.least == 0; });
  if (demands.empty()) return std::nullopt;
  const DyadSides sides = requested_modes(mechanism, asked).front();
  // One design and one of the loads are enough.
  Task nominal = task;
  nominal.tolerances.clear();
  nominal.loads_within.clear();
  const WidenedTask widened(mechanism, nominal);
  const std::vector<std::vector<double>> poses =
      mechanism::is_plane(mechanism)
          ? usual_poses(loci::TaskRegion(task.shape))
          : loci::pose::PoseRegion(task.shape, widened.metric(mechanism, nominal), widened.beside()).samples();
  std::vector<numeric::NumericModel> models;
  for (const Mechanism& loaded : widened.loads()) models.push_back(numeric::compile(loaded));
  const auto at = std::find_if(poses.begin(), poses.end(), [&](const std::vector<double>& pose) {
    return numeric::reachable(models.front(), pose, sides);
  });
  if (at == poses.end()) return std::nullopt;
  for (numeric::NumericModel& other : models_beside_efforts(widened.loads().front()))
    models.push_back(std::move(other));
  const std::vector<Loaded> known = loads_of_demands(models, sides, demands, poses);
  core::TaskWitness witness;
  for (std::size_t d = 0; d < demands.size(); ++d) {
    if (known[d] != Loaded::never || (witness.least && *witness.least != demands[d].least)) continue;
    witness.least = demands[d].least;
    witness.too_small.push_back({demands[d].joint, demands[d].quantity, 1});
  }
  if (witness.too_small.empty()) return std::nullopt;
  witness.kind = core::TaskWitness::Kind::too_small;
  witness.at = *at;
  if (task.loads) witness.load = load_between(*task.loads, 0);
  Verification result;
  result.task = task;
  result.verdict = core::Verdict::refuted;
  result.witness = std::move(witness);
  result.notes = mechanism::notes_of(mechanism);
  if (!mechanism::is_plane(mechanism)) return result;
  result.map.loci = empty_map(mechanism);
  result.mode = mode_of(sides, result.map.loci.tower);
  return result;
}

Verification answered(const Mechanism& mechanism, const Task& task, const VerifyRequest& request) {
  std::optional<Verification> unloaded = refuted_as_unloaded(mechanism, task, request);
  Verification result = unloaded ? std::move(*unloaded)
                        : is_asked_of_tower(mechanism, task, request.fit)
                            ? verify_by_tower(mechanism, task, request)
                            : verify_by_statics(mechanism::with_bounded_belts(mechanism), task, request);
  tell_mechanism(mechanism, request, result);
  return result;
}

Verification verified_in(const Mechanism& mechanism, const Task& task, const VerifyRequest& request) {
  Verification result = answered(mechanism, task, request);
  if (request.fit != TaskFit::best || !result.moved_by) return result;
  // Places are compared by their clearance within the ranges of the workspace, which a margin may leave.
  VerifyRequest unmoved = request;
  unmoved.fit = TaskFit::none;
  Verification here = answered(mechanism, task, unmoved);
  if (!is_better(here, result, request.fit)) return result;
  here.moved_by = core::RationalPose(mechanism.coordinates.size());
  return here;
}

/// A place on any flank, where none is asked for: the teeth push all over it.
Verification placed_on_flanks(Mechanism mechanism, const Task& task, VerifyRequest request) {
  const bool by_tower = is_asked_of_tower(mechanism, task, request.fit);
  // The tower ends where teeth would have to pull; statics is told so. No effort that a file can ask for is larger.
  constexpr long largest = 1'000'000'000'000'000;
  for (mechanism::Joint& joint : mechanism.joints)
    if (!by_tower && has_teeth(joint)) joint.within = {0, largest};
  std::vector<DyadSides> modes = requested_modes(mechanism, request.loci);
  if (request.loci.working_modes.empty()) modes = modes_of_flanks(mechanism, modes.front());
  std::optional<Verification> best;
  for (const DyadSides& sides : modes) {
    request.loci.working_modes = {sides};
    Verification verification = verified_in(mechanism, task, request);
    if (!best || is_better(verification, *best, request.fit)) best = std::move(verification);
  }
  return std::move(*best);
}

/// With gears a task is verified on the flanks that bear in it: no teeth change theirs between two of its poses, or
/// under two of its loads.
VerifyRequest on_flanks(const Mechanism& mechanism, const Task& task, VerifyRequest request) {
  if (std::none_of(mechanism.joints.begin(), mechanism.joints.end(), has_teeth)) return request;
  const DyadSides sides = requested_modes(mechanism, request.loci).front(),
                  bearing = sides_that_push(mechanism, task, sides);
  if (!request.loci.working_modes.empty() && bearing != sides)
    throw InputError({.file = "--working-mode"},
                     "in this working mode the teeth of a gear would have to pull in the task",
                     "leave it out, or ask for the other flank");
  request.loci.working_modes = {bearing};
  return request;
}

bool depends_on(const core::Expression& expression, const std::string& parameter, const Mechanism& mechanism) {
  const std::set<std::string> all = core::symbols(expression);
  return all.contains(parameter) ||
         std::any_of(mechanism.parameters.begin(), mechanism.parameters.end(), [&](const mechanism::Parameter& other) {
           return all.contains(other.name) && depends_on(other.expression, parameter, mechanism);
         });
}

void refuse_tolerances_of_belts(const Mechanism& mechanism, const Task& task) {
  for (const core::Tolerance& tolerance : task.tolerances)
    for (const mechanism::Joint& joint : mechanism.joints)
      if (joint.meshing && !has_teeth(joint) && depends_on(joint.meshing->most, tolerance.parameter, mechanism))
        throw InputError({task.file},
                         "what belt " + joint.name + " carries before a span is slack depends on " +
                             tolerance.parameter + ", which has a tolerance",
                         "leave this tolerance out, and verify the task with both of its ends");
}

}  // namespace

void tell_mechanism(const Mechanism& mechanism, const VerifyRequest& request, Verification& result) {
  result.mechanism = mechanism.name;
  result.parameters = mechanism::told_parameters(mechanism);
  // A free effort without a value is part of the question.
  for (const mechanism::Joint& joint : mechanism.joints)
    if (joint.free_effort && !joint.free_effort->given)
      std::erase_if(result.parameters,
                    [&](const auto& parameter) { return parameter.first == joint.free_effort->parameter; });
  result.units = mechanism.units;
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
    result.coordinates.push_back(coordinate.name);
    result.angles.push_back(coordinate.angle);
  }
  result.working_mode = side_names(mechanism, requested_modes(mechanism, request.loci).front());
}

Verification verify(const Model& model, const Task& task, const VerifyRequest& asked) {
  const Mechanism& mechanism = model.content().mechanism;
  check_request(mechanism, asked.loci);
  const bool placed =
      asked.fit != TaskFit::none && std::any_of(mechanism.joints.begin(), mechanism.joints.end(), has_teeth);
  const VerifyRequest request = placed ? asked : on_flanks(mechanism, task, asked);
  refuse_tolerances_of_belts(mechanism, task);
  check_task(mechanism, task);
  require_answerable(mechanism, task, request);
  if (!task.preload.empty()) return verify_preloaded(model, task, request);
  if (!mechanism::joints_without_preload(mechanism).empty()) return verify_with_preload(model, task, request);
  return placed ? placed_on_flanks(mechanism, task, request) : verified_in(mechanism, task, request);
}

Task read_task(const std::string& path, const Model& model) {
  return mechanism::read_task(path, model.content().mechanism);
}

Task parse_task(const std::string& text, const Model& model, const std::string& file) {
  return mechanism::parse_task(text, file, model.content().mechanism);
}

Task parse_task(const std::string& text, const Model& model, const HandedFiles& handed, const std::string& file) {
  return mechanism::parse_task(text, file, model.content().mechanism, &handed);
}

}  // namespace clearloci
