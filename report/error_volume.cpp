#include "report/error_volume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/error.hpp"
#include "report/error_sizes.hpp"
#include "report/field_exports.hpp"
#include "report/file_units.hpp"
#include "report/loci_json.hpp"
#include "report/picture.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;
using core::FieldVolume;

/// The middle of a cell.
std::array<double, 3> place(const FieldVolume& volume, std::size_t cell) {
  const auto nx = static_cast<std::size_t>(volume.cells[0]), ny = static_cast<std::size_t>(volume.cells[1]);
  return {volume.at(0, static_cast<int>(cell % nx)), volume.at(1, static_cast<int>(cell / nx % ny)),
          volume.at(2, static_cast<int>(cell / (nx * ny)))};
}

Json sizes_json(const core::VolumeModeErrors& one) {
  Json all = Json::object();
  for (std::size_t f = 0; f < one.volume.fields.size(); ++f) {
    const core::Field& field = one.volume.fields[f];
    Json& own = all[field.name] = {{"unit", field.unit}, {"median", nullptr}};
    if (!one.sizes[f]) continue;
    own = {{"unit", field.unit},
           {"median", one.sizes[f]->median},
           {"percentile_90", one.sizes[f]->percentile_90},
           {"percentile_99", one.sizes[f]->percentile_99},
           {"largest", one.sizes[f]->largest},
           {"at", place(one.volume, one.sizes[f]->at)}};
  }
  return all;
}

/// "z = 300 mm", an angle in degrees.
std::string coordinate_words(const FieldVolume& volume, std::size_t c, double value, const core::Units& units) {
  if (volume.angles[c]) return fmt::format("{} = {:.4g} deg", volume.coordinates[c], value * 180 / std::numbers::pi);
  const ShownUnit length = shown_unit("m", units);
  return fmt::format("{} = {:.4g} {}", volume.coordinates[c], value * length.per_si, length.name);
}

std::string mode_text(const core::VolumeModeErrors& one) {
  std::string words;
  for (const auto& [point, side] : one.mode) words += (words.empty() ? "" : ", ") + point + " " + side;
  return words;
}

std::string slug(const core::VolumeModeErrors& one) {
  std::string words;
  for (const auto& [point, side] : one.mode) words += "-" + side;
  return words;
}

/// What a picture of a slice has below its colours: no loci, but names, units and the title.
core::LocusMap plane_of(const FieldVolume& volume, const core::VolumeSlice& slice, const core::VolumeErrors& errors,
                        const std::string& mode) {
  core::LocusMap plane;
  plane.mechanism = volume.mechanism + ", " +
                    coordinate_words(volume, slice.across, volume.at(slice.across, slice.layer), errors.units) +
                    (mode.empty() ? "" : "; " + mode);
  plane.units = errors.units;
  for (std::size_t c = 0; c < 3; ++c) {
    if (c == slice.across) continue;
    plane.tower.coordinates.push_back(volume.coordinates[c]);
    plane.angles.push_back(volume.angles[c]);
    plane.lower.emplace_back(volume.lower[c]);
    plane.upper.emplace_back(volume.upper[c]);
  }
  return plane;
}

FieldVolume in_file_units(FieldVolume volume, const core::Units& units) {
  if (!units.declared) return volume;
  for (core::Field& field : volume.fields) {
    const ShownUnit shown = shown_unit(field.unit, units);
    field.unit = shown.name;
    for (double& value : field.values) value *= shown.per_si;
  }
  return volume;
}

}  // namespace

Json error_volume_object(const core::VolumeErrors& errors) {
  Json all = Json::array();
  for (const core::VolumeModeErrors& one : errors.modes) {
    Json mode = Json::object();
    for (const auto& [point, side] : one.mode) mode[point] = side;
    all.push_back({{"working_mode", std::move(mode)},
                   {"reachable", one.reachable},
                   {"undefined", one.undefined},
                   {"never_loaded", one.never_loaded},
                   {"fields", sizes_json(one)}});
  }
  const FieldVolume& volume = errors.modes.front().volume;
  Json box = Json::array();
  for (std::size_t c = 0; c < 3; ++c) box.push_back({volume.lower[c], volume.upper[c]});
  Json root = {{"format", 1},
               {"mechanism", volume.mechanism},
               {"coordinates", volume.coordinates},
               {"box", std::move(box)},
               {"grid", volume.cells},
               {"complete", true},
               {"modes", std::move(all)}};
  if (errors.units.declared) root["units"] = "SI";
  if (!errors.notes.empty()) root["notes"] = errors.notes;
  return root;
}

std::string error_volume_text(const core::VolumeErrors& errors) {
  std::string text;
  for (const core::VolumeModeErrors& one : errors.modes) {
    const FieldVolume& volume = one.volume;
    const std::string mode = mode_text(one);
    text += fmt::format("{}: pose error over {} x {} x {} cells{}\n", volume.mechanism, volume.cells[0],
                        volume.cells[1], volume.cells[2], mode.empty() ? "" : "; " + mode);
    if (!one.never_loaded.empty()) text += never_loaded_words(one.never_loaded);
    std::vector<Row> rows;
    for (std::size_t f = 0; f < volume.fields.size(); ++f)
      if (one.sizes[f])
        rows.push_back(size_row(
            volume.fields[f].label, volume.fields[f].unit, *one.sizes[f], errors.units,
            place_words(place(volume, one.sizes[f]->at), std::vector<bool>(volume.angles.begin(), volume.angles.end()),
                        errors.units, few_digits)));
    text += "\n" + format_rows(size_columns("absolute values"), rows);
    text += fmt::format("\n{} cells in the workspace, {} of them exactly on a locus\n\n", one.reachable, one.undefined);
  }
  for (const std::string& note : errors.notes) text += note + "\n";
  return text;
}

namespace {

std::string slug(const core::VolumeErrors& errors, const core::VolumeModeErrors& one) {
  return errors.modes.size() > 1 ? slug(one) : "";
}

}  // namespace

Files volume_pictures(const VolumeSheet& sheet, PictureFormat format) {
  Files files;
  const bool named = !sheet.slices.empty();
  for (const core::VolumeModeErrors& one : sheet.errors.modes) {
    const FieldVolume& volume = one.volume;
    const std::vector<core::VolumeSlice> middle = {{2, volume.cells[2] / 2}};
    for (const core::VolumeSlice& slice : named ? sheet.slices : middle) {
      const core::LocusMap plane = plane_of(volume, slice, sheet.errors, mode_text(one));
      const core::FieldMap map = core::slice_of(volume, slice.across, slice.layer);
      const std::string layer = named ? fmt::format("-{}{}", volume.coordinates[slice.across], slice.layer) : "";
      for (const core::Field& field : map.fields) {
        std::string name = field.name;
        std::replace(name.begin(), name.end(), '_', '-');
        files.push_back({"error-" + name + slug(sheet.errors, one) + layer + ending_of(format),
                         field_picture(plane, {}, map, field, format)});
      }
    }
  }
  return files;
}

Files volume_csv(const VolumeSheet& sheet) {
  Files files;
  for (const core::VolumeModeErrors& one : sheet.errors.modes)
    files.push_back({"error" + slug(sheet.errors, one) + ".csv",
                     field_csv(in_file_units(one.volume, sheet.errors.units), sheet.errors.units)});
  return files;
}

Files volume_vti(const VolumeSheet& sheet) {
  Files files;
  for (const core::VolumeModeErrors& one : sheet.errors.modes)
    files.push_back({"error" + slug(sheet.errors, one) + ".vti", vti(one.volume)});
  return files;
}

}  // namespace clearloci::report
