#include "report/coordinate_errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/coordinate_plots.hpp"
#include "report/error.hpp"
#include "report/error_sizes.hpp"
#include "report/file_units.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/pose.hpp"
#include "report/table_json.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

Json sizes_json(const core::CoordinateModeErrors& mode, std::size_t component, const std::string& unit) {
  const std::optional<core::ErrorSizes>& sizes = mode.sizes[component];
  if (!sizes) return {{"unit", unit}, {"median", nullptr}};
  return {{"unit", unit},
          {"median", sizes->median},
          {"percentile_90", sizes->percentile_90},
          {"largest", sizes->largest},
          {"at", {mode.samples.columns.front()[sizes->at]}}};
}

Json mode_json(const core::CoordinateErrors& result, const core::CoordinateModeErrors& mode) {
  Json fields = Json::object();
  for (std::size_t c = 0; c < result.components.size(); ++c)
    fields[result.components[c].name] = sizes_json(mode, c, result.components[c].unit);
  Json jumps = Json::array();
  for (const core::ErrorEvent& event : mode.events) {
    if (!event.jumps) continue;
    jumps.push_back({{"at", event.point.at},
                     {"kind", core::to_string(event.point.kind)},
                     {"vanishing", vanishing_array(event.point.vanishing)}});
    jumps.back().update(pose_error_object(event.jump));
  }
  return {{"working_mode", mode_object(result.loci.tower, mode.mode)},
          {"never_loaded", mode.never_loaded},
          {"fields", std::move(fields)},
          {"jumps", std::move(jumps)},
          {"samples", table_object(mode.samples)}};
}

double shown(const core::CoordinateErrors& result) {
  return table_unit(result.angle ? "rad" : "m", result.loci.units).per_si;
}

std::string shown_coordinate(const core::CoordinateErrors& result) {
  return result.coordinate + " [" + table_unit(result.angle ? "rad" : "m", result.loci.units).name + "]";
}

std::string jumps_text(const core::CoordinateErrors& result, const core::CoordinateModeErrors& mode) {
  double lengths = 0, angles = 0;
  for (const core::ErrorEvent& event : mode.events) {
    if (!event.jumps) continue;
    for (const double jump : event.jump.displacement)
      if (std::isfinite(jump)) lengths = std::max(lengths, std::abs(jump));
    for (const double jump : event.jump.rotation)
      if (std::isfinite(jump)) angles = std::max(angles, std::abs(jump));
  }
  const ShownUnit length = table_unit("m", result.loci.units, lengths), turn = table_unit("rad", result.loci.units);
  const auto size = [](double value, double beside, const ShownUnit& unit) {
    if (!std::isfinite(value)) return std::string("undefined");
    return engineering_beside(value * unit.per_si, beside * unit.per_si, few_digits);
  };
  std::vector<Column> heading = {{shown_coordinate(result), 0, Alignment::point}};
  std::vector<Row> rows;
  for (const core::ErrorEvent& event : mode.events) {
    if (!event.jumps) continue;
    const std::vector<double>&places = event.jump.displacement, &turns = event.jump.rotation;
    if (rows.empty()) {
      for (std::size_t c = 0; c < places.size(); ++c)
        heading.push_back({fmt::format("jump in {} [{}]", "xyz"[c], length.name), 0, Alignment::point});
      for (std::size_t c = 0; c < turns.size(); ++c)
        heading.push_back({turns.size() == 1 ? fmt::format("turn [{}]", turn.name)
                                             : fmt::format("turn about {} [{}]", "xyz"[c], turn.name),
                           0, Alignment::point});
      heading.push_back({"what lets go"});
    }
    Row& row = rows.emplace_back(Row{engineering(shown(result) * event.point.at.front(), place_digits)});
    for (const double jump : places) row.push_back(size(jump, lengths, length));
    for (const double jump : turns) row.push_back(size(jump, angles, turn));
    row.push_back(vanishing_words(event.point.kind, event.point.vanishing));
  }
  return rows.empty() ? std::string() : format_rows(heading, rows) + "\n";
}

}  // namespace

Json coordinate_errors_object(const core::CoordinateErrors& result) {
  Json modes = Json::array();
  for (const core::CoordinateModeErrors& mode : result.modes) modes.push_back(mode_json(result, mode));
  return {{"format", 1},
          {"mechanism", result.mechanism},
          {"coordinates", {result.coordinate}},
          {"complete", result.loci.complete},
          {"units", {result.angle ? "rad" : "m"}},
          {"box", {{result.range[0], result.range[1]}}},
          {"steps", result.steps},
          {"modes", std::move(modes)}};
}

std::string coordinate_errors_text(const core::CoordinateErrors& result) {
  std::string text;
  for (const core::CoordinateModeErrors& one : result.modes) {
    const std::string mode = mode_words(result.loci.tower, one.mode);
    text += fmt::format("{}: pose error over {} in {} steps{}\n\n", result.mechanism, result.coordinate, result.steps,
                        mode.empty() ? "" : "; " + mode);
    if (!one.never_loaded.empty()) text += never_loaded_words(one.never_loaded) + "\n";
    std::vector<Row> rows;
    for (std::size_t c = 0; c < result.components.size(); ++c)
      if (const std::optional<core::ErrorSizes>& sizes = one.sizes[c])
        rows.push_back(size_row(result.components[c].label, result.components[c].unit, *sizes, result.loci.units,
                                engineering(shown(result) * one.samples.columns.front()[sizes->at], few_digits)));
    std::vector<Column> heading = size_columns("absolute values");
    heading.back() = {"at " + shown_coordinate(result), 0, Alignment::point};
    text += format_rows(heading, rows);
    text += "\n" + jumps_text(result, one);
  }
  for (const std::string& note : result.notes) text += note + "\n";
  return text;
}

}  // namespace clearloci::report
