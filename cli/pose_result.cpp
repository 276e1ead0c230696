#include "cli/pose_result.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace clearloci::cli {

using Json = nlohmann::ordered_json;

std::string number_text(const Json& value) {
  return value.is_null() ? std::string("unbounded") : fmt::format("{:.9g}", value.get<double>() + 0.0);  // no -0
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
