#include "report/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/unloaded_words.hpp"
#include "report/file_units.hpp"
#include "report/loci_json.hpp"
#include "report/pose.hpp"
#include "report/table_json.hpp"
#include "report/text_table.hpp"
#include "report/wording.hpp"
#include "report/zones.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;
using Sizes = std::vector<std::optional<core::ErrorSizes>>;

Json sizes_json(const core::FieldMap& map, const Sizes& sizes) {
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
                       {"at", map.place(sizes[f]->at)}};
  }
  return all;
}

Json jumps_json(const core::ModeErrors& mode) {
  Json jumps = Json::array();
  for (const core::ErrorEvent& event : mode.events) {
    if (!event.jumps) continue;
    jumps.push_back({{"at", event.point.at},
                     {"kind", core::to_string(event.point.kind)},
                     {"vanishing", vanishing_array(event.point.vanishing)}});
    jumps.back().update(pose_error_object(event.jump));
  }
  return jumps;
}

Json mode_json(const core::Errors& errors, const core::ModeErrors& mode) {
  Json body = {{"working_mode", mode_object(errors.loci.tower, mode.mode)},
               {"reachable", mode.reachable},
               {"undefined", mode.undefined},
               {"never_loaded", mode.never_loaded},
               {"fields", sizes_json(mode.map, mode.sizes)}};
  for (const core::ZoneErrors& zone : mode.zones)
    body["zones"].push_back(
        {{"id", zone.zone}, {"cells", zone.cells.size()}, {"fields", sizes_json(mode.map, zone.sizes)}});
  if (mode.map.dimension() == 1) {
    body["jumps"] = jumps_json(mode);
    body["samples"] = table_object(core::samples_of(mode));
  }
  return body;
}

std::vector<Column> size_columns(const std::string& what, const std::string& place) {
  return {{what},
          {"unit"},
          {"median", 0, Alignment::point},
          {"90 %", 0, Alignment::point},
          {"largest", 0, Alignment::point},
          {place, 0, place == "at" ? Alignment::left : Alignment::point}};
}

/// Tables of the sizes that errors have over the workspace.
class SizesText {
 public:
  SizesText(const core::Errors& errors, const core::ModeErrors& mode) : loci_(errors.loci), mode_(mode) {
    if (mode.map.dimension() > 1) return;
    along_ = table_unit(mode.map.angles.front() ? "rad" : "m", loci_.units);
    head_ = fmt::format("at {} [{}]", mode.map.coordinates.front(), along_.name);
  }

  std::string of_all() const {
    std::vector<Row> rows;
    for (std::size_t f = 0; f < mode_.map.fields.size(); ++f)
      if (mode_.sizes[f]) rows.push_back(row(mode_.map.fields[f].label, mode_.map.fields[f].unit, *mode_.sizes[f]));
    return format_rows(size_columns("absolute values", head_), rows);
  }

  /// The bound that counts where the load is not known, zone by zone.
  std::string of_zones() const {
    std::string text;
    for (std::size_t f = 0; f < mode_.map.fields.size(); ++f) {
      const core::Field& field = mode_.map.fields[f];
      if (field.name != "dp" && field.name != "worst_dp") continue;
      std::vector<Row> rows;
      for (const core::ZoneErrors& zone : mode_.zones) {
        const std::string name = fmt::format("{}, {} cells", zone.zone, zone.cells.size());
        rows.push_back(zone.sizes[f] ? row(name, field.unit, *zone.sizes[f]) : Row{name, "", "none", "", "", ""});
      }
      text += format_rows(size_columns(field.label + ", zone by zone", head_), rows) + "\n";
    }
    return text;
  }

 private:
  /// A quantity of a unit of SI, shown in what reads best.
  Row row(const std::string& label, const std::string& si, const core::ErrorSizes& sizes) const {
    // By the most that is typical: near a direct singularity the largest has no bound.
    const ShownUnit unit = table_unit(si, loci_.units, sizes.percentile_90);
    const auto shown = [&](double value) {
      return engineering_beside(std::abs(value) * unit.per_si, std::abs(sizes.largest) * unit.per_si, few_digits);
    };
    return {label, unit.name, shown(sizes.median), shown(sizes.percentile_90), shown(sizes.largest), at(sizes.at)};
  }

  std::string at(std::size_t cell) const {
    const std::vector<double> place = mode_.map.place(cell);
    return place.size() == 1 ? engineering(along_.per_si * place.front(), few_digits)
                             : place_words(place, loci_.angles, loci_.units, few_digits);
  }

