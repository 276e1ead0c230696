#include "report/zones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/file_units.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/picture.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

const core::LocusCurve* curve_of(const core::ZoneMap& map, const core::ZoneBorder& border) {
  const auto& curves = map.loci.curves;
  const auto found = std::find_if(curves.begin(), curves.end(), [&](const auto& c) { return c.id == border.curve; });
  return found == curves.end() ? nullptr : &*found;
}

/// Joints whose contact force vanishes somewhere on the zone's border.
std::vector<std::string> lost_at_border(const core::ZoneMap& map, const core::Zone& zone) {
  std::vector<std::string> joints;
  for (const core::ZoneBorder& border : zone.borders) {
    const core::LocusCurve* const curve = curve_of(map, border);
    if (curve == nullptr || curve->kind != core::LocusKind::contact_loss) continue;
    for (const core::Vanishing& v : curve->vanishing) {
      const bool known = std::find(joints.begin(), joints.end(), v.joint) != joints.end();
      if (v.quantity == core::Quantity::f && !known) joints.push_back(v.joint);
    }
  }
  return joints;
}

Json borders_array(const core::ZoneMap& map, const core::Zone& zone) {
  Json borders = Json::array();
  for (const core::ZoneBorder& border : zone.borders) {
    const core::LocusCurve* const curve = curve_of(map, border);
    Json entry = {{"curve", border.curve},
                  {"kind", curve == nullptr ? "box" : core::to_string(curve->kind)},
                  {"vanishing", curve == nullptr ? Json::array() : vanishing_array(curve->vanishing)},
                  {"length", border.length}};
    borders.push_back(std::move(entry));
  }
  return borders;
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

Json zone_object(const core::ZoneMap& map, const core::Zone& zone) {
  Json points = Json::array();
  for (const int i : zone.isolated_points) {
    const core::IsolatedPoint& point = map.loci.isolated_points[static_cast<std::size_t>(i)];
    points.push_back({{"vanishing", vanishing_array(point.vanishing)}, {"at", point.at}});
  }
  return {{"id", zone.id},
          {"working_mode", mode_object(map.loci.tower, zone.mode)},
          {"assembly_mode", zone.assembly_mode},
          {"signs", signs_of(zone)},
          {"contact_lost_at_border", lost_at_border(map, zone)},
          {"area", zone.area},
          {"inscribed_circle", {{"centre", zone.inscribed.centre}, {"radius", zone.inscribed.radius}}},
          {"sample", zone.sample},
          {"certified", zone.certified},
          {"borders", borders_array(map, zone)},
          {"isolated_points", std::move(points)},
          {"polygon", polygon_of(zone)}};
}

std::string sign_words(int sign) { return sign > 0 ? "+" : sign < 0 ? "-" : "?"; }

std::string border_words(const core::ZoneMap& map, const core::Zone& zone) {
  std::string words;
  for (const core::ZoneBorder& border : zone.borders) words += (words.empty() ? "" : " ") + border.curve;
  if (const auto joints = lost_at_border(map, zone); !joints.empty()) {
    words += "; contact lost:";
    for (const std::string& joint : joints) words += " " + joint;
  }
  if (!zone.isolated_points.empty()) words += fmt::format("; {} isolated points", zone.isolated_points.size());
  return words;
}

}  // namespace

std::vector<core::WorkingMode> modes_of_zones(const core::ZoneMap& map) {
  std::vector<core::WorkingMode> modes;
  const auto add = [&](const core::WorkingMode& mode) {
    if (std::find(modes.begin(), modes.end(), mode) == modes.end()) modes.push_back(mode);
  };
  for (const core::Zone& zone : map.zones) add(zone.mode);
  for (const core::ModeArea& area : map.areas)
    if (area.in_doubt > 0) add(area.mode);
  return modes;
}

