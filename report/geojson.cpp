#include <nlohmann/json.hpp>

#include "report/exports.hpp"
#include "report/loci_json.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

Json feature(Json geometry, Json properties) {
  return {{"type", "Feature"}, {"geometry", std::move(geometry)}, {"properties", std::move(properties)}};
}

/// "m", or one a coordinate.
Json units_object(const core::LocusMap& map) {
  const std::vector<std::string> units = units_of(map);
  return units.size() == 1 ? Json(units.front()) : Json(units);
}

Json arc_feature(const core::LocusMap& map, const core::LocusCurve& curve, std::size_t index) {
  const core::Arc& arc = curve.arcs[index];
  Json properties = {{"curve", curve.id},
                     {"arc", index + 1},
                     {"kind", core::to_string(curve.kind)},
                     {"vanishing", vanishing_array(curve.vanishing)},
                     {"excited", curve.excited},
                     {"factor", printable(curve.factor)},
                     {"cause", printable(curve.cause)},
                     {"mode", mode_object(map.tower, curve.mode)},
                     {"certified", curve.certified},
                     {"closed", arc.closed},
                     {"ends", Json::array()},
                     {"length", arc.length},
                     {"units", units_object(map)}};
  if (!arc.closed) properties["ends"] = {core::to_string(arc.ends[0]), core::to_string(arc.ends[1])};
  return feature({{"type", "LineString"}, {"coordinates", arc.points}}, std::move(properties));
}

/// A position has two numbers: with a single free coordinate the second is 0.
Json point_feature(const core::LocusMap& map, std::size_t index) {
  const core::IsolatedPoint& point = map.isolated_points[index];
  std::vector<double> position = point.at;
  if (position.size() == 1) position.push_back(0);
  Json properties = {{"curve", "p" + std::to_string(index + 1)},
                     {"kind", core::to_string(point.kind)},
                     {"vanishing", vanishing_array(point.vanishing)},
                     {"mode", mode_object(map.tower, point.mode)},
                     {"certified", point.certified},
                     {"units", units_object(map)}};
  return feature({{"type", "Point"}, {"coordinates", position}}, std::move(properties));
}

}  // namespace

std::string geojson(const core::LocusMap& map) {
  Json root = {{"type", "FeatureCollection"},          {"name", printable(map.mechanism)}, {"units", units_object(map)},
               {"coordinates", map.tower.coordinates}, {"complete", map.complete},         {"features", Json::array()}};
  for (const auto& curve : map.curves) {
    for (std::size_t i = 0; i < curve.arcs.size(); ++i) {
      if (curve.arcs[i].points.size() >= 2) root["features"].push_back(arc_feature(map, curve, i));
    }
  }
  for (std::size_t i = 0; i < map.isolated_points.size(); ++i) root["features"].push_back(point_feature(map, i));
  return json_text(root);
}

}  // namespace clearloci::report
