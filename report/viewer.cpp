#include "report/viewer.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/shown_units.hpp"
#include "report/base64.hpp"
#include "report/groups.hpp"
#include "report/loci_json.hpp"
#include "report/surface_groups.hpp"
#include "report/wording.hpp"
#include "report/zones.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

Json colour_json(const Colour& colour) {
  const auto byte = [](double part) { return static_cast<int>(std::lround(255 * part)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.red), byte(colour.green), byte(colour.blue));
}

template <std::size_t count>
Json colours_json(const std::array<Colour, count>& colours) {
  Json list = Json::array();
  for (const Colour& colour : colours) list.push_back(colour_json(colour));
  return list;
}

Json theme_json(const Theme& theme) {
  return {{"paper", colour_json(theme.paper)},         {"ink", colour_json(theme.ink)},
          {"faded_ink", colour_json(theme.faded_ink)}, {"frame", colour_json(theme.frame)},
          {"grid", colour_json(theme.grid)},           {"workspace", colour_json(theme.workspace)},
          {"outline", colour_json(theme.outline)},     {"link", colour_json(theme.link)},
          {"load", colour_json(theme.load)},           {"verified", colour_json(theme.verified)},
          {"failed", colour_json(theme.failed)},       {"singularity", colour_json(theme.singularity)},
          {"boundary", colour_json(theme.boundary)},   {"circle", colour_json(theme.circle)},
          {"curves", colours_json(theme.curves)},      {"zones", colours_json(theme.zones)},
          {"zone_strength", theme.zone_strength}};
}

/// Where a theme has the colour of such loci: "singularity", "boundary", "margin", or a place among its curves.
Json colour_role(core::LocusKind kind, int number) {
  if (kind == core::LocusKind::direct_singularity) return "singularity";
  if (kind == core::LocusKind::workspace_boundary) return "boundary";
  if (kind == core::LocusKind::margin) return "margin";
  return number % static_cast<int>(light_theme.curves.size());
}

Json curve_groups(const Groups& groups) {
  Json list = Json::array();
  for (const CurveGroup& group : groups.curves) {
    Json ids = Json::array();
    for (const core::LocusCurve* curve : group.curves) ids.push_back(curve->id);
    list.push_back({{"kind", core::to_string(group.kind)},
                    {"what", group.what},
                    {"why", group.why},
                    {"colour", colour_role(group.kind, group.number)},
                    {"width", group.stroke.width},
                    {"dash", group.stroke.dash},
                    {"round", group.stroke.round},
                    {"ids", std::move(ids)}});
  }
  return list;
}

const char* shape_name(MarkerShape shape) {
  constexpr std::array names = {"circle", "square", "diamond", "triangle"};
  return names.at(static_cast<std::size_t>(shape));
}

/// `points`: their places in loci.json's isolated_points.
Json point_groups(const Groups& groups, const core::LocusMap& map) {
  Json list = Json::array();
  if (map.tower.coordinates.size() == 3) return list;  // among the groups of surfaces
  int number = 1;                                      // as group_loci colours them
  for (const PointGroup& group : groups.points) {
    Json points = Json::array();
    for (const core::IsolatedPoint* point : group.points) points.push_back(point - map.isolated_points.data());
    list.push_back({{"kind", core::to_string(group.kind)},
                    {"what", group.label},
                    {"colour", colour_role(group.kind, number++)},
                    {"shape", shape_name(group.marker.shape)},
                    {"points", std::move(points)}});
  }
  return list;
}

/// With the curves and points over three coordinates, which have no surface.
/// Reasons that several of them have go to the remarks.
Json surface_groups(const core::LocusMap& map, std::vector<std::string>& remarks) {
  Json list = Json::array();
  int number = 0;
  std::vector<SurfaceGroup> surfaces = group_surfaces(map);
  for (std::string& remark : tell_shared_reasons(surfaces)) remarks.push_back(std::move(remark));
  for (const SurfaceGroup& group : surfaces) {
    Json ids = Json::array();
    for (const core::LocusSurface* surface : group.surfaces) ids.push_back(surface->id);
    const Json colour = colour_role(group.kind, number);
    if (colour.is_number()) ++number;
    list.push_back({{"kind", core::to_string(group.kind)},
                    {"what", group.what},
                    {"why", group.why},
                    {"colour", colour},
                    {"opacity", group.opacity},
                    {"ids", std::move(ids)},
                    {"points", Json::array()}});
  }
  if (map.tower.coordinates.size() != 3) return list;
  for (const LineGroup& group : group_lines(map, surfaces)) {
    Json ids = Json::array(), points = Json::array();
    for (const core::SpaceCurve* curve : group.curves) ids.push_back(curve->id);
    for (const core::IsolatedPoint* point : group.points) points.push_back(point - map.isolated_points.data());
    list.push_back({{"kind", core::to_string(group.kind)},
                    {"what", group.what},
                    {"why", ""},
                    {"colour", colour_role(group.kind, group.number)},
                    {"opacity", 1},
                    {"ids", std::move(ids)},
                    {"points", std::move(points)}});
  }
  return list;
}

template <class Word>
void append_word(std::string& bytes, Word word) {
  static_assert(std::endian::native == std::endian::little);
  std::array<char, sizeof word> raw{};
  std::memcpy(raw.data(), &word, sizeof word);
  bytes.append(raw.data(), raw.size());
}

