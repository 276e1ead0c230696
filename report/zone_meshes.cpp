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
  core::Field zone{"zone", "zone", "", true, {mode.labels.begin(), mode.labels.end()}};
  const auto lower = [&](std::size_t c) { return core::to_double(map.loci.lower[c]); };
  const auto upper = [&](std::size_t c) { return core::to_double(map.loci.upper[c]); };
  const std::vector<std::string>& names = map.loci.tower.coordinates;
  if (map.grid.size() == 2)
    return vti(core::FieldMap{map.loci.mechanism,
                              {names[0], names[1]},
                              {lower(0), lower(1)},
                              {upper(0), upper(1)},
                              map.grid[0],
                              map.grid[1],
                              {std::move(zone)}});
  core::FieldVolume volume;
  for (std::size_t c = 0; c < 3; ++c) {
    volume.coordinates[c] = names[c];
    volume.lower[c] = lower(c);
    volume.upper[c] = upper(c);
    volume.cells[c] = map.grid[c];
  }
  volume.fields.push_back(std::move(zone));
  return vti(volume);
}

}  // namespace

Files zones_vtk(const core::Zones& map) {
  Files files;
  const std::vector<core::WorkingMode> modes = modes_of_zones(map);
  if (map.grid.size() > 1)
    for (const core::ZonedMode& own : map.modes)
      files.push_back({"zones" + mode_suffix(modes, map.loci.tower, own.mode) + ".vti", label_vti(map, own)});
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
