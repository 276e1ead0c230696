// Errors as files of other programs and as pictures.
#include <algorithm>

#include "report/coordinate_plots.hpp"
#include "report/error.hpp"
#include "report/field_exports.hpp"
#include "report/file_units.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/trajectory.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

/// The name of a mode's file, where there are several modes with the mode.
std::string file_name(const std::string& stem, const core::Errors& errors, const core::ModeErrors& mode,
                      const std::string& ending) {
  return stem + (errors.modes.size() > 1 ? "-" + mode_slug(errors.loci.tower, mode.mode) : "") + ending;
}

/// A map over two coordinates and the loci to be drawn over it.
struct Plane {
  core::FieldMap map;
  core::LocusMap loci;
  std::string name = {};  ///< "-z12" where slices are named
  const core::ModeErrors* mode = nullptr;
};

/// The values of all fields that are to be compared with this one.
std::vector<double> like(const std::vector<Plane>& planes, const core::Field& field) {
  std::vector<double> values;
  for (const Plane& plane : planes)
    for (const core::Field& other : plane.map.fields)
      if (other.unit == field.unit && other.is_signed == field.is_signed)
        values.insert(values.end(), other.values.begin(), other.values.end());
  return values;
}

Plane sliced(const core::Errors& errors, const core::FieldMap& map, const core::FieldSlice& slice) {
  const std::size_t across = slice.across;
  Plane plane{core::slice_of(map, slice), {}};
  core::LocusMap& loci = plane.loci;
  const std::string value =
      core::told(map.axes[across][slice.layer], map.angles[across] ? "rad" : "m", errors.loci.units, few_digits);
  loci.mechanism = errors.loci.mechanism + ", " + map.coordinates[across] + " = " + value;
  loci.units = errors.loci.units;
  loci.tower.roots = errors.loci.tower.roots;
  loci.tower.coordinates = plane.map.coordinates;
  loci.angles = plane.map.angles;
  for (std::size_t c = 0; c < plane.map.dimension(); ++c) {
    loci.lower.emplace_back(plane.map.lower[c]);
    loci.upper.emplace_back(plane.map.upper[c]);
  }
  return plane;
}

std::vector<Plane> planes_of(const ErrorSheet& sheet, const core::ModeErrors& mode) {
  const core::FieldMap& map = mode.map;
  std::vector<Plane> planes;
  if (map.dimension() < 3) planes.push_back({map, sheet.errors.loci});
  if (map.dimension() == 3 && sheet.slices.empty())
    planes.push_back(sliced(sheet.errors, map, {2, map.axes[2].size() / 2}));
  for (const core::FieldSlice& slice : sheet.slices) {
    planes.push_back(sliced(sheet.errors, map, slice));
    planes.back().name = "-" + map.coordinates[slice.across] + std::to_string(slice.layer);
  }
  for (Plane& plane : planes) plane.mode = &mode;
  return planes;
}

Files plots(const core::Errors& errors, PictureFormat format) {
  Files files;
  for (const core::ModeErrors& mode : errors.modes)
    for (const NamedPlot& named_plot : coordinate_plots(errors, mode))
      files.push_back({file_name(named_plot.name, errors, mode, ending_of(format)), plot(named_plot.plot, format)});
  return files;
}

}  // namespace

std::vector<std::string> error_formats(std::size_t coordinates) {
  std::vector<std::string> names = format_names<ErrorSheet>();
  if (coordinates == 1) std::erase(names, "vtk");
  return names;
}

Files error_csv(const ErrorSheet& sheet) {
  Files files;
  const core::Units& units = sheet.errors.loci.units;
  for (const core::ModeErrors& mode : sheet.errors.modes)
    files.push_back({file_name("error", sheet.errors, mode, ".csv"), mode.map.dimension() == 1
                                                                         ? shown_csv(core::samples_of(mode), units)
                                                                         : field_csv(mode.map, units)});
  return files;
}

Files error_vti(const ErrorSheet& sheet) {
  Files files;
  for (const core::ModeErrors& mode : sheet.errors.modes)
    if (mode.map.dimension() > 1) files.push_back({file_name("error", sheet.errors, mode, ".vti"), vti(mode.map)});
  return files;
}

Files error_pictures(const ErrorSheet& sheet, PictureFormat format) {
  const core::Errors& errors = sheet.errors;
  if (!errors.modes.empty() && errors.modes.front().map.dimension() == 1) return plots(errors, format);
  std::vector<Plane> planes;
  for (const core::ModeErrors& mode : errors.modes)
    for (Plane& plane : planes_of(sheet, mode)) planes.push_back(std::move(plane));
  Files files;
  for (const Plane& plane : planes)
    for (const core::Field& field : plane.map.fields) {
      std::string name = field.name;
      std::replace(name.begin(), name.end(), '_', '-');
      files.push_back({file_name("error-" + name, errors, *plane.mode, plane.name + ending_of(format)),
                       field_picture(plane.loci, plane.mode->mode, plane.map, field, format, like(planes, field))});
    }
  return files;
}

}  // namespace clearloci::report
