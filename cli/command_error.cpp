// clearloci error: the pose error that the clearances cause, over the workspace.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/error.hpp"
#include "cli/commands.hpp"
#include "cli/loci_arguments.hpp"
#include "cli/memory_bound.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "core/errors.hpp"
#include "mechanism/read_task.hpp"
#include "report/error.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"

namespace clearloci::cli {
namespace {

struct ErrorCommand {
  CommonArguments common;
  LociArguments loci;
  std::string grid;
  std::string formats = "png";
  bool without_loci = false;
  bool without_worst_case = false;
  bool zones = false;
  long zone_cells = 300'000;
  std::vector<std::string> slices;
};

/// The grid in words, for messages: "400x400".
std::string grid_words(const std::vector<int>& grid) { return fmt::format("{}", fmt::join(grid, "x")); }

/// Bytes that the maps hold at once: their fields, and the texts of which a file is made.
double memory_of(const std::vector<int>& grid, const mechanism::Mechanism& mechanism, std::size_t modes,
                 const std::set<std::string>& formats) {
  constexpr double of_number = 8, of_text = 24;
  const double fields = mechanism.space == mechanism::Space::spatial ? 14 : 8;
  double cells = 1;
  for (const int along : grid) cells *= along;
  const double text = formats.contains("csv") ? 2 * of_text * (fields + 2) : 0;  // the text grows by doubling
  return cells * (static_cast<double>(modes) * fields * of_number + text + 4 * of_number);
}

std::vector<core::FieldSlice> slices_of(const ErrorCommand& arguments, const mechanism::Mechanism& mechanism,
                                        const std::vector<int>& grid) {
  if (!arguments.slices.empty() && grid.size() != 3)
    throw core::InputError({.file = "--slice"}, "slices are layers of three free coordinates", "leave it out");
  std::vector<core::FieldSlice> slices;
  for (const std::string& word : arguments.slices) {
    const auto [across, value] = parse_slice(word, mechanism);
    const double lower = core::to_double(mechanism.coordinates[across].lower),
                 upper = core::to_double(mechanism.coordinates[across].upper);
    const int layer = static_cast<int>((value - lower) / (upper - lower) * grid[across]);
    slices.push_back({across, static_cast<std::size_t>(std::clamp(layer, 0, grid[across] - 1))});
  }
  return slices;
}

int run(const ErrorCommand& arguments, TimeLimit& limit) {
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  const std::size_t coordinates = mechanism.coordinates.size();
  const std::set<std::string> formats = parse_formats(arguments.formats, report::error_formats(coordinates));
  const std::future<void> letters = report::prepare_pictures(formats);
  limit.known([common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "error.json", incomplete_body(name, "the errors were"));
  });
  require_coordinates(mechanism, 1, 3, "errors are mapped");
  if (arguments.zones && arguments.without_loci && mechanism::is_plane(mechanism))
    throw core::InputError({.file = "--zones"}, "zones are bounded by the loci", "leave --no-loci out");
  Progress progress(arguments.common.quiet);
  ErrorRequest request{.worst_case = !arguments.without_worst_case,
                       .with_loci = !arguments.without_loci,
                       .with_zones = arguments.zones,
                       .zone_cells = arguments.zone_cells,
                       .loci = loci_request(arguments.loci, mechanism, progress, limit)};
  request.grid = arguments.grid.empty() ? error_grid(request, coordinates) : parse_grid(arguments.grid, coordinates);
  require_memory(memory_of(request.grid, mechanism, requested_modes(mechanism, request.loci).size(), formats), "--grid",
                 grid_words(request.grid));
  const std::vector<core::FieldSlice> slices = slices_of(arguments, mechanism, request.grid);
  const Errors errors = find_errors(mechanism, request);
  progress.clear();
  const std::filesystem::path folder = output_folder(arguments.common);
  report::StagedFiles staged;
  const auto files = report::stage_answer(staged, report::ErrorSheet{errors, slices}, folder, formats);
  limit.commit(staged);
  if (arguments.common.json)
    fmt::print("{}", report::json_text(report::error_object(errors)));
  else if (!arguments.common.quiet)
    fmt::print("{}{}", report::error_text(errors), written_words(folder, files));
  if (!errors.loci.out_of_time) return exit_done;
  throw core::LimitReached("the time limit was reached; loci or zones are incomplete, the errors are whole");
}

}  // namespace

Command add_error_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("error", "Map the pose error that the clearances cause over the workspace");
  const auto arguments = std::make_shared<ErrorCommand>();
  add_common_arguments(*app, arguments->common);
  add_tracing_arguments(*app, arguments->loci);
  app->add_option("--grid", arguments->grid,
                  "Cells along each coordinate (default: 400x400, over three 40x40x40), or steps along a single one "
                  "(default: 720)")
      ->type_name("NXxNY|NXxNYxNZ|N");
  app->add_option(
         "--slice", arguments->slices,
         "Over three coordinates: draw the layer of cells at this value, such as z=0.3 (repeatable; default: the "
         "middle of the last coordinate)")
      ->type_name("NAME=VALUE");
  add_export_argument(*app, arguments->formats,
                      fmt::format("Files besides error.json, comma-separated: {}; over one coordinate without vtk",
                                  fmt::join(report::error_formats(2), ", ")));
  app->add_flag("--no-loci", arguments->without_loci, "Draw no loci over the pictures");
  app->add_flag("--no-worst-case", arguments->without_worst_case,
                "Compute only the error under the load of the file, not the worst case over all loads");
  app->add_flag("--zones", arguments->zones, "Also print the size of the errors in each zone");
  app->add_option(
         "--cells", arguments->zone_cells,
         "With --zones over one to three coordinates that are not two lengths: the number of cells in each mode")
      ->check(CLI::Range(1L, 100'000'000L))
      ->capture_default_str();
  app->footer(
      "Example: clearloci error examples/five_bar.yaml --grid 300x400 --export png,csv,vtk\n"
      "Writes error.json, a picture for each component (error-dx.png, ...) and for the worst case over all take-ups\n"
      "(error-worst-dx.png, ...). With one free coordinate the "
      "error,\n"
      "the take-up of every joint and the reactions are drawn over it (error.png, take-up.png, reactions.png), and "
      "the\n"
      "table lists the jumps of the end effector at the loci: clearloci error examples/four_bar.yaml");
  return within_limit(app, arguments, run);
}

}  // namespace clearloci::cli
