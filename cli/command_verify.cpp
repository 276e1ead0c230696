// clearloci verify: does the mechanism keep clear of its discontinuity loci over a task?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/certificate_argument.hpp"
#include "cli/commands.hpp"
#include "cli/loci_arguments.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "cli/verification.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "mechanism/read_task.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/picture.hpp"
#include "report/wording.hpp"

namespace clearloci::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  CommonArguments common;
  LociArguments loci;
  std::string task, fit;
  std::string formats = "svg,png";
  std::string certificate;
};

const std::set<std::string> known_formats = {"pdf", "png", "svg"};

std::set<std::string> parse_formats(const std::string& text) {
  std::set<std::string> formats;
  for (const std::string& word : split(text)) {
    if (!known_formats.contains(word))
      throw core::InputError({.file = "--export"}, fmt::format("unknown format '{}'", word),
                             fmt::format("choose from {}", fmt::join(known_formats, ", ")));
    formats.insert(word);
  }
  return formats;
}

/// Exact numbers of a shape, rounded.
Json point_json(const core::RationalPoint& p) { return {core::to_double(p[0]), core::to_double(p[1])}; }

Json points_json(const std::vector<core::RationalPoint>& points) {
  Json list = Json::array();
  for (const core::RationalPoint& p : points) list.push_back(point_json(p));
  return list;
}

Json shape_json(const core::TaskShape& shape) {
  if (const auto* box = std::get_if<core::TaskBox>(&shape))
    return {{"lower", point_json(box->lower)}, {"upper", point_json(box->upper)}};
  if (const auto* circle = std::get_if<core::TaskCircle>(&shape))
    return {{"centre", point_json(circle->centre)}, {"radius", core::to_double(circle->radius)}};
  if (const auto* polygon = std::get_if<core::TaskPolygon>(&shape)) return points_json(polygon->corners);
  return points_json(std::get<core::TaskPath>(shape).points);
}

Json result_json(const Verification& result) {
  const core::LocusMap& loci = result.map.loci;
  Json root = {{"format", 1},
               {"mechanism", report::printable(loci.mechanism)},
               {"working_mode", report::mode_object(loci.tower, result.mode)},
               {"task", {{core::kind_of(result.task.shape), shape_json(result.task.shape)}}},
               {"verdict", to_string(result.verdict)},
               {"verified", result.verified()},
               {"zone", result.zone.empty() ? Json(nullptr) : Json(result.zone)},
               {"margin", result.verified() ? Json(result.margin) : Json(nullptr)},
               {"nearest", nullptr},
               {"witness", nullptr},
               {"open", nullptr}};
  if (result.by) root["moved_by"] = point_json(*result.by);
  if (result.nearest) {
    const NearestOfTask& nearest = *result.nearest;
    Json joints = Json::array();
    for (const core::Vanishing& v : nearest.vanishing)
      if (std::find(joints.begin(), joints.end(), v.joint) == joints.end()) joints.push_back(v.joint);
    root["nearest"] = {{"curve", nearest.curve.empty() ? Json(nullptr) : Json(nearest.curve)},
                       {"kind", core::to_string(nearest.kind)},
                       {"joints", std::move(joints)},
                       {"vanishing", report::vanishing_array(nearest.vanishing)},
                       {"at", nearest.at},
                       {"distance", nearest.distance}};
  }
  if (result.witness) {
    const TaskWitness& witness = *result.witness;
    root["witness"] = {{"at", witness.at},
                       {"load", witness.load ? Json(*witness.load) : Json(nullptr)},
                       {"distance", witness.distance},
                       {"reason", witness.reason},
                       {"vanishing", report::vanishing_array(witness.vanishing)},
                       {"too_small", report::vanishing_array(witness.too_small)},
                       {"size", witness.size ? Json(*witness.size) : Json(nullptr)}};
  }
  if (result.open)
    root["open"] = {{"lower", result.open->lower},
                    {"upper", result.open->upper},
                    {"cells", result.open->cells},
                    {"reason", result.open->reason}};
  root["notes"] = result.notes;
  return root;
}

