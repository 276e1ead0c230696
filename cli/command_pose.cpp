// clearloci pose: posture, reactions, take-up of the clearances and pose error at one pose.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/singular_modes.hpp"
#include "cli/arguments.hpp"
#include "cli/columns.hpp"
#include "cli/commands.hpp"
#include "cli/pose_result.hpp"
#include "cli/program.hpp"
#include "cli/spatial_pose.hpp"
#include "cli/time_limit.hpp"
#include "core/errors.hpp"
#include "numeric/displaced.hpp"
#include "numeric/pose_error.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"

namespace clearloci::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  CommonArguments common;
  std::string at;
  std::string working_mode;
  bool iterate = false;
};

struct PoseResult {
  std::vector<double> at;
  DyadSides sides;
  numeric::Posture posture;
  numeric::Accuracy accuracy;
  bool singular = false;                      ///< |A| cannot be told from zero
  std::optional<numeric::ActualPose> actual;  ///< if asked for
};

Json error_json(const numeric::PoseError& error) {
  return {{"dalpha", error.dalpha}, {"dx", error.dx}, {"dy", error.dy}};
}

/// Joints with a clearance; null where the take-up is undefined.
Json take_up_json(const numeric::NumericModel& model, const std::vector<numeric::TakeUp>& take_up) {
  const std::vector<numeric::JointClearance> clearances = numeric::joint_clearances(model.mechanism);
  Json all = Json::object();
  for (std::size_t j = 0; j < take_up.size(); ++j) {
    const numeric::TakeUp& t = take_up[j];
    const auto& [radial, angular, gap, half_length] = clearances[j];
    if (radial == 0 && angular == 0 && gap == 0) continue;
    Json& joint = all[model.mechanism.joints[j].name] = Json::object();
    if (model.mechanism.joints[j].type == mechanism::JointType::prismatic) {
      const auto way = [](bool lost, double value) { return lost ? Json(nullptr) : Json(value); };
      if (gap > 0) joint["normal"] = way(t.guide_vanishes, t.normal);
      if (gap > 0) joint["tilt"] = way(t.guide_vanishes, t.tilt);
      if (angular > 0) joint["axial"] = way(t.couple_vanishes, t.rotation);
      continue;
    }
    const bool lost = t.force_vanishes && radial > 0;
    joint["dx"] = lost ? Json(nullptr) : Json(t.displacement[0]);
    joint["dy"] = lost ? Json(nullptr) : Json(t.displacement[1]);
    joint["beta"] = t.beta ? Json(*t.beta) : Json(nullptr);
    if (angular > 0) joint["dtheta"] = t.couple_vanishes ? Json(nullptr) : Json(t.rotation);
  }
  return all;
}

Json actual_json(const numeric::NumericModel& model, const numeric::ActualPose& actual) {
  return {{"pose_error", error_json(actual.error)},
          {"beyond_linear", error_json(actual.beyond_linear)},
          {"take_up", take_up_json(model, actual.take_up)},
          {"iterations", actual.iterations},
          {"residual", actual.residual}};
}

Json pose_json(const mechanism::Mechanism& mechanism, const numeric::NumericModel& model, const PoseResult& pose) {
  Json posture = Json::object();
  for (std::size_t i = 0; i < mechanism.points.size(); ++i)
    if (!mechanism.points[i].auxiliary) posture[mechanism.points[i].name] = pose.posture.points[i];
  Json reactions = Json::object();
  for (const mechanism::Joint& joint : mechanism.joints) reactions[joint.name] = Json::object();
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    const mechanism::Unknown& unknown = model.unknowns[k];
    reactions[mechanism.joints[static_cast<std::size_t>(unknown.joint)].name][core::to_string(unknown.quantity)] =
        number_json(pose.accuracy.reactions.values[static_cast<Eigen::Index>(k)]);
  }
  const numeric::Accuracy& accuracy = pose.accuracy;
  const numeric::WorstCase& worst = accuracy.worst;
  Json result = {{"format", 1},
                 {"mechanism", mechanism.name},
                 {"at", pose.at},
                 {"working_mode", mode_json(mechanism, pose.sides)},
                 {"posture", std::move(posture)},
                 {"reactions", std::move(reactions)},
                 {"determinant", pose.accuracy.reactions.determinant},
                 {"condition", number_json(accuracy.reactions.condition)},
                 {"take_up", take_up_json(model, accuracy.take_up)},
                 {"pose_error", accuracy.undefined.empty() ? error_json(accuracy.error) : Json(nullptr)},
                 {"undefined_take_up", accuracy.undefined},
                 {"vanishing", report::vanishing_array(numeric::lost_reactions(
                                   model, numeric::joint_clearances(mechanism), accuracy.take_up))},
                 {"singular", pose.singular},
                 {"worst_case",
                  {{"dalpha", number_json(worst.dalpha)},
                   {"dx", number_json(worst.dx)},
                   {"dy", number_json(worst.dy)},
                   {"dp", number_json(worst.dp)}}}};
  if (pose.actual) result["iterated"] = actual_json(model, *pose.actual);
  return result;
}

