#include "cli/pose_result.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace clearloci::cli {

using Json = nlohmann::ordered_json;

std::string number_text(const Json& value) {
  return value.is_null() ? std::string("unbounded") : fmt::format("{:.9g}", value.get<double>() + 0.0);  // no -0
}

std::string undefined_words(const Json& pose) {
  if (pose["singular"].get<bool>()) return "|A| = 0 here: the reactions are unbounded or have no limit";
  const std::vector<std::pair<std::string, std::string>> wordings = {{"f", "contact is lost at "},
                                                                     {"end_ahead", "the end ahead lifts at "},
                                                                     {"end_behind", "the end behind lifts at "},
                                                                     {"M", "M = 0 at "},
                                                                     {"F", "F = 0 at "}};
  std::string words;
  for (const auto& [quantity, start] : wordings) {
    std::string joints;
    for (const Json& one : pose["vanishing"])
      if (one["quantity"] == quantity) joints += (joints.empty() ? "" : ", ") + one["joint"].get<std::string>();
    if (!joints.empty()) words += (words.empty() ? "" : "; ") + start + joints;
  }
  return words;
}

Json mode_json(const mechanism::Mechanism& mechanism, const DyadSides& sides) {
  const std::vector<mechanism::PointIndex> points = mechanism::dyad_points(mechanism);
  Json mode = Json::object();
  for (std::size_t j = 0; j < points.size(); ++j)
    mode[mechanism.points[static_cast<std::size_t>(points[j])].name] =
        mechanism::side_name(mechanism, points[j], sides[j]);
  return mode;
}

core::InputError out_of_reach(const mechanism::Mechanism& mechanism, mechanism::PointIndex point) {
  const std::string& name = mechanism.points[static_cast<std::size_t>(point)].name;
  return {{.file = "--at"},
          fmt::format("the pose is out of reach: point {} cannot be placed", name),
          "choose a pose inside the workspace"};
}

}  // namespace clearloci::cli
