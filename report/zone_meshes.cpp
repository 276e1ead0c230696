// Zones by cells as files of VTK and STL.
#include <algorithm>

#include "report/exports.hpp"
#include "report/field_exports.hpp"
#include "report/zones.hpp"

namespace clearloci::report {
namespace {

/// The outside of what is proven of a zone.
core::LocusSurface surface_of(const core::Zone& zone) {
  core::LocusSurface surface;
  surface.id = zone.id;
  surface.kind = core::LocusKind::workspace_boundary;
  for (const auto& corners : zone.faces) {
    const int first = static_cast<int>(surface.vertices.size());
    surface.vertices.insert(surface.vertices.end(), corners.begin(), corners.end());
    for (int i = 2; i < static_cast<int>(corners.size()); ++i)
      surface.triangles.push_back({first, first + i - 1, first + i});
  }
  return surface;
}

/// The grid of labels as a field.
std::string label_vti(const core::Zones& map, const core::ZonedMode& mode) {
  core::FieldMap labels;
  labels.coordinates = map.loci.tower.coordinates;
  labels.angles = angles_of(map.loci);
  for (std::size_t c = 0; c < map.grid.size(); ++c) {
    const double low = core::to_double(map.loci.lower[c]), high = core::to_double(map.loci.upper[c]);
    labels.lower.push_back(low);
    labels.upper.push_back(high);
    std::vector<double>& axis = labels.axes.emplace_back();
    for (int i = 0; i < map.grid[c]; ++i) axis.push_back(low + (i + 0.5) * (high - low) / map.grid[c]);
  }
  labels.fields.push_back({"zone", "zone", "", true, {mode.labels.begin(), mode.labels.end()}});
  return vti(labels);
}

}  // namespace

Files zones_vtk(const core::Zones& map) {
  Files files;
  const std::vector<core::WorkingMode> modes = modes_of_zones(map);
  if (map.grid.size() > 1)
    for (const core::ZonedMode& mode : map.modes)
      files.push_back({"zones" + mode_suffix(modes, map.loci.tower, mode.mode) + ".vti", label_vti(map, mode)});
  if (map.grid.size() < 3) return files;
  for (const core::Zone& zone : map.zones) {
    core::LocusMap alone;
    alone.mechanism = map.loci.mechanism;
    alone.surfaces.push_back(surface_of(zone));
    files.push_back({"zones-" + zone.id + ".vtp", vtp(alone)});
  }
  return files;
}

Files zones_stl(const core::Zones& map) {
  Files files;
  if (map.grid.size() < 3) return files;
  for (const core::Zone& zone : map.zones) files.push_back({"zones-" + zone.id + ".stl", stl(surface_of(zone))});
  return files;
}

}  // namespace clearloci::report
