#include "analysis/task_certificate.hpp"

#include <algorithm>

#include "analysis/flanks.hpp"
#include "analysis/idle_efforts.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/widened_task.hpp"
#include "core/errors.hpp"
#include "loci/tasks/tasks.hpp"
#include "mechanism/open_design.hpp"

namespace clearloci {

void require_certifiable(const core::Task& task) {
  const auto refuse = [](const std::string& what) {
    throw core::InputError({.file = "--certificate"}, "there is no certificate of " + what, "leave --certificate out");
  };
  if (task.pose_error) refuse("a task that bounds the pose error");
  if (std::holds_alternative<core::TaskMesh>(task.shape)) refuse("a mesh");
}

core::TaskCertificate certificate_of(const mechanism::Mechanism& mechanism, const core::Task& task,
                                     const LociRequest& asked) {
  const LociRequest request = request_of(task, asked);
  core::TaskCertificate certificate{
      {}, task, sides_that_push(mechanism, task, requested_modes(mechanism, request).front()), {}, {}};
  for (const mechanism::Coordinate& c : mechanism.coordinates) certificate.coordinates.push_back(c.name);
  for (const core::Tolerance& tolerance : task.tolerances) {
    const Rational& value = mechanism::parameter_named(mechanism, tolerance.parameter)->value;
    certificate.parameters.push_back({tolerance.parameter, value + tolerance.below, value + tolerance.above});
  }
  const WidenedTask widened(mechanism, task);
  const loci::pose::PoseRegion region(task.shape, widened.metric(mechanism, task), widened.beside());
  std::vector<numeric::NumericModel> models;
  const std::vector<mechanism::JointIndex> open = mechanism::joints_without_preload(mechanism);
  for (const mechanism::Mechanism& loaded : widened.loads())
    for (const int effort : {0, 1}) {
      mechanism::Mechanism given = loaded;
      for (const mechanism::JointIndex j : open) mechanism::give_effort(given, j, effort);
      if (effort == 0 || !open.empty()) models.push_back(numeric::compile(given));
    }
  for (numeric::NumericModel& beside : models_beside_efforts(widened.loads().front()))
    models.push_back(std::move(beside));
  std::vector<std::string> notes;
  certificate.demands =
      loaded_demands(models, certificate.sides, demands_of(mechanism, request), region.samples(), notes);
  // Bounds of efforts are the model's.
  std::erase_if(certificate.demands, [](const core::TaskDemand& demand) { return demand.bound.has_value(); });
  return certificate;
}

}  // namespace clearloci
