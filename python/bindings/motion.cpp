// Poses, reactions, errors and trajectories.
#include <cmath>
#include <limits>

#include "bindings/bindings.hpp"
#include "bindings/maps.hpp"
#include "clearloci/error.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/trajectory.hpp"

namespace clearloci::python {
namespace {

using PyPoses = py::array_t<double, py::array::c_style | py::array::forcecast>;

py::array_t<double> column(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::dict dict_of(const Table& table) {
  py::dict all;
  for (std::size_t i = 0; i < table.names.size(); ++i) all[py::str(table.names[i])] = column(table.columns[i]);
  return all;
}

py::dict units_of(const Table& table) {
  py::dict all;
  for (std::size_t i = 0; i < table.names.size(); ++i) all[py::str(table.names[i])] = table.units[i];
  return all;
}

py::dict dict_of(const PoseError& error) {
  py::dict one;
  one["displacement"] = error.displacement;
  one["rotation"] = error.rotation;
  return one;
}

py::dict dict_of(const std::vector<JointTakeUp>& all) {
  py::dict joints;
  for (const JointTakeUp& take_up : all) {
    py::dict one;
    one["displacement"] = take_up.displacement;
    one["beta"] = take_up.beta;
    one["rotation"] = take_up.rotation;
    one["normal"] = take_up.normal;
    one["tilt"] = take_up.tilt;
    one["axial"] = take_up.axial;
    joints[py::str(take_up.joint)] = one;
  }
  return joints;
}

py::dict dict_of(const std::vector<FeasibleEfforts>& all) {
  py::dict joints;
  for (const FeasibleEfforts& efforts : all) {
    py::list ranges;
    for (const EffortRange& range : efforts.ranges) {
      py::dict one;
      one["from"] = range.from;
      one["to"] = range.to;
      one["below"] = names_of(range.below);
      one["above"] = names_of(range.above);
      ranges.append(one);
    }
    py::dict one;
    one["effort"] = efforts.effort;
    one["given"] = efforts.given;
    one["within"] = efforts.within;
    one["ranges"] = ranges;
    one["never"] = names_of(efforts.never);
    joints[py::str(efforts.joint)] = one;
  }
  return joints;
}

py::dict dict_of(const Pose& pose) {
  py::dict mode, points, reactions, worst, all;
  for (const auto& [point, side] : pose.working_mode) mode[py::str(point)] = side;
  for (const PosePoint& point : pose.points) points[py::str(point.name)] = point.at;
  for (const JointReaction& joint : pose.reactions) {
    py::dict one;
    for (const ReactionComponent& part : joint.components) one[py::str(to_string(part.quantity))] = part.value;
    reactions[py::str(joint.joint)] = one;
  }
  const bool reached = pose.unreachable.empty() && pose.beyond_limit.empty();
  const auto is_given = [&](const py::object& value) { return reached ? value : py::object(py::none()); };
  worst["displacement"] = pose.worst.displacement;
  worst["rotation"] = pose.worst.rotation;
  worst["distance"] = pose.worst.distance;
  worst["angle"] = pose.worst.angle;
  all["at"] = pose.at;
  all["working_mode"] = mode;
  all["unreachable"] = reached                     ? py::object(py::none())
                       : !pose.unreachable.empty() ? py::cast("point " + pose.unreachable + " cannot be placed")
                                                   : py::cast("beyond the limit of the " + pose.beyond_limit);
  all["points"] = points;
  all["reactions"] = reactions;
  all["determinant"] = is_given(py::cast(pose.determinant));
  all["condition"] = is_given(py::cast(pose.condition));
  all["singular"] = is_given(py::cast(pose.singular));
  all["take_up"] = dict_of(pose.take_up);
  all["error"] = pose.error ? py::object(dict_of(*pose.error)) : py::none();
  all["worst"] = is_given(worst);
  all["undefined"] = pose.undefined;
  all["vanishing"] = names_of(pose.vanishing);
  all["feasible_efforts"] = dict_of(pose.efforts);
  all["notes"] = in_python(pose.notes);
  all["actual"] = pose.actual && pose.actual->converged ? py::object(dict_of(pose.actual->error)) : py::none();
  return all;
}

py::list list_of(const std::vector<ErrorEvent>& events) {
  py::list all;
  for (const ErrorEvent& event : events) {
    py::dict one;
    one["at"] = event.point.at.front();
    one["kind"] = to_string(event.point.kind);
    one["vanishing"] = names_of(event.point.vanishing);
    one["jumps"] = event.jumps;
    put_error(one, event.jump);
    all.append(one);
  }
  return all;
}

py::dict dict_of(const Errors& errors, const ModeErrors& mode) {
  const FieldMap& map = mode.map;
  // The last coordinate first, as images and volumes are indexed.
  std::vector<py::ssize_t> shape;
  for (std::size_t c = map.dimension(); c-- > 0;) shape.push_back(static_cast<py::ssize_t>(map.axes[c].size()));
  py::dict fields, units = units_of(mode.take_up), axes, zones, one;
  for (const Field& field : map.fields) {
    py::array_t<double> array(shape);
    std::copy(field.values.begin(), field.values.end(), array.mutable_data());
    fields[py::str(field.name)] = array;
    units[py::str(field.name)] = field.unit;
  }
  for (std::size_t c = 0; c < map.dimension(); ++c) {
    axes[py::str(map.coordinates[c])] = column(map.axes[c]);
    units[py::str(map.coordinates[c])] = map.angles[c] ? "rad" : "m";
  }
  for (const ZoneErrors& zone : mode.zones) {
    py::array_t<std::size_t> cells(static_cast<py::ssize_t>(zone.cells.size()), zone.cells.data());
    zones[py::str(zone.zone)] = cells;
  }
  one["working_mode"] = mode_of(errors.loci.tower, mode.mode);
  one["coordinates"] = map.coordinates;
  one["axes"] = axes;
  one["fields"] = fields;
  one["take_up"] = dict_of(mode.take_up);
  one["units"] = units;
  one["events"] = list_of(mode.events);
  one["zones"] = zones;
  one["reachable"] = mode.reachable;
  one["undefined"] = mode.undefined;
  one["never_loaded"] = mode.never_loaded;
  one["notes"] = in_python(errors.notes);
  one["complete"] = errors.loci.complete;
  return one;
}

py::list list_of(const Errors& errors) {
  py::list modes;
  for (const ModeErrors& mode : errors.modes) modes.append(dict_of(errors, mode));
  return modes;
}

py::dict dict_of(const TrajectoryResult& result) {
  py::list losses, stages;
  for (const ContactLoss& loss : result.losses) {
    py::dict one;
    one["kind"] = to_string(loss.kind);
    one["joint"] = loss.joint;
    one["quantity"] = to_string(loss.quantity);
    one["time"] = loss.time;
    one["distance"] = loss.distance;
    one["stage"] = loss.stage;
    one["crossed"] = loss.crossed;
    one["displacement"] = loss.displacement;
    one["rotation"] = loss.rotation;
    if (loss.kind == LossKind::minimum) one["earles_wu"] = loss.earles_wu;
    losses.append(one);
  }
  for (const TrajectoryStage& stage : result.stages) {
    py::dict one;
    one["from"] = stage.from;
    one["to"] = stage.to;
    one["begins"] = stage.begins;
    one["ends"] = stage.ends;
    one["critical_period"] = stage.critical_period;
    stages.append(one);
  }
  py::dict all;
  all["period"] = result.period;
  all["length"] = result.length;
  all["samples"] = dict_of(result.samples);
  all["units"] = units_of(result.samples);
  all["losses"] = losses;
  all["stages"] = stages;
  if (result.sweep) {
    const PeriodSweep& sweep = *result.sweep;
    const auto grid = [&](const std::vector<double>& values) {
      py::array_t<double> array(
          {static_cast<py::ssize_t>(sweep.periods.size()), static_cast<py::ssize_t>(sweep.distance.size())});
      std::copy(values.begin(), values.end(), array.mutable_data());
      return array;
    };
    py::dict one;
    one["periods"] = column(sweep.periods);
    one["distance"] = column(sweep.distance);
    one["dx"] = grid(sweep.dx);
    one["dy"] = grid(sweep.dy);
    if (!sweep.dz.empty()) one["dz"] = grid(sweep.dz);
    one["dalpha"] = grid(sweep.dalpha);
    all["sweep"] = one;
  } else {
    all["sweep"] = py::none();
  }
  return all;
}

py::list list_of(const PoseInModes& poses) {
  py::list all;
  for (const ModePose& pose : poses.modes)
    if (pose.pose) all.append(dict_of(*pose.pose));
  return all;
}

DyadSides only_mode(const Model& model, const py::kwargs& options) {
  const LociRequest request = request_of(model, options);
  return request.working_modes.empty() ? DyadSides{} : request.working_modes.front();
}

PoseRequest pose_request(const Model& model, bool iterate, const py::kwargs& options) {
  const LociRequest request = request_of(model, options);
  return {.working_mode = only_mode(model, options),
          .iterate = iterate,
          .min_force = request.min_force,
          .min_couple = request.min_couple};
}

}  // namespace

void put_error(py::dict& to, const PoseError& error) {
  const auto put = [&](const std::string& name, const std::vector<double>& parts) {
    for (std::size_t c = 0; c < parts.size(); ++c) to[py::str(name + "xyz"[c])] = parts[c];
  };
  put("d", error.displacement);
  if (error.rotation.size() == 1)
    to["dalpha"] = error.rotation.front();
  else
    put("dalpha_", error.rotation);
}

void bind_motion(py::module_& module) {
  bind_answer<Pose>(module, "Pose", [](const Pose& pose) { return dict_of(pose); });
  bind_answer<PoseInModes>(module, "PoseInModes", [](const PoseInModes& modes) { return list_of(modes); });
  bind_answer<Errors>(module, "Errors", [](const Errors& errors) { return list_of(errors); });
  bind_answer<TrajectoryResult>(module, "TrajectoryResult",
                                [](const TrajectoryResult& result) { return dict_of(result); });
  module.def("solve_pose",
             [](const Model& model, const std::vector<double>& at, bool iterate, const py::kwargs& options) {
               return solve_pose(model, at, pose_request(model, iterate, options));
             });
  module.def("solve_pose_in_modes",
             [](const Model& model, const std::vector<double>& at, bool iterate, const py::kwargs& options) {
               return solve_pose_in_modes(model, at, pose_request(model, iterate, options));
             });
  module.def("reactions", [](const Model& model, const PyPoses& poses, const py::kwargs& options) {
    const DyadSides sides = only_mode(model, options);
    const std::span<const double> values(poses.data(), static_cast<std::size_t>(poses.size()));
    const Reactions found = [&] {
      const py::gil_scoped_release free;
      return reactions(model, values, sides);
    }();
    return dict_of(found.table);
  });
  module.def("find_errors", [](const Model& model, const std::vector<int>& grid, bool worst_case, bool loci, bool zones,
                               const py::kwargs& options) {
    ErrorRequest request{.grid = grid,
                         .worst_case = worst_case,
                         .with_loci = loci,
                         .with_zones = zones,
                         .loci = request_of(model, options)};
    LociRequest loci_request = request.loci;
    return unlocked(loci_request, [&](const LociRequest& with_signals) {
      request.loci = with_signals;
      return find_errors(model, request);
    });
  });
  module.def("follow_trajectory", [](const Model& model, const std::string& path, const py::object& period, int samples,
                                     const py::object& min_force, const std::vector<double>& periods,
                                     const py::kwargs& options) {
    TrajectoryRequest request{.working_mode = only_mode(model, options), .samples = samples, .periods = periods};
    if (!period.is_none()) request.period = period.cast<double>();
    if (!min_force.is_none()) request.min_force = min_force.cast<double>();
    const py::gil_scoped_release free;
    return follow_trajectory(model, path, request);
  });
}

}  // namespace clearloci::python
