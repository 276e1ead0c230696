// Zones over one to three coordinates, by cells.
#include "bindings/bindings.hpp"
#include "bindings/maps.hpp"
#include "clearloci/pose_zones.hpp"

namespace clearloci::python {
namespace {

py::dict dict_of(const PoseZone& zone) {
  py::dict signs, one;
  for (const auto& [reaction, sign] : zone.signs) signs[py::str(name_of(reaction))] = sign;
  py::list bounds, ends, faces;
  for (const PoseZoneBound& own : zone.bounds)
    bounds.append(py::dict(py::arg("kind") = to_string(own.kind), py::arg("reactions") = names_of(own.reactions)));
  for (const PoseZoneEnd& own : zone.ends) {
    py::dict end(py::arg("at") = own.at, py::arg("kind") = to_string(own.kind),
                 py::arg("reactions") = names_of(own.reactions), py::arg("jumps") = own.jump.has_value());
    if (own.jump) put_error(end, *own.jump);
    ends.append(end);
  }
  for (const auto& own : zone.faces) {
    py::array_t<double> corners({static_cast<py::ssize_t>(own.size()), py::ssize_t{3}});
    double* to = corners.mutable_data();
    for (const auto& corner : own) to = std::copy(corner.begin(), corner.end(), to);
    faces.append(corners);
  }
  one["id"] = zone.id;
  one["assembly_mode"] = zone.assembly_mode;
  one["signs"] = signs;
  one["at_least"] = zone.at_least;
  one["at_most"] = zone.at_most;
  one["lower"] = zone.lower;
  one["upper"] = zone.upper;
  one["sample"] = zone.sample;
  one["bounds"] = bounds;
  one["at_side"] = zone.at_side;
  one["perhaps_one_with"] = zone.perhaps_one_with;
  one["ends"] = ends;
  one["faces"] = faces;
  one["ball"] = zone.ball ? py::object(py::make_tuple(zone.ball->centre, zone.ball->radius)) : py::none();
  return one;
}

py::dict dict_of(const PoseZones& map) {
  py::list zones;
  for (const PoseZone& own : map.zones) zones.append(dict_of(own));
  // The last coordinate first, as images and volumes are indexed.
  const std::vector<py::ssize_t> shape(map.grid.rbegin(), map.grid.rend());
  py::array_t<int> labels(shape);
  std::copy(map.labels.begin(), map.labels.end(), labels.mutable_data());
  py::dict all;
  all["zones"] = zones;
  all["coordinates"] = map.coordinates;
  all["lower"] = map.lower;
  all["upper"] = map.upper;
  all["working_mode"] = mode_of(map.working_mode);
  all["outside"] = map.outside;
  all["in_doubt"] = map.in_doubt;
  all["labels"] = labels;
  all["cells"] = map.cells;
  all["complete"] = map.complete;
  all["notes"] = in_python(map.notes);
  return all;
}

}  // namespace

void bind_poses(py::module_& module) {
  bind_answer<PoseZones>(
      module, "PoseZones", [](const PoseZones& own) { return dict_of(own); }, &export_zones);
  module.def("find_pose_zones", [](const Model& model, long cells, const py::kwargs& options) {
    LociRequest request = request_of(model, options);
    return unlocked(request, [&](const LociRequest& own) { return find_pose_zones(model, own, cells); });
  });
}

}  // namespace clearloci::python
