#include "cli/spatial_pose.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/columns.hpp"
#include "cli/pose_result.hpp"
#include "numeric/spatial.hpp"
#include "report/loci_json.hpp"

namespace clearloci::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array error_names = {"dx", "dy", "dz", "dalpha_x", "dalpha_y", "dalpha_z"};

Json vector_json(const Eigen::Vector3d& v) { return {number_json(v(0)), number_json(v(1)), number_json(v(2))}; }

Json error_json(const Eigen::Vector3d& dp, const Eigen::Vector3d& dalpha) {
  Json error = Json::object();
  for (std::size_t c = 0; c < 6; ++c) {
    const auto i = static_cast<Eigen::Index>(c % 3);
    error[error_names[c]] = number_json(c < 3 ? dp(i) : dalpha(i));
  }
  return error;
}

/// Joints with a clearance; null where the take-up is undefined.
Json take_up_json(const mechanism::Mechanism& mechanism, const numeric::SpatialAccuracy& accuracy) {
  Json all = Json::object();
  for (std::size_t j = 0; j < accuracy.joints.size(); ++j) {
    const numeric::SpatialJoint& joint = accuracy.joints[j];
    const numeric::SpatialTakeUp& t = accuracy.take_up[j];
    if (!joint.presses() && !joint.plays()) continue;
    Json& own = all[mechanism.joints[j].name] = Json::object();
    for (int c = 0; joint.presses() && c < 3; ++c)
      own["d" + std::string(1, "xyz"[c])] = t.force_vanishes ? Json(nullptr) : Json(t.displacement(c));
    if (joint.plays())
      own[joint.type == mechanism::JointType::prismatic ? "axial" : "dtheta"] =
          t.actuator_vanishes ? Json(nullptr) : Json(t.actuator);
  }
  return all;
}

Json reaction_json(const mechanism::Joint& joint, const numeric::SpatialReaction& r) {
  Json reaction = Json::object();
  for (int c = 0; c < 3; ++c) {
    const std::string axis(1, "xyz"[c]);
    reaction["f" + axis] = number_json(r.force(c));
    if (joint.type != mechanism::JointType::spherical) reaction["m" + axis] = number_json(r.couple(c));
  }
  if (joint.actuated) reaction[core::to_string(mechanism::actuator_quantity(joint))] = number_json(r.actuator);
  return reaction;
}

void print_accuracy(const Json& pose) {
  if (pose["take_up"].empty()) return;
  const auto entry = [](const Json& joint, const char* key, const char* unit = "") {
    if (!joint.contains(key)) return std::string();
    return joint[key].is_null() ? std::string("undefined") : number_text(joint[key]) + unit;
  };
  fmt::print("\n{:<12}{:>18}{:>18}{:>18}  actuator\n", "take-up", "dx [m]", "dy [m]", "dz [m]");
  for (const auto& [name, joint] : pose["take_up"].items()) {
    fmt::print("{:<12}{:>18}{:>18}{:>18}", name, entry(joint, "dx"), entry(joint, "dy"), entry(joint, "dz"));
    if (joint.contains("axial")) fmt::print("  axial {}", entry(joint, "axial", " m"));
    if (joint.contains("dtheta")) fmt::print("  dtheta {}", entry(joint, "dtheta", " rad"));
    fmt::print("\n");
  }
  fmt::print("\n{:<18}{:>16}{:>16}{:>16}{:>16}{:>16}{:>16}\n", "pose error", "dx [m]", "dy [m]", "dz [m]",
             "dalpha_x [rad]", "dalpha_y [rad]", "dalpha_z [rad]");
  const auto row = [](const char* what, const Json& error) {
    fmt::print("{:<18}", what);
    for (const char* key : error_names) fmt::print("{:>16}", number_text(error[key]));
    fmt::print("\n");
  };
  if (pose["pose_error"].is_null())
    fmt::print("undefined: {}\n", undefined_words(pose));
  else
    row("linear", pose["pose_error"]);
  row("worst, any load", pose["worst_case"]);
  fmt::print("{:<18}{:>16} m largest distance, {} rad largest rotation\n", "", number_text(pose["worst_case"]["dp"]),
             number_text(pose["worst_case"]["dalpha"]));
}

}  // namespace

