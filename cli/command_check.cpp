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

struct Arguments {
  CommonArguments common;  ///< of which the model, the limit and --json are asked for here
  std::string certificate;
};

int run(const Arguments& arguments, TimeLimit& limit) {
  limit.known([json = arguments.common.json] {
    if (json) fmt::print("{}", report::json_text({{"accepted", false}, {"complete", false}}));
  });
  const check::Verdict verdict =
      check::check_certificate(arguments.common.model, arguments.certificate, limit.deadline());
  limit.writing();
  const std::string why = report::printable(verdict.why);
  if (arguments.common.json) {
    fmt::print("{}", report::json_text({{"accepted", verdict.accepted},
                                        {"why", why},
                                        {"cells", verdict.cells},
                                        {"graphs", verdict.graphs},
                                        {"crossings", verdict.crossings},
                                        {"arcs", verdict.arcs},
                                        {"points", verdict.points},
                                        {"zones", verdict.zones},
                                        {"open_share", verdict.open_share},
                                        {"unchecked", verdict.unchecked}}));
  } else if (!verdict.accepted) {
    fmt::print("rejected: {}\n", why);
  } else {
    fmt::print("accepted: {} cells, {} graphs, {} crossings, {} arcs, {} points", verdict.cells, verdict.graphs,
               verdict.crossings, verdict.arcs, verdict.points);
    if (verdict.zones > 0) fmt::print(", {} zones", verdict.zones);
    if (verdict.open_share > 0)
      fmt::print(
          "; unchecked: {:.2g} % of the area (around places where a sheet is not smooth, or left to the exact engine)",
          100 * verdict.open_share);
    fmt::print("\n");
    for (const std::string& what : verdict.unchecked) fmt::print("unchecked: {}\n", report::printable(what));
  }
  return verdict.accepted ? exit_done : exit_check_said_no;
}

}  // namespace

Command add_check_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("check", "Verify a certificate from the model, by means of its own");
  const auto arguments = std::make_shared<Arguments>();
  app->add_option("MODEL", arguments->common.model, "The mechanism file that the certificate was made for")->required();
  app->add_option("FILE", arguments->certificate, "What --certificate of loci or zones wrote")->required();
  app->add_option("--time-limit", arguments->common.time_limit,
                  "Seconds; then nothing is said, and the exit status is 3")
      ->type_name("SECONDS");
  app->add_flag("--json", arguments->common.json, "Print the verdict as JSON");
  app->footer(
      "Example: clearloci loci examples/five_bar.yaml --certificate out/five_bar.cert\n"
      "         clearloci check examples/five_bar.yaml out/five_bar.cert\n"
      "Ends with 0 where every claim was shown, with 1 where one was not, with 2 where a file cannot be read.");
  return {app, [arguments] {
            return run_within(arguments->common, [&](TimeLimit& limit) { return run(*arguments, limit); });
          }};
}

}  // namespace clearloci::cli
