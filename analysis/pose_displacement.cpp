#include "analysis/pose_displacement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/take_ups.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/verification.hpp"
#include "numeric/pose_error.hpp"
#include "symbolic/pose_statics.hpp"
#include "symbolic/unloaded_reactions.hpp"

namespace clearloci {
namespace {

using loci::pose::PoseDisplacement;
using loci::pose::PoseTakeUp;

/// To how much of itself the bound is proven, and the cells that this may take.
constexpr double accuracy = 0.02;
constexpr long most_cells = 200'000;
/// Of a size that is solved in floating point.
constexpr double rounding_of_pose_errors = 1e-9;

/// The equations under the loads and under the unit forces, with the reactions that take up clearances.
struct Displaced {
  core::PoseStatics statics;
  std::vector<PoseTakeUp> take_ups;
  bool has_clearance = false;
};

Displaced displaced_by(const WidenedTask& widened, const DyadSides& sides) {
  const std::vector<mechanism::Mechanism> unit = under_unit_forces(widened.loads().front());
  std::vector<const mechanism::Mechanism*> list;
  for (const mechanism::Mechanism& mechanism : widened.loads()) list.push_back(&mechanism);
  for (const mechanism::Mechanism& mechanism : unit) list.push_back(&mechanism);
  std::vector<core::TaskDemand> demands;
  for (core::TaskDemand& demand : take_up_demands(widened.loads().front()))
    if (widened.clearance({demand.joint, demand.quantity, 1}).upper() > 0) demands.push_back(std::move(demand));
  // Where a joint bears nothing, its parts are anywhere in its clearance; where it bears nothing of a force on the end
  // effector either, that does not move the end effector.
  const std::vector<bool> idle = symbolic::unloaded_reactions(list, demands);
  std::size_t next = 0;
  std::erase_if(demands, [&](const core::TaskDemand&) { return idle[next++]; });
  Displaced result{symbolic::pose_statics(list, sides, demands, symbolic::ForceParts::cartesian), {}, !idle.empty()};
  for (core::PoseDemand& demand : std::exchange(result.statics.demands, {})) {
    const core::Interval clearance = widened.clearance({demand.demand.joint, demand.demand.quantity, 1});
    result.take_ups.push_back({std::move(demand.components), {clearance.lower(), clearance.upper()}});
  }
  return result;
}

/// Where the numeric solution confirms that it is displaced too far.
std::optional<core::TaskWitness> confirmed(const core::Task& task, const WidenedTask& widened, const DyadSides& sides,
                                           const loci::pose::PoseRegion& region, const PoseDisplacement& found) {
  const std::vector<double> at = widened.settled(found.at);
  if (!(region.distance(at) <= core::to_double(task.margin) + region.hair())) return std::nullopt;
  const numeric::NumericModel model = numeric::compile(widened.at_place(at, found.load));
  const numeric::Posture posture = numeric::posture(model, at, sides);
  if (!posture.reachable()) return std::nullopt;
  const double size = numeric::pose_accuracy(model, posture).least_distance;
  if (!(size > core::to_double(*task.pose_error) * (1 + rounding_of_pose_errors))) return std::nullopt;
  core::TaskWitness told;
  told.kind = core::TaskWitness::Kind::displaced;
  told.at = widened.pose_of(at);
  told.distance = region.distance(at);
  told.size = size;
  told.most = task.pose_error;
  told.design = widened.design(at);
  if (task.loads) told.load = load_between(*task.loads, found.load);
  for (const core::LoadWithin& within : task.loads_within)
    told.loads.push_back(load_at(posture, within.load, model.mechanism));
  return told;
}

}  // namespace

void judge_displacement(const mechanism::Mechanism& mechanism, const core::Task& task, const WidenedTask& widened,
                        const DyadSides& sides, const loci::pose::PoseRegion& region,
                        std::optional<std::chrono::steady_clock::time_point> deadline, Verification& result) {
  const Displaced displaced = displaced_by(widened, sides);
  if (!displaced.has_clearance)
    throw core::InputError({mechanism.file}, "no joint has a clearance, so there is no pose error",
                           "write such as clearance: {radial: 10e-6} at a joint, or leave pose_error out");
  const double allowed = std::nextafter(core::to_double(*task.pose_error), 0.0);
  const PoseDisplacement found = loci::pose::most_displaced(
      displaced.statics, widened.loads().size(), displaced.take_ups, region, core::to_double(task.margin), allowed,
      accuracy, {.most_cells = most_cells, .deadline = deadline});
  result.cells += found.proof.cost.cells;
  if (found.most <= allowed) {
    result.pose_error = found.most;
    return;
  }
  if (found.met > allowed) result.witness = confirmed(task, widened, sides, region, found);
  result.verdict = result.witness ? core::Verdict::refuted : core::Verdict::undecided;
  if (!result.witness) result.open = open_part(found.proof, widened);
}

}  // namespace clearloci
