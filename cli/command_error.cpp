// clearloci error: the pose error that the clearances cause, over the workspace.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/singular_modes.hpp"
#include "analysis/zone_errors.hpp"
#include "analysis/zones.hpp"
#include "cli/commands.hpp"
#include "cli/coordinate_errors.hpp"
#include "cli/loci_arguments.hpp"
#include "cli/memory_bound.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "numeric/error_map.hpp"
#include "report/field_exports.hpp"
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
  std::string grid;
  std::string formats = "png";
  bool without_loci = false;
  bool without_worst_case = false;
  bool zones = false;
};

const std::vector<std::string> format_names = {"png", "svg", "pdf", "csv", "vtk"};

std::set<std::string> parse_formats(const std::string& text) {
  std::set<std::string> formats;
  for (const std::string& word : split(text)) {
    if (std::find(format_names.begin(), format_names.end(), word) == format_names.end())
      throw core::InputError({.file = "--export"}, fmt::format("unknown format '{}'", word),
                             fmt::format("choose from {}", fmt::join(format_names, ", ")));
    formats.insert(word);
  }
  return formats;
}

/// A zone with the cells of the map that lie in it.
struct ZoneCells {
  const core::Zone* zone = nullptr;
  std::vector<std::size_t> cells;
};

/// One working mode with its errors.
struct ModeErrors {
  core::WorkingMode mode;
  numeric::ErrorMap errors;
  std::vector<ZoneCells> zones;  ///< where they are wanted
};

/// Typical sizes: near direct singularities errors grow without bound, so means say nothing. `cells`: those that count;
/// null: all.
Json sizes_json(const core::FieldMap& map, const core::Field& field, const std::vector<std::size_t>* cells = nullptr) {
  std::vector<double> sizes;
  std::size_t at = 0;
  double largest = -1;
  for (std::size_t i = 0; i < (cells != nullptr ? cells->size() : field.values.size()); ++i) {
    const std::size_t k = cells != nullptr ? (*cells)[i] : i;
    const double size = std::abs(field.values[k]);
    if (!std::isfinite(size)) continue;
    sizes.push_back(size);
    if (size > largest) {
      largest = size;
      at = k;
    }
  }
  if (sizes.empty()) return {{"unit", field.unit}, {"median", nullptr}};
  std::sort(sizes.begin(), sizes.end());
  const auto part = [&](double p) {
    return sizes[static_cast<std::size_t>(p * static_cast<double>(sizes.size() - 1))];
  };
  const auto width = static_cast<std::size_t>(map.nx);
  return {{"unit", field.unit},
          {"median", part(0.5)},
          {"percentile_90", part(0.9)},
          {"percentile_99", part(0.99)},
          {"largest", field.values[at]},
          {"at", {map.x(static_cast<int>(at % width)), map.y(static_cast<int>(at / width))}}};
}

Json result_json(const core::LocusMap& loci, const std::vector<ModeErrors>& modes) {
  Json all = Json::array();
  for (const ModeErrors& one : modes) {
    const numeric::ErrorMap& errors = one.errors;
    Json fields = Json::object();
    for (const core::Field& field : errors.map.fields) fields[field.name] = sizes_json(errors.map, field);
    all.push_back({{"working_mode", report::mode_object(loci.tower, one.mode)},
                   {"reachable", errors.reachable},
                   {"undefined", errors.undefined},
                   {"never_loaded", errors.never_loaded},
                   {"fields", std::move(fields)}});
    for (const ZoneCells& zone : one.zones) {
      Json in_zone = Json::object();
      for (const core::Field& field : errors.map.fields)
        in_zone[field.name] = sizes_json(errors.map, field, &zone.cells);
      all.back()["zones"].push_back(
          {{"id", zone.zone->id}, {"cells", zone.cells.size()}, {"fields", std::move(in_zone)}});
    }
  }
  const core::FieldMap& map = modes.front().errors.map;
  return {{"format", 1},
          {"mechanism", map.mechanism},
          {"coordinates", map.coordinates},
          {"box", {{map.lower[0], map.upper[0]}, {map.lower[1], map.upper[1]}}},
          {"grid", {map.nx, map.ny}},
          {"complete", loci.complete},
          {"modes", std::move(all)}};
}

/// The bound that counts where the load is not known, zone by zone.
void print_zones(const ModeErrors& one) {
  const core::FieldMap& map = one.errors.map;
  for (const core::Field& field : map.fields) {
    if (field.name != "dp" && field.name != "worst_dp") continue;
    fmt::print("{:<60}{:>12}{:>12}{:>12}  at\n", fmt::format("{} [{}], zone by zone", field.label, field.unit),
               "median", "90 %", "largest");
    for (const ZoneCells& zone : one.zones) {
      const Json sizes = sizes_json(map, field, &zone.cells);
      const std::string name = fmt::format("{}, {} cells", zone.zone->id, zone.cells.size());
      if (sizes["median"].is_null())
        fmt::print("{:<60}{:>12}\n", name, "none");
      else
        fmt::print("{:<60}{:>12.4g}{:>12.4g}{:>12.4g}  ({:.4g}, {:.4g})\n", name, sizes["median"].get<double>(),
                   sizes["percentile_90"].get<double>(), std::abs(sizes["largest"].get<double>()),
                   sizes["at"][0].get<double>(), sizes["at"][1].get<double>());
    }
    fmt::print("\n");
  }
}

