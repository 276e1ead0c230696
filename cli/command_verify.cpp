// clearloci verify: does the mechanism keep clear of its discontinuity loci over a task?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/framed.hpp"
#include "analysis/model.hpp"
#include "analysis/task_certificate.hpp"
#include "clearloci/verify.hpp"
#include "cli/certificate_argument.hpp"
#include "cli/commands.hpp"
#include "cli/loci_arguments.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "mechanism/write_task.hpp"
#include "report/files.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
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

TaskFit parse_fit(const std::string& word) {
  if (word.empty()) return TaskFit::none;
  if (word == "nearest") return TaskFit::nearest;
  if (word == "best") return TaskFit::best;
  if (word == "largest") return TaskFit::largest;
  throw core::InputError({.file = "--fit"}, fmt::format("unknown goal '{}'", word),
                         "choose from nearest, best, largest");
}

/// Whether a task is certified with the loci around it: what these do not cover is certified of the task alone.
bool goes_with_loci(const mechanism::Mechanism& mechanism, const core::Task& task) {
  const bool more =
      !task.tolerances.empty() || task.min_force || task.min_couple || task.loads || !task.loads_within.empty();
  return has_certified_loci(mechanism) && (!more || task.pose_error);
}

/// The loci of the file's load with their cells, and the task where it was verified.
void certify_with_loci(const VerifyCommand& arguments, const mechanism::Mechanism& mechanism,
                       const Verification& result, const LociRequest& request, report::StagedFiles& staged) {
  core::Certificate certificate;
  trace_loci(mechanism, request, &certificate);
  const bool nominal = result.verified() && !result.task.loads && result.task.tolerances.empty() &&
                       result.task.loads_within.empty() && !result.task.pose_error;
  const core::Task task = in_frame(result.task, certificate);
  stage_certificate(staged, arguments.certificate, "verify", arguments.common, certificate, nominal ? &task : nullptr);
}

void certify(const VerifyCommand& arguments, const mechanism::Mechanism& mechanism, const Verification& result,
             const LociRequest& request, report::StagedFiles& staged) {
  if (goes_with_loci(mechanism, result.task)) return certify_with_loci(arguments, mechanism, result, request, staged);
  if (!result.verified()) return;
  stage_certificate(staged, arguments.certificate, "verify", arguments.common,
                    certificate_of(mechanism, result.task, request));
}

/// The efforts that a task was verified with, as --preload gives them: those of the task, or what was found.
std::vector<Model::Value> efforts_of(const Model& model, const Verification& result) {
  std::vector<Model::Value> efforts;
  const auto joint_of = [&](const std::string& name) -> const mechanism::Joint& {
    const std::vector<mechanism::Joint>& all = model.content().mechanism.joints;
    return *std::find_if(all.begin(), all.end(), [&](const mechanism::Joint& joint) { return joint.name == name; });
  };
  const auto add = [&](const mechanism::Joint& joint, const core::Rational& value) {
    const char* const unit = mechanism::actuator_quantity(joint) == core::Quantity::F ? " N" : " N m";
    efforts.emplace_back(joint.free_effort->parameter, "(" + core::to_string(value) + ")" + unit);
  };
  for (const auto& [joint, value] : result.task.preload) add(joint_of(joint), value);
  if (!result.preload) return efforts;
  const core::PreloadAnswer& found = *result.preload;
  if (found.law) efforts.emplace_back(joint_of(found.joints.front()).free_effort->parameter, found.law->expression);
  for (std::size_t i = 0; found.value && i < found.joints.size(); ++i)
    add(joint_of(found.joints[i]), core::Rational((*found.value)[i]));
  return efforts;
}

