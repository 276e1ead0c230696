#include "report/pose_zones.hpp"
#include "core/shown_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/exports.hpp"
#include "report/field_exports.hpp"
#include "report/file_units.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/pose.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

Json signs_of(const core::PoseZone& zone) {
  Json signs = Json::object();
  for (const auto& [reaction, sign] : zone.signs) signs[reaction.joint][core::to_string(reaction.quantity)] = sign;
  return signs;
}

Json zone_object(const core::PoseZone& zone) {
  Json bounds = Json::array();
  for (const core::PoseZoneBound& own : zone.bounds)
    bounds.push_back({{"kind", core::to_string(own.kind)}, {"vanishing", vanishing_array(own.reactions)}});
  Json ends = Json::array();
  for (const core::PoseZoneEnd& own : zone.ends) {
    ends.push_back(
        {{"at", own.at}, {"kind", core::to_string(own.kind)}, {"vanishing", vanishing_array(own.reactions)}});
    if (own.jump) ends.back()["jump"] = pose_error_object(*own.jump);
  }
  if (zone.at_side) bounds.push_back({{"kind", "box"}, {"vanishing", Json::array()}});
  return {{"id", zone.id},
          {"assembly_mode", zone.assembly_mode},
          {"signs", signs_of(zone)},
          {"at_least", zone.at_least},
          {"at_most", zone.at_most},
          {"lower", zone.lower},
          {"upper", zone.upper},
          {"sample", zone.sample},
          {"bounds", std::move(bounds)},
          {"ends", std::move(ends)},
          {"ball", zone.ball ? Json{{"centre", zone.ball->centre}, {"radius", zone.ball->radius}} : Json(nullptr)},
          {"perhaps_one_with", zone.perhaps_one_with}};
}

/// Of a zone's size, of as many dimensions as there are coordinates: "mm2 deg".
ShownUnit unit_of_size(const core::PoseZones& map) {
  const auto angles = std::count(map.angles.begin(), map.angles.end(), true);
  const auto lengths = static_cast<std::ptrdiff_t>(map.angles.size()) - angles;
  const ShownUnit length = table_unit("m", map.units), turn = table_unit("rad", map.units);
  const auto power = [](const ShownUnit& unit, std::ptrdiff_t count) {
    return count == 0 ? std::string() : count == 1 ? unit.name : unit.name + std::to_string(count);
  };
  const std::string m = power(length, lengths), rad = power(turn, angles);
  return {m + (m.empty() || rad.empty() ? "" : " ") + rad,
          std::pow(length.per_si, static_cast<double>(lengths)) * std::pow(turn.per_si, static_cast<double>(angles))};
}

std::string bounds_words(const core::PoseZone& zone) {
  std::string words;
  for (const core::LocusKind kind :
       {core::LocusKind::workspace_boundary, core::LocusKind::direct_singularity, core::LocusKind::contact_loss,
        core::LocusKind::backlash, core::LocusKind::margin}) {
    std::vector<core::Vanishing> all;
    bool any = false;
    for (const core::PoseZoneBound& own : zone.bounds) {
      if (own.kind != kind) continue;
      any = true;
      all.insert(all.end(), own.reactions.begin(), own.reactions.end());
    }
    if (any) words += (words.empty() ? "" : "; ") + kind_words(kind) + (all.empty() ? "" : " ") + reaction_names(all);
  }
  if (zone.at_side) words += words.empty() ? "box" : "; box";
  return words;
}

class Places {
 public:
  explicit Places(const core::PoseZones& map) : map_(map), length_(shown_unit("m", map.units)) {}

  std::string value(std::size_t c, double at) const {
    if (map_.angles[c]) return engineering(at * 180 / std::numbers::pi, place_digits) + " deg";
    return engineering(at * length_.per_si, place_digits) + " " + length_.name;
  }
  std::string pose(const std::vector<double>& at) const {
    std::string words;
    for (std::size_t c = 0; c < at.size(); ++c)
      words += fmt::format("{}{} = {}", c == 0 ? "" : ", ", map_.coordinates[c], value(c, at[c]));
    return words;
  }

 private:
  const core::PoseZones& map_;
  ShownUnit length_;
};

