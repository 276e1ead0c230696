#include "clearloci/study.hpp"

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
  for (const Named& own : names)
    if (own.figure == figure) return own.name;
  return {};
}

std::optional<Figure> figure_named(std::string_view name) {
  for (const Named& own : names)
    if (own.name == name) return own.figure;
  return std::nullopt;
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
