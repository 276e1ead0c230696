#include "analysis/design_task.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/pose_demands.hpp"
#include "analysis/take_ups.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/verification.hpp"
#include "core/enclosure.hpp"
#include "core/errors.hpp"
#include "mechanism/read_task.hpp"
#include "symbolic/task_conditions.hpp"

namespace clearloci {
namespace {

using core::Quantity;
using core::Rational;
using core::TaskDemand;
using mechanism::Mechanism;
using mechanism::ParameterRange;

/// What is left open: what varies, then what has a tolerance besides, each with all it may be.
std::vector<ParameterRange> opened(const Mechanism& mechanism, std::vector<ParameterRange> ranges,
                                   const core::Task& task) {
  for (const core::Tolerance& tolerance : task.tolerances) {
    const auto found = std::find_if(ranges.begin(), ranges.end(),
                                    [&](const ParameterRange& r) { return r.name == tolerance.parameter; });
    if (found == ranges.end()) {
      const mechanism::Parameter* parameter = mechanism::parameter_named(mechanism, tolerance.parameter);
      if (parameter == nullptr)
        throw core::InputError({task.file}, "there is no parameter '" + tolerance.parameter + "' in " + mechanism.file,
                               "give tolerances to parameters of the mechanism file");
      ranges.push_back({parameter->name, parameter->value + tolerance.below, parameter->value + tolerance.above});
    } else {
      found->lower += tolerance.below;
      found->upper += tolerance.above;
    }
  }
  return ranges;
}

std::vector<Mechanism> unit_loads(const Mechanism& open, const core::Task& task, std::vector<core::LoadBall>& balls) {
  std::vector<Mechanism> directions;
  for (const core::LoadWithin& within : task.loads_within) {
    const auto add = [&](int fx, int fy, int couple) {
      Mechanism bare = unloaded(open);
      mechanism::Load load = open.loads[within.load];
      load.force.clear();
      load.force_vector.reset();
      load.couple_vector.clear();
      if (fx != 0 || fy != 0) load.force = {core::Expression::number(fx), core::Expression::number(fy)};
      load.couple = core::Expression::number(couple);
      bare.loads = {load};
      directions.push_back(std::move(bare));
    };
    // Radii are rounded up: more loads than asked for.
    const auto add_ball = [&](const core::Rational& radius, std::size_t count) {
      balls.push_back({directions.size(), count, std::nextafter(core::to_double(radius), 1e300)});
    };
    if (within.force > 0) {
      add_ball(within.force, 2);
      add(1, 0, 0);
      add(0, 1, 0);
    }
    if (within.couple > 0) {
      add_ball(within.couple, 1);
      add(0, 0, 1);
    }
  }
  return directions;
}

std::string joints_of(const core::TaskCondition& condition) {
  std::string names;
  for (const core::Vanishing& vanishing : condition.reactions) names += (names.empty() ? "" : ", ") + vanishing.joint;
  return names;
}

bool is_effort(Quantity quantity) { return quantity == Quantity::M || quantity == Quantity::F; }

}  // namespace

void require_asked_of_designs(const Mechanism& mechanism, const core::Task& task) {
  const auto refuse = [&](const std::string& what, const std::string& mend) {
    throw core::InputError({task.file}, what, mend);
  };
  const bool spatial = mechanism.space == mechanism::Space::spatial;
  if (!mechanism::is_plane(mechanism))
    refuse("designs are judged for tasks in the plane of two lengths", "make the other coordinates parameters");
  if (mechanism::has_effort_bounds(mechanism))
    refuse("designs are judged without bounds of efforts, and " + mechanism.file + " has some",
           "leave out the within of its motors");
  if (spatial && task.loads)
    refuse("loads_from turns in space, and designs are judged under loads of the plane", "leave it out");
  if (spatial && !task.loads_within.empty())
    refuse("loads_within are loads of the plane, and " + mechanism.file + " is spatial",
           "leave it out and verify the task once for every load");
  if (spatial && task.pose_error)
    refuse("pose_error is proven in the plane, and " + mechanism.file + " is spatial", "leave it out");
}

namespace {

const Mechanism& checked(const Mechanism& mechanism, const core::Task& task) {
  require_asked_of_designs(mechanism, task);
  return mechanism;
}

}  // namespace

DesignTask::DesignTask(const Mechanism& mechanism, const std::vector<ParameterRange>& vary, const core::Task& task,
                       const LociRequest& request)
    : mechanism_(checked(mechanism, task)),
      vary_(vary),
      task_(task),
      request_(request_of(task, request)),
      open_(mechanism::open_design(mechanism, opened(mechanism, vary, task))),
      loads_(under_loads_of(task, open_.mechanism)),
      directions_(unit_loads(open_.mechanism, task, balls_)),
      sides_(requested_modes(mechanism, request_).front()),
      demands_(demands_of(open_.mechanism, request_)),
      conditions_(conditions_for(
          demands_, task.pose_error.has_value(),
          loaded_beside_efforts(mechanism, sides_, demands_, usual_poses(loci::TaskRegion(task.shape))))),
      mode_(mode_of(sides_, names_of(conditions_.tower))),
      region_(task.shape),
      margin_(core::to_double(task.margin)) {}

core::TaskConditions DesignTask::conditions_for(const std::vector<TaskDemand>& demands, bool take_ups,
                                                const std::vector<bool>& always) const {
  std::vector<const Mechanism*> loads, directions;
  for (const Mechanism& mechanism : loads_) loads.push_back(&mechanism);
  for (const Mechanism& mechanism : directions_) directions.push_back(&mechanism);
  if (!take_ups) return symbolic::task_conditions(loads, demands, directions, {}, always);
  const std::vector<Mechanism> unit = under_unit_forces(open_.mechanism);
  return symbolic::task_conditions(loads, demands, directions, {take_up_demands(open_.mechanism), {&unit[0], &unit[1]}},
                                   always);
}

std::vector<TaskDemand> DesignTask::demands() const {
  std::vector<TaskDemand> demands = demands_;
  for (const TaskDemand& never : conditions_.never_loaded)
    std::erase_if(demands, [&](const TaskDemand& demand) {
      return demand.joint == never.joint && demand.quantity == never.quantity;
    });
  return demands;
}

std::optional<loci::DesignBox> DesignTask::box(const std::vector<ExactRange>& values) const {
  core::ensure(values.size() == vary_.size(), "a range for every parameter that varies");
  Ranges nominal;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < values.size(); ++i) {
    nominal[vary_[i].name] = range_of(values[i].first, values[i].second);
    names.push_back(vary_[i].name);
  }
  Ranges ranges = nominal;
  for (const core::Tolerance& tolerance : task_.tolerances) {
    const auto varied = std::find(names.begin(), names.end(), tolerance.parameter);
    if (varied != names.end()) {
      const ExactRange& range = values[static_cast<std::size_t>(varied - names.begin())];
      ranges[tolerance.parameter] = range_of(range.first + tolerance.below, range.second + tolerance.above);
    } else {  // around the value that the file computes for each design
      const core::Expression varied_expression =
          mechanism::in_varied(core::Expression::symbol(tolerance.parameter), mechanism_, names);
      ranges[tolerance.parameter] = enclosure(varied_expression, nominal) + range_of(tolerance.below, tolerance.above);
    }
  }
  for (const core::Expression& length : open_.lengths)
    if (!(enclosure(length, ranges).lower() > 0)) return std::nullopt;
  loci::DesignBox box;
  for (const std::string& name : open_.varied) box.push_back(ranges.at(name));
  return box;
}

