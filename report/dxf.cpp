// DXF in two versions. LWPOLYLINE came with R14, so a file that holds one has to be R2000 (AC1015: the oldest version
// whose specification every current program still reads), with handles, owners and the block records that version asks
// for. A reader that stops at R12 gets the r12 version: the same layers and entities, without those, and POLYLINE
// instead.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "report/dxf_document.hpp"
#include "report/file_units.hpp"
#include "report/groups.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

std::string line_type_of(core::LocusKind kind) {
  switch (kind) {
    case core::LocusKind::backlash:
      return "DASHED";
    case core::LocusKind::component:
      return "DOT";
    case core::LocusKind::margin:
      return "HIDDEN";
    case core::LocusKind::preload:
      return "PHANTOM";
    case core::LocusKind::direct_singularity:
      return "DASHDOT";
    default:
      return "CONTINUOUS";
  }
}

/// The nearest colour indices to the picture's palette, in its order; white/black and grey for what is not a reaction.
int colour_of(core::LocusKind kind, int number) {
  constexpr std::array<int, 6> indices = {160, 20, 104, 221, 40, 140};
  if (kind == core::LocusKind::direct_singularity) return 7;
  if (kind == core::LocusKind::workspace_boundary) return 8;
  return indices[static_cast<std::size_t>(number) % indices.size()];
}

/// A name that every version allows: letters, digits, '-' and '_', at most 31.
std::string symbol_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    name += plain ? c : '_';
  }
  return name.substr(0, 31);
}

/// What an entity says about itself in its extended data.
struct Remarks {
  std::vector<std::string> lines;
};

void put_remarks(DxfWriter& out, const Remarks& remarks) {
  out.put(1001, "CLEARLOCI");
  for (const auto& line : remarks.lines) out.put(1000, dxf_string(line));
}

void start_entity(DxfWriter& out, std::string_view type, const std::string& layer, const DxfHandles& handles) {
  out.put(0, type);
  out.put_handle(handles.model_space);
  out.put_class("AcDbEntity");
  out.put(8, layer);
}

void write_line(DxfWriter& out, const core::Polyline& points, const std::string& layer, const DxfHandles& handles) {
  start_entity(out, "LINE", layer, handles);
  out.put_class("AcDbLine");
  out.put_point(points.front(), true);
  out.put_point(points.back(), true, 11);
}

/// Angle from `from` to `to` as seen from `centre`, in (-pi, pi].
double turn(const core::Point2& centre, const core::Point2& from, const core::Point2& to) {
  const double ax = from[0] - centre[0], ay = from[1] - centre[1], bx = to[0] - centre[0], by = to[1] - centre[1];
  return std::atan2(ax * by - ay * bx, ax * bx + ay * by);
}

/// CIRCLE for a closed arc, else ARC, which runs counter-clockwise from its start angle to its end angle.
void write_circle(DxfWriter& out, const core::Arc& arc, const core::Circle& circle, const std::string& layer,
                  const DxfHandles& handles) {
  const core::Point2& centre = circle.centre;
  start_entity(out, arc.closed ? "CIRCLE" : "ARC", layer, handles);
  out.put_class("AcDbCircle");
  out.put_point(centre, true);
  out.put_real(40, circle.radius);
  if (arc.closed) return;
  double swept = 0;
  for (std::size_t i = 1; i < arc.points.size(); ++i) swept += turn(centre, arc.points[i - 1], arc.points[i]);
  const auto degrees = [&](const core::Point2& point) {
    const double angle = std::atan2(point[1] - centre[1], point[0] - centre[0]) * 180 / std::numbers::pi;
    return angle < 0 ? angle + 360 : angle;
  };
  const double first = degrees(arc.points.front()), last = degrees(arc.points.back());
  out.put_class("AcDbArc");
  out.put_real(50, swept > 0 ? first : last);
  out.put_real(51, swept > 0 ? last : first);
}

/// A closed polyline has a flag instead of its first point again.
std::size_t vertex_count(const core::Arc& arc) { return arc.points.size() - (arc.closed ? 1 : 0); }

void write_lightweight_polyline(DxfWriter& out, const core::Arc& arc, const std::string& layer,
                                const DxfHandles& handles) {
  start_entity(out, "LWPOLYLINE", layer, handles);
  out.put_class("AcDbPolyline");
  out.put(90, static_cast<int>(vertex_count(arc)));
  out.put(70, arc.closed ? 1 : 0);
  for (std::size_t i = 0; i < vertex_count(arc); ++i) out.put_point(arc.points[i], false);
}