Json spatial_pose_json(const mechanism::Mechanism& mechanism, const std::vector<numeric::Bounded>& at,
                       const DyadSides& sides) {
  std::vector<double> pose;
  for (const numeric::Bounded& value : at) pose.push_back(value.value);
  if (const auto unreachable = numeric::spatial_posture(mechanism, pose, sides).unreachable)
    throw out_of_reach(mechanism, *unreachable);
  const numeric::NumericModel model = numeric::compile(mechanism);
  const numeric::SpatialAccuracy accuracy =
      numeric::spatial_accuracy(mechanism, pose, numeric::lost_contacts(model, sides, at), sides);
  const numeric::Bounded determinant = numeric::bounded_numerators(model, at, sides).determinant;
  std::vector<core::Vanishing> lost;
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    const mechanism::Joint& joint = mechanism.joints[j];
    if (accuracy.take_up[j].force_vanishes) lost.push_back({joint.name, core::Quantity::f});
    if (accuracy.take_up[j].actuator_vanishes) lost.push_back({joint.name, mechanism::actuator_quantity(joint)});
  }
  const numeric::SpatialPosture& posture = accuracy.posture;
  Json points = Json::object(), reactions = Json::object();
  for (std::size_t i = 0; i < mechanism.points.size(); ++i)
    if (!mechanism.points[i].auxiliary) points[mechanism.points[i].name] = vector_json(posture.points[i]);
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    reactions[mechanism.joints[j].name] = reaction_json(mechanism.joints[j], posture.reactions[j]);
  Json worst = error_json(accuracy.worst.dp, accuracy.worst.dalpha);
  worst["dp"] = number_json(accuracy.worst.distance);
  worst["dalpha"] = number_json(accuracy.worst.rotation);
  return {
      {"format", 1},
      {"mechanism", mechanism.name},
      {"at", pose},
      {"working_mode", mode_json(mechanism, sides)},
      {"posture", std::move(points)},
      {"reactions", std::move(reactions)},
      {"determinant", posture.determinant},
      {"condition", number_json(posture.condition)},
      {"take_up", take_up_json(mechanism, accuracy)},
      {"pose_error", accuracy.undefined.empty() ? error_json(accuracy.error.dp, accuracy.error.dalpha) : Json(nullptr)},
      {"undefined_take_up", accuracy.undefined},
      {"vanishing", report::vanishing_array(lost)},
      {"singular", !(std::abs(determinant.value) > determinant.error)},
      {"worst_case", std::move(worst)}};
}

void print_spatial_pose(const Json& pose) {
  fmt::print("{} at ({})", pose["mechanism"].get<std::string>(),
             fmt::join(pose["at"].get<std::vector<double>>(), ", "));
  for (const auto& [point, side] : pose["working_mode"].items()) fmt::print(", {} {}", point, side.get<std::string>());
  fmt::print("\n\n{:<12}{:>18}{:>18}{:>18}\n", "point", "x [m]", "y [m]", "z [m]");
  for (const auto& [name, at] : pose["posture"].items())
    fmt::print("{:<12}{:>18}{:>18}{:>18}\n", name, number_text(at[0]), number_text(at[1]), number_text(at[2]));
  fmt::print("\n{:<12}{:>16}{:>16}{:>16}{:>16}{:>16}{:>16}  actuator\n", "joint", "fx [N]", "fy [N]", "fz [N]",
             "mx [N m]", "my [N m]", "mz [N m]");
  for (const auto& [name, reaction] : pose["reactions"].items()) {
    fmt::print("{:<12}", name);
    for (const char* key : {"fx", "fy", "fz", "mx", "my", "mz"})
      fmt::print("{:>16}", reaction.contains(key) ? number_text(reaction[key]) : "");
    if (reaction.contains("F")) fmt::print("  F {} N", number_text(reaction["F"]));
    if (reaction.contains("M")) fmt::print("  M {} N m", number_text(reaction["M"]));
    fmt::print("\n");
  }
  fmt::print("\n|A| = {}, condition number {}\n", number_text(pose["determinant"]), number_text(pose["condition"]));
  print_accuracy(pose);
}

}  // namespace clearloci::cli
