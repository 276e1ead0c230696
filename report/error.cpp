#include "report/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/error_sizes.hpp"
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

std::string at_words(const core::FieldMap& map, std::size_t cell, const core::LocusMap& loci) {
  return place_words(place(map, cell), loci.angles, loci.units, few_digits);
}

/// The bound that counts where the load is not known, zone by zone.
std::string zones_text(const core::ModeErrors& one, const core::LocusMap& loci) {
  std::string text;
  for (std::size_t f = 0; f < one.map.fields.size(); ++f) {
    const core::Field& field = one.map.fields[f];
    if (field.name != "dp" && field.name != "worst_dp") continue;
    std::vector<Row> rows;
    for (const core::ZoneErrors& zone : one.zones) {
      const std::string name = fmt::format("{}, {} cells", zone.zone, zone.cells.size());
      rows.push_back(zone.sizes[f] ? size_row(name, field.unit, *zone.sizes[f], loci.units,
                                              at_words(one.map, zone.sizes[f]->at, loci))
                                   : Row{name, "", "none", "", "", ""});
    }
    text += format_rows(size_columns(field.label + ", zone by zone"), rows) + "\n";
  }
  return text;
}

}  // namespace

std::vector<Column> size_columns(const std::string& what) {
  return {{what},
          {"unit"},
          {"median", 0, Alignment::point},
          {"90 %", 0, Alignment::point},
          {"largest", 0, Alignment::point},
          {"at"}};
}

Row size_row(const std::string& label, const std::string& si, const core::ErrorSizes& sizes, const core::Units& units,
             const std::string& at) {
  // By the most that is typical: near a direct singularity the largest has no bound.
  const ShownUnit unit = table_unit(si, units, sizes.percentile_90);
  const auto shown = [&](double value) {
    return engineering_beside(std::abs(value) * unit.per_si, std::abs(sizes.largest) * unit.per_si, few_digits);
  };
  return {label, unit.name, shown(sizes.median), shown(sizes.percentile_90), shown(sizes.largest), at};
}

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
    const std::string mode = mode_words(errors.loci.tower, one.mode);
    text += fmt::format("{}: pose error over {} x {} cells{}\n", map.mechanism, map.nx, map.ny,
                        mode.empty() ? "" : "; " + mode);
    if (!one.never_loaded.empty()) text += never_loaded_words(one.never_loaded);
    std::vector<Row> rows;
    for (std::size_t f = 0; f < map.fields.size(); ++f)
      if (one.sizes[f])
        rows.push_back(size_row(map.fields[f].label, map.fields[f].unit, *one.sizes[f], errors.loci.units,
                                at_words(map, one.sizes[f]->at, errors.loci)));
    text += "\n" + format_rows(size_columns("absolute values"), rows);
    text += fmt::format("\n{} cells in the workspace, {} of them exactly on a locus\n\n", one.reachable, one.undefined);
    if (!one.zones.empty()) text += zones_text(one, errors.loci);
  }
  for (const std::string& note : errors.notes) text += note + "\n";
  return text;
}

}  // namespace clearloci::report
