// clearloci pose: posture, reactions and condition number at one pose.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/program.hpp"
#include "core/errors.hpp"
#include "numeric/reactions.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"

namespace clearloci::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  CommonArguments common;
  std::string at;
  std::string working_mode;
};

struct PoseResult {
  std::vector<double> at;
  DyadSides sides;
  numeric::Posture posture;
  numeric::Reactions reactions;
};

/// JSON has no infinity: a reaction at a direct singularity is null.
Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json pose_json(const mechanism::Mechanism& mechanism, const numeric::NumericModel& model, const PoseResult& pose) {
  Json mode = Json::object();
  for (std::size_t j = 0; j < model.dyads.size(); ++j)
    mode[mechanism.points[static_cast<std::size_t>(model.dyads[j])].name] = pose.sides[j] > 0 ? "left" : "right";
  Json posture = Json::object();
  for (std::size_t i = 0; i < mechanism.points.size(); ++i)
    if (!mechanism.points[i].auxiliary) posture[mechanism.points[i].name] = pose.posture.points[i];
  Json reactions = Json::object();
  for (const mechanism::Joint& joint : mechanism.joints) reactions[joint.name] = Json::object();
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    const mechanism::Unknown& unknown = model.unknowns[k];
    reactions[mechanism.joints[static_cast<std::size_t>(unknown.joint)].name][core::to_string(unknown.quantity)] =
        number_json(pose.reactions.values[static_cast<Eigen::Index>(k)]);
  }
  return {{"format", 1},
          {"mechanism", mechanism.name},
          {"at", pose.at},
          {"working_mode", std::move(mode)},
          {"posture", std::move(posture)},
          {"reactions", std::move(reactions)},
          {"determinant", pose.reactions.determinant},
          {"condition", number_json(pose.reactions.condition)}};
}

void print_table(const Json& pose) {
  const auto number = [](const Json& value) {
    return value.is_null() ? std::string("unbounded") : fmt::format("{:.9g}", value.get<double>() + 0.0);  // no -0
  };
  fmt::print("{} at (", pose["mechanism"].get<std::string>());
  for (std::size_t i = 0; i < pose["at"].size(); ++i) fmt::print("{}{}", i == 0 ? "" : ", ", number(pose["at"][i]));
  fmt::print(")");
  for (const auto& [point, side] : pose["working_mode"].items()) fmt::print(", {} {}", point, side.get<std::string>());
  fmt::print("\n\n{:<12}{:>18}{:>18}\n", "point", "x [m]", "y [m]");
  for (const auto& [name, at] : pose["posture"].items())
    fmt::print("{:<12}{:>18}{:>18}\n", name, number(at[0]), number(at[1]));
  fmt::print("\n{:<12}{:>18}{:>18}{:>18}{:>18}\n", "joint", "fx [N]", "fy [N]", "|f| [N]", "M [N m]");
  for (const auto& [name, reaction] : pose["reactions"].items()) {
    const bool finite = !reaction["fx"].is_null() && !reaction["fy"].is_null();
    const std::string size =
        finite ? number(std::hypot(reaction["fx"].get<double>(), reaction["fy"].get<double>())) : "unbounded";
    fmt::print("{:<12}{:>18}{:>18}{:>18}{:>18}\n", name, number(reaction["fx"]), number(reaction["fy"]), size,
               reaction.contains("M") ? number(reaction["M"]) : "");
  }
  fmt::print("\n|A| = {}, condition number {}\n", number(pose["determinant"]), number(pose["condition"]));
}

PoseResult solve(const Arguments& arguments, const mechanism::Mechanism& mechanism,
                 const numeric::NumericModel& model) {
  PoseResult pose;
  for (const core::Rational& value : parse_pose(arguments.at, mechanism)) pose.at.push_back(core::to_double(value));
  pose.sides = arguments.working_mode.empty() ? mechanism::working_mode(mechanism)
                                              : parse_working_mode(arguments.working_mode, mechanism);
  pose.posture = numeric::posture(model, pose.at, pose.sides);
  if (pose.posture.unreachable) {
    const std::string& name = mechanism.points[static_cast<std::size_t>(*pose.posture.unreachable)].name;
    throw core::InputError({.file = "--at"}, fmt::format("the pose is out of reach: point {} cannot be placed", name),
                           "choose a pose inside the workspace");
  }
  pose.reactions = numeric::solve_reactions(model, pose.posture);
  return pose;
}

int run(const Arguments& arguments) {
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  const numeric::NumericModel model = numeric::compile(mechanism);
  const Json result = pose_json(mechanism, model, solve(arguments, mechanism, model));
  const std::string text = report::json_text(result);
  if (!arguments.common.output.empty()) report::write_atomically(output_folder(arguments.common) / "pose.json", text);
  if (arguments.common.json)
    fmt::print("{}", text);
  else if (!arguments.common.quiet)
    print_table(result);
  return exit_done;
}

}  // namespace

Command add_pose_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("pose", "Posture, reactions and condition number at one pose");
  const auto arguments = std::make_shared<Arguments>();
  add_common_arguments(*app, arguments->common);
  app->add_option("--at", arguments->at, "The pose: one value for each free coordinate, e.g. 0.25,-0.7")
      ->required()
      ->type_name("POSE");
  app->add_option("--working-mode", arguments->working_mode,
                  "left or right for every dyad, e.g. right,left (default: the file's)")
      ->type_name("SIDES");
  app->footer(
      "Example: clearloci pose examples/five_bar.yaml --at 0.25,-0.7\n"
      "With -o, DIR/pose.json is written.");
  return {app, [arguments] { return run(*arguments); }};
}

}  // namespace clearloci::cli
