#include <span>

#include "report/exports.hpp"
#include "report/file_units.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

/// A field of RFC 4180: quoted where it holds a separator, a quote or a space at an end.
std::string field(const std::string& text) {
  std::string clean = printable(text);
  const bool plain = clean.find_first_of(",\"") == std::string::npos &&
                     (clean.empty() || (clean.front() != ' ' && clean.back() != ' '));
  if (plain) return clean;
  std::string quoted = "\"";
  for (const char c : clean) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

void append_row(std::string& out, const std::string& start, std::span<const double> point) {
  out += start;
  for (const double value : point) {
    out += ',';
    out += exact_number(value);
  }
  out += '\n';
}

bool is_angle(const core::LocusMap& map, std::size_t coordinate) {
  return coordinate < map.angles.size() && map.angles[coordinate];
}

void angles_in_file_units(core::LocusMap& map) {
  const double per_rad = 1 / map.units.angle.size;
  for (std::size_t c = 0; c < map.tower.coordinates.size(); ++c) {
    if (!is_angle(map, c)) continue;
    for (core::LocusCurve& curve : map.curves)
      for (core::Arc& arc : curve.arcs)
        for (core::Point2& at : arc.points) at[c] *= per_rad;
    for (core::SpaceCurve& curve : map.space_curves)
      for (core::SpaceArc& arc : curve.arcs)
        for (core::Point3& at : arc.points) at[c] *= per_rad;
    for (core::LocusSurface& surface : map.surfaces)
      for (core::Point3& at : surface.vertices) at[c] *= per_rad;
    for (core::IsolatedPoint& point : map.isolated_points) point.at[c] *= per_rad;
  }
}

}  // namespace

std::string csv(const core::LocusMap& in_si) {
  core::LocusMap map = in_file_units(in_si);
  if (map.units.declared) angles_in_file_units(map);
  std::string out = "curve,arc,kind,vanishing,mode,closed";
  for (std::size_t c = 0; c < map.tower.coordinates.size(); ++c)
    out += "," + field(column_head(map.tower.coordinates[c], is_angle(map, c) ? "rad" : "m", map.units));
  out += '\n';
  const auto append = [&](const auto& curve) {
    const std::string what = field(core::to_string(curve.kind)) + "," + field(reaction_names(curve.vanishing)) + "," +
                             field(mode_words(map.tower, curve.mode));
    for (std::size_t i = 0; i < curve.arcs.size(); ++i) {
      const std::string start =
          field(curve.id) + "," + std::to_string(i + 1) + "," + what + (curve.arcs[i].closed ? ",true" : ",false");
      for (const auto& point : curve.arcs[i].points) append_row(out, start, point);
    }
  };
  for (const auto& curve : map.curves) append(curve);
  for (const auto& curve : map.space_curves) append(curve);
  for (const auto& surface : map.surfaces) {
    const std::string start = field(surface.id) + ",," + field(core::to_string(surface.kind)) + "," +
                              field(reaction_names(surface.vanishing)) + "," +
                              field(mode_words(map.tower, surface.mode)) + ",false";
    for (const auto& point : surface.vertices) append_row(out, start, point);
  }
  for (std::size_t i = 0; i < map.isolated_points.size(); ++i) {
    const auto& point = map.isolated_points[i];
    const std::string start = "p" + std::to_string(i + 1) + ",," + field(core::to_string(point.kind)) + "," +
                              field(reaction_names(point.vanishing)) + "," + field(mode_words(map.tower, point.mode)) +
                              ",false";
    append_row(out, start, point.at);
  }
  return out;
}

}  // namespace clearloci::report