std::string ball_words(const core::PoseZones& map, const Places& places, const core::PoseZoneBall& ball) {
  const auto angles = std::count(map.angles.begin(), map.angles.end(), true);
  const bool mixed = angles > 0 && angles < static_cast<std::ptrdiff_t>(map.angles.size());
  const ShownUnit length = shown_unit("m", map.units);
  // Where lengths and angles mix, a radian counts as a metre.
  const std::string radius = mixed        ? engineering(ball.radius, few_digits) + " (m and rad alike)"
                             : angles > 0 ? engineering(ball.radius * 180 / std::numbers::pi, few_digits) + " deg"
                                          : engineering(ball.radius * length.per_si, few_digits) + " " + length.name;
  return fmt::format("      holds a ball of radius {} around {}\n", radius, places.pose(ball.centre));
}

std::string end_words(const core::PoseZones& map, const Places& places, const core::PoseZoneEnd& end) {
  std::string words = fmt::format("{}: {}{}{}", places.value(0, end.at), kind_words(end.kind),
                                  end.reactions.empty() ? "" : " ", reaction_names(end.reactions));
  const auto is_known = [](const std::vector<double>& parts) {
    return std::all_of(parts.begin(), parts.end(), [](double part) { return std::isfinite(part); });
  };
  if (end.jump && !(is_known(end.jump->displacement) && is_known(end.jump->rotation))) {
    words += "; the jump of the end effector is undefined";
  } else if (end.jump) {
    double most = 0;
    for (const double part : end.jump->displacement) most = std::max(most, std::abs(part));
    const ShownUnit unit = table_unit("m", map.units, most), turn = table_unit("rad", map.units);
    const auto numbers = [](const std::vector<double>& parts, double factor) {
      double largest = 0;
      for (const double part : parts) largest = std::max(largest, std::abs(part));
      std::string list;
      for (const double part : parts)
        list += (list.empty() ? "" : ", ") + engineering_beside(part * factor, largest * factor, few_digits);
      return parts.size() == 1 ? list : "(" + list + ")";
    };
    words += fmt::format("; the end effector jumps by {} {} and {} {}", numbers(end.jump->displacement, unit.per_si),
                         unit.name, numbers(end.jump->rotation, turn.per_si), turn.name);
  }
  return words;
}

}  // namespace

std::vector<std::string> zone_end_lines(const core::PoseZones& map) {
  const Places places(map);
  std::map<double, std::string> lines;
  // Two zones end at one place, to the finest cells.
  constexpr double one_place = 1e-7;
  for (const core::PoseZone& zone : map.zones)
    for (const core::PoseZoneEnd& end : zone.ends) {
      const double width = one_place * (map.upper[0] - map.lower[0]);
      const auto near = lines.lower_bound(end.at - width);
      if (near == lines.end() || near->first > end.at + width) lines.emplace(end.at, end_words(map, places, end));
    }
  std::vector<std::string> all;
  for (auto& [at, words] : lines) all.push_back(std::move(words));
  return all;
}

Json pose_zones_object(const core::PoseZones& map) {
  Json mode = Json::object();
  for (const auto& [point, side] : map.working_mode) mode[point] = side;
  Json box = Json::array();
  for (std::size_t c = 0; c < map.lower.size(); ++c) box.push_back({map.lower[c], map.upper[c]});
  Json root = {{"format", 1},
               {"mechanism", printable(map.mechanism)},
               {"coordinates", map.coordinates},
               {"angles", map.angles},
               {"box", std::move(box)},
               {"working_mode", std::move(mode)},
               {"zones", Json::array()},
               {"outside", map.outside},
               {"in_doubt", map.in_doubt},
               {"cells", map.cells},
               {"complete", map.complete},
               {"notes", map.notes}};
  for (const core::PoseZone& zone : map.zones) root["zones"].push_back(zone_object(zone));
  if (map.units.declared) root["units"] = "SI";
  return root;
}

