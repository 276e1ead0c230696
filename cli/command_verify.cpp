// clearloci verify: does the mechanism keep clear of its discontinuity loci over a task?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/framed.hpp"
#include "analysis/pose_verification.hpp"
#include "analysis/verification.hpp"
#include "cli/certificate_argument.hpp"
#include "cli/commands.hpp"
#include "cli/loci_arguments.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "core/errors.hpp"
#include "mechanism/read_pose_task.hpp"
#include "mechanism/read_task.hpp"
#include "mechanism/write_task.hpp"
#include "report/files.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/pose_verification.hpp"
#include "report/verification.hpp"

namespace clearloci::cli {
namespace {

struct VerifyCommand {
  CommonArguments common;
  LociArguments loci;
  std::string task, fit;
  std::string formats = "svg,png";
  std::string certificate;
};

/// Where a place that was found is written, as a task to be read.
constexpr const char* moved_task = "moved.yaml";

int status_of(core::Verdict verdict) {
  switch (verdict) {
    case core::Verdict::verified:
      return exit_done;
    case core::Verdict::refuted:
      return exit_check_said_no;
    case core::Verdict::undecided:
      break;
  }
  return exit_limit_reached;
}

std::optional<FitGoal> parse_fit(const std::string& word) {
  if (word.empty()) return std::nullopt;
  if (word == "nearest") return FitGoal::nearest;
  if (word == "best") return FitGoal::best;
  if (word == "largest")
    throw core::InputError({.file = "--fit"}, "the largest scale is looked for over other than two lengths",
                           "choose from nearest, best");
  throw core::InputError({.file = "--fit"}, fmt::format("unknown goal '{}'", word), "choose from nearest, best");
}

std::optional<PoseFit> parse_pose_fit(const std::string& word) {
  if (word.empty()) return std::nullopt;
  if (word == "nearest") return PoseFit::nearest;
  if (word == "best") return PoseFit::best;
  if (word == "largest") return PoseFit::largest;
  throw core::InputError({.file = "--fit"}, fmt::format("unknown goal '{}'", word),
                         "choose from nearest, best, largest");
}

/// The loci of the file's load with their cells, and the task where it was verified.
void certify(const VerifyCommand& arguments, const mechanism::Mechanism& mechanism, const Verification& result,
             const LociRequest& request, report::StagedFiles& staged) {
  core::Certificate certificate;
  trace_loci(mechanism, request, &certificate);
  const bool nominal = result.verified() && !result.task.loads && result.task.tolerances.empty() &&
                       result.task.loads_within.empty() && !result.task.pose_error;
  const core::Task task = in_frame(result.task, certificate);
  stage_certificate(staged, arguments.certificate, "verify", arguments.common, certificate, nominal ? &task : nullptr);
}

/// Over other than two lengths: a verdict without traced loci.
int run_over_poses(const VerifyCommand& arguments, const std::set<std::string>& formats,
                   const mechanism::Mechanism& mechanism, TimeLimit& limit) {
  const std::optional<PoseFit> goal = parse_pose_fit(arguments.fit);
  const core::PoseTask task = mechanism::read_pose_task(arguments.task, mechanism);
  Progress progress(arguments.common.quiet);
  const LociRequest request = loci_request(arguments.loci, mechanism, progress, limit);
  if (request.all_working_modes || request.working_modes.size() > 1)
    throw core::InputError({.file = "--working-mode"}, "a task is verified in one working mode",
                           "give one side for each dyad");
  const core::PoseVerification result =
      goal ? fit_poses(mechanism, task, *goal, request) : verify_poses(mechanism, task, request);
  progress.clear();
  limit.writing();
  const std::filesystem::path folder = output_folder(arguments.common);
  const auto files = report::write_answer(result, folder, formats);
  if (arguments.common.json)
    fmt::print("{}", report::json_text(report::pose_verification_object(result)));
  else if (!arguments.common.quiet)
    fmt::print("{}\n{}", report::pose_verification_text(result), written_words(folder, files));
  return status_of(result.verdict);
}

int run(const VerifyCommand& arguments, TimeLimit& limit) {
  const std::set<std::string> formats = parse_formats(arguments.formats, report::format_names<core::Verification>());
  const std::future<void> letters = report::prepare_pictures(formats);
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  if (!arguments.certificate.empty()) require_certifiable(mechanism);
  const bool over_poses = mechanism::is_pose_task(arguments.task, mechanism);
  const std::optional<FitGoal> goal = over_poses ? std::nullopt : parse_fit(arguments.fit);
  const core::Task task = over_poses ? core::Task{} : mechanism::read_task(arguments.task, mechanism);
  limit.known([common = arguments.common, name = mechanism.name] {
    nlohmann::ordered_json body = incomplete_body(name, "the verdict was");
    body["verdict"] = to_string(core::Verdict::undecided);
    body["verified"] = false;
    write_incomplete(common, "verify.json", body);
  });
  if (over_poses) return run_over_poses(arguments, formats, mechanism, limit);
  Progress progress(arguments.common.quiet);
  const LociRequest request = loci_request(arguments.loci, mechanism, progress, limit);
  if (request.all_working_modes || request.working_modes.size() > 1)
    throw core::InputError({.file = "--working-mode"}, "a task is verified in one working mode",
                           "give one side for each dyad");
  const Verification result = goal ? fit_task(mechanism, task, request, *goal) : verify_task(mechanism, task, request);
  report::StagedFiles staged;
  if (!arguments.certificate.empty()) certify(arguments, mechanism, result, request, staged);
  progress.clear();
  limit.writing();

  const std::filesystem::path folder = output_folder(arguments.common);
  std::vector<std::filesystem::path> files = report::stage_answer(staged, result, folder, formats);
  if (result.by) {
    files.push_back(folder / moved_task);
    staged.add(files.back(), mechanism::task_text(result.task, mechanism));
  }
  staged.commit();
  if (arguments.common.json) {
    fmt::print("{}", report::json_text(report::verification_object(result)));
  } else if (!arguments.common.quiet) {
    fmt::print("{}", report::verification_text(result, goal.has_value()));
    fmt::print("\n{}", written_words(folder, files));
  }
  return status_of(result.verdict);
}

}  // namespace

Command add_verify_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("verify", "Prove that a task keeps clear of every discontinuity locus");
  const auto arguments = std::make_shared<VerifyCommand>();
  add_common_arguments(*app, arguments->common);
  app->add_option("TASK", arguments->task,
                  "The task file: a box, circle, polygon or path; over other than two lengths a box, ball or path, "
                  "over three a mesh")
      ->required();
  add_tracing_arguments(*app, arguments->loci);
  add_locus_arguments(*app, arguments->loci);
  app->add_option(
         "--fit", arguments->fit,
         "Move the task: to the nearest place that verifies, or to the best, with the largest margin; over other "
         "than two lengths also the largest scale of it")
      ->type_name("nearest|best|largest")
      ->expected(0, 1)
      ->default_str("nearest");
  app->add_option("--export", arguments->formats,
                  fmt::format("Pictures besides verify.json, comma-separated: {}",
                              fmt::join(report::format_names<core::Verification>(), ", ")))
      ->type_name("LIST")
      ->capture_default_str();
  add_certificate_argument(*app, arguments->certificate);
  app->footer(
      "Example: clearloci verify examples/five_bar.yaml examples/tasks/pick_and_place.yaml\n"
      "Exit status: 0 verified: proven for every pose of the task and every load; 1 refuted: a witness is confirmed\n"
      "numerically; 3 undecided within the time limit or the resolution of doubles.\n"
      "The files go to ./out/<name of MODEL>, or to the folder of -o.");
  return {app, [arguments] {
            return run_within(arguments->common, [&](TimeLimit& limit) { return run(*arguments, limit); });
          }};
}

}  // namespace clearloci::cli
