// clearloci validate: the traced loci held against reactions solved numerically on a grid.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/loci_arguments.hpp"
#include "cli/memory_bound.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/validation.hpp"
#include "report/wording.hpp"

namespace clearloci::cli {
namespace {

struct Arguments {
  CommonArguments common;
  LociArguments loci;
  std::string grid = "400x400";
};

std::string reaction_name(const numeric::TracedReaction& reaction) {
  return fmt::format("{}_{}", to_string(reaction.quantity), reaction.joint);
}

void print_table(const LociValidation& validation, const numeric::GridSpec& grid) {
  constexpr std::size_t edges_shown = 20;
  const numeric::ValidationReport& report = validation.report;
  fmt::print("{}: loci against reactions at {} x {} nodes\n", validation.map.mechanism, grid.nx, grid.ny);
  const core::WorkingMode* mode = nullptr;
  for (const numeric::ReactionTally& tally : report.tallies) {
    if (mode == nullptr || *mode != tally.mode) {
      const std::string words = report::mode_words(validation.map.tower, tally.mode);
      fmt::print("\n{:<16}{:>10}{:>10}{:>10}{:>10}  edges{}{}\n", "reaction", "held", "disputed", "undecided",
                 "outside", words.empty() ? "" : "; ", words);
      mode = &tally.mode;
    }
    const std::string name = reaction_name(tally.reaction);
    if (tally.identically_zero)
      fmt::print("{:<16}{:>10}\n", name, "zero in every pose");
    else
      fmt::print("{:<16}{:>10}{:>10}{:>10}{:>10}\n", name, tally.held, tally.disputed, tally.undecided, tally.outside);
  }
  fmt::print("\n{} edges held, {} disputed, {} undecided, {} outside\n", report.held, report.disputed, report.undecided,
             report.outside);
  for (std::size_t i = 0; i < report.disputed_edges.size() && i < edges_shown; ++i) {
    const numeric::DisputedEdge& edge = report.disputed_edges[i];
    const std::string words = report::mode_words(validation.map.tower, edge.mode);
    fmt::print("disputed: {} {} from ({}, {}) to ({}, {}), crossed by {} arcs{}{}\n", reaction_name(edge.reaction),
               edge.sign_change ? "changes sign" : "keeps its sign", edge.from[0], edge.from[1], edge.to[0], edge.to[1],
               edge.crossings, words.empty() ? "" : "; ", words);
  }
  if (report.disputed_edges.size() > edges_shown) fmt::print("... --json lists more disputed edges\n");
  fmt::print("{} reactions along arcs held, {} disputed, {} undecided\n", report.arcs_held, report.disputed_arcs.size(),
             report.arcs_undecided);
  for (std::size_t i = 0; i < report.disputed_arcs.size() && i < edges_shown; ++i) {
    const numeric::DisputedArc& arc = report.disputed_arcs[i];
    const std::string words = report::mode_words(validation.map.tower, arc.mode);
    const char* what = arc.unbounded ? "grows without bound" : arc.claimed ? "does not vanish" : "vanishes unnamed";
    fmt::print("disputed: {} {} along {} near ({}, {}){}{}\n", reaction_name(arc.reaction), what, arc.curve, arc.at[0],
               arc.at[1], words.empty() ? "" : "; ", words);
  }
}

int run(const Arguments& arguments, TimeLimit& limit) {
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  limit.known([common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "validation.json", incomplete_body(name, "the outcome was"), false);
  });
  Progress progress(arguments.common.quiet);
  LociRequest request = loci_request(arguments.loci, mechanism, progress, limit);
  const auto [nx, ny] = parse_grid(arguments.grid);
  // At every node of one mode |A| and the numerators.
  require_memory(static_cast<double>(nx) * ny * 8 * (2.0 + static_cast<double>(mechanism::unknowns(mechanism).size())),
                 "--grid", arguments.grid);
  const numeric::GridSpec grid = {.nx = nx, .ny = ny};
  const LociValidation validation = validate_loci(mechanism, std::move(request), grid);
  progress.clear();
  limit.writing();

  const bool write = !arguments.common.output.empty();
  if (write || arguments.common.json) {
    const std::string text = report::json_text(report::validation_object(validation, grid.nx, grid.ny));
    if (write) report::write_atomically(output_folder(arguments.common) / "validation.json", text);
    if (arguments.common.json) fmt::print("{}", text);
  }
  if (!arguments.common.json && !arguments.common.quiet) print_table(validation, grid);
  return validation.report.disputed == 0 ? exit_done : exit_check_said_no;
}

}  // namespace

Command add_validate_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("validate", "Hold the loci against reactions solved numerically on a grid");
  const auto arguments = std::make_shared<Arguments>();
  add_common_arguments(*app, arguments->common);
  add_tracing_arguments(*app, arguments->loci);
  app->add_option("--grid", arguments->grid, "Nodes along each coordinate")->type_name("NXxNY")->capture_default_str();
  app->footer(
      "Example: clearloci validate examples/five_bar.yaml --grid 400x400\n"
      "Exit status 1 where an edge of the grid is disputed. With -o, DIR/validation.json is written.");
  return {app, [arguments] {
            return run_within(arguments->common, [&](TimeLimit& limit) { return run(*arguments, limit); });
          }};
}

}  // namespace clearloci::cli
