#include "report/zones.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/loci_json.hpp"
#include "report/pose.hpp"
#include "report/preload.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

/// Joints whose contact force vanishes somewhere on the zone's border.
Json lost_at_border(const core::Zone& zone) {
  Json joints = Json::array();
  for (const std::string& joint : joints_lost_at(zone)) joints.push_back(joint);
  return joints;
}

/// By cells without a curve and a length.
Json borders_array(const core::Zones& map, const core::Zone& zone) {
  Json borders = Json::array();
  for (const core::ZoneBorder& border : zone.borders) {
    Json entry = Json::object();
    if (!map.by_cells) entry["curve"] = border.curve;
    entry["kind"] = border.kind ? core::to_string(*border.kind) : "box";
    entry["vanishing"] = vanishing_array(border.vanishing);
    if (!map.by_cells) entry["length"] = border.length;
    if (!border.cause.empty()) entry["cause"] = border.cause;
    if (!border.beside.empty()) entry["beside"] = border.beside;
    borders.push_back(std::move(entry));
  }
  return borders;
}

Json ends_array(const core::Zone& zone) {
  Json ends = Json::array();
  for (const core::ZoneEnd& end : zone.ends) {
    ends.push_back(
        {{"at", end.at}, {"kind", core::to_string(end.kind)}, {"vanishing", vanishing_array(end.vanishing)}});
    if (!end.limit.empty()) ends.back()["limit"] = end.limit;
    if (!end.cause.empty()) ends.back()["cause"] = end.cause;
    if (end.jump) ends.back()["jump"] = pose_error_object(*end.jump);
  }
  return ends;
}

Json polygon_of(const core::Zone& zone) {
  Json rings = Json::array({zone.outer});
  for (const core::Polyline& hole : zone.holes) rings.push_back(hole);
  return rings;
}

Json signs_of(const core::Zone& zone) {
  Json signs = Json::object();
  for (const auto& [reaction, sign] : zone.signs) signs[reaction.joint][core::to_string(reaction.quantity)] = sign;
  return signs;
}

Json zone_object(const core::Zones& map, const core::Zone& zone) {
  const auto ball = [&] { return Json{{"centre", zone.ball.centre}, {"radius", zone.ball.radius}}; };
  Json body = {{"id", zone.id},
               {"working_mode", mode_object(map.loci.tower, zone.mode)},
               {"assembly_mode", zone.assembly_mode},
               {"signs", signs_of(zone)},
               {"too_small", vanishing_array(zone.too_small)},
               {"contact_lost_at_border", lost_at_border(zone)},
               {"at_least", zone.at_least},
               {"at_most", zone.at_most},
               {"lower", zone.lower},
               {"upper", zone.upper},
               {"sample", zone.sample},
               {"ball", zone.ball.radius > 0 ? ball() : Json(nullptr)},
               {"certified", zone.certified},
               {"borders", borders_array(map, zone)},
               {"perhaps_one_with", zone.perhaps_one_with}};
  if (zone.preload) body["preload"] = zone_preload_object(*zone.preload);
  if (map.by_cells) {
    body["bounds"] = body["borders"];
    body["ends"] = ends_array(zone);
    return body;
  }
  body["area"] = zone.size;
  body["inscribed_circle"] = ball();
  body["isolated_points"] = Json::array();
  for (const int i : zone.isolated_points) {
    const core::IsolatedPoint& point = map.loci.isolated_points[static_cast<std::size_t>(i)];
    body["isolated_points"].push_back({{"vanishing", vanishing_array(point.vanishing)}, {"at", point.at}});
  }
  body["polygon"] = polygon_of(zone);
  return body;
}

}  // namespace

std::vector<bool> angles_of(const core::LocusMap& map) {
  return map.angles.empty() ? std::vector<bool>(map.tower.coordinates.size(), false) : map.angles;
}

