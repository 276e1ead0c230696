// clearloci validate: the traced loci held against reactions solved numerically on a grid.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "analysis/loci.hpp"
#include "cli/commands.hpp"
#include "cli/loci_arguments.hpp"
#include "cli/memory_bound.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/validation.hpp"

namespace clearloci::cli {
namespace {

struct ValidateCommand {
  CommonArguments common;
  LociArguments loci;
  std::string grid;
};

numeric::GridSpec grid_of(const ValidateCommand& arguments, const mechanism::Mechanism& mechanism) {
  const std::size_t coordinates = mechanism.coordinates.size();
  const std::string usual = coordinates == 1 ? "4000" : coordinates == 3 ? "40x40x40" : "400x400";
  const std::string& words = arguments.grid.empty() ? usual : arguments.grid;
  const std::vector<int> along = parse_grid(words, coordinates);
  numeric::GridSpec grid;
  grid.nx = along[0];
  if (coordinates > 1) grid.ny = along[1];
  if (coordinates > 2) grid.nz = along[2];
  // Those that are held at once: over three coordinates a row.
  const double nodes = coordinates == 3 ? *std::max_element(along.begin(), along.end())
                                        : std::accumulate(along.begin(), along.end(), 1.0, std::multiplies<>());
  // At every node of one mode |A| and the numerators.
  require_memory(nodes * 8 * (2.0 + static_cast<double>(mechanism::unknowns(mechanism).size())), "--grid", words);
  return grid;
}

int run(const ValidateCommand& arguments, TimeLimit& limit) {
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  limit.known([common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "validation.json", incomplete_body(name, "the outcome was"), false);
  });
  Progress progress(arguments.common.quiet);
  LociRequest request = loci_request(arguments.loci, mechanism, progress, limit);
  require_coordinates(mechanism, 1, 3, "loci are held against a grid");
  const numeric::GridSpec grid = grid_of(arguments, mechanism);
  const core::Validation validation = validate_loci(mechanism, std::move(request), grid);
  progress.clear();

  report::StagedFiles staged;
  if (!arguments.common.output.empty()) report::stage_answer(staged, validation, output_folder(arguments.common));
  limit.commit(staged);
  if (arguments.common.json)
    fmt::print("{}", report::json_text(report::validation_object(validation)));
  else if (!arguments.common.quiet)
    fmt::print("{}", report::validation_text(validation));
  return validation.validated() ? exit_done : exit_check_said_no;
}

}  // namespace

Command add_validate_command(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("validate", "Compare the loci with reactions that are solved numerically on a grid");
  const auto arguments = std::make_shared<ValidateCommand>();
  add_common_arguments(*app, arguments->common);
  add_tracing_arguments(*app, arguments->loci);
  add_controlled_argument(*app, arguments->loci);
  app->add_option("--grid", arguments->grid,
                  "Nodes along each coordinate (default: 400x400, over one 4000, over three 40x40x40)")
      ->type_name("NXxNY|NXxNYxNZ|N");
  app->footer(
      "Example: clearloci validate examples/five_bar.yaml --grid 400x400\n"
      "Exit status 1 if reactions contradict the loci. With -o, DIR/validation.json is written.");
  return within_limit(app, arguments, run);
}

}  // namespace clearloci::cli
