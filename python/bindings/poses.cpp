// Tasks and zones over one to six coordinates, by cells.
#include "bindings/bindings.hpp"
#include "bindings/maps.hpp"
#include "clearloci/pose_tasks.hpp"
#include "clearloci/pose_zones.hpp"

namespace clearloci::python {
namespace {

template <class Value>
py::object or_none(const std::optional<Value>& value) {
  return value ? py::cast(*value) : py::object(py::none());
}

py::object witness_of(const std::optional<PoseTaskWitness>& witness) {
  if (!witness) return py::none();
  using Kind = TaskWitness::Kind;
  py::dict one;
  one["at"] = witness->at;
  one["kind"] = witness->kind == Kind::unreachable ? "unreachable"
                : witness->kind == Kind::boundary  ? "boundary"
                : witness->kind == Kind::singular  ? "singular"
                : witness->kind == Kind::vanishing ? "vanishing"
                                                   : "too small";
  one["reactions"] = names_of(witness->reactions);
  one["size"] = or_none(witness->size);
  one["load"] = witness->load;
  one["distance"] = witness->distance;
  return one;
}

py::dict dict_of(const PoseVerification& answer) {
  py::list least;
  for (const LeastReaction& own : answer.least)
    least.append(py::dict(py::arg("reaction") = name_of(own.reaction), py::arg("proven") = own.proven,
                          py::arg("met") = own.met));
  py::object nearest = py::none(), open = py::none();
  if (answer.nearest) {
    const NearestToPoses& own = *answer.nearest;
    nearest = py::dict(py::arg("kind") = to_string(own.kind), py::arg("reactions") = names_of(own.reactions),
                       py::arg("at") = own.at, py::arg("distance") = own.distance);
  }
  if (answer.open)
    open = py::dict(py::arg("cells") = answer.open->cells, py::arg("lower") = answer.open->lower,
                    py::arg("upper") = answer.open->upper, py::arg("reason") = word_of(answer.open->reason));
  py::dict all;
  all["verdict"] = to_string(answer.verdict);
  all["coordinates"] = answer.coordinates;
  all["working_mode"] = mode_of(answer.working_mode);
  all["by"] = or_none(answer.by);
  all["scale"] = or_none(answer.scale);
  all["margin"] = or_none(answer.margin);
  all["angle_margin"] = or_none(answer.angle_margin);
  all["nearest"] = nearest;
  all["witness"] = witness_of(answer.witness);
  all["open"] = open;
  all["least"] = least;
  all["cells"] = answer.cells;
  all["notes"] = in_python(answer.notes);
  return all;
}

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

std::optional<PoseFit> goal_of(const std::string& fit) {
  if (fit.empty()) return std::nullopt;
  if (fit == "nearest") return PoseFit::nearest;
  if (fit == "best") return PoseFit::best;
  if (fit == "largest") return PoseFit::largest;
  throw InputError({"fit", 0, 0}, "unknown goal '" + fit + "'", "choose nearest, best or largest");
}

}  // namespace

void bind_poses(py::module_& module) {
  bind_answer<PoseVerification>(
      module, "PoseVerification", [](const PoseVerification& own) { return dict_of(own); }, &export_verification);
  bind_answer<PoseZones>(
      module, "PoseZones", [](const PoseZones& own) { return dict_of(own); }, &export_zones);
  module.def("verify_poses", [](const Model& model, const std::string& text, const std::string& file,
                                const std::string& fit, const py::kwargs& options) {
    LociRequest request = request_of(model, options);
    const PoseTask task = text.empty() ? read_pose_task(file, model) : parse_pose_task(text, model, file);
    const std::optional<PoseFit> goal = goal_of(fit);
    return unlocked(request, [&](const LociRequest& own) {
      return goal ? fit_poses(model, task, *goal, own) : verify_poses(model, task, own);
    });
  });
  module.def("find_pose_zones", [](const Model& model, long cells, const py::kwargs& options) {
    LociRequest request = request_of(model, options);
    return unlocked(request, [&](const LociRequest& own) { return find_pose_zones(model, own, cells); });
  });
}

}  // namespace clearloci::python
