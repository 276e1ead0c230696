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
#include "report/coordinate_errors.hpp"
#include "report/error.hpp"
#include "report/error_volume.hpp"
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
  std::vector<std::string> slices;
};

/// What is printed: the JSON or the table, and where the files are.
template <class Answer>
void print(const ErrorCommand& arguments, const Answer& errors, nlohmann::ordered_json (*object)(const Answer&),
           std::string (*text)(const Answer&), const std::vector<std::filesystem::path>& files) {
  if (arguments.common.json) {
    fmt::print("{}", report::json_text(object(errors)));
  } else if (!arguments.common.quiet) {
    fmt::print("{}{}", text(errors), written_words(output_folder(arguments.common), files));
  }
}

/// One free coordinate: take-up and error over its range.
int run_over_coordinate(const ErrorCommand& arguments, const std::set<std::string>& formats,
                        const mechanism::Mechanism& mechanism, TimeLimit& limit) {
  constexpr const char* usual_steps = "720";
  const std::vector<std::string> known = report::format_names<core::CoordinateErrors>();
  for (const std::string& format : formats)
    if (std::find(known.begin(), known.end(), format) == known.end())
      throw core::InputError({.file = "--export"},
                             format + " holds maps over two coordinates, and the workspace has one",
                             fmt::format("choose from {}", fmt::join(known, ", ")));
  if (arguments.zones)
    throw core::InputError({.file = "--zones"}, "zones are cut from two free coordinates, and the workspace has one",
                           "leave it out: the table lists the jumps between the pieces of the range");
  const int steps = parse_steps(arguments.grid.empty() ? usual_steps : arguments.grid);
  Progress progress(arguments.common.quiet);
  const CoordinateErrors errors =
      coordinate_errors(mechanism, {.steps = steps,
                                    .worst_case = !arguments.without_worst_case,
                                    .with_loci = !arguments.without_loci,
                                    .loci = loci_request(arguments.loci, mechanism, progress, limit)});
  report::StagedFiles staged;
  const auto files = report::stage_answer(staged, errors, output_folder(arguments.common), formats);
  limit.commit(staged);
  progress.clear();
  print(arguments, errors, report::coordinate_errors_object, report::coordinate_errors_text, files);
  if (!errors.loci.out_of_time) return exit_done;
  throw core::LimitReached("the time limit was reached; loci are missing from the pictures, the errors are whole");
}

/// Bytes that the maps hold at once: their fields, and the texts of which a file is made.
double memory_of(int nx, int ny, const mechanism::Mechanism& mechanism, std::size_t modes,
                 const std::set<std::string>& formats) {
  constexpr double of_number = 8, of_text = 24;
  const double fields = mechanism.space == mechanism::Space::spatial ? 14 : 8;
  const double cells = static_cast<double>(nx) * ny;
  const double text = formats.contains("csv") ? 2 * of_text * (fields + 2) : 0;  // the text grows by doubling
  return cells * (static_cast<double>(modes) * fields * of_number + text + 4 * of_number);
}

/// Three free coordinates: a volume, and pictures of slices.
int run_over_volume(const ErrorCommand& arguments, const std::set<std::string>& formats,
                    const mechanism::Mechanism& mechanism, TimeLimit& limit) {
  constexpr const char* usual_grid = "40x40x40";
  if (arguments.zones)
    throw core::InputError({.file = "--zones"}, "errors zone by zone are those over two lengths", "leave it out");
  const std::string& words = arguments.grid.empty() ? usual_grid : arguments.grid;
  const std::array<int, 3> cells = parse_volume_grid(words);
  Progress progress(arguments.common.quiet);
  const LociRequest loci = loci_request(arguments.loci, mechanism, progress, limit);
  require_memory(memory_of(cells[0], cells[1] * cells[2], mechanism, requested_modes(mechanism, loci).size(), formats),
                 "--grid", words);
  std::vector<core::VolumeSlice> slices;
  for (const std::string& word : arguments.slices) {
    const auto [across, value] = parse_slice(word, mechanism);
    const double lower = core::to_double(mechanism.coordinates[across].lower),
                 upper = core::to_double(mechanism.coordinates[across].upper);
    const int layer = static_cast<int>((value - lower) / (upper - lower) * cells[across]);
    slices.push_back({across, std::clamp(layer, 0, cells[across] - 1)});
  }
  const VolumeErrors errors =
      error_volume(mechanism, {.cells = cells, .worst_case = !arguments.without_worst_case, .loci = loci});
  progress.clear();
  report::StagedFiles staged;
  const auto files =
      report::stage_answer(staged, report::VolumeSheet{errors, slices}, output_folder(arguments.common), formats);
  limit.commit(staged);
  print(arguments, errors, report::error_volume_object, report::error_volume_text, files);
  return exit_done;
}

