#include "analysis/pose_demands.hpp"

#include "analysis/idle_efforts.hpp"
#include "numeric/task_witness.hpp"

namespace clearloci {

using core::Quantity;
using core::TaskDemand;

namespace {

/// One a demand: it is for no least size nor a bound, and zero at every pose, to rounding.
std::vector<bool> are_never_loaded(const std::vector<numeric::NumericModel>& models, const std::vector<int>& sides,
                                   const std::vector<TaskDemand>& demands,
                                   const std::vector<std::vector<double>>& poses) {
  numeric::WitnessLoads loads;
  for (const numeric::NumericModel& model : models) loads.ends.push_back(&model);
  const numeric::TaskWitness all(loads, sides, demands, poses, numeric::TaskWitness::Rounding::of_coordinates);
  std::vector<bool> never;
  for (std::size_t d = 0; d < demands.size(); ++d)
    never.push_back(demands[d].least == 0 && !demands[d].bound && all.is_never_loaded(static_cast<int>(d), poses));
  return never;
}

}  // namespace

std::vector<TaskDemand> loaded_demands(const std::vector<numeric::NumericModel>& models, const std::vector<int>& sides,
                                       std::vector<TaskDemand> demands, const std::vector<std::vector<double>>& poses,
                                       std::vector<std::string>& notes) {
  const std::vector<bool> never = are_never_loaded(models, sides, demands, poses);
  std::vector<TaskDemand> loaded;
  std::string names;
  for (std::size_t d = 0; d < demands.size(); ++d) {
    if (!never[d])
      loaded.push_back(std::move(demands[d]));
    else
      names += (names.empty() ? "" : ", ") + core::to_string(demands[d].quantity) + "_" + demands[d].joint;
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
  std::vector<bool> loaded = are_never_loaded(models, sides, demands, poses);
  loaded.flip();
  return loaded;
}

core::LocusKind locus_kind_of(const TaskDemand& demand) {
  if (demand.least > 0 || demand.bound) return core::LocusKind::margin;
  const bool effort = demand.quantity == Quantity::M || demand.quantity == Quantity::F;
  return effort ? core::LocusKind::backlash : core::LocusKind::contact_loss;
}

}  // namespace clearloci
