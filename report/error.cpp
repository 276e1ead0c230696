#include "report/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/field_exports.hpp"
#include "report/file_units.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/picture.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

/// The middle of a cell.
core::Point2 place(const core::FieldMap& map, std::size_t cell) {
  const auto width = static_cast<std::size_t>(map.nx);
  return {map.x(static_cast<int>(cell % width)), map.y(static_cast<int>(cell / width))};
}

Json sizes_json(const core::FieldMap& map, const std::vector<std::optional<core::ErrorSizes>>& sizes) {
  Json all = Json::object();
  for (std::size_t f = 0; f < map.fields.size(); ++f) {
    const core::Field& field = map.fields[f];
    if (!sizes[f]) {
      all[field.name] = {{"unit", field.unit}, {"median", nullptr}};
      continue;
    }
    all[field.name] = {{"unit", field.unit},
                       {"median", sizes[f]->median},
                       {"percentile_90", sizes[f]->percentile_90},
                       {"percentile_99", sizes[f]->percentile_99},
                       {"largest", sizes[f]->largest},
                       {"at", place(map, sizes[f]->at)}};
  }
  return all;
}

/// `map` as it is shown; `per_si`: of the field's unit.
std::string sizes_row(const std::string& name, const core::FieldMap& map, const core::ErrorSizes& sizes,
                      double per_si) {
  const core::Point2 at = place(map, sizes.at);
  return fmt::format("{:<60}{:>12.4g}{:>12.4g}{:>12.4g}  ({:.4g}, {:.4g})\n", name, sizes.median * per_si,
                     sizes.percentile_90 * per_si, std::abs(sizes.largest) * per_si, at[0], at[1]);
}

/// The grid in the units of the file, without its fields, which are large.
core::FieldMap shown_grid(const core::FieldMap& map, const core::LocusMap& loci) {
  core::FieldMap grid{map.mechanism, map.coordinates, map.lower, map.upper, map.nx, map.ny, {}};
  return in_file_units(std::move(grid), loci.units, loci.angles);
}

/// The bound that counts where the load is not known, zone by zone.
std::string zones_text(const core::ModeErrors& one, const core::LocusMap& loci) {
  const core::FieldMap grid = shown_grid(one.map, loci);
  std::string text;
  for (std::size_t f = 0; f < one.map.fields.size(); ++f) {
    const core::Field& field = one.map.fields[f];
    if (field.name != "dp" && field.name != "worst_dp") continue;
    const ShownUnit unit = shown_unit(field.unit, loci.units);
    text += fmt::format("{:<60}{:>12}{:>12}{:>12}  at\n", fmt::format("{} [{}], zone by zone", field.label, unit.name),
                        "median", "90 %", "largest");
    for (const core::ZoneErrors& zone : one.zones) {
      const std::string name = fmt::format("{}, {} cells", zone.zone, zone.cells.size());
      text += zone.sizes[f] ? sizes_row(name, grid, *zone.sizes[f], unit.per_si)
                            : fmt::format("{:<60}{:>12}\n", name, "none");
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::string never_loaded_words(const std::vector<std::string>& joints) {
  return fmt::format("No error under the load: {} bear{} nothing in any pose, so the take-up is undefined.\n",
                     fmt::join(joints, ", "), joints.size() == 1 ? "s" : "");
}

Json error_object(const core::ErrorMap& errors) {
  Json all = Json::array();
  for (const core::ModeErrors& one : errors.modes) {
    all.push_back({{"working_mode", mode_object(errors.loci.tower, one.mode)},
                   {"reachable", one.reachable},
                   {"undefined", one.undefined},
                   {"never_loaded", one.never_loaded},
                   {"fields", sizes_json(one.map, one.sizes)}});
    for (const core::ZoneErrors& zone : one.zones)
      all.back()["zones"].push_back(
          {{"id", zone.zone}, {"cells", zone.cells.size()}, {"fields", sizes_json(one.map, zone.sizes)}});
  }
  const core::FieldMap& map = errors.modes.front().map;
  Json root = {{"format", 1},
               {"mechanism", map.mechanism},
               {"coordinates", map.coordinates},
               {"box", {{map.lower[0], map.upper[0]}, {map.lower[1], map.upper[1]}}},
               {"grid", {map.nx, map.ny}},
               {"complete", errors.loci.complete},
               {"modes", std::move(all)}};
  if (errors.loci.units.declared) root["units"] = "SI";
  if (!errors.notes.empty()) root["notes"] = errors.notes;
  return root;
}

std::string error_text(const core::ErrorMap& errors) {
  std::string text;
  for (const core::ModeErrors& one : errors.modes) {
    const core::FieldMap& map = one.map;
    const core::FieldMap grid = shown_grid(map, errors.loci);
    const std::string mode = mode_words(errors.loci.tower, one.mode);
    text += fmt::format("{}: pose error over {} x {} cells{}\n", map.mechanism, map.nx, map.ny,
                        mode.empty() ? "" : "; " + mode);
    if (!one.never_loaded.empty()) text += never_loaded_words(one.never_loaded);
    text += fmt::format("\n{:<60}{:>12}{:>12}{:>12}  at\n", "absolute values", "median", "90 %", "largest");
    for (std::size_t f = 0; f < map.fields.size(); ++f)
      if (one.sizes[f]) {
        const ShownUnit unit = shown_unit(map.fields[f].unit, errors.loci.units);
        text += sizes_row(fmt::format("{} [{}]", map.fields[f].label, unit.name), grid, *one.sizes[f], unit.per_si);
      }
    text += fmt::format("\n{} cells in the workspace, {} on a locus to the last bit\n\n", one.reachable, one.undefined);
    if (!one.zones.empty()) text += zones_text(one, errors.loci);
  }
  for (const std::string& note : errors.notes) text += note + "\n";
  return text;
}

}  // namespace clearloci::report
