// Zones over one to three coordinates.
#include "clearloci/zones.hpp"

#include "bindings/bindings.hpp"
#include "bindings/maps.hpp"
#include "clearloci/export.hpp"

namespace clearloci::python {
namespace {

py::list borders_of(const Zones& map, const Zone& zone) {
  py::list borders;
  for (const ZoneBorder& border : zone.borders) {
    py::dict one;
    if (!map.by_cells) one["curve"] = border.curve;
    one["kind"] = border.kind ? to_string(*border.kind) : "box";
    one["vanishing"] = names_of(border.vanishing);
    if (!map.by_cells) one["length"] = border.length;
    if (!border.cause.empty()) one["cause"] = border.cause;
    if (!border.beside.empty()) one["beside"] = border.beside;
    borders.append(one);
  }
  return borders;
}

py::list ends_of(const Zone& zone) {
  py::list ends;
  for (const ZoneEnd& end : zone.ends) {
    py::dict one(py::arg("at") = end.at, py::arg("kind") = to_string(end.kind),
                 py::arg("vanishing") = names_of(end.vanishing), py::arg("jumps") = end.jump.has_value());
    if (!end.limit.empty()) one["limit"] = end.limit;
    if (!end.cause.empty()) one["cause"] = end.cause;
    if (end.jump) put_error(one, *end.jump);
    ends.append(one);
  }
  return ends;
}

py::list faces_of(const Zone& zone) {
  py::list faces;
  for (const auto& face : zone.faces) {
    py::array_t<double> corners({static_cast<py::ssize_t>(face.size()), py::ssize_t{3}});
    double* to = corners.mutable_data();
    for (const auto& corner : face) to = std::copy(corner.begin(), corner.end(), to);
    faces.append(corners);
  }
  return faces;
}

py::dict signs_of(const std::vector<std::pair<Vanishing, int>>& all) {
  py::dict signs;
  for (const auto& [reaction, sign] : all) signs[py::str(name_of(reaction))] = sign;
  return signs;
}

py::object preload_of(const Zone& zone) {
  if (!zone.preload) return py::none();
  const ZonePreload& preload = *zone.preload;
  py::dict efforts;
  for (const FeasibleEfforts& feasible_efforts : preload.efforts) {
    py::list ranges;
    for (std::size_t i = 0; i < feasible_efforts.ranges.size(); ++i) {
      const EffortRange& range = feasible_efforts.ranges[i];
      py::dict one(py::arg("from") = range.from, py::arg("to") = range.to, py::arg("below") = names_of(range.below),
                   py::arg("above") = names_of(range.above));
      if (preload.efforts.size() == 1 && !feasible_efforts.cable) one["signs"] = signs_of(preload.patterns[i]);
      ranges.append(one);
    }
    efforts[py::str(feasible_efforts.joint)] =
        py::dict(py::arg("ranges") = ranges, py::arg("never") = names_of(feasible_efforts.never));
  }
  return py::dict(py::arg("feasible") = preload.feasible, py::arg("smallest") = preload.smallest,
                  py::arg("efforts") = efforts);
}

py::dict zone_dict(const Zones& map, const Zone& zone) {
  py::list holes;
  for (const Polyline& hole : zone.holes) holes.append(array_of(hole));
  py::dict one;
  one["id"] = zone.id;
  one["working_mode"] = mode_of(map.loci.tower, zone.mode);
  one["assembly_mode"] = zone.assembly_mode;
  one["signs"] = signs_of(zone.signs);
  one["too_small"] = names_of(zone.too_small);
  one["size"] = zone.size;
  one["at_least"] = zone.at_least;
  one["at_most"] = zone.at_most;
  one["certified"] = zone.certified;
  one["perhaps_one_with"] = zone.perhaps_one_with;
  one["lower"] = zone.lower;
  one["upper"] = zone.upper;
  one["sample"] = py::tuple(py::cast(zone.sample));
  one["ball"] = zone.ball.centre.empty() ? py::object(py::none())
                                         : py::make_tuple(py::tuple(py::cast(zone.ball.centre)), zone.ball.radius);
  one["borders"] = borders_of(map, zone);
  one["ends"] = ends_of(zone);
  one["polygon"] = map.by_cells ? py::object(py::none()) : py::object(array_of(zone.outer));
  one["holes"] = holes;
  one["faces"] = faces_of(zone);
  one["preload"] = preload_of(zone);
  return one;
}

py::dict mode_dict(const Zones& map, const ZonedMode& mode) {
  py::dict one;
  one["working_mode"] = mode_of(map.loci.tower, mode.mode);
  one["workspace"] = mode.workspace;
  one["outside"] = mode.outside;
  one["in_doubt"] = mode.in_doubt;
  one["cells"] = mode.cells;
  one["labels"] = py::none();
  if (!map.by_cells) return one;
  // The last coordinate first, as images and volumes are indexed.
  const std::vector<py::ssize_t> shape(map.grid.rbegin(), map.grid.rend());
  py::array_t<int> labels(shape);
  std::copy(mode.labels.begin(), mode.labels.end(), labels.mutable_data());
  one["labels"] = labels;
  return one;
}

py::dict zones_dict(const Zones& map) {
  py::list zones, modes;
  for (const Zone& zone : map.zones) zones.append(zone_dict(map, zone));
  for (const ZonedMode& mode : map.modes) modes.append(mode_dict(map, mode));
  py::dict all;
  all["zones"] = zones;
  all["modes"] = modes;
  py::list regions;
  for (const PreloadRegion& region : map.preload_regions)
    regions.append(py::dict(py::arg("working_mode") = mode_of(map.loci.tower, region.mode),
                            py::arg("signs") = signs_of(region.signs), py::arg("zones") = region.zones,
                            py::arg("size") = region.size));
  all["preload_regions"] = regions;
  all["by_cells"] = map.by_cells;
  all["loci"] = dict_of(map.loci);
  return all;
}

}  // namespace

void bind_zones(py::module_& module) {
  auto answer = bind_answer<Zones>(module, "Zones", [](const Zones& zones) { return zones_dict(zones); });
  answer.def("svgs", [](const Zones& map) {
    std::vector<std::string> pictures;
    for (const WorkingMode& mode : modes_of(map)) pictures.push_back(to_svg(map, mode));
    return pictures;
  });
  module.def("find_zones", [](const Model& model, long cells, bool by_cells, const py::kwargs& options) {
    LociRequest request = request_of(model, options);
    return unlocked(request, [&](const LociRequest& loci_request) {
      return find_zones(model, {.loci = loci_request, .cells = cells, .by_cells = by_cells});
    });
  });
}

}  // namespace clearloci::python
