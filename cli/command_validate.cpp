// clearloci validate: the traced loci held against reactions solved numerically on a grid.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <tuple>

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
  std::string grid;
};

std::string reaction_name(const numeric::TracedReaction& reaction) {
  return fmt::format("{}_{}", to_string(reaction.quantity), reaction.joint);
}

/// Along each coordinate.
std::vector<int> nodes_of(const LociValidation& validation, const numeric::GridSpec& grid) {
  std::vector<int> nodes = {grid.nx, grid.ny, grid.nz};
  nodes.resize(validation.map.lower.size());
  return nodes;
}

void print_table(const LociValidation& validation, const numeric::GridSpec& grid) {
  constexpr std::size_t edges_shown = 20;
  const std::array<const char*, 3> names = {"points", "arcs", "surfaces"};
  const char* const loci = names.at(validation.map.lower.size() - 1);
  const numeric::ValidationReport& report = validation.report;
  fmt::print("{}: loci against reactions at {} nodes\n", validation.map.mechanism,
             fmt::join(nodes_of(validation, grid), " x "));
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
    fmt::print("disputed: {} {} from ({}) to ({}), crossed by {} {}{}{}\n", reaction_name(edge.reaction),
               edge.sign_change ? "changes sign" : "keeps its sign", fmt::join(edge.from, ", "),
               fmt::join(edge.to, ", "), edge.crossings, loci, words.empty() ? "" : "; ", words);
  }
  if (report.disputed_edges.size() > edges_shown) fmt::print("... --json lists more disputed edges\n");
  fmt::print("{} reactions along {} held, {} disputed, {} undecided\n", report.arcs_held, loci,
             report.disputed_arcs.size(), report.arcs_undecided);
  for (std::size_t i = 0; i < report.disputed_arcs.size() && i < edges_shown; ++i) {
    const numeric::DisputedArc& arc = report.disputed_arcs[i];
    const std::string words = report::mode_words(validation.map.tower, arc.mode);
    const char* what = arc.unbounded ? "grows without bound" : arc.claimed ? "does not vanish" : "vanishes unnamed";
    fmt::print("disputed: {} {} along {} near ({}){}{}\n", reaction_name(arc.reaction), what, arc.curve,
               fmt::join(arc.at, ", "), words.empty() ? "" : "; ", words);
  }
}

numeric::GridSpec grid_of(const Arguments& arguments, const mechanism::Mechanism& mechanism) {
  const std::size_t coordinates = mechanism.coordinates.size();
  const std::string usual = coordinates == 1 ? "4000" : coordinates == 3 ? "40x40x40" : "400x400";
  const std::string& words = arguments.grid.empty() ? usual : arguments.grid;
  numeric::GridSpec grid;
  double nodes = 1;  // that are held at once
  if (coordinates == 1) {
    nodes = grid.nx = parse_steps(words);
  } else if (coordinates == 3) {
    const std::array<int, 3> along = parse_volume_grid(words);
    grid.nx = along[0];
    grid.ny = along[1];
    grid.nz = along[2];
    nodes = *std::max_element(along.begin(), along.end());
  } else {
    std::tie(grid.nx, grid.ny) = parse_grid(words);
    nodes = static_cast<double>(grid.nx) * grid.ny;
  }
  // At every node of one mode |A| and the numerators.
  require_memory(nodes * 8 * (2.0 + static_cast<double>(mechanism::unknowns(mechanism).size())), "--grid", words);
  return grid;
}

int run(const Arguments& arguments, TimeLimit& limit) {
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  limit.known([common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "validation.json", incomplete_body(name, "the outcome was"), false);
  });
  Progress progress(arguments.common.quiet);
  LociRequest request = loci_request(arguments.loci, mechanism, progress, limit);
  const numeric::GridSpec grid = grid_of(arguments, mechanism);
  const LociValidation validation = validate_loci(mechanism, std::move(request), grid);
  progress.clear();
  limit.writing();

  const bool write = !arguments.common.output.empty();
  if (write || arguments.common.json) {
    const std::string text = report::json_text(report::validation_object(validation, nodes_of(validation, grid)));
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
  app->add_option("--grid", arguments->grid,
                  "Nodes along each coordinate (default: 400x400, over one 4000, over three 40x40x40)")
      ->type_name("NXxNY|NXxNYxNZ|N");
  app->footer(
      "Example: clearloci validate examples/five_bar.yaml --grid 400x400\n"
      "Exit status 1 where an edge of the grid is disputed. With -o, DIR/validation.json is written.");
  return {app, [arguments] {
            return run_within(arguments->common, [&](TimeLimit& limit) { return run(*arguments, limit); });
          }};
}

}  // namespace clearloci::cli