std::string error_row(const std::string& what, const Json& error) {
  return fmt::format("{:<18}{:>16}{:>18}{:>18}\n", what, number_text(error["dx"]), number_text(error["dy"]),
                     number_text(error["dalpha"]));
}

void print_accuracy(const Json& pose) {
  const auto entry = [](const Json& joint, const char* key) {
    if (!joint.contains(key)) return std::string();
    return joint[key].is_null() ? std::string("undefined") : number_text(joint[key]);
  };
  if (pose["take_up"].empty()) return;
  fmt::print("\n{:<12}{:>18}{:>18}{:>18}{:>18}\n", "take-up", "dx [m]", "dy [m]", "beta [rad]", "dtheta [rad]");
  for (const auto& [name, joint] : pose["take_up"].items()) {
    if (!joint.contains("dx")) {
      std::vector<std::string> parts;
      for (const char* key : {"normal", "tilt", "axial"})
        if (joint.contains(key))
          parts.push_back(fmt::format("{} {} {}", key, entry(joint, key), std::string(key) == "tilt" ? "rad" : "m"));
      fmt::print("{:<12}      {}\n", name, fmt::join(parts, ", "));
      continue;
    }
    fmt::print("{:<12}{:>18}{:>18}{:>18}{:>18}\n", name, entry(joint, "dx"), entry(joint, "dy"), entry(joint, "beta"),
               entry(joint, "dtheta"));
  }
  fmt::print("\n{:<18}{:>16}{:>18}{:>18}\n", "pose error", "dx [m]", "dy [m]", "dalpha [rad]");
  if (pose["pose_error"].is_null())
    fmt::print("undefined: {}\n", undefined_words(pose));
  else
    fmt::print("{}", error_row("linear", pose["pose_error"]));
  if (pose.contains("iterated")) {
    const Json& iterated = pose["iterated"];
    fmt::print("{}{}", error_row("iterated", iterated["pose_error"]),
               error_row("  difference", iterated["beyond_linear"]));
    fmt::print("  {} iterations, closure within {:.2g}\n", iterated["iterations"].get<int>(),
               iterated["residual"].get<double>());
  }
  fmt::print("{}", error_row("worst, any load", pose["worst_case"]));
  fmt::print("{:<18}{:>16}  largest distance\n", "", number_text(pose["worst_case"]["dp"]));
}

/// "N 12.5 N, T 0 N m, F 3 N".
void print_prismatic(const std::string& name, const Json& reaction) {
  std::vector<std::string> parts;
  for (const auto& [quantity, value] : reaction.items())
    parts.push_back(fmt::format("{} {} {}", quantity, number_text(value), quantity == "T" ? "N m" : "N"));
  fmt::print("{:<12}      {}\n", name, fmt::join(parts, ", "));
}

void print_table(const Json& pose) {
  fmt::print("{} at (", pose["mechanism"].get<std::string>());
  for (std::size_t i = 0; i < pose["at"].size(); ++i)
    fmt::print("{}{}", i == 0 ? "" : ", ", number_text(pose["at"][i]));
  fmt::print(")");
  for (const auto& [point, side] : pose["working_mode"].items()) fmt::print(", {} {}", point, side.get<std::string>());
  fmt::print("\n\n{:<12}{:>18}{:>18}\n", "point", "x [m]", "y [m]");
  for (const auto& [name, at] : pose["posture"].items())
    fmt::print("{:<12}{:>18}{:>18}\n", name, number_text(at[0]), number_text(at[1]));
  fmt::print("\n{:<12}{:>18}{:>18}{:>18}{:>18}\n", "joint", "fx [N]", "fy [N]", "|f| [N]", "M [N m]");
  for (const auto& [name, reaction] : pose["reactions"].items()) {
    if (!reaction.contains("fx")) {
      print_prismatic(name, reaction);
      continue;
    }
    const bool finite = !reaction["fx"].is_null() && !reaction["fy"].is_null();
    const std::string size =
        finite ? number_text(std::hypot(reaction["fx"].get<double>(), reaction["fy"].get<double>())) : "unbounded";
    fmt::print("{:<12}{:>18}{:>18}{:>18}{:>18}\n", name, number_text(reaction["fx"]), number_text(reaction["fy"]), size,
               reaction.contains("M") ? number_text(reaction["M"]) : "");
  }
  fmt::print("\n|A| = {}, condition number {}\n", number_text(pose["determinant"]), number_text(pose["condition"]));
  print_accuracy(pose);
}

