// clearloci trajectory: reactions, take-up, pose error and contact losses along a path, and over cycle times.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/trajectory.hpp"
#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/memory_bound.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "cli/time_limit.hpp"
#include "core/errors.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/trajectory.hpp"

namespace clearloci::cli {
namespace {

struct TrajectoryCommand {
  CommonArguments common;
  std::string path;
  std::string period, periods, min_force, working_mode;
  int samples = 2000;
  std::string formats = "png,csv";
};

/// "0.5:3:0.02": first, last, step.
std::vector<double> parse_periods(const std::string& text, const mechanism::Mechanism& mechanism) {
  if (text.empty()) return {};
  const std::vector<std::string> words = split(text, ':');
  const auto refuse = [&](const std::string& problem) {
    throw core::InputError({.file = "--periods"}, problem, "give first:last:step in seconds, e.g. 0.5:3:0.02");
  };
  if (words.size() != 3) refuse(fmt::format("'{}' is no range of periods", text));
  std::vector<core::Rational> range;
  for (const std::string& word : words) range.push_back(parse_positive(word, "--periods", mechanism, "period"));
  if (range[1] < range[0]) refuse(fmt::format("'{}' ends before it begins", text));
  constexpr double most = 100000;
  if (core::to_double((range[1] - range[0]) / range[2]) > most) refuse(fmt::format("'{}' is too fine", text));
  std::vector<double> periods;
  for (core::Rational period = range[0]; period <= range[1]; period += range[2])
    periods.push_back(core::to_double(period));
  return periods;
}

TrajectoryRequest request_of(const TrajectoryCommand& arguments, const mechanism::Mechanism& mechanism) {
  TrajectoryRequest request;
  if (!arguments.working_mode.empty()) request.working_mode = parse_working_mode(arguments.working_mode, mechanism);
  if (!arguments.period.empty())
    request.period = core::to_double(parse_positive(arguments.period, "--period", mechanism, "period"));
  if (arguments.samples < 10 || arguments.samples > 10'000'000)
    throw core::InputError({.file = "--samples"}, fmt::format("{} instants a cycle", arguments.samples),
                           "give a number from 10 to 10000000");
  request.samples = arguments.samples;
  if (!arguments.min_force.empty())
    request.min_force = core::to_double(parse_positive(arguments.min_force, "--min-force", mechanism, "min_force"));
  request.periods = parse_periods(arguments.periods, mechanism);
  // An instant keeps its reactions, their influence on the pose and a row of the table, as numbers and as text; a
  // period adds a row of its own for each.
  const double unknowns = static_cast<double>(mechanism::unknowns(mechanism).size());
  const double instants = static_cast<double>(request.samples);
  require_memory(instants * (1500 + 8 * 10 * unknowns), "--samples", std::to_string(request.samples));
  require_memory(instants * 220 * static_cast<double>(request.periods.size()), "--periods", arguments.periods);
  return request;
}

int run(const TrajectoryCommand& arguments, TimeLimit& limit) {
  const std::set<std::string> formats =
      parse_formats(arguments.formats, report::format_names<core::TrajectoryResult>());
  const std::future<void> letters = report::prepare_pictures(formats);
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  const mechanism::Trajectory trajectory = mechanism::read_trajectory(arguments.path, mechanism);
  limit.known([common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "trajectory.json", incomplete_body(name, "the motion was"));
  });
  Progress progress(arguments.common.quiet);
  progress.show(0, "dynamics");
  const TrajectoryResult result = follow_trajectory(mechanism, trajectory, request_of(arguments, mechanism));
  const std::filesystem::path folder = output_folder(arguments.common);
  report::StagedFiles staged;
  const std::vector<std::filesystem::path> files =
      report::stage_trajectory(staged, result, folder, formats,
                               [&](double fraction, std::string_view stage) { progress.show(fraction, stage); });
  limit.commit(staged);
  progress.clear();
  if (arguments.common.json) {
    fmt::print("{}", report::json_text(report::trajectory_object(result)));
  } else if (!arguments.common.quiet) {
    fmt::print("{}\n{}", report::trajectory_text(result), written_words(folder, files));
  }
  return exit_done;
}

}  // namespace

Command add_trajectory_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("trajectory", "Reactions, pose error and contact losses along a path");
  const auto arguments = std::make_shared<TrajectoryCommand>();
  add_common_arguments(*app, arguments->common);
  app->add_option("PATH", arguments->path, "The trajectory file (YAML)")->required()->type_name("FILE");
  app->add_option("--period", arguments->period, "Period of the cycle (default: that of the file)")->type_name("S");
  app->add_option("--periods", arguments->periods,
                  "Also compute the error over a range of periods, first:last:step, such as 0.5:3:0.02")
      ->type_name("RANGE");
  app->add_option("--min-force", arguments->min_force,
                  "Contact counts as lost at or below this force (default: 1 % of the largest force at rest)")
      ->type_name("N");
  app->add_option("--samples", arguments->samples, "Number of instants in a cycle")
      ->type_name("COUNT")
      ->capture_default_str();
  app->add_option("--working-mode", arguments->working_mode,
                  "left or right for every dyad, such as right,left (default: the mode of the file)")
      ->type_name("SIDES");
  add_export_argument(*app, arguments->formats,
                      fmt::format("Files besides trajectory.json, comma-separated: {}",
                                  fmt::join(report::format_names<core::TrajectoryResult>(), ", ")));
  app->footer(
      "Example: clearloci trajectory examples/pick_and_place/manipulator.yaml examples/pick_and_place/path.yaml "
      "--periods 0.5:3:0.02\n"
      "Writes trajectory.json, trajectory.csv and pictures.");
  return within_limit(app, arguments, run);
}

}  // namespace clearloci::cli
