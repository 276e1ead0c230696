// clearloci check: the second opinion on a certificate.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "check/check.hpp"
#include "cli/commands.hpp"
#include "cli/program.hpp"
#include "report/loci_json.hpp"
#include "report/wording.hpp"

namespace clearloci::cli {
namespace {

struct Arguments {
  std::string model, certificate;
  double time_limit = 0;
  bool json = false;
};

int run(const Arguments& arguments) {
  check::Deadline deadline;
  constexpr double century = 3e9;  // beyond, the clock's ticks would overflow
  if (arguments.time_limit > 0 && arguments.time_limit < century)
    deadline = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                      std::chrono::duration<double>(arguments.time_limit));
  const check::Verdict verdict = check::check_certificate(arguments.model, arguments.certificate, deadline);
  const std::string why = report::printable(verdict.why);
  if (arguments.json) {
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
      fmt::print("; unchecked: {:.2g} % of the area (cells around places where the sheet is not smooth)",
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
  app->add_option("MODEL", arguments->model, "The mechanism file that the certificate was made for")->required();
  app->add_option("FILE", arguments->certificate, "What --certificate of loci or zones wrote")->required();
  app->add_option("--time-limit", arguments->time_limit, "Seconds; then nothing is said, and the exit status is 3")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber);
  app->add_flag("--json", arguments->json, "Print the verdict as JSON");
  app->footer(
      "Example: clearloci loci examples/five_bar.yaml --certificate out/five_bar.cert\n"
      "         clearloci check examples/five_bar.yaml out/five_bar.cert\n"
      "Ends with 0 where every claim was shown, with 1 where one was not, with 2 where a file cannot be read.");
  return {app, [arguments] { return run(*arguments); }};
}

}  // namespace clearloci::cli