loci::DesignVariables DesignTask::variables() const {
  loci::DesignVariables variables;
  for (const mechanism::DesignVariable& variable : open_.variables) {
    const std::set<std::string> names = core::symbols(variable.meaning);
    std::vector<std::size_t>& list = variables.parameters.emplace_back();
    for (std::size_t p = 0; p < open_.varied.size(); ++p)
      if (names.contains(open_.varied[p])) list.push_back(p);
  }
  variables.enclosure = [this](std::size_t v, const loci::DesignBox& parameters) {
    const core::Expression& meaning = open_.variables[v].meaning;
    if (meaning.kind() == core::Expression::Kind::symbol)
      for (std::size_t p = 0; p < open_.varied.size(); ++p)
        if (open_.varied[p] == meaning.name()) return parameters[p];
    Ranges ranges;
    for (std::size_t p = 0; p < open_.varied.size(); ++p) ranges[open_.varied[p]] = parameters[p];
    return enclosure(meaning, ranges);
  };
  return variables;
}

std::unique_ptr<loci::DesignJudge> DesignTask::judge() const {
  loci::DesignClearances clearances = design_clearances(open_, conditions_);
  if (task_.pose_error) clearances.most_displaced = std::nextafter(core::to_double(*task_.pose_error), 0.0);
  return std::make_unique<loci::DesignJudge>(conditions_, mode_, region_, variables(), balls_, std::move(clearances));
}

