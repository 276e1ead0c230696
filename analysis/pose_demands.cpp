#include "analysis/pose_demands.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/idle_efforts.hpp"
#include "core/unloaded_words.hpp"
#include "numeric/task_witness.hpp"
#include "symbolic/unloaded_reactions.hpp"

namespace clearloci {

using core::Quantity;
using core::TaskDemand;

namespace {

std::vector<bool> unloaded_under_all(const std::vector<numeric::NumericModel>& models,
                                     const std::vector<TaskDemand>& demands) {
  std::vector<const mechanism::Mechanism*> loads;
  for (const numeric::NumericModel& model : models) loads.push_back(&model.mechanism);
  return symbolic::unloaded_reactions(loads, demands);
}

/// What is left out: joints by their contacts, the others by the reaction.
struct LeftOut {
  std::vector<std::string> joints, reactions;

  void add(const TaskDemand& demand) {
    const bool effort = demand.quantity == Quantity::M || demand.quantity == Quantity::F;
    std::vector<std::string>& names = effort ? reactions : joints;
    const std::string name = effort ? core::to_string(demand.quantity) + "_" + demand.joint : demand.joint;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }

  /// `known`: behind what is said of joints, and of a reaction.
  void tell(const std::string& known, std::vector<std::string>& notes) const {
    if (!joints.empty()) notes.push_back(core::unloaded_note(joints) + known);
    for (const std::string& name : reactions) notes.push_back(name + core::unloaded_words + known);
  }
};

}  // namespace

std::vector<Loaded> loads_of_demands(const std::vector<numeric::NumericModel>& models, const std::vector<int>& sides,
                                     const std::vector<TaskDemand>& demands,
                                     const std::vector<std::vector<double>>& poses) {
  numeric::WitnessLoads loads;
  for (const numeric::NumericModel& model : models) loads.ends.push_back(&model);
  const numeric::TaskWitness all(loads, sides, demands, poses, numeric::TaskWitness::Rounding::of_coordinates);
  using Found = numeric::TaskWitness::Loaded;
  std::vector<Loaded> result;
  std::optional<std::vector<bool>> unloaded;  // asked for where rounding does not tell
  for (std::size_t d = 0; d < demands.size(); ++d) {
    const Found found = demands[d].bound ? Found::sometimes : all.is_loaded(static_cast<int>(d), poses);
    if (found != Found::sometimes && !unloaded) unloaded = unloaded_under_all(models, demands);
    result.push_back(found == Found::sometimes ? Loaded::sometimes
                     : (*unloaded)[d]          ? Loaded::never
                     : found == Found::never   ? Loaded::never_to_rounding
                                               : Loaded::perhaps);
  }
  return result;
}

std::vector<TaskDemand> loaded_demands(const std::vector<numeric::NumericModel>& models, const std::vector<int>& sides,
                                       std::vector<TaskDemand> demands, const std::vector<std::vector<double>>& poses,
                                       std::vector<std::string>& notes, LeastSizes least) {
  const std::vector<Loaded> known = loads_of_demands(models, sides, demands, poses);
  std::vector<TaskDemand> loaded;
  LeftOut proven, rounded;
  bool unmet = false;
  for (std::size_t d = 0; d < demands.size(); ++d) {
    const bool stays = demands[d].least > 0 && least == LeastSizes::stay;
    if (stays || !bears_nothing(known[d])) {
      loaded.push_back(std::move(demands[d]));
      continue;
    }
    unmet = unmet || demands[d].least > 0;
    (known[d] == Loaded::never ? proven : rounded).add(demands[d]);
  }
  const std::string left_out = unmet ? core::no_least_size_words : "";
  proven.tell(left_out, notes);
  rounded.tell(" (zero within rounding errors at every computed pose)" + left_out, notes);
  return loaded;
}

std::vector<bool> loaded_beside_efforts(const mechanism::Mechanism& mechanism, const std::vector<int>& sides,
                                        const std::vector<TaskDemand>& demands,
                                        const std::vector<std::vector<double>>& poses) {
  const std::vector<numeric::NumericModel> models = models_beside_efforts(mechanism);
  if (models.empty()) return {};
  const auto is_told = [](const numeric::Bounded& value) { return std::abs(value.value) > value.error; };
  std::vector<bool> loaded(demands.size(), false);
  for (const std::vector<double>& pose : poses)
    for (const numeric::NumericModel& model : models) {
      const numeric::BoundedNumerators numerators = numeric::bounded_numerators(model, pose, sides);
      if (!numerators.reachable || !is_told(numerators.determinant)) continue;
      for (std::size_t d = 0; d < demands.size(); ++d) {
        if (loaded[d] || demands[d].bound) continue;
        const std::vector<numeric::Bounded> parts = numeric::demanded_parts(model, demands[d], numerators);
        loaded[d] = std::any_of(parts.begin(), parts.end(), is_told);
      }
    }
  return loaded;
}

std::vector<core::Vanishing> too_small_at(const numeric::NumericModel& model, const std::vector<TaskDemand>& demands,
                                          const std::vector<double>& pose, const std::vector<int>& sides) {
  std::vector<core::Vanishing> small;
  if (std::none_of(demands.begin(), demands.end(), [](const TaskDemand& demand) { return demand.least > 0; }))
    return {};
  const numeric::BoundedNumerators numerators = numeric::bounded_numerators(model, pose, sides);
  if (!numerators.reachable) return {};
  for (const TaskDemand& demand : demands) {
    double size = 0;
    for (const numeric::Bounded& part : numeric::demanded_parts(model, demand, numerators))
      size = std::hypot(size, part.value);
    if (size < core::to_double(demand.least) * std::abs(numerators.determinant.value))
      small.push_back({demand.joint, demand.quantity, 1});
  }
  return small;
}

core::LocusKind locus_kind_of(const TaskDemand& demand) {
  if (demand.bound) return core::LocusKind::preload;
  if (demand.least > 0) return core::LocusKind::margin;
  const bool effort = demand.quantity == Quantity::M || demand.quantity == Quantity::F;
  return effort ? core::LocusKind::backlash : core::LocusKind::contact_loss;
}

}  // namespace clearloci