const char* verdict_line(loci::TaskVerdict verdict) {
  switch (verdict) {
    case loci::TaskVerdict::verified:
      return "VERIFIED      no locus, singularity or boundary in the task: proven";
    case loci::TaskVerdict::refuted:
      return "REFUTED       the task fails at the witness, confirmed numerically";
    case loci::TaskVerdict::undecided:
      break;
  }
  return "UNDECIDED     neither proven nor refuted";
}

int status_of(loci::TaskVerdict verdict) {
  switch (verdict) {
    case loci::TaskVerdict::verified:
      return exit_done;
    case loci::TaskVerdict::refuted:
      return exit_check_said_no;
    case loci::TaskVerdict::undecided:
      break;
  }
  return exit_limit_reached;
}

void print_result(const Verification& result, bool fit) {
  const core::LocusMap& loci = result.map.loci;
  fmt::print("{}: {}", report::printable(loci.mechanism), core::kind_of(result.task.shape));
  const std::string mode = report::printable(report::mode_words(loci.tower, result.mode));
  fmt::print("{}\n\n", mode.empty() ? "" : "; " + mode);
  if (result.by)
    fmt::print("moved by      ({:.6f}, {:.6f}) m\n", core::to_double((*result.by)[0]),
               core::to_double((*result.by)[1]));
  else if (fit)
    fmt::print("No place in the box was found that verifies; where the task lies:\n");
  fmt::print("{}\n", verdict_line(result.verdict));
  if (!result.zone.empty()) fmt::print("zone          {}\n", result.zone);
  if (result.verified()) fmt::print("margin        at least {:.6g} m, proven\n", result.margin);
  if (result.nearest) {
    const NearestOfTask& nearest = *result.nearest;
    fmt::print("nearest       {}{}{}{} at ({:.6f}, {:.6f}), {}\n", report::kind_words(nearest.kind),
               nearest.vanishing.empty() ? "" : " ", report::reaction_names(nearest.vanishing),
               nearest.isolated        ? ", an isolated point"
               : nearest.curve.empty() ? ""
                                       : " on " + nearest.curve,
               nearest.at[0], nearest.at[1],
               nearest.distance > 1e-12 ? fmt::format("{:.6g} m away", nearest.distance) : "in the task");
  }
  if (result.witness)
    fmt::print("witness       ({:.9f}, {:.9f}): {}\n", result.witness->at[0], result.witness->at[1],
               result.witness->reason);
  if (result.open)
    fmt::print("open          {} cell{} in [{:.9f}, {:.9f}] x [{:.9f}, {:.9f}]: {}; the rest is proven\n",
               result.open->cells, result.open->cells == 1 ? "" : "s", result.open->lower[0], result.open->upper[0],
               result.open->lower[1], result.open->upper[1], result.open->reason);
  for (const std::string& note : result.notes) fmt::print("{}\n", report::printable(note));
}

std::vector<std::string> write_files(const Verification& result, const std::set<std::string>& formats,
                                     const std::filesystem::path& folder) {
  std::vector<std::string> names;
  const auto write = [&](const std::string& name, const std::string& bytes) {
    report::write_atomically(folder / name, bytes);
    names.push_back(name);
  };
  write("verify.json", report::json_text(result_json(result)));
  report::TaskMark mark;
  mark.outline = loci::TaskRegion(result.task.shape).outline();
  mark.filled = !std::holds_alternative<core::TaskPath>(result.task.shape);
  mark.verified = result.verified();
  mark.margin = result.verified() ? result.margin : core::to_double(result.task.margin);
  if (result.witness)
    mark.points.push_back(result.witness->at);
  else if (result.nearest)
    mark.points.push_back(result.nearest->at);
  const auto picture = [&](const char* format, report::PictureFormat kind) {
    if (formats.contains(format))
      write(std::string("verify.") + format, report::task_picture(result.map, result.mode, mark, kind));
  };
  picture("svg", report::PictureFormat::svg);
  picture("png", report::PictureFormat::png);
  picture("pdf", report::PictureFormat::pdf);
  return names;
}