void print_table(const core::LocusMap& loci, const std::vector<ModeErrors>& modes) {
  for (const ModeErrors& one : modes) {
    const numeric::ErrorMap& errors = one.errors;
    const std::string mode = report::mode_words(loci.tower, one.mode);
    fmt::print("{}: pose error over {} x {} cells{}\n", errors.map.mechanism, errors.map.nx, errors.map.ny,
               mode.empty() ? "" : "; " + mode);
    if (!errors.never_loaded.empty())
      fmt::print("No error under the load: {} bear{} nothing in any pose, so the take-up is undefined.\n",
                 fmt::join(errors.never_loaded, ", "), errors.never_loaded.size() == 1 ? "s" : "");
    fmt::print("\n{:<60}{:>12}{:>12}{:>12}  at\n", "absolute values", "median", "90 %", "largest");
    for (const core::Field& field : errors.map.fields) {
      const Json sizes = sizes_json(errors.map, field);
      if (sizes["median"].is_null()) continue;
      fmt::print("{:<60}{:>12.4g}{:>12.4g}{:>12.4g}  ({:.4g}, {:.4g})\n",
                 fmt::format("{} [{}]", field.label, field.unit), sizes["median"].get<double>(),
                 sizes["percentile_90"].get<double>(), std::abs(sizes["largest"].get<double>()),
                 sizes["at"][0].get<double>(), sizes["at"][1].get<double>());
    }
    fmt::print("\n{} cells in the workspace, {} on a locus to the last bit\n\n", errors.reachable, errors.undefined);
    if (!one.zones.empty()) print_zones(one);
  }
}

std::vector<std::string> write_files(const std::set<std::string>& formats, const std::filesystem::path& folder,
                                     const core::LocusMap& loci, const std::vector<ModeErrors>& modes) {
  std::vector<std::string> names;
  const auto write = [&](const std::string& name, const std::string& bytes) {
    report::write_atomically(folder / name, bytes);
    names.push_back(name);
  };
  write("error.json", report::json_text(result_json(loci, modes)));
  for (const ModeErrors& one : modes) {
    const core::FieldMap& map = one.errors.map;
    const std::string which = modes.size() > 1 ? "-" + report::mode_slug(loci.tower, one.mode) : "";
    for (const core::Field& field : map.fields) {
      const auto picture = [&](const char* ending, report::PictureFormat format) {
        std::string name = field.name;
        std::replace(name.begin(), name.end(), '_', '-');
        write("error-" + name + which + ending, report::field_picture(loci, one.mode, map, field, format));
      };
      if (formats.contains("png")) picture(".png", report::PictureFormat::png);
      if (formats.contains("svg")) picture(".svg", report::PictureFormat::svg);
      if (formats.contains("pdf")) picture(".pdf", report::PictureFormat::pdf);
    }
    if (formats.contains("csv")) write("error" + which + ".csv", report::field_csv(map));
    if (formats.contains("vtk")) write("error" + which + ".vti", report::vti(map));
  }
  return names;
}

/// A map that a time limit ended before there was a tower of roots has no working modes to name; the errors have.
core::LocusMap with_modes(const mechanism::Mechanism& mechanism, core::LocusMap loci) {
  if (!loci.complete && loci.tower.roots.empty()) loci.tower.roots = empty_map(mechanism).tower.roots;
  return loci;
}

