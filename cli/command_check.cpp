// clearloci check: the second opinion on a certificate.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "check/check.hpp"
#include "cli/commands.hpp"
#include "cli/program.hpp"
#include "cli/time_limit.hpp"
#include "report/loci_json.hpp"
#include "report/wording.hpp"

namespace clearloci::cli {
namespace {

struct CheckCommand {
  CommonArguments common;  ///< of which the model, the limit and --json are asked for here
  std::string certificate;
};

int run(const CheckCommand& arguments, TimeLimit& limit) {
  limit.known([json = arguments.common.json] {
    if (json) fmt::print("{}", report::json_text({{"accepted", false}, {"complete", false}}));
  });
  const check::Examination examination =
      check::check_certificate(arguments.common.model, arguments.certificate, limit.deadline());
  limit.writing();
  const std::string why = report::printable(examination.why);
  if (arguments.common.json) {
    fmt::print("{}", report::json_text({{"accepted", examination.accepted},
                                        {"why", why},
                                        {"cells", examination.cells},
                                        {"graphs", examination.graphs},
                                        {"crossings", examination.crossings},
                                        {"arcs", examination.arcs},
                                        {"points", examination.points},
                                        {"zones", examination.zones},
                                        {"task_cells", examination.task_cells},
                                        {"refuted_patterns", examination.refuted_patterns},
                                        {"open_share", examination.open_share},
                                        {"unchecked", examination.unchecked}}));
  } else if (!examination.accepted) {
    fmt::print("rejected: {}\n", why);
  } else if (examination.cells == 0 && examination.task_cells > 0) {
    if (examination.refuted_patterns > 0)
      fmt::print("accepted: no efforts keep the task clear, by {} patterns of signs\n", examination.refuted_patterns);
    else if (examination.zones == 0)
      fmt::print("accepted: the task, over {} cells\n", examination.task_cells);
    else
      fmt::print("accepted: {} intervals without loci, {} points, over {} cells\n", examination.zones,
                 examination.points, examination.task_cells);
    for (const std::string& what : examination.unchecked) fmt::print("unchecked: {}\n", report::printable(what));
  } else {
    fmt::print("accepted: {} cells, {} graphs, {} crossings, {} arcs, {} points", examination.cells, examination.graphs,
               examination.crossings, examination.arcs, examination.points);
    if (examination.zones > 0) fmt::print(", {} zones", examination.zones);
    if (examination.open_share > 0)
      fmt::print(
          "; unchecked: {:.2g} % of the area (around places where a sheet is not smooth, or left to the exact engine)",
          100 * examination.open_share);
    fmt::print("\n");
    for (const std::string& what : examination.unchecked) fmt::print("unchecked: {}\n", report::printable(what));
  }
  return examination.accepted ? exit_done : exit_check_said_no;
}

}  // namespace

Command add_check_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("check", "Check a certificate against the model, with independent code");
  const auto arguments = std::make_shared<CheckCommand>();
  app->add_option("MODEL", arguments->common.model, "The mechanism file that the certificate was made for")->required();
  app->add_option("FILE", arguments->certificate,
                  "The certificate, which the option --certificate of loci, zones or verify wrote")
      ->required();
  app->add_option("--time-limit", arguments->common.time_limit,
                  "Largest time. When it is over, the check ends with exit status 3")
      ->type_name("SECONDS");
  app->add_flag("--json", arguments->common.json, "Print the result of the check as JSON");
  app->footer(
      "Example: clearloci loci examples/five_bar.yaml --certificate out/five_bar.cert\n"
      "         clearloci check examples/five_bar.yaml out/five_bar.cert\n"
      "Exit status: 0 every claim is confirmed; 1 a claim is not; 2 a file cannot be read.");
  return within_limit(app, arguments, run);
}

}  // namespace clearloci::cli
