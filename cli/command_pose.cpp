// clearloci pose: posture, reactions, take-up of the clearances and pose error at one pose.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/pose.hpp"
#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/program.hpp"
#include "cli/time_limit.hpp"
#include "core/errors.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/pose.hpp"

namespace clearloci::cli {
namespace {

struct PoseCommand {
  CommonArguments common;
  std::string at;
  std::string velocity, acceleration, min_force, min_couple;
  std::string working_mode;
  bool iterate = false;
};

PoseRequest request_of(const PoseCommand& arguments, const mechanism::Mechanism& mechanism) {
  PoseRequest request{.iterate = arguments.iterate};
  request.velocity = parse_rates(arguments.velocity, "--velocity", mechanism);
  request.acceleration = parse_rates(arguments.acceleration, "--acceleration", mechanism);
  if (!arguments.min_force.empty())
    request.min_force = parse_positive(arguments.min_force, "--min-force", mechanism, "min_force");
  if (!arguments.min_couple.empty())
    request.min_couple = parse_positive(arguments.min_couple, "--min-couple", mechanism, "min_couple");
  return request;
}

int run_all_modes(const PoseCommand& arguments, const mechanism::Mechanism& mechanism, TimeLimit& limit) {
  const std::vector<core::Rational> at = parse_pose(arguments.at, mechanism);
  const PoseInModes poses = solve_pose_in_modes(mechanism, at, request_of(arguments, mechanism));
  if (std::none_of(poses.modes.begin(), poses.modes.end(), [](const ModePose& pose) { return pose.pose.has_value(); }))
    throw core::InputError({.file = "--at"}, "the pose is out of reach in every working mode",
                           "choose a pose inside the workspace");
  report::StagedFiles staged;
  if (!arguments.common.output.empty()) report::stage_answer(staged, poses, output_folder(arguments.common));
  limit.commit(staged);
  if (arguments.common.json)
    fmt::print("{}", report::json_text(report::pose_in_modes_object(poses)));
  else if (!arguments.common.quiet)
    fmt::print("{}", report::pose_in_modes_text(poses));
  return exit_done;
}

Pose solve(const PoseCommand& arguments, const mechanism::Mechanism& mechanism) {
  const std::vector<core::Rational> at = parse_pose(arguments.at, mechanism);
  PoseRequest request = request_of(arguments, mechanism);
  if (!arguments.working_mode.empty()) request.working_mode = parse_working_mode(arguments.working_mode, mechanism);
  Pose pose = solve_pose(mechanism, at, request);
  if (!pose.unreachable.empty())
    throw core::InputError({.file = "--at"},
                           fmt::format("the pose is out of reach: point {} cannot be placed", pose.unreachable),
                           "choose a pose inside the workspace");
  if (!pose.beyond_limit.empty())
    throw core::InputError({.file = "--at"}, "the pose is beyond the limit of the " + pose.beyond_limit,
                           "choose a pose inside the workspace");
  require_iterated(pose, "--iterate");
  return pose;
}

int run(const PoseCommand& arguments, TimeLimit& limit) {
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  limit.known([common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "pose.json", incomplete_body(name, "the pose was"), false);
  });
  if (arguments.working_mode == "all") return run_all_modes(arguments, mechanism, limit);
  const Pose pose = solve(arguments, mechanism);
  report::StagedFiles staged;
  if (!arguments.common.output.empty()) report::stage_answer(staged, pose, output_folder(arguments.common));
  limit.commit(staged);
  if (arguments.common.json)
    fmt::print("{}", report::json_text(report::pose_object(pose)));
  else if (!arguments.common.quiet)
    fmt::print("{}", report::pose_text(pose));
  return exit_done;
}

}  // namespace

Command add_pose_command(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("pose", "Posture, reactions, take-up of clearances and pose error at one pose");
  const auto arguments = std::make_shared<PoseCommand>();
  add_common_arguments(*app, arguments->common);
  app->add_option("--at", arguments->at,
                  "The pose: one value for each free coordinate, such as 0.25,-0.7 or y=-0.7,x=0.25")
      ->required()
      ->type_name("POSE");
  app->add_option("--velocity", arguments->velocity,
                  "Rates of the coordinates, m/s or rad/s: include the inertia of the links in the reactions")
      ->type_name("RATES");
  app->add_option("--acceleration", arguments->acceleration, "Accelerations of the coordinates, m/s^2 or rad/s^2")
      ->type_name("RATES");
  app->add_option("--working-mode", arguments->working_mode,
                  "left or right for every dyad, such as right,left; or all (default: the mode of the file)")
      ->type_name("SIDES");
  app->add_flag("--iterate", arguments->iterate,
                "Also solve the mechanism with its clearances taken up, without linearisation");
  app->add_option("--min-force", arguments->min_force,
                  "Of free efforts: those with which every contact force is at least this large are feasible")
      ->type_name("N");
  app->add_option("--min-couple", arguments->min_couple, "Of free efforts: the same for the couples of actuators")
      ->type_name("NM");
  app->footer(
      "Example: clearloci pose examples/five_bar.yaml --at 0.25,-0.7 --iterate\n"
      "With -o, DIR/pose.json is written.");
  return within_limit(app, arguments, run);
}

}  // namespace clearloci::cli
