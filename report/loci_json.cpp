#include "report/loci_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "report/exports.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

Json exact(const core::Rational& value) { return core::to_string(value); }

/// "1/4 - 1/4*sqrt(3)".
std::string exact(const core::QuadraticNumber& value, const core::Integer& n, int sign) {
  const core::Rational multiple = sign * value.multiple;
  if (multiple == 0) return core::to_string(value.rational);
  const std::string root =
      (abs(multiple) == 1 ? "" : core::to_string(abs(multiple)) + "*") + "sqrt(" + n.get_str() + ")";
  if (value.rational == 0) return (sgn(multiple) < 0 ? "-" : "") + root;
  return core::to_string(value.rational) + (sgn(multiple) < 0 ? " - " : " + ") + root;
}

Json circle_pair_object(const core::CirclePairForm& pair) {
  Json circles = Json::array();
  const std::vector<core::Circle> rounded = core::circles_of(pair);
  for (const int sign : {1, -1}) {
    Json body;
    body["centre"] = {exact(pair.centre[0], pair.n, sign), exact(pair.centre[1], pair.n, sign)};
    body["radius"] = rounded[sign > 0 ? 0 : 1].radius;
    body["radius_squared"] = exact(pair.radius_squared, pair.n, sign);
    circles.push_back(std::move(body));
  }
  return {{"circles", std::move(circles)}};
}

Json closed_form_object(const core::ClosedForm& form) {
  if (const auto* line = std::get_if<core::LineForm>(&form)) {
    return {{"line", {{"a", exact(line->a)}, {"b", exact(line->b)}, {"c", exact(line->c)}}}};
  }
  if (const auto* circle = std::get_if<core::CircleForm>(&form)) {
    Json body;
    body["centre"] = Json::array({exact(circle->centre[0]), exact(circle->centre[1])});
    if (circle->radius) {
      body["radius"] = exact(*circle->radius);
    } else {
      body["radius"] = std::sqrt(core::to_double(circle->radius_squared));
      body["radius_squared"] = exact(circle->radius_squared);
    }
    return {{"circle", std::move(body)}};
  }
  if (const auto* pair = std::get_if<core::CirclePairForm>(&form)) return circle_pair_object(*pair);
  if (const auto* conic = std::get_if<core::ConicForm>(&form)) {
    Json body;
    body["type"] = conic->type;
    for (const auto& coefficient : conic->coefficients) body["coefficients"].push_back(exact(coefficient));
    if (conic->centre) body["centre"] = *conic->centre;
    if (conic->semi_axes) body["semi_axes"] = *conic->semi_axes;
    if (conic->semi_axes) body["angle"] = conic->angle;
    return {{"conic", std::move(body)}};
  }
  return nullptr;
}

template <class Arc>
Json arc_object(const Arc& arc) {
  Json body;
  body["closed"] = arc.closed;
  body["ends"] = arc.closed ? Json::array() : Json::array({core::to_string(arc.ends[0]), core::to_string(arc.ends[1])});
  if constexpr (std::is_same_v<Arc, core::SpaceArc>) body["certified"] = arc.certified;
  body["length"] = arc.length;
  body["points"] = arc.points;
  return body;
}

/// What every locus has; its polynomial is not known.
template <class Locus>
Json named(const Locus& locus) {
  Json body;
  body["id"] = locus.id;
  body["kind"] = core::to_string(locus.kind);
  body["vanishing"] = vanishing_array(locus.vanishing);
  body["factor"] = printable(locus.factor);
  body["cause"] = printable(locus.cause);
  body["implicit"] = nullptr;
  return body;
}

Json curve_object(const core::LocusMap& map, const core::LocusCurve& curve) {
  Json body = named(curve);
  if (!curve.implicit.is_zero())
    body["implicit"] = {{"polynomial", core::to_string(curve.implicit, curve.variables.empty() ? map.tower.coordinates
                                                                                               : curve.variables)},
                        {"degree", core::total_degree(curve.implicit)}};
  body["closed_form"] = closed_form_object(curve.closed_form);
  body["working_mode"] = mode_object(map.tower, curve.mode);
  body["certified"] = curve.certified;
  if (curve.kind == core::LocusKind::direct_singularity) body["excited"] = curve.excited;
  body["arcs"] = Json::array();
  for (const auto& arc : curve.arcs) body["arcs"].push_back(arc_object(arc));
  return body;
}

Json space_curve_object(const core::LocusMap& map, const core::SpaceCurve& curve) {
  Json body = named(curve);
  body["closed_form"] = nullptr;
  body["working_mode"] = mode_object(map.tower, curve.mode);
  body["certified"] = curve.certified;
  body["arcs"] = Json::array();
  for (const auto& arc : curve.arcs) body["arcs"].push_back(arc_object(arc));
  return body;
}

Json surface_object(const core::LocusMap& map, const core::LocusSurface& surface) {
  Json body = named(surface);
  if (!surface.implicit.is_zero())
    body["implicit"] = {{"polynomial", core::to_string(surface.implicit, surface.variables)},
                        {"degree", core::total_degree(surface.implicit)}};
  body["working_mode"] = mode_object(map.tower, surface.mode);
  body["certified"] = surface.certified;
  body["within_resolution"] = surface.within_resolution;
  body["resolution"] = surface.resolution;
  body["open"] = Json::array();
  for (const core::LocusSurface::Open& open : surface.open)
    body["open"].push_back({{"from", open.lower}, {"to", open.upper}, {"cells", open.cells}});
  body["components"] = surface.components;
  body["euler_characteristic"] = surface.euler_characteristic;
  body["area"] = surface.area;
  body["deviation"] = surface.deviation;
  body["vertices"] = surface.vertices.size();
  body["triangles"] = surface.triangles.size();
  body["mesh"] = {{"file", "loci.obj"}, {"group", mesh_name(surface)}};
  return body;
}

