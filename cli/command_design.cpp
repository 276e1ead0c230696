// clearloci design: which of many designs are good, and which is best?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "clearloci/study.hpp"
#include "cli/commands.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "cli/standard_streams.hpp"
#include "cli/time_limit.hpp"
#include "core/errors.hpp"
#include "core/shown_units.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/study.hpp"
#include "studies/mpi_ranks.hpp"

namespace clearloci::cli {
namespace {

struct DesignCommand {
  CommonArguments common;
  std::string study;
  std::string formats = "csv,svg,png,html";
  std::string threads;
  bool resume = false;
};

int parse_threads(const std::string& text) {
  if (text.empty()) return 0;
  const core::Rational number = parse_positive(text, "--threads", mechanism::Mechanism{});
  if (number.get_den() != 1 || number > most_threads)
    throw core::InputError({.file = "--threads"}, "'" + text + "' is no number of threads",
                           fmt::format("write a number to {}", most_threads));
  return static_cast<int>(number.get_num().get_si());
}

std::string words_of(const StudyProgress& progress) {
  std::string words = fmt::format("{} of {}, {} feasible", progress.done, progress.total, progress.feasible);
  if (progress.best) words += fmt::format(", best {:.4g}", *progress.best);
  return words + fmt::format(", {:.0f} s left", progress.seconds_left);
}

/// What verify says of the best design, a task each.
std::vector<Verification> proofs_of(const Model& best, const Study& study, const TimeLimit& limit) {
  std::vector<Verification> proofs;
  for (const Task& task : required_tasks(study))
    proofs.push_back(verify(best, task, {.loci = {.deadline = limit.deadline()}}));
  return proofs;
}

/// Of several tasks the worst: the first that is not verified, else that of the least margin.
std::string words_of(const std::vector<Verification>& proofs) {
  const auto worse = [](const Verification& a, const Verification& b) {
    return a.verified() != b.verified() ? !a.verified() : a.margin < b.margin;
  };
  const Verification& proof = *std::min_element(proofs.begin(), proofs.end(), worse);
  return proof.verified() ? fmt::format("verify: VERIFIED, margin at least {}",
                                        core::told(proof.margin.value_or(0), "m", proof.units))
                          : fmt::format("verify: {}", to_string(proof.verdict));
}

/// Of rank 0, or of the only process there is.
int lead(const DesignCommand& arguments, const StudyRanks* ranks, TimeLimit& limit) {
  const std::set<std::string> formats = parse_formats(arguments.formats, report::study_format_names());
  const Model model = Model::read(arguments.common.model, parse_overrides(arguments.common.overrides));
  const Study study = read_study(arguments.study, model);
  const std::filesystem::path folder = output_folder(arguments.common);
  Progress progress(arguments.common.quiet);
  StudyOptions options;
  options.table = folder / "designs.table";
  options.resume = arguments.resume;
  options.threads = parse_threads(arguments.threads);
  options.deadline = limit.deadline();
  options.ranks = ranks;
  if (ranks != nullptr && ranks->rank != 0) {
    (void)run_study(model, study, options);
    return exit_done;
  }
  options.progress = [&](const StudyProgress& study_progress) {
    progress.show(static_cast<double>(study_progress.done) /
                      static_cast<double>(std::max<std::uint64_t>(study_progress.total, 1)),
                  words_of(study_progress));
  };
  const StudyResult result = run_study(model, study, options);
  progress.clear();
  const StudyDesign* best = result.best ? &result.designs[*result.best] : nullptr;
  const std::vector<Verification> proofs =
      best != nullptr ? proofs_of(design_model(model, result, *best), study, limit) : std::vector<Verification>{};
  report::StagedFiles staged;
  std::vector<std::filesystem::path> files = report::stage_study(staged, result, folder, formats);
  if (best != nullptr) {
    files.push_back(folder / "best.yaml");
    staged.add(files.back(), design_text(model, result, *best));
    for (const std::size_t index : result.front)
      staged.add(folder / "front" / fmt::format("{}.yaml", result.designs[index].index),
                 design_text(model, result, result.designs[index]));
    if (!result.front.empty()) files.push_back(folder / "front");
  }
  if (formats.contains("html")) {
    files.push_back(folder / "report.html");
    staged.add(files.back(), report::study_page(result, proofs));
  }
  limit.commit(staged);
  if (arguments.common.json) {
    fmt::print("{}", report::json_text(report::study_object(result)));
  } else if (!arguments.common.quiet) {
    fmt::print("{}", report::study_text(result));
    if (!proofs.empty()) fmt::print("  {}\n", words_of(proofs));
    fmt::print("\n{}", written_words(folder, files));
  }
  return result.complete ? exit_done : exit_limit_reached;
}

int run(const DesignCommand& arguments, TimeLimit& limit) {
  if (!started_by_mpi()) return lead(arguments, nullptr, limit);
  const MpiRanks mpi;
  const StudyRanks& ranks = mpi.ranks();
  try {
    return lead(arguments, &ranks, limit);
  } catch (const core::InputError&) {
    if (ranks.rank == 0) throw;
    return exit_wrong_input;  // rank 0 says what is wrong
  } catch (const std::exception& error) {
    if (ranks.rank == 0 && dynamic_cast<const core::LimitReached*>(&error) != nullptr) throw;
    complain(error.what());
    mpi.abort(exit_internal_error);
  }
}

}  // namespace

Command add_design_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("design", "Check many designs for a task, and find the best one");
  const auto arguments = std::make_shared<DesignCommand>();
  add_common_arguments(*app, arguments->common);
  app->add_option("STUDY", arguments->study, "The study file: what varies, the task, the goal, the method")->required();
  app->add_flag("--resume", arguments->resume, "Continue a run of the same study that was stopped");
  app->add_option("--threads", arguments->threads,
                  "Number of designs that are checked at the same time (default: the number of cores)")
      ->type_name("COUNT");
  add_export_argument(
      *app, arguments->formats,
      fmt::format("Files besides designs.json, comma-separated: {}", fmt::join(report::study_format_names(), ", ")));
  app->footer(
      "Example: clearloci design examples/five_bar.yaml examples/studies/link_lengths.yaml\n"
      "Exit status 3: the time limit was reached; --resume continues. The same study gives the same files with any\n"
      "number of threads.");
  return within_limit(app, arguments, run);
}

}  // namespace clearloci::cli
