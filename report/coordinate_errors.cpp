#include "report/coordinate_errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/coordinate_plots.hpp"
#include "report/error.hpp"
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

/// In tables angles are in degrees.
double shown(const core::CoordinateErrors& result) {
  return result.angle ? 180 / std::numbers::pi : shown_unit("m", result.loci.units).per_si;
}

std::string shown_coordinate(const core::CoordinateErrors& result) {
  return result.coordinate + (result.angle ? "/deg" : "/" + result.loci.units.length.name);
}

std::string jumps_text(const core::CoordinateErrors& result, const core::CoordinateModeErrors& mode) {
  std::string text;
  const ShownUnit length = shown_unit("m", result.loci.units), turn = shown_unit("rad", result.loci.units);
  for (const core::ErrorEvent& event : mode.events) {
    if (!event.jumps) continue;
    const std::vector<double>&places = event.jump.displacement, &turns = event.jump.rotation;
    std::string head = fmt::format("{:>14}", shown_coordinate(result));
    std::string line = fmt::format("{:>14.9g}", shown(result) * event.point.at.front());
    for (std::size_t c = 0; c < places.size(); ++c) {
      head += fmt::format("{:>14}", fmt::format("jump in {}/{}", "xyz"[c], length.name));
      line += fmt::format("{:>14.4g}", places[c] * length.per_si);
    }
    const int width = turns.size() == 1 ? 16 : 19;
    for (std::size_t c = 0; c < turns.size(); ++c) {
      head += fmt::format(
          "{:>{}}", turns.size() == 1 ? "turn/" + turn.name : fmt::format("turn about {}/{}", "xyz"[c], turn.name),
          width);
      line += fmt::format("{:>{}.4g}", turns[c] * turn.per_si, width);
    }
    if (text.empty()) text = head + "  what lets go\n";
    text += line + "  " + vanishing_words(event.point.kind, event.point.vanishing) + "\n";
  }
  return text.empty() ? text : text + "\n";
}

/// Of a mode in the names of files; empty where there is one alone.
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
    text += fmt::format("{:<66}{:>12}{:>12}{:>12}  at {}\n", "absolute values", "median", "90 %", "largest",
                        shown_coordinate(result));
    for (std::size_t c = 0; c < result.components.size(); ++c) {
      const std::optional<core::ErrorSizes>& sizes = one.sizes[c];
      if (!sizes) continue;
      const ShownUnit unit = shown_unit(result.components[c].unit, result.loci.units);
      text += fmt::format("{:<66}{:>12.4g}{:>12.4g}{:>12.4g}  {:.6g}\n",
                          fmt::format("{} [{}]", result.components[c].label, unit.name), sizes->median * unit.per_si,
                          sizes->percentile_90 * unit.per_si, std::abs(sizes->largest) * unit.per_si,
                          shown(result) * one.samples.columns.front()[sizes->at]);
    }
    text += "\n" + jumps_text(result, one);
  }
  for (const std::string& note : result.notes) text += note + "\n";
  return text;
}

}  // namespace clearloci::report
