#include <span>

#include "report/exports.hpp"
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

}  // namespace

std::string csv(const core::LocusMap& map) {
  std::string out = "curve,arc,kind,vanishing,mode,closed";
  for (const auto& name : map.tower.coordinates) out += "," + field(name);
  out += '\n';
  for (const auto& curve : map.curves) {
    const std::string what = field(core::to_string(curve.kind)) + "," + field(reaction_names(curve.vanishing)) + "," +
                             field(mode_words(map.tower, curve.mode));
    for (std::size_t i = 0; i < curve.arcs.size(); ++i) {
      const std::string start =
          field(curve.id) + "," + std::to_string(i + 1) + "," + what + (curve.arcs[i].closed ? ",true" : ",false");
      for (const auto& point : curve.arcs[i].points) append_row(out, start, point);
    }
  }
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