Json mesh_object(const core::LocusSurface& surface) {
  std::string vertices, triangles;
  for (const core::Point3& vertex : surface.vertices)
    for (const double value : vertex) append_word(vertices, static_cast<float>(value));
  for (const auto& triangle : surface.triangles)
    for (const int corner : triangle) append_word(triangles, static_cast<std::uint32_t>(corner));
  return {{"id", surface.id}, {"vertices", base64(vertices)}, {"triangles", base64(triangles)}};
}

struct Happening {
  core::LocusKind kind;
  const char* what;
};

// What stands beside the pictures in the README, for readers who have none at hand.
constexpr std::array happenings = {
    Happening{core::LocusKind::contact_loss,
              "the force in a joint vanishes: the pin crosses its clearance, and the end effector jumps"},
    Happening{core::LocusKind::backlash, "the effort of an actuator vanishes: the actuator crosses its play"},
    Happening{core::LocusKind::component, "a component of a reaction vanishes and changes its sign"},
    Happening{core::LocusKind::margin, "a reaction has the least size that is allowed"},
    Happening{core::LocusKind::preload,
              "the efforts of free motors that keep contact are others on either side, or none"},
    Happening{core::LocusKind::direct_singularity,
              "the mechanism is singular: reactions grow without bound and change their sign"},
    Happening{core::LocusKind::workspace_boundary, "a leg is stretched out or folded: the workspace ends"},
    Happening{core::LocusKind::no_limit, "the reaction depends on the direction from which the pose is reached"}};

/// What the page shows: as told_unit, so degrees unless the file says otherwise.
Json units_object(const core::Units& units) {
  const auto unit = [&](const char* si) {
    const core::ShownUnit shown = core::told_unit(si, units);
    return Json{{"name", shown.name}, {"size", 1 / shown.per_si}};
  };
  return {{"declared", units.declared}, {"length", unit("m")}, {"angle", unit("rad")}, {"force", unit("N")}};
}

}  // namespace

Json sketch_object(const core::Sketch& sketch) {
  Json body = {{"links", Json::array()}, {"slides", Json::array()},  {"joints", Json::array()},
               {"loads", Json::array()}, {"springs", Json::array()}, {"gravity", sketch.gravity}};
  for (const core::SketchLink& link : sketch.links)
    body["links"].push_back({{"name", printable(link.name)}, {"points", link.points}});
  for (const core::SketchSlide& slide : sketch.slides)
    body["slides"].push_back({{"from", slide.from}, {"to", slide.to}, {"rail", slide.rail}});
  for (const core::SketchJoint& joint : sketch.joints)
    body["joints"].push_back({{"name", printable(joint.name)},
                              {"at", joint.at},
                              {"on_ground", joint.on_ground},
                              {"actuated", joint.actuated}});
  for (const core::SketchLoad& load : sketch.loads)
    body["loads"].push_back({{"at", load.at}, {"force", load.force}, {"couple", load.couple}});
  if (sketch.end_effector && !sketch.end_effector->name.empty())
    body["end_effector"] = {{"name", printable(sketch.end_effector->name)}, {"at", sketch.end_effector->at}};
  for (const core::SketchSpring& spring : sketch.springs)
    body["springs"].push_back({{"from", spring.from},
                               {"to", spring.to},
                               {"torsion", spring.torsion},
                               {"from_ground", spring.from_ground},
                               {"to_ground", spring.to_ground}});
  return body;
}

Json drawing_rules() {
  Json rules = {{"themes", {{"light", theme_json(light_theme)}, {"dark", theme_json(dark_theme)}}},
                {"kinds", Json::array()}};
  for (const Happening& one : happenings)
    rules["kinds"].push_back(
        {{"kind", core::to_string(one.kind)}, {"words", kind_words(one.kind)}, {"happens", one.what}});
  return rules;
}

Json viewer_object(const LociSheet& loci) {
  const Groups groups = group_loci(loci.map);
  Json meshes = Json::array(), sketches = Json::array();
  for (const core::LocusSurface& surface : loci.map.surfaces) meshes.push_back(mesh_object(surface));
  for (const core::ModeSketch& one : loci.sketches)
    if (!one.beside)
      sketches.push_back(
          {{"working_mode", mode_object(loci.map.tower, one.mode)}, {"sketch", sketch_object(one.sketch)}});
  const core::LocusMap& map = loci.map;
  std::vector<std::string> remarks = groups.remarks;
  Json surfaces = surface_groups(map, remarks);
  Json answer = loci_object(map);
  answer.erase("timing");  // a page of the same loci has the same bytes
  Json parameters = Json::array(), zones = Json::array();
  for (const auto& [name, value] : map.parameters)
    parameters.push_back({{"name", printable(name)}, {"value", printable(decimal_words(value))}});
  if (loci.zones != nullptr) zones = zones_object(*loci.zones)["zones"];
  return {{"loci", std::move(answer)},
          {"units", units_object(map.units)},
          {"notes", told_once(core::in_file_units(map.notes, map.units, map.angles))},
          {"parameters", std::move(parameters)},
          {"zones", std::move(zones)},
          {"curve_groups", curve_groups(groups)},
          {"remarks", remarks},
          {"point_groups", point_groups(groups, loci.map)},
          {"surface_groups", std::move(surfaces)},
          {"meshes", std::move(meshes)},
          {"sketches", std::move(sketches)}};
}

}  // namespace clearloci::report