/// With the efforts that were found as if they had been given: they are part of what is claimed.
void certify_efforts(VerifyCommand arguments, const Model& model, Verification result, const LociRequest& request,
                     report::StagedFiles& staged) {
  if (result.preload && result.preload->of_poses) {
    if (!result.verified()) return;
    const mechanism::Mechanism& mechanism = model.content().mechanism;
    require_certifiable(result.task);
    return stage_certificate(staged, arguments.certificate, "verify", arguments.common,
                             certificate_of(mechanism, result.task, request), result.preload->cells_of_law);
  }
  const std::vector<Model::Value> efforts = efforts_of(model, result);
  for (const auto& [name, value] : efforts) arguments.common.overrides.push_back(name + "=" + value);
  result.task.preload.clear();
  result.task.controlled_preload = false;
  const Model chosen = efforts.empty() ? model : model.with(efforts);
  certify(arguments, chosen.content().mechanism, result, request, staged);
}

int run(const VerifyCommand& arguments, TimeLimit& limit) {
  const std::set<std::string> formats = parse_formats(arguments.formats, report::format_names<core::Verification>());
  const std::future<void> letters = report::prepare_pictures(formats);
  const Model model = Model::read(arguments.common.model, parse_overrides(arguments.common.overrides));
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  VerifyRequest request{.fit = parse_fit(arguments.fit)};
  const Task task = read_task(arguments.task, model);
  const bool certified = !arguments.certificate.empty();
  if (certified && !goes_with_loci(mechanism, task)) require_certifiable(task);
  limit.known([common = arguments.common, name = mechanism.name] {
    nlohmann::ordered_json body = incomplete_body(name, "the verdict was");
    body["verdict"] = to_string(core::Verdict::undecided);
    body["verified"] = false;
    write_incomplete(common, "verify.json", body);
  });
  Progress progress(arguments.common.quiet);
  request.loci = loci_request(arguments.loci, mechanism, progress, limit);
  const Verification result = verify(model, task, request);
  report::StagedFiles staged;
  if (certified) certify_efforts(arguments, model, result, request.loci, staged);
  progress.clear();

  const std::filesystem::path folder = output_folder(arguments.common);
  std::vector<std::filesystem::path> files = report::stage_answer(staged, result, folder, formats);
  const bool placed = result.moved_by || result.scaled_by;
  if (placed && !std::holds_alternative<core::TaskMesh>(result.task.shape)) {
    files.push_back(folder / moved_task);
    staged.add(files.back(), mechanism::task_text(result.task, mechanism));
  }
  limit.commit(staged);
  if (arguments.common.json)
    fmt::print("{}", report::json_text(report::verification_object(result)));
  else if (!arguments.common.quiet)
    fmt::print("{}\n{}", report::verification_text(result), written_words(folder, files));
  if (certified && !result.verified() && !arguments.common.json && !arguments.common.quiet)
    fmt::print("No certificate of the task: it is not verified.\n");
  return status_of(result.verdict);
}

}  // namespace

Command add_verify_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("verify", "Prove that a task keeps clear of every discontinuity locus");
  const auto arguments = std::make_shared<VerifyCommand>();
  add_common_arguments(*app, arguments->common);
  app->add_option(
         "TASK", arguments->task,
         "The task file: a box, ball (over two lengths a circle), polygon or path of poses, over three lengths "
         "a mesh")
      ->required();
  add_tracing_arguments(*app, arguments->loci);
  add_locus_arguments(*app, arguments->loci);
  app->add_option("--fit", arguments->fit,
                  "Move the task to the nearest place at which it is verified, or to the place of the largest margin "
                  "(best); or scale it to the largest size at which it is verified")
      ->type_name("nearest|best|largest")
      ->expected(0, 1)
      ->default_str("nearest");
  add_export_argument(*app, arguments->formats,
                      fmt::format("Pictures besides verify.json, comma-separated: {}",
                                  fmt::join(report::format_names<core::Verification>(), ", ")));
  add_certificate_argument(*app, arguments->certificate, "only if the task is verified");
  app->footer(
      "Example: clearloci verify examples/five_bar.yaml examples/tasks/pick_and_place.yaml\n"
      "Exit status: 0 verified: proven for every pose of the task and every load; 1 refuted: a pose at which the\n"
      "task fails is confirmed numerically; 3 undecided within the time limit or the resolution of doubles.");
  return within_limit(app, arguments, run);
}

}  // namespace clearloci::cli