Json zones_object(const core::ZoneMap& map) {
  const Json loci = loci_object(map.loci);
  Json root;
  for (const char* key : {"format", "mechanism", "parameters", "coordinates", "box", "tolerance"})
    root[key] = loci[key];
  root["complete"] = loci["complete"];
  root["open"] = loci["open"];
  if (map.loci.units.declared) root["units"] = "SI";
  root["zones"] = Json::array();
  for (const core::Zone& zone : map.zones) root["zones"].push_back(zone_object(map, zone));
  root["areas"] = Json::array();
  for (const core::ModeArea& area : map.areas)
    root["areas"].push_back({{"working_mode", mode_object(map.loci.tower, area.mode)},
                             {"workspace", area.workspace},
                             {"in_doubt", area.in_doubt}});
  root["notes"] = loci["notes"];
  root["timing"] = loci["timing"];
  return root;
}

std::string zones_geojson(const core::ZoneMap& map) {
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
                       {"area", zone.area},
                       {"certified", zone.certified},
                       {"units", "m"}};
    root["features"].push_back({{"type", "Feature"},
                                {"geometry", {{"type", "Polygon"}, {"coordinates", polygon_of(zone)}}},
                                {"properties", std::move(properties)}});
  }
  return json_text(root);
}

namespace {

constexpr int area_digits = 7;

/// Without those of reactions that no load reaches, which a note tells.
std::string sign_list(const core::ZoneMap& map, const core::Zone& zone) {
  const std::vector<std::string>& notes = map.loci.notes;
  std::string signs;
  for (const auto& [reaction, sign] : zone.signs) {
    const std::string unloaded = core::to_string(reaction.quantity) + reaction.joint + " is zero in every pose";
    if (std::any_of(notes.begin(), notes.end(), [&](const std::string& note) { return note.rfind(unloaded, 0) == 0; }))
      continue;
    signs += (signs.empty() ? "" : " ") + reaction_name(reaction) + sign_words(sign);
  }
  return signs;
}

}  // namespace

std::string zones_table(const core::ZoneMap& in_si) {
  const core::ZoneMap map = in_file_units(in_si);
  const std::string& unit = map.loci.units.length.name;
  int widest = 18;
  for (const core::Zone& zone : map.zones) widest = std::max(widest, columns(sign_list(map, zone)));
  const auto row = [&](const std::string& zone, const std::string& sign, const std::string& signs,
                       const std::string& area, const std::string& rest) {
    return fmt::format("{:<6} {:<4} {:<{}} {:>12}{}\n", zone, sign, signs, widest, area, rest);
  };
  std::string out = printable(map.loci.mechanism) + "\n";
  for (const core::WorkingMode& mode : modes_of_zones(map)) {
    const std::string words = printable(mode_words(map.loci.tower, mode));
    out += words.empty() ? "\n" : "\nWorking mode: " + words + "\n";
    out += row("zone", "|A|", "signs", "area/" + unit + "2",
               fmt::format("  {:<36} {}", "largest circle/" + unit, "bounded by"));
    double total = 0;
    for (const core::Zone& zone : map.zones) {
      if (zone.mode != mode) continue;
      total += zone.area;
      const std::string circle = fmt::format("{} about ({}, {})", engineering(zone.inscribed.radius, size_digits),
                                             engineering(zone.inscribed.centre[0], size_digits),
                                             engineering(zone.inscribed.centre[1], size_digits));
      out += row(zone.id + (zone.certified ? "" : "*"), sign_words(zone.assembly_mode), sign_list(map, zone),
                 engineering(zone.area, area_digits), fmt::format("  {:<36} {}", circle, border_words(map, zone)));
    }
    out += row("all", "", "", engineering(total, area_digits), "");
    for (const core::ModeArea& area : map.areas)
      if (area.mode == mode && area.in_doubt != 0)
        out += row("doubt", "", "", engineering(area.in_doubt, area_digits),
                   fmt::format("  of a workspace of {}: not certified, or in no zone",
                               engineering(area.workspace, area_digits)));
  }
  if (modes_of_zones(map).empty()) out += "\nno zones: the mechanism reaches nothing in the box\n";
  const bool doubtful = std::any_of(map.zones.begin(), map.zones.end(), [](const auto& z) { return !z.certified; });
  if (doubtful) out += "\n*: not certified\n";
  for (const std::string& note : told_once(map.loci.notes)) out += printable(note) + "\n";
  return out;
}

}  // namespace clearloci::report