/// A pose that was written in decimals stands for its exact value, which is no double: a pose on a locus is one.
std::vector<numeric::Bounded> with_rounding(const std::vector<core::Rational>& exact) {
  std::vector<numeric::Bounded> pose;
  for (const core::Rational& value : exact) {
    const double nearest = core::to_double(value);
    pose.emplace_back(nearest, core::Rational(nearest) == value ? 0.0 : numeric::unit_roundoff * std::abs(nearest));
  }
  return pose;
}

DyadSides sides_of(const Arguments& arguments, const mechanism::Mechanism& mechanism) {
  return arguments.working_mode.empty() ? mechanism::working_mode(mechanism)
                                        : parse_working_mode(arguments.working_mode, mechanism);
}

PoseResult solve(const Arguments& arguments, const mechanism::Mechanism& mechanism,
                 const numeric::NumericModel& model) {
  PoseResult pose;
  const std::vector<numeric::Bounded> at = with_rounding(parse_pose(arguments.at, mechanism));
  for (const numeric::Bounded& value : at) pose.at.push_back(value.value);
  pose.sides = sides_of(arguments, mechanism);
  require_regular(mechanism, pose.sides);
  pose.posture = numeric::posture(model, pose.at, pose.sides);
  if (pose.posture.unreachable) throw out_of_reach(mechanism, *pose.posture.unreachable);
  pose.accuracy = numeric::pose_accuracy(model, pose.posture, numeric::vanishing_unknowns(model, at, pose.sides));
  const numeric::Bounded determinant = numeric::bounded_numerators(model, at, pose.sides).determinant;
  pose.singular = !(std::abs(determinant.value) > determinant.error);
  if (!arguments.iterate) return pose;
  pose.actual = numeric::actual_pose(model, pose.posture, pose.accuracy);
  if (!pose.actual->converged)
    throw core::InputError({.file = "--iterate"}, "the pose error cannot be iterated: " + pose.actual->reason,
                           "leave --iterate out, choose another pose or smaller clearances");
  return pose;
}

int report_pose(const Arguments& arguments, const Json& result, void (*print)(const Json&), TimeLimit& limit) {
  limit.writing();
  const std::string text = report::json_text(result);
  if (!arguments.common.output.empty()) report::write_atomically(output_folder(arguments.common) / "pose.json", text);
  if (arguments.common.json)
    fmt::print("{}", text);
  else if (!arguments.common.quiet)
    print(result);
  return exit_done;
}

int run_spatial(const Arguments& arguments, const mechanism::Mechanism& mechanism, TimeLimit& limit) {
  if (arguments.iterate)
    throw core::InputError({.file = "--iterate"}, "the pose error of a spatial mechanism is not iterated",
                           "leave --iterate out: the linear error is given");
  const std::vector<numeric::Bounded> at = with_rounding(parse_pose(arguments.at, mechanism));
  const DyadSides sides = sides_of(arguments, mechanism);
  require_regular(mechanism, sides);
  return report_pose(arguments, spatial_pose_json(mechanism, at, sides), print_spatial_pose, limit);
}

int run(const Arguments& arguments, TimeLimit& limit) {
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  limit.known([common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "pose.json", incomplete_body(name, "the pose was"), false);
  });
  if (mechanism.space == mechanism::Space::spatial) return run_spatial(arguments, mechanism, limit);
  const numeric::NumericModel model = numeric::compile(mechanism);
  return report_pose(arguments, pose_json(mechanism, model, solve(arguments, mechanism, model)), print_table, limit);
}

}  // namespace

Command add_pose_command(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("pose", "Posture, reactions, take-up of clearances and pose error at one pose");
  const auto arguments = std::make_shared<Arguments>();
  add_common_arguments(*app, arguments->common);
  app->add_option("--at", arguments->at, "The pose: one value for each free coordinate, e.g. 0.25,-0.7")
      ->required()
      ->type_name("POSE");
  app->add_option("--working-mode", arguments->working_mode,
                  "left or right for every dyad, e.g. right,left (default: the file's)")
      ->type_name("SIDES");
  app->add_flag("--iterate", arguments->iterate,
                "Also the pose error beyond the linear step: the mechanism closed with its clearances taken up");
  app->footer(
      "Example: clearloci pose examples/five_bar.yaml --at 0.25,-0.7 --iterate\n"
      "With -o, DIR/pose.json is written.");
  return {app, [arguments] {
            return run_within(arguments->common, [&](TimeLimit& limit) { return run(*arguments, limit); });
          }};
}

}  // namespace clearloci::cli