/// One free coordinate: take-up and error over its range.
int run_over_coordinate(const Arguments& arguments, const mechanism::Mechanism& mechanism, TimeLimit& limit) {
  constexpr const char* usual_steps = "720";
  const std::set<std::string> formats = parse_formats(arguments.formats);
  if (formats.contains("vtk"))
    throw core::InputError({.file = "--export"}, "vtk holds maps over two coordinates, and the workspace has one",
                           "choose from png, svg, pdf, csv");
  if (arguments.zones)
    throw core::InputError({.file = "--zones"}, "zones are cut from two free coordinates, and the workspace has one",
                           "leave it out: the table lists the jumps between the pieces of the range");
  const int steps = parse_steps(arguments.grid.empty() ? usual_steps : arguments.grid);
  Progress progress(arguments.common.quiet);
  const LociRequest request = loci_request(arguments.loci, mechanism, progress, limit);
  core::LocusMap loci =
      arguments.without_loci ? empty_map(mechanism) : with_modes(mechanism, trace_loci(mechanism, request));
  const std::vector<DyadSides> modes = regular_modes(mechanism, requested_modes(mechanism, request), loci.notes);
  const CoordinateResult result =
      coordinate_errors(mechanism, std::move(loci), modes, steps, !arguments.without_worst_case);
  const std::string json = report::json_text(coordinate_errors_json(result));
  limit.writing();
  const std::filesystem::path folder = output_folder(arguments.common);
  std::vector<std::string> names;
  const auto write = [&](const std::string& name, const std::string& bytes) {
    report::write_atomically(folder / name, bytes);
    names.push_back(name);
  };
  write("error.json", json);
  for (const CoordinateErrors& one : result.modes) {
    const std::string which = result.modes.size() > 1 ? "-" + report::mode_slug(result.loci.tower, one.mode) : "";
    if (formats.contains("csv"))
      write("error" + which + ".csv", report::table_csv(one.columns.names, one.columns.columns));
  }
  for (const report::NamedChart& chart : coordinate_charts(result)) {
    if (formats.contains("png")) write(chart.name + ".png", report::chart(chart.chart, report::PictureFormat::png));
    if (formats.contains("svg")) write(chart.name + ".svg", report::chart(chart.chart, report::PictureFormat::svg));
    if (formats.contains("pdf")) write(chart.name + ".pdf", report::chart(chart.chart, report::PictureFormat::pdf));
  }
  progress.clear();
  if (arguments.common.json) {
    fmt::print("{}", json);
  } else if (!arguments.common.quiet) {
    print_coordinate_errors(result);
    fmt::print("Written to {}: {}\n", core::printable(folder.string()), fmt::join(names, ", "));
  }
  if (result.loci.complete) return exit_done;
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

int run(const Arguments& arguments, TimeLimit& limit) {
  const std::set<std::string> formats = parse_formats(arguments.formats);
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  limit.known([common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "error.json", incomplete_body(name, "the errors were"));
  });
  if (mechanism.coordinates.size() == 1) return run_over_coordinate(arguments, mechanism, limit);
  constexpr const char* usual_grid = "400x400";
  const auto [nx, ny] = parse_grid(arguments.grid.empty() ? usual_grid : arguments.grid);
  const numeric::NumericModel model = numeric::compile(mechanism);
  Progress progress(arguments.common.quiet);
  const LociRequest request = loci_request(arguments.loci, mechanism, progress, limit);

  require_memory(memory_of(nx, ny, mechanism, requested_modes(mechanism, request).size(), formats), "--grid",
                 fmt::format("{}x{}", nx, ny));

  std::vector<ModeErrors> modes;
  if (arguments.zones && arguments.without_loci)
    throw core::InputError({.file = "--zones"}, "zones are bounded by the loci", "leave --no-loci out");
  core::ZoneMap zones;
  if (arguments.zones) zones = find_zones(mechanism, request);
  core::LocusMap loci = with_modes(mechanism, arguments.zones          ? zones.loci
                                              : arguments.without_loci ? empty_map(mechanism)
                                                                       : trace_loci(mechanism, request));
  const numeric::ErrorGrid grid = {.nx = nx, .ny = ny, .worst_case = !arguments.without_worst_case};
  for (const DyadSides& sides : regular_modes(mechanism, requested_modes(mechanism, request), loci.notes)) {
    progress.show(0.9, "errors");
    modes.push_back(
        {loci.tower.roots.empty() ? sides : mode_of(sides, loci.tower), numeric::error_map(model, sides, grid), {}});
    for (const core::Zone& zone : zones.zones)
      if (zone.mode == modes.back().mode)
        modes.back().zones.push_back({&zone, cells_in(zone, modes.back().errors.map)});
  }
  progress.clear();
  limit.writing();

  const std::filesystem::path folder = output_folder(arguments.common);
  const std::vector<std::string> names = write_files(formats, folder, loci, modes);
  if (arguments.common.json) {
    fmt::print("{}", report::json_text(result_json(loci, modes)));
  } else if (!arguments.common.quiet) {
    print_table(loci, modes);
    fmt::print("Written to {}: {}\n", core::printable(folder.string()), fmt::join(names, ", "));
  }
  if (loci.complete) return exit_done;
  throw core::LimitReached("the time limit was reached; the loci in the pictures are incomplete, the errors are not");
}

}  // namespace

Command add_error_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("error", "Map the pose error that the clearances cause over the workspace");
  const auto arguments = std::make_shared<Arguments>();
  add_common_arguments(*app, arguments->common);
  add_tracing_arguments(*app, arguments->loci);
  app->add_option("--grid", arguments->grid,
                  "Cells along each coordinate (default: 400x400), or steps along a single one (default: 720)")
      ->type_name("NXxNY|N");
  app->add_option("--export", arguments->formats,
                  fmt::format("Files besides error.json, several after commas: {}", fmt::join(format_names, ", ")))
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