std::string pose_zones_table(const core::PoseZones& map) {
  const Places places(map);
  const ShownUnit unit = unit_of_size(map);
  const auto size = [&](double si) { return engineering(si * unit.per_si, size_digits); };
  std::string mode;
  for (const auto& [point, side] : map.working_mode)
    mode += fmt::format("{}{} {}", mode.empty() ? "" : ", ", point, side);
  std::string out = printable(map.mechanism) + "\n\n";
  if (!mode.empty()) out += "Working mode: " + printable(mode) + "\n";
  const bool line = map.coordinates.size() == 1;
  for (const core::PoseZone& zone : map.zones) {
    std::string signs;
    for (const auto& [reaction, sign] : zone.signs)
      signs += fmt::format("{}{}{}", signs.empty() ? "" : " ", reaction_name(reaction),
                           sign > 0   ? "+"
                           : sign < 0 ? "-"
                                      : "?");
    out += fmt::format("{:<5} |A|{}  {}\n", zone.id, zone.assembly_mode > 0 ? "+" : "-", signs);
    if (line)
      out += fmt::format("      {} to {}\n", places.value(0, zone.lower[0]), places.value(0, zone.upper[0]));
    else
      out += fmt::format("      {} to {} {}; a pose of it: {}\n", size(zone.at_least), size(zone.at_most), unit.name,
                         places.pose(zone.sample));
    if (zone.ball) out += ball_words(map, places, *zone.ball);
    out += fmt::format("      beside it: {}\n", bounds_words(zone));
    for (const core::PoseZoneEnd& own : zone.ends) out += "      ends at " + end_words(map, places, own) + "\n";
    if (!zone.perhaps_one_with.empty()) {
      out += "      not proven to be another zone than";
      for (const std::string& other : zone.perhaps_one_with) out += " " + other;
      out += "\n";
    }
  }
  if (map.zones.empty()) out += "no zones: nothing in the box is proven to be free of loci\n";
  out += fmt::format("\nin doubt {} {}, out of reach {} {}; {} cells\n", size(map.in_doubt), unit.name,
                     size(map.outside), unit.name, map.cells);
  if (!map.complete) out += "the time limit came first\n";
  for (const std::string& note : told_once(core::in_file_units(map.notes, map.units, map.angles)))
    out += printable(note) + "\n";
  return out;
}

namespace {

/// The outside of what is proven of a zone.
core::LocusSurface surface_of(const core::PoseZone& zone) {
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
std::string label_vti(const core::PoseZones& map) {
  core::Field zone{"zone", "zone", "", true, {map.labels.begin(), map.labels.end()}};
  if (map.grid.size() == 2)
    return vti(core::FieldMap{map.mechanism,
                              {map.coordinates[0], map.coordinates[1]},
                              {map.lower[0], map.lower[1]},
                              {map.upper[0], map.upper[1]},
                              map.grid[0],
                              map.grid[1],
                              {std::move(zone)}});
  core::FieldVolume volume;
  for (std::size_t c = 0; c < 3; ++c) {
    volume.coordinates[c] = map.coordinates[c];
    volume.lower[c] = map.lower[c];
    volume.upper[c] = map.upper[c];
    volume.cells[c] = map.grid[c];
  }
  volume.fields.push_back(std::move(zone));
  return vti(volume);
}

}  // namespace

std::vector<std::string> pose_zone_formats(std::size_t coordinates) {
  std::vector<std::string> names = format_names<core::PoseZones>();
  std::erase_if(names, [&](const std::string& name) {
    return (name == "vtk" && coordinates < 2) || (name == "stl" && coordinates < 3);
  });
  return names;
}

Files pose_zones_vtk(const core::PoseZones& map) {
  Files files;
  if (map.grid.size() > 1) files.push_back({"zones.vti", label_vti(map)});
  if (map.grid.size() < 3) return files;
  for (const core::PoseZone& zone : map.zones) {
    core::LocusMap alone;
    alone.mechanism = map.mechanism;
    alone.surfaces.push_back(surface_of(zone));
    files.push_back({"zones-" + zone.id + ".vtp", vtp(alone)});
  }
  return files;
}

Files pose_zones_stl(const core::PoseZones& map) {
  Files files;
  if (map.grid.size() < 3) return files;
  for (const core::PoseZone& zone : map.zones) files.push_back({"zones-" + zone.id + ".stl", stl(surface_of(zone))});
  return files;
}

}  // namespace clearloci::report