  const core::LocusMap& loci_;
  const core::ModeErrors& mode_;
  ShownUnit along_;
  std::string head_ = "at";
};

std::string jumps_text(const core::Errors& errors, const core::ModeErrors& mode) {
  const core::Units& units = errors.loci.units;
  double lengths = 0, angles = 0;
  for (const core::ErrorEvent& event : mode.events) {
    if (!event.jumps) continue;
    for (const double jump : event.jump.displacement)
      if (std::isfinite(jump)) lengths = std::max(lengths, std::abs(jump));
    for (const double jump : event.jump.rotation)
      if (std::isfinite(jump)) angles = std::max(angles, std::abs(jump));
  }
  const ShownUnit length = table_unit("m", units, lengths), turn = table_unit("rad", units);
  const ShownUnit along = table_unit(mode.map.angles.front() ? "rad" : "m", units);
  const auto size = [](double value, double beside, const ShownUnit& unit) {
    if (!std::isfinite(value)) return std::string("undefined");
    return engineering_beside(value * unit.per_si, beside * unit.per_si, few_digits);
  };
  std::vector<Column> heading = {
      {fmt::format("{} [{}]", mode.map.coordinates.front(), along.name), 0, Alignment::point}};
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
      heading.push_back({"what vanishes"});
    }
    Row& row = rows.emplace_back(Row{engineering(along.per_si * event.point.at.front(), place_digits)});
    for (const double jump : places) row.push_back(size(jump, lengths, length));
    for (const double jump : turns) row.push_back(size(jump, angles, turn));
    row.push_back(vanishing_words(event.point.kind, event.point.vanishing));
  }
  return rows.empty() ? std::string() : format_rows(heading, rows) + "\n";
}

std::string never_loaded_words(const std::vector<std::string>& joints) {
  return fmt::format("No error under the load: {} in any pose{}.\n", core::words_of_idle(joints),
                     core::undefined_take_up_words);
}

std::string mode_text(const core::Errors& errors, const core::ModeErrors& mode) {
  const bool range = mode.map.dimension() == 1;
  const std::string over = range ? fmt::format("{} in {} steps", mode.map.coordinates.front(), errors.grid.front())
                                 : fmt::format("{} cells", fmt::join(errors.grid, " x "));
  const std::string words = mode_words(errors.loci.tower, mode.mode);
  std::string text =
      fmt::format("{}: pose error over {}{}\n", errors.loci.mechanism, over, words.empty() ? "" : "; " + words);
  if (&mode == &errors.modes.front()) text += parameter_line(errors.loci.parameters);
  if (!mode.never_loaded.empty()) text += never_loaded_words(mode.never_loaded);
  const SizesText sizes(errors, mode);
  text += "\n" + sizes.of_all() + "\n";
  text += range ? jumps_text(errors, mode)
                : fmt::format("{} cells in the workspace, {} of them exactly on a locus\n\n", mode.reachable,
                              mode.undefined);
  return mode.zones.empty() ? text : text + sizes.of_zones();
}

}  // namespace

Json error_object(const core::Errors& errors) {
  const core::FieldMap& map = errors.modes.front().map;
  const bool range = map.dimension() == 1;
  Json root = {{"format", 1},
               {"mechanism", errors.loci.mechanism},
               {"parameters", parameters_object(errors.loci.parameters)},
               {"coordinates", map.coordinates},
               {"angles", angles_of(errors.loci)},
               {"complete", errors.loci.complete}};
  if (range)
    root["units"] = {map.angles.front() ? "rad" : "m"};
  else if (errors.loci.units.declared)
    root["units"] = "SI";
  for (std::size_t c = 0; c < map.dimension(); ++c) root["box"].push_back({map.lower[c], map.upper[c]});
  root["grid"] = errors.grid;
  if (range) root["steps"] = errors.grid.front();
  root["modes"] = Json::array();
  for (const core::ModeErrors& mode : errors.modes) root["modes"].push_back(mode_json(errors, mode));
  if (!errors.notes.empty()) root["notes"] = errors.notes;
  return root;
}

std::string error_text(const core::Errors& errors) {
  std::string text;
  for (const core::ModeErrors& mode : errors.modes) text += mode_text(errors, mode);
  for (const std::string& note : errors.notes) text += note + "\n";
  return text;
}

}  // namespace clearloci::report