const DesignTask::Measured& DesignTask::measured() const {
  const std::lock_guard lock(mutex_);
  if (measured_) return *measured_;
  Measured figures;
  // A least size that anything has: conditions then say what sizes are. What a least force is not asked of, such as a
  // guide whose ends are not known, is not measured.
  LociRequest sized = request_;
  sized.min_force = sized.min_couple = 1;
  std::vector<TaskDemand> demands = demands_of(open_.mechanism, sized);
  std::erase_if(demands, [](const TaskDemand& demand) { return demand.least == 0; });
  const auto is_among = [&](const core::Vanishing& reaction) {
    return std::any_of(demands.begin(), demands.end(), [&](const TaskDemand& demand) {
      return demand.joint == reaction.joint && demand.quantity == reaction.quantity;
    });
  };
  // Efforts are those of all actuators, whatever reactions are asked for.
  std::vector<TaskDemand> all = demands;
  for (const mechanism::Joint& joint : open_.mechanism.joints) {
    if (!joint.actuated) continue;
    const Quantity effort = mechanism::actuator_quantity(joint);
    if (!is_among({joint.name, effort})) all.push_back({joint.name, effort, 1});
  }
  figures.conditions = conditions_for(all, mechanism_.space == mechanism::Space::planar);
  figures.mode = mode_of(sides_, names_of(figures.conditions.tower));
  for (std::size_t i = 0; i < figures.conditions.conditions.size(); ++i) {
    const core::TaskCondition& condition = figures.conditions.conditions[i];
    if (condition.denominator < 0) continue;
    const Quantity quantity = condition.reactions.front().quantity;
    // What a linear drive exerts is both.
    if (is_effort(quantity)) figures.efforts.push_back(static_cast<int>(i));
    if (quantity != Quantity::M && std::any_of(condition.reactions.begin(), condition.reactions.end(), is_among))
      figures.forces.push_back(static_cast<int>(i));
  }
  measured_ = std::move(figures);
  return *measured_;
}

std::unique_ptr<loci::DesignJudge> DesignTask::measure() const {
  const Measured& figures = measured();
  return std::make_unique<loci::DesignJudge>(figures.conditions, figures.mode, region_, variables(), balls_,
                                             design_clearances(open_, figures.conditions));
}

std::vector<int> DesignTask::forces() const { return measured().forces; }
std::vector<int> DesignTask::efforts() const { return measured().efforts; }

std::string DesignTask::reason(const loci::DesignFailure& failure) const {
  using Kind = loci::DesignFailure::Kind;
  const std::string where = region_.signed_distance(failure.at) > 1e-12 ? "margin: " : "";
  if (failure.kind == Kind::unreachable) return where + "workspace";
  if (failure.kind == Kind::displaced) return where + "pose_error";
  if (failure.kind == Kind::singular || failure.condition < 0) return where + "singularity";
  const core::TaskCondition& condition = conditions_.conditions[static_cast<std::size_t>(failure.condition)];
  const bool effort = is_effort(condition.reactions.front().quantity);
  if (failure.kind == Kind::too_small && condition.least > 0)
    return where + (condition.reactions.front().quantity == Quantity::M ? "min_couple in " : "min_force in ") +
           joints_of(condition);
  return where + (effort ? "backlash in " : "contact lost in ") + joints_of(condition);
}

}  // namespace clearloci
