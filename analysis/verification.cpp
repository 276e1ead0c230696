#include "analysis/verification.hpp"

#include <algorithm>

#include "analysis/design_task.hpp"
#include "analysis/loci.hpp"
#include "analysis/model.hpp"
#include "analysis/request_limits.hpp"
#include "analysis/side_names.hpp"
#include "clearloci/handed_files.hpp"
#include "core/errors.hpp"
#include "mechanism/read_task.hpp"

namespace clearloci {
namespace {

using core::InputError;
using mechanism::Mechanism;

/// What is not answered, and why: the one place.
void require_answerable(const Mechanism& mechanism, const Task& task, const VerifyRequest& request) {
  const auto refuse = [&](const std::string& what, const std::string& mend) {
    throw InputError({task.file}, what, mend);
  };
  if (request.loci.all_working_modes || request.loci.working_modes.size() > 1)
    throw InputError({.file = "--working-mode"}, "a task is verified in one working mode",
                     "give one side for each dyad");
  const std::string asked = !task.tolerances.empty()     ? "tolerances are"
                            : !task.loads_within.empty() ? "loads_within are"
                            : task.pose_error            ? "pose_error is"
                                                         : "";
  if (!is_asked_of_tower(mechanism, task)) {
    const bool plane = mechanism::is_plane(mechanism);
    if (!asked.empty())
      refuse(asked + (plane ? " not asked together with loads_from in space"
                            : " asked of tasks in the plane of two lengths"),
             plane ? "leave one of them out" : "leave it out, or make the other coordinates parameters");
    if (std::holds_alternative<core::TaskPolygon>(task.shape))
      refuse(plane ? "loads_from is not asked of polygons in space" : "a polygon is asked of the plane of two lengths",
             "write a box, a ball or a path");
    return;
  }
  if (!asked.empty()) require_asked_of_designs(mechanism, task);
  if (request.fit == TaskFit::largest)
    refuse("the largest scale is looked for over other than two lengths", "choose from nearest, best");
  if (request.fit != TaskFit::none && !asked.empty())
    refuse("a task with tolerances, loads_within or pose_error is verified where it lies",
           "leave out --fit, or these keys");
}

}  // namespace

bool is_asked_of_tower(const Mechanism& mechanism, const Task& task) {
  return mechanism::is_plane(mechanism) && !(task.loads && mechanism.space == mechanism::Space::spatial);
}

Verification verify(const Model& model, const Task& task, const VerifyRequest& request) {
  const Mechanism& mechanism = model.content().mechanism;
  check_request(mechanism, request.loci);
  check_task(mechanism, task);
  require_answerable(mechanism, task, request);
  Verification result = is_asked_of_tower(mechanism, task) ? verify_by_tower(mechanism, task, request)
                                                           : verify_by_statics(mechanism, task, request);
  result.mechanism = mechanism.name;
  result.units = mechanism.units;
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
    result.coordinates.push_back(coordinate.name);
    result.angles.push_back(coordinate.angle);
  }
  result.working_mode = side_names(mechanism, requested_modes(mechanism, request.loci).front());
  return result;
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