std::vector<std::string> joints_lost_at(const core::Zone& zone) {
  std::vector<std::string> joints;
  for (const core::ZoneBorder& border : zone.borders) {
    if (border.kind != core::LocusKind::contact_loss) continue;
    for (const core::Vanishing& v : border.vanishing) {
      const bool found = std::find(joints.begin(), joints.end(), v.joint) != joints.end();
      if (v.quantity == core::Quantity::f && !found) joints.push_back(v.joint);
    }
  }
  return joints;
}

std::vector<core::WorkingMode> modes_of_zones(const core::Zones& map) {
  std::vector<core::WorkingMode> modes;
  const auto add = [&](const core::WorkingMode& mode) {
    if (std::find(modes.begin(), modes.end(), mode) == modes.end()) modes.push_back(mode);
  };
  for (const core::Zone& zone : map.zones) add(zone.mode);
  for (const core::ZonedMode& mode : map.modes)
    if (map.by_cells || mode.in_doubt > 0) add(mode.mode);
  return modes;
}

Json zones_object(const core::Zones& map) {
  const Json loci = loci_object(map.loci);
  Json root;
  for (const char* key : {"format", "mechanism", "parameters", "coordinates"}) root[key] = loci[key];
  root["angles"] = angles_of(map.loci);
  root["box"] = loci["box"];
  if (!map.by_cells) root["tolerance"] = map.loci.tolerance;
  root["complete"] = map.loci.complete;
  root["open"] = loci.value("open", Json::array());
  if (map.loci.units.declared) root["units"] = "SI";
  if (map.by_cells && map.modes.size() == 1) root["working_mode"] = mode_object(map.loci.tower, map.modes.front().mode);
  root["zones"] = Json::array();
  for (const core::Zone& zone : map.zones) root["zones"].push_back(zone_object(map, zone));
  for (const core::PreloadRegion& region : map.preload_regions) {
    Json signs = Json::object();
    for (const auto& [reaction, sign] : region.signs) signs[reaction.joint][core::to_string(reaction.quantity)] = sign;
    root["preload_regions"].push_back({{"working_mode", mode_object(map.loci.tower, region.mode)},
                                       {"signs", std::move(signs)},
                                       {"zones", region.zones},
                                       {"area", region.size}});
  }
  root["areas"] = Json::array();
  core::ZonedMode all;
  for (const core::ZonedMode& mode : map.modes) {
    root["areas"].push_back({{"working_mode", mode_object(map.loci.tower, mode.mode)},
                             {"workspace", mode.workspace},
                             {"outside", mode.outside},
                             {"in_doubt", mode.in_doubt}});
    if (map.by_cells) root["areas"].back()["cells"] = mode.cells;
    all.outside += mode.outside;
    all.in_doubt += mode.in_doubt;
    all.cells += mode.cells;
  }
  if (map.by_cells) {
    root["outside"] = all.outside;
    root["in_doubt"] = all.in_doubt;
    root["cells"] = all.cells;
  }
  root["notes"] = loci["notes"];
  root["timing"] = loci["timing"];
  return root;
}

std::string zones_geojson(const core::Zones& map) {
  Json root = {{"type", "FeatureCollection"},
               {"name", printable(map.loci.mechanism)},
               {"units", "m"},
               {"coordinates", map.loci.tower.coordinates},
               {"features", Json::array()}};
  for (const core::Zone& zone : map.zones) {
    Json properties = {{"zone", zone.id},
                       {"mode", mode_object(map.loci.tower, zone.mode)},
                       {"assembly_mode", zone.assembly_mode},
                       {"signs", signs_of(zone)},
                       {"area", zone.size},
                       {"certified", zone.certified},
                       {"units", "m"}};
    root["features"].push_back({{"type", "Feature"},
                                {"geometry", {{"type", "Polygon"}, {"coordinates", polygon_of(zone)}}},
                                {"properties", std::move(properties)}});
  }
  return json_text(root);
}

}  // namespace clearloci::report