Json isolated_point_object(const core::LocusMap& map, const core::IsolatedPoint& point) {
  Json body;
  body["kind"] = core::to_string(point.kind);
  body["vanishing"] = vanishing_array(point.vanishing);
  if (!point.factor.empty()) {
    body["factor"] = printable(point.factor);
    body["cause"] = printable(point.cause);
  }
  if (point.kind == core::LocusKind::direct_singularity && point.at.size() == 1) body["excited"] = point.excited;
  body["at"] = point.at;
  body["certified"] = point.certified;
  body["working_mode"] = mode_object(map.tower, point.mode);
  return body;
}

Json open_array(const core::LocusMap& map) {
  Json list = Json::array();
  for (const core::OpenRegion& region : map.open)
    list.push_back({{"kind", core::to_string(region.kind)},
                    {"vanishing", vanishing_array(region.vanishing)},
                    {"factor", printable(region.factor)},
                    {"cause", printable(region.cause)},
                    {"working_mode", mode_object(map.tower, region.mode)},
                    {"from", region.lower},
                    {"to", region.upper},
                    {"point", region.point}});
  return list;
}

Json box_array(const core::LocusMap& map) {
  Json box = Json::array();
  for (std::size_t i = 0; i < map.lower.size(); ++i) {
    box.push_back({core::to_double(map.lower[i]), core::to_double(map.upper[i])});
  }
  return box;
}

bool holds_object(const Json& value) {
  return value.is_object() || (value.is_array() && std::any_of(value.begin(), value.end(), holds_object));
}

void print(const Json& value, int depth, std::string& out) {
  const bool object = value.is_object();
  if (value.empty() || !holds_object(value)) {
    out += value.dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  const std::string indent(static_cast<std::size_t>(2 * depth + 2), ' ');
  out += object ? "{\n" : "[\n";
  bool first = true;
  for (auto it = value.begin(); it != value.end(); ++it) {
    if (!first) out += ",\n";
    first = false;
    out += indent;
    if (object) out += Json(it.key()).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
    print(*it, depth + 1, out);
  }
  out += "\n" + indent.substr(2) + (object ? "}" : "]");
}

}  // namespace

Json mode_object(const core::TowerNames& tower, const core::WorkingMode& mode) {
  Json body = Json::object();
  for (const auto& [point, side] : core::describe_mode(tower, mode)) body[printable(point)] = side;
  return body;
}

Json parameters_object(const std::vector<std::pair<std::string, std::string>>& parameters) {
  Json all = Json::object();
  for (const auto& [name, value] : parameters) all[printable(name)] = value;
  return all;
}

Json vanishing_array(const std::vector<core::Vanishing>& vanishing) {
  Json reactions = Json::array();
  for (const auto& one : vanishing) {
    Json body = {{"joint", printable(one.joint)}, {"quantity", core::to_string(one.quantity)}};
    if (one.multiplicity > 1) body["multiplicity"] = one.multiplicity;
    reactions.push_back(std::move(body));
  }
  return reactions;
}

Json loci_object(const core::LocusMap& map) {
  Json root;
  root["format"] = 1;
  root["mechanism"] = printable(map.mechanism);
  root["parameters"] = parameters_object(map.parameters);
  root["coordinates"] = map.tower.coordinates;
  if (!map.angles.empty()) {
    for (const bool angle : map.angles) root["units"].push_back(angle ? "rad" : "m");
  } else if (map.units.declared) {
    root["units"] = "SI";  // whatever the file is written in
  }
  root["box"] = box_array(map);
  if (map.tower.coordinates.size() != 3 || !map.space_curves.empty()) root["tolerance"] = map.tolerance;  // of arcs
  root["complete"] = map.complete;
  root["curves"] = Json::array();
  for (const auto& curve : map.curves) root["curves"].push_back(curve_object(map, curve));
  for (const auto& curve : map.space_curves) root["curves"].push_back(space_curve_object(map, curve));
  if (map.tower.coordinates.size() == 3) {
    root["surfaces"] = Json::array();
    for (const auto& surface : map.surfaces) root["surfaces"].push_back(surface_object(map, surface));
  }
  root["isolated_points"] = Json::array();
  for (const auto& point : map.isolated_points) root["isolated_points"].push_back(isolated_point_object(map, point));
  if (map.tower.coordinates.size() <= 2) root["open"] = open_array(map);
  root["workspace"] = Json::array();
  for (const auto& region : map.workspace) {
    root["workspace"].push_back({{"working_mode", mode_object(map.tower, region.mode)}, {"rings", region.rings}});
  }
  if (map.tower.coordinates.size() == 1) root["reachable"] = Json::array();
  for (const auto& interval : map.reachable) {
    root["reachable"].push_back(
        {{"working_mode", mode_object(map.tower, interval.mode)}, {"from", interval.from}, {"to", interval.to}});
  }
  root["notes"] = Json::array();
  for (const auto& note : map.notes) root["notes"].push_back(printable(note));
  root["timing"] = Json::object();
  for (const auto& [stage, seconds] : map.timing) root["timing"][stage] = seconds;
  return root;
}

std::string json_text(const Json& value) {
  std::string out;
  print(value, 0, out);
  return out + "\n";
}

}  // namespace clearloci::report