int run(const ErrorCommand& arguments, TimeLimit& limit) {
  const std::set<std::string> formats = parse_formats(arguments.formats, report::format_names<core::ErrorMap>());
  const std::future<void> letters = report::prepare_pictures(formats);
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  limit.known([common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "error.json", incomplete_body(name, "the errors were"));
  });
  require_coordinates(mechanism, 1, 3, "errors are mapped");
  if (mechanism.coordinates.size() == 1) return run_over_coordinate(arguments, formats, mechanism, limit);
  if (mechanism.coordinates.size() == 3) return run_over_volume(arguments, formats, mechanism, limit);
  constexpr const char* usual_grid = "400x400";
  const auto [nx, ny] = parse_grid(arguments.grid.empty() ? usual_grid : arguments.grid);
  Progress progress(arguments.common.quiet);
  const LociRequest loci = loci_request(arguments.loci, mechanism, progress, limit);
  require_memory(memory_of(nx, ny, mechanism, requested_modes(mechanism, loci).size(), formats), "--grid",
                 fmt::format("{}x{}", nx, ny));
  if (arguments.zones && arguments.without_loci)
    throw core::InputError({.file = "--zones"}, "zones are bounded by the loci", "leave --no-loci out");
  const ErrorMap errors = error_map(mechanism, {.nx = nx,
                                                .ny = ny,
                                                .worst_case = !arguments.without_worst_case,
                                                .with_loci = !arguments.without_loci,
                                                .with_zones = arguments.zones,
                                                .loci = loci});
  progress.clear();
  report::StagedFiles staged;
  const auto files = report::stage_answer(staged, errors, output_folder(arguments.common), formats);
  limit.commit(staged);
  print(arguments, errors, report::error_object, report::error_text, files);
  if (!errors.loci.out_of_time) return exit_done;
  throw core::LimitReached("the time limit was reached; the loci in the pictures are incomplete, the errors are not");
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
  app->add_option("--slice", arguments->slices,
                  "Over three coordinates: which layers of cells are drawn, such as z=0.3, once or more (default: the "
                  "middle of the last coordinate)")
      ->type_name("NAME=VALUE");
  app->add_option("--export", arguments->formats,
                  fmt::format("Files besides error.json, comma-separated: {}",
                              fmt::join(report::format_names<core::ErrorMap>(), ", ")))
      ->type_name("LIST")
      ->capture_default_str();
  app->add_flag("--no-loci", arguments->without_loci, "Pictures without the loci drawn over them");
  app->add_flag("--no-worst-case", arguments->without_worst_case, "Only the error under the file's load");
  app->add_flag("--zones", arguments->zones, "Also the sizes of the errors in each discontinuity-free zone");
  app->footer(
      "Example: clearloci error examples/five_bar.yaml --grid 300x400 --export png,csv,vtk\n"
      "Writes error.json, a picture for each component (error-dx.png, ...) and for the worst case over all take-ups\n"
      "(error-worst-dx.png, ...) to ./out/<name of MODEL>, or to the folder of -o. With one free coordinate the "
      "error,\n"
      "the take-up of every joint and the reactions are drawn over it (error.png, take-up.png, reactions.png), and "
      "the\n"
      "table lists how far the end effector jumps at each locus: clearloci error examples/four_bar.yaml");
  return {app, [arguments] {
            return run_within(arguments->common, [&](TimeLimit& limit) { return run(*arguments, limit); });
          }};
}

}  // namespace clearloci::cli
