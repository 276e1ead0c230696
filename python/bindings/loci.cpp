#include "clearloci/export.hpp"

#include "bindings/bindings.hpp"
#include "bindings/maps.hpp"

namespace clearloci::python {

py::dict mode_of(const std::vector<std::pair<std::string, std::string>>& mode) {
  py::dict sides;
  for (const auto& [point, side] : mode) sides[py::str(point)] = side;
  return sides;
}

py::dict mode_of(const TowerNames& tower, const WorkingMode& mode) { return mode_of(describe_mode(tower, mode)); }

namespace {

/// What every locus has.
template <class Locus>
py::dict named(const Locus& locus) {
  py::dict one;
  one["id"] = locus.id;
  one["kind"] = to_string(locus.kind);
  one["vanishing"] = names_of(locus.vanishing);
  one["factor"] = locus.factor;
  one["cause"] = locus.cause;
  return one;
}

py::dict dict_of(const LocusMap& map, const LocusCurve& curve) {
  py::list arcs, ends;
  for (const Arc& arc : curve.arcs) {
    arcs.append(array_of(arc.points));
    ends.append(py::make_tuple(to_string(arc.ends[0]), to_string(arc.ends[1])));
  }
  const std::vector<std::string>& variables = curve.variables.empty() ? map.tower.coordinates : curve.variables;
  py::dict one = named(curve);
  one["degree"] = curve.implicit.is_zero() ? py::object(py::none()) : py::cast(total_degree(curve.implicit));
  one["implicit"] = curve.implicit.is_zero() ? py::object(py::none()) : py::cast(to_string(curve.implicit, variables));
  one["variables"] = variables;
  one["working_mode"] = mode_of(map.tower, curve.mode);
  one["certified"] = curve.certified;
  one["excited"] = curve.excited;
  one["arcs"] = arcs;
  one["ends"] = ends;
  return one;
}

py::dict dict_of(const LocusMap& map, const SpaceCurve& curve) {
  py::list arcs, ends;
  for (const SpaceArc& arc : curve.arcs) {
    py::array_t<double> points({static_cast<py::ssize_t>(arc.points.size()), py::ssize_t{3}});
    double* to = points.mutable_data();
    for (const Point3& at : arc.points) to = std::copy(at.begin(), at.end(), to);
    arcs.append(points);
    ends.append(py::make_tuple(to_string(arc.ends[0]), to_string(arc.ends[1])));
  }
  py::dict one = named(curve);
  one["degree"] = py::none();
  one["implicit"] = py::none();
  one["variables"] = map.tower.coordinates;
  one["working_mode"] = mode_of(map.tower, curve.mode);
  one["certified"] = curve.certified;
  one["excited"] = true;
  one["arcs"] = arcs;
  one["ends"] = ends;
  return one;
}

py::dict dict_of(const LocusMap& map, const LocusSurface& surface) {
  py::array_t<double> vertices({static_cast<py::ssize_t>(surface.vertices.size()), py::ssize_t{3}});
  py::array_t<int> triangles({static_cast<py::ssize_t>(surface.triangles.size()), py::ssize_t{3}});
  auto vertex = vertices.mutable_unchecked<2>();
  auto triangle = triangles.mutable_unchecked<2>();
  for (std::size_t i = 0; i < surface.vertices.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      vertex(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(c)) = surface.vertices[i][c];
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      triangle(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(c)) = surface.triangles[i][c];
  py::dict one = named(surface);
  one["working_mode"] = mode_of(map.tower, surface.mode);
  one["certified"] = surface.certified;
  one["within_resolution"] = surface.within_resolution;
  py::list open;
  for (const LocusSurface::Open& place : surface.open) {
    py::dict box;
    box["from"] = place.lower;
    box["to"] = place.upper;
    box["cells"] = place.cells;
    open.append(box);
  }
  one["open"] = open;
  one["vertices"] = vertices;
  one["triangles"] = triangles;
  return one;
}

}  // namespace

py::dict dict_of(const LocusMap& map) {
  py::list curves, surfaces, points, workspace, reachable;
  for (const LocusCurve& curve : map.curves) curves.append(dict_of(map, curve));
  for (const SpaceCurve& curve : map.space_curves) curves.append(dict_of(map, curve));
  for (const LocusSurface& surface : map.surfaces) surfaces.append(dict_of(map, surface));
  for (const IsolatedPoint& point : map.isolated_points) {
    py::dict one;
    one["kind"] = to_string(point.kind);
    one["vanishing"] = names_of(point.vanishing);
    one["at"] = point.at;
    one["working_mode"] = mode_of(map.tower, point.mode);
    one["certified"] = point.certified;
    one["factor"] = point.factor;
    one["cause"] = point.cause;
    points.append(one);
  }
  py::list open;
  for (const OpenRegion& region : map.open) {
    py::dict one;
    one["kind"] = to_string(region.kind);
    one["vanishing"] = names_of(region.vanishing);
    one["factor"] = region.factor;
    one["cause"] = region.cause;
    one["working_mode"] = mode_of(map.tower, region.mode);
    one["lower"] = region.lower;
    one["upper"] = region.upper;
    one["point"] = region.point;
    open.append(one);
  }
  for (const WorkspaceRegion& region : map.workspace) {
    py::list rings;
    for (const Polyline& ring : region.rings) rings.append(array_of(ring));
    py::dict one;
    one["working_mode"] = mode_of(map.tower, region.mode);
    one["rings"] = rings;
    workspace.append(one);
  }
  for (const ReachableInterval& interval : map.reachable) {
    py::dict one;
    one["working_mode"] = mode_of(map.tower, interval.mode);
    one["range"] = py::make_tuple(interval.from, interval.to);
    reachable.append(one);
  }
  py::list box;
  for (std::size_t i = 0; i < map.lower.size(); ++i)
    box.append(py::make_tuple(to_double(map.lower[i]), to_double(map.upper[i])));
  py::dict all;
  all["mechanism"] = map.mechanism;
  all["coordinates"] = map.tower.coordinates;
  all["box"] = box;
  all["complete"] = map.complete;
  all["open"] = open;
  all["notes"] = in_python(map.notes);
  all["curves"] = curves;
  all["surfaces"] = surfaces;
  all["isolated_points"] = points;
  all["workspace"] = workspace;
  all["reachable"] = reachable;
  return all;
}

std::vector<std::string> names_of(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files) names.push_back(file.string());
  return names;
}

void bind_loci(py::module_& module) {
  py::class_<LocusMap>(module, "LocusMap", "Traced loci as the library holds them.")
      .def("data", [](const LocusMap& map) { return dict_of(map); })
      .def("json", [](const LocusMap& map) { return to_json(map); })
      .def("table", [](const LocusMap& map) { return to_table(map); })
      .def("svgs",
           [](const LocusMap& map) {
             std::vector<std::string> pictures;
             for (const WorkingMode& mode : modes_of(map)) pictures.push_back(to_svg(map, mode));
             return pictures;
           })
      .def("export",
           [](const LocusMap& map, const Model& model, const std::string& folder,
              const std::set<std::string>& formats) { return names_of(export_to(model, map, folder, formats)); });
  module.def("trace_loci", [](const Model& model, const py::kwargs& options) {
    LociRequest request = request_of(model, options);
    return unlocked(request, [&](const LociRequest& loci_request) { return trace_loci(model, loci_request); });
  });
  module.def("carry_loci", [](const LocusMap& last, const Model& model, const py::kwargs& options) {
    LociRequest request = request_of(model, options);
    return unlocked(request, [&](const LociRequest& loci_request) { return carry_loci(last, model, loci_request); });
  });
  // Its values are those of its JSON.
  bind_answer<Validation>(module, "Validation", [](const Validation& validation) {
    return py::module_::import("json").attr("loads")(to_json(validation));
  });
  module.def("validate_loci", [](const Model& model, const std::vector<int>& nodes, const py::kwargs& options) {
    LociRequest request = request_of(model, options);
    return unlocked(request, [&](const LociRequest& loci_request) {
      return validate_loci(model, {nodes, loci_request});
    });
  });
}

}  // namespace clearloci::python