void write_old_polyline(DxfWriter& out, const core::Arc& arc, const std::string& layer, const Remarks& remarks,
                        const DxfHandles& handles) {
  start_entity(out, "POLYLINE", layer, handles);
  out.put(66, 1);
  out.put_point({0, 0}, true);
  out.put(70, arc.closed ? 1 : 0);
  put_remarks(out, remarks);
  for (std::size_t i = 0; i < vertex_count(arc); ++i) {
    start_entity(out, "VERTEX", layer, handles);
    out.put_point(arc.points[i], true);
  }
  start_entity(out, "SEQEND", layer, handles);
}

void write_arc(DxfWriter& out, const core::LocusCurve& curve, const core::Arc& arc, const std::string& layer,
               const Remarks& remarks, const DxfHandles& handles) {
  if (arc.points.size() < 2) return;
  const std::optional<core::Circle> circle = core::circle_through(curve.closed_form, arc.points);
  if (std::holds_alternative<core::LineForm>(curve.closed_form)) {
    write_line(out, arc.points, layer, handles);
  } else if (circle) {
    write_circle(out, arc, *circle, layer, handles);
  } else if (out.modern()) {
    write_lightweight_polyline(out, arc, layer, handles);
  } else {
    return write_old_polyline(out, arc, layer, remarks, handles);
  }
  put_remarks(out, remarks);
}

std::string curve_layer(const core::LocusCurve& curve) {
  return symbol_name(curve.id + "-" + core::to_string(curve.kind));
}

std::string point_layer(const core::IsolatedPoint& point) {
  return symbol_name("isolated-" + core::to_string(point.kind));
}

std::vector<DxfLayer> layers_of(const core::LocusMap& map) {
  std::vector<DxfLayer> layers = {{"0", 7, "CONTINUOUS"}};
  const Groups groups = group_loci(map);
  for (const auto& curve : map.curves) {
    for (const auto& group : groups.curves) {
      if (std::find(group.curves.begin(), group.curves.end(), &curve) == group.curves.end()) continue;
      layers.push_back({curve_layer(curve), colour_of(curve.kind, group.number), line_type_of(curve.kind)});
    }
  }
  for (const auto& point : map.isolated_points) {
    const std::string name = point_layer(point);
    const bool is_present =
        std::any_of(layers.begin(), layers.end(), [&](const DxfLayer& l) { return l.name == name; });
    if (!is_present) layers.push_back({name, 1, "CONTINUOUS"});
  }
  return layers;
}

void write_entities(DxfWriter& out, const core::LocusMap& map, const DxfHandles& handles) {
  out.begin_section("ENTITIES");
  for (const auto& curve : map.curves) {
    Remarks remarks = {{"mode: " + mode_words(map.tower, curve.mode)}};
    if (!curve.vanishing.empty()) remarks.lines.push_back("vanishing: " + reaction_names(curve.vanishing));
    if (!curve.factor.empty()) remarks.lines.push_back("factor: " + curve.factor);
    if (!curve.cause.empty()) remarks.lines.push_back("cause: " + curve.cause);
    for (const auto& arc : curve.arcs) write_arc(out, curve, arc, curve_layer(curve), remarks, handles);
  }
  for (const auto& point : map.isolated_points) {
    start_entity(out, "POINT", point_layer(point), handles);
    out.put_class("AcDbPoint");
    out.put_point({point.at[0], point.at.size() > 1 ? point.at[1] : 0}, true);
    put_remarks(out, {{"mode: " + mode_words(map.tower, point.mode), "vanishing: " + reaction_names(point.vanishing)}});
  }
  out.end_section();
}

}  // namespace

std::string dxf(const core::LocusMap& in_si, DxfVersion version) {
  const core::LocusMap map = in_file_units(in_si);
  DxfWriter body(version);
  write_dxf_classes(body);
  const DxfHandles handles = write_dxf_tables(body, map, layers_of(map));
  write_dxf_blocks(body, handles);
  write_entities(body, map, handles);
  write_dxf_objects(body);
  body.put(0, "EOF");

  DxfWriter header(version);
  header.put(999, dxf_string("clearloci: discontinuity loci of " + map.mechanism + "; " +
                             (map.units.declared ? map.units.length.name : "metres")));
  write_dxf_header(header, map, body.next_handle());
  return header.text() + body.text();
}

}  // namespace clearloci::report
