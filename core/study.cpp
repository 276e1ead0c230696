#include "clearloci/study.hpp"

#include <algorithm>

namespace clearloci::inline core {
namespace {

struct Named {
  Figure figure;
  const char* name;
};
constexpr Named names[] = {{Figure::margin, "margin"},       {Figure::min_force, "min_force"},
                           {Figure::effort, "effort"},       {Figure::pose_error, "pose_error"},
                           {Figure::zone_area, "zone_area"}, {Figure::largest_circle, "largest_circle"}};

}  // namespace

std::string to_string(Figure figure) {
  for (const Named& named : names)
    if (named.figure == figure) return named.name;
  return {};
}

std::optional<Figure> figure_named(std::string_view name) {
  for (const Named& named : names)
    if (named.name == name) return named.figure;
  return std::nullopt;
}

std::vector<Task> required_tasks(const Study& study) {
  std::vector<Task> tasks = study.tasks;
  for (Task& task : tasks)
    for (const StudyRequirement& requirement : study.require) {
      if (requirement.figure == Figure::margin) task.margin = std::max(task.margin, requirement.bound);
      if (requirement.figure == Figure::pose_error)
        task.pose_error = std::min(task.pose_error.value_or(requirement.bound), requirement.bound);
      if (requirement.figure == Figure::min_force && requirement.bound > 0)
        task.min_force = std::max(task.min_force.value_or(0), requirement.bound);
    }
  return tasks;
}

std::string to_string(StudyDesign::Status status) {
  switch (status) {
    case StudyDesign::Status::feasible:
      return "feasible";
    case StudyDesign::Status::infeasible:
      return "infeasible";
    case StudyDesign::Status::left_out:
      return "left out";
    case StudyDesign::Status::undecided:
      break;
  }
  return "undecided";
}

}  // namespace clearloci::inline core
