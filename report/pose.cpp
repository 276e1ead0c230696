#include "report/pose.hpp"

#include <nlohmann/json.hpp>

#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/preload.hpp"
#include "report/table_json.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* axes = "xyz";

bool in_space(const core::Pose& pose) { return pose.worst.displacement.size() == 3; }

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number_json(value));
  return list;
}

void put_displacement(Json& object, const std::vector<double>& displacement) {
  for (std::size_t c = 0; c < displacement.size(); ++c)
    object[std::string("d") + axes[c]] = number_json(displacement[c]);
}

/// {"dalpha", "dx", "dy"}, in space {"dx", "dy", "dz", "dalpha_x", "dalpha_y", "dalpha_z"}.
Json error_json(const std::vector<double>& displacement, const std::vector<double>& rotation) {
  Json error = Json::object();
  if (rotation.size() == 1) error["dalpha"] = number_json(rotation.front());
  put_displacement(error, displacement);
  for (std::size_t c = 0; rotation.size() == 3 && c < 3; ++c)
    error[std::string("dalpha_") + axes[c]] = number_json(rotation[c]);
  return error;
}

/// null where the take-up is undefined.
Json take_up_json(const std::vector<core::JointTakeUp>& take_up) {
  Json all = Json::object();
  for (const core::JointTakeUp& entry : take_up) {
    Json& joint = all[entry.joint] = Json::object();
    put_displacement(joint, entry.displacement);
    const auto put = [&](const char* key, const std::optional<double>& value) {
      if (value) joint[key] = number_json(*value);
    };
    put("beta", entry.beta);
    put("normal", entry.normal);
    put("tilt", entry.tilt);
    put("axial", entry.axial);
    put("dtheta", entry.rotation);
  }
  return all;
}

Json actual_json(const core::ActualPose& actual) {
  return {{"pose_error", pose_error_object(actual.error)},
          {"beyond_linear", pose_error_object(actual.beyond_linear)},
          {"take_up", take_up_json(actual.take_up)},
          {"iterations", actual.iterations},
          {"residual", actual.residual}};
}

}  // namespace

Json pose_error_object(const core::PoseError& error) { return error_json(error.displacement, error.rotation); }

Json pose_object(const core::Pose& pose) {
  Json mode = Json::object(), points = Json::object(), reactions = Json::object();
  for (const auto& [point, side] : pose.working_mode) mode[point] = side;
  for (const core::PosePoint& point : pose.points) points[point.name] = numbers(point.at);
  for (const core::JointReaction& reaction : pose.reactions) {
    Json& joint = reactions[reaction.joint] = Json::object();
    for (const core::ReactionComponent& c : reaction.components)
      joint[core::to_string(c.quantity)] = number_json(c.value);
  }
  Json worst = error_json(pose.worst.displacement, pose.worst.rotation);
  worst["dp"] = number_json(pose.worst.distance);
  if (in_space(pose)) worst["dalpha"] = number_json(pose.worst.angle);
  Json result = {{"format", 1},
                 {"mechanism", pose.mechanism},
                 {"parameters", parameters_object(pose.parameters)},
                 {"at", pose.at},
                 {"working_mode", std::move(mode)},
                 {"posture", std::move(points)},
                 {"reactions", std::move(reactions)},
                 {"determinant", pose.determinant},
                 {"condition", number_json(pose.condition)},
                 {"take_up", take_up_json(pose.take_up)},
                 {"pose_error", pose.error ? pose_error_object(*pose.error) : Json(nullptr)},
                 {"undefined_take_up", pose.undefined},
                 {"vanishing", vanishing_array(pose.vanishing)},
                 {"singular", pose.singular},
                 {"worst_case", std::move(worst)}};
  for (const core::FeasibleEfforts& efforts : pose.efforts)
    result["feasible_efforts"][efforts.joint] = feasible_efforts_object(efforts);
  if (pose.units.declared) result["units"] = "SI";
  if (!pose.relative_to.empty()) result["relative_to"] = pose.relative_to;
  if (!pose.notes.empty()) result["notes"] = pose.notes;
  if (pose.actual) result["iterated"] = actual_json(*pose.actual);
  return result;
}

namespace {

/// With the assemblies of groups, beside the sides of dyads.
core::Pose in_mode(const core::ModePose& mode_pose) {
  core::Pose pose = *mode_pose.pose;
  pose.working_mode = mode_pose.working_mode;
  return pose;
}

}  // namespace

nlohmann::ordered_json pose_in_modes_object(const core::PoseInModes& poses) {
  nlohmann::ordered_json all = {{"format", 1},
                                {"mechanism", poses.mechanism},
                                {"parameters", parameters_object(poses.parameters)},
                                {"poses", nlohmann::ordered_json::array()}};
  for (const core::ModePose& pose : poses.modes)
    if (pose.pose) all["poses"].push_back(pose_object(in_mode(pose)));
  return all;
}

std::string pose_in_modes_text(const core::PoseInModes& poses) {
  std::string text = parameter_line(poses.parameters);
  for (const core::ModePose& mode_pose : poses.modes) {
    if (!text.empty()) text += "\n";
    if (mode_pose.pose) {
      core::Pose pose = in_mode(mode_pose);
      pose.parameters.clear();  // told once, above
      text += pose_text(pose);
      continue;
    }
    std::string words;
    for (const auto& [point, side] : mode_pose.working_mode) words += (words.empty() ? "" : ", ") + point + " " + side;
    text += words + ": " + mode_pose.why_not + "\n";
  }
  return text;
}

}  // namespace clearloci::report