std::optional<loci::FitGoal> parse_fit(const std::string& word) {
  if (word.empty()) return std::nullopt;
  if (word == "nearest") return loci::FitGoal::nearest;
  if (word == "best") return loci::FitGoal::best;
  throw core::InputError({.file = "--fit"}, fmt::format("unknown goal '{}'", word), "choose from nearest, best");
}

/// The loci of the file's load with their cells, and the task where it was verified.
void certify(const Arguments& arguments, const mechanism::Mechanism& mechanism, const Verification& result,
             LociRequest request) {
  core::Certificate certificate;
  request.certificate = &certificate;
  const core::LocusMap map = trace_loci(mechanism, request);
  write_certificate(arguments.certificate, "verify", arguments.common, certificate, map,
                    {.task = result.verified() && !result.task.loads ? &result.task : nullptr});
}

int run(const Arguments& arguments, TimeLimit& limit) {
  const std::set<std::string> formats = parse_formats(arguments.formats);
  const std::optional<loci::FitGoal> goal = parse_fit(arguments.fit);
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  const core::Task task = mechanism::read_task(arguments.task, mechanism);
  if (!arguments.certificate.empty()) require_certifiable(mechanism);
  limit.known([common = arguments.common, name = mechanism.name] {
    Json body = incomplete_body(name, "the verdict was");
    body["verdict"] = to_string(loci::TaskVerdict::undecided);
    body["verified"] = false;
    write_incomplete(common, "verify.json", body);
  });
  Progress progress(arguments.common.quiet);
  const LociRequest request = loci_request(arguments.loci, mechanism, progress, limit);
  if (request.all_working_modes || request.working_modes.size() > 1)
    throw core::InputError({.file = "--working-mode"}, "a task is verified in one working mode",
                           "give one side for each dyad");
  const Verification result = goal ? fit_task(mechanism, task, request, *goal) : verify_task(mechanism, task, request);
  if (!arguments.certificate.empty()) certify(arguments, mechanism, result, request);
  progress.clear();
  limit.writing();

  const std::filesystem::path folder = output_folder(arguments.common);
  const std::vector<std::string> files = write_files(result, formats, folder);
  if (arguments.common.json) {
    fmt::print("{}", report::json_text(result_json(result)));
  } else if (!arguments.common.quiet) {
    print_result(result, goal.has_value());
    fmt::print("\nWritten to {}: {}\n", core::printable(folder.string()), fmt::join(files, ", "));
  }
  return status_of(result.verdict);
}

}  // namespace

Command add_verify_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("verify", "Prove that a task keeps clear of every discontinuity locus");
  const auto arguments = std::make_shared<Arguments>();
  add_common_arguments(*app, arguments->common);
  app->add_option("TASK", arguments->task, "The task file: a box, circle, polygon or path")->required();
  add_tracing_arguments(*app, arguments->loci);
  add_locus_arguments(*app, arguments->loci);
  app->add_option("--fit", arguments->fit,
                  "Move the task: to the nearest place that verifies, or to the best, with the largest margin")
      ->type_name("nearest|best")
      ->expected(0, 1)
      ->default_str("nearest");
  app->add_option("--export", arguments->formats,
                  fmt::format("Pictures besides verify.json, several after commas: {}", fmt::join(known_formats, ", ")))
      ->type_name("LIST")
      ->capture_default_str();
  add_certificate_argument(*app, arguments->certificate);
  app->footer(
      "Example: clearloci verify examples/five_bar.yaml examples/tasks/pick_and_place.yaml\n"
      "Ends with 0 where the task is verified: proven for every pose of it and every load; with 1 where it is refuted: "
      "a\n"
      "witness is confirmed numerically; with 3 where it is undecided, within the time limit or by doubles at all.\n"
      "The files go to ./out/<name of MODEL>, or to the folder of -o.");
  return {app, [arguments] {
            return run_within(arguments->common, [&](TimeLimit& limit) { return run(*arguments, limit); });
          }};
}

}  // namespace clearloci::cli
