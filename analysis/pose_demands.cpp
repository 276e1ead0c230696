#include "analysis/pose_demands.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/idle_efforts.hpp"
#include "numeric/task_witness.hpp"
#include "symbolic/unloaded_reactions.hpp"

namespace clearloci {

using core::Quantity;
using core::TaskDemand;

namespace {

/// Of every demand whether it is zero in every pose under all loads.
std::vector<bool> unloaded_under_all(const std::vector<numeric::NumericModel>& models,
                                     const std::vector<TaskDemand>& demands) {
  std::vector<bool> unloaded(demands.size(), true);
  for (const numeric::NumericModel& model : models) {
    const std::vector<bool> here = symbolic::unloaded_reactions(model.mechanism, demands);
    for (std::size_t d = 0; d < demands.size(); ++d) unloaded[d] = unloaded[d] && here[d];
  }
  return unloaded;
}

}  // namespace

std::vector<TaskDemand> loaded_demands(const std::vector<numeric::NumericModel>& models, const std::vector<int>& sides,
                                       std::vector<TaskDemand> demands, const std::vector<std::vector<double>>& poses,
                                       std::vector<std::string>& notes) {
  numeric::WitnessLoads loads;
  for (const numeric::NumericModel& model : models) loads.ends.push_back(&model);
  const numeric::TaskWitness all(loads, sides, demands, poses, numeric::TaskWitness::Rounding::of_coordinates);
  using Loaded = numeric::TaskWitness::Loaded;
  std::vector<TaskDemand> loaded;
  std::string names;
  std::vector<bool> unloaded;  // asked for where rounding leaves a doubt
  for (std::size_t d = 0; d < demands.size(); ++d) {
    const bool may_be_left = demands[d].least == 0 && !demands[d].bound;
    const Loaded found = may_be_left ? all.is_loaded(static_cast<int>(d), poses) : Loaded::sometimes;
    if (found == Loaded::perhaps && unloaded.empty()) unloaded = unloaded_under_all(models, all.demands());
    const std::string name = core::to_string(demands[d].quantity) + "_" + demands[d].joint;
    if (found == Loaded::never)
      names += (names.empty() ? "" : ", ") + name;
    else if (found == Loaded::perhaps && unloaded[d])
      notes.push_back(name + " is zero in every pose under these loads");
    else
      loaded.push_back(std::move(demands[d]));
  }
  if (!names.empty())
    notes.push_back(names + ": zero within rounding errors at every computed pose; treated as unloaded in every pose");
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

core::LocusKind locus_kind_of(const TaskDemand& demand) {
  if (demand.bound) return core::LocusKind::preload;
  if (demand.least > 0) return core::LocusKind::margin;
  const bool effort = demand.quantity == Quantity::M || demand.quantity == Quantity::F;
  return effort ? core::LocusKind::backlash : core::LocusKind::contact_loss;
}

}  // namespace clearloci
