#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "bindings/bindings.hpp"
#include "clearloci/import.hpp"
#include "clearloci/normalize.hpp"
#include "clearloci/sketch.hpp"
#include "clearloci/work_limit.hpp"

namespace clearloci::python {
namespace {

std::vector<std::string> words_of(const py::handle& value) {
  if (!py::isinstance<py::str>(value)) return value.cast<std::vector<std::string>>();
  std::vector<std::string> words(1);
  for (const char c : value.cast<std::string>()) {
    if (c == ',')
      words.emplace_back();
    else if (c != ' ')
      words.back() += c;
  }
  return words;
}

[[noreturn]] void refuse(const std::string& option, const std::string& problem, const std::string& mend) {
  throw InputError({option, 0, 0}, problem, mend);
}

/// "right,left", ["right", "left"] or [-1, +1].
DyadSides sides_of(const Model& model, const py::handle& value) {
  const std::vector<Model::Dyad> dyads = model.dyads();
  if (!py::isinstance<py::str>(value) && py::len(value) > 0 && py::isinstance<py::int_>(value[py::int_(0)]))
    return value.cast<DyadSides>();
  const std::vector<std::string> words = words_of(value);
  if (words.size() != dyads.size())
    refuse("working_mode", std::to_string(words.size()) + " sides for " + std::to_string(dyads.size()) + " dyads",
           "give one for each");
  DyadSides sides;
  for (std::size_t j = 0; j < dyads.size(); ++j) {
    if (words[j] != dyads[j].left && words[j] != dyads[j].right)
      refuse("working_mode", "'" + words[j] + "' is no side of " + dyads[j].point,
             "choose " + dyads[j].left + " or " + dyads[j].right);
    sides.push_back(words[j] == dyads[j].left ? 1 : -1);
  }
  return sides;
}

[[noreturn]] void refuse_number(const py::handle& value, const std::string& option) {
  constexpr std::size_t longest = 40;
  refuse(option, "'" + py::repr(value).cast<std::string>().substr(0, longest) + "' is no finite number",
         "give a number or a fraction '1/2'");
}

/// What Python takes for a number and doubles hold.
double finite(const py::handle& value, const std::string& option) {
  const double number = PyFloat_AsDouble(value.ptr());
  const bool failed = PyErr_Occurred() != nullptr;
  PyErr_Clear();
  if (failed || !std::isfinite(number)) refuse_number(value, option);
  return number;
}

Rational exact(const py::handle& value, const std::string& option) {
  if (py::isinstance<py::float_>(value)) return Rational(finite(value, option));
  try {
    Rational number(py::str(value).cast<std::string>());
    if (number.get_den() == 0) refuse_number(value, option);
    number.canonicalize();
    return number;
  } catch (const std::invalid_argument&) {
    refuse_number(value, option);
  }
}

std::vector<Model::Value> values_of(const py::kwargs& values) {
  std::vector<Model::Value> list;
  for (const auto& [name, value] : values)
    list.emplace_back(py::str(name).cast<std::string>(), py::str(value).cast<std::string>());
  return list;
}

py::dict dict_of(const Model::Parameter& parameter) {
  py::dict one;
  one["exact"] = parameter.exact;
  one["value"] = parameter.value;
  return one;
}

py::tuple place_of(const Point2& at) { return py::make_tuple(at[0], at[1]); }

/// Links, guides and joints in a pose that is well seen, m; None where the coordinates are not the place of the end
/// effector, so that mechanism and loci are not in one plane, and where the working mode reaches no pose.
py::object sketch_of(const Model& model, const std::optional<std::map<std::string, std::string>>& mode) {
  if (!pose_is_place(model)) return py::none();
  DyadSides sides;
  for (const Model::Dyad& dyad : model.dyads())
    sides.push_back(mode && mode->contains(dyad.point) ? (mode->at(dyad.point) == dyad.left ? 1 : -1) : dyad.side);
  const auto pose = sample_pose(model, sides);
  if (!pose) return py::none();
  const Sketch sketch = sketch_pose(model, *pose, sides);
  py::list links, slides, springs, joints;
  for (const SketchLink& link : sketch.links) links.append(array_of(Polyline(link.points)));
  for (const SketchSlide& slide : sketch.slides) slides.append(array_of(Polyline{slide.from, slide.to}));
  for (const SketchSpring& spring : sketch.springs)
    if (!spring.torsion) springs.append(array_of(Polyline{spring.from, spring.to}));
  for (const SketchJoint& joint : sketch.joints)
    joints.append(py::dict(py::arg("name") = joint.name, py::arg("at") = place_of(joint.at),
                           py::arg("on_ground") = joint.on_ground, py::arg("actuated") = joint.actuated));
  py::dict all(py::arg("links") = links, py::arg("slides") = slides, py::arg("springs") = springs,
               py::arg("joints") = joints);
  if (sketch.end_effector)
    all["end_effector"] = py::make_tuple(sketch.end_effector->name, place_of(sketch.end_effector->at));
  return all;
}

}  // namespace

LociRequest request_of(const Model& model, const py::kwargs& options) {
  LociRequest request;
  for (const auto& [key, value] : options) {
    const std::string name = py::str(key).cast<std::string>();
    if (value.is_none()) continue;
    if (name == "working_mode") {
      if (py::isinstance<py::str>(value) && value.cast<std::string>() == "all")
        request.all_working_modes = true;
      else
        request.working_modes = {sides_of(model, value)};
    } else if (name == "quantity") {
      request.quantities.clear();
      for (const std::string& word : words_of(value)) {
        const auto found = std::find_if(all_quantities.begin(), all_quantities.end(),
                                        [&](Quantity quantity) { return to_string(quantity) == word; });
        if (found == all_quantities.end()) refuse(name, "unknown quantity '" + word + "'", "f, M, F, N, T, fx to mz");
        request.quantities.push_back(*found);
      }
    } else if (name == "joint") {
      request.joints = words_of(value);
    } else if (name == "min_force") {
      request.min_force = exact(value, name);
    } else if (name == "min_couple") {
      request.min_couple = exact(value, name);
    } else if (name == "controlled") {
      request.controlled = value.cast<bool>();
    } else if (name == "tolerance") {
      request.tolerance = finite(value, name);
    } else if (name == "mesh_size") {
      request.mesh_size = finite(value, name);
    } else if (name == "engine") {
      const auto engine = engine_named(value.cast<std::string>());
      if (!engine)
        refuse(name, "unknown engine '" + value.cast<std::string>() + "'", "adaptive-then-exact, exact or adaptive");
      request.engine = *engine;
    } else if (name == "time_limit") {
      const double seconds = finite(value, name);
      if (seconds <= 0) refuse(name, "a time limit is above zero", "give seconds");
      request.deadline = deadline_after(std::chrono::steady_clock::now(), seconds);
    } else {
      throw py::type_error("unexpected keyword argument '" + name + "'");
    }
  }
  return request;
}

py::tuple state_of(const Model& model) { return py::make_tuple(model.text(), model.file(), model.values()); }

Model model_of(const py::tuple& state) {
  return Model::parse(state[0].cast<std::string>(), state[1].cast<std::string>(),
                      state[2].cast<std::vector<Model::Value>>());
}

void bind_mechanism(py::module_& module) {
  py::class_<Model>(module, "Model", "A mechanism file, whose parameters may take new values.")
      .def_static(
          "read", [](const std::string& path) { return Model::read(path); }, py::arg("path"))
      .def_static(
          "parse", [](std::string text, std::string file) { return Model::parse(std::move(text), std::move(file)); },
          py::arg("text"), py::arg("file") = "model")
      .def(
          "with_parameters", [](const Model& model, const py::kwargs& values) { return model.with(values_of(values)); },
          "The same mechanism with new values: with_parameters(L='0.45', F=80). What does not depend on them is "
          "derived "
          "once.")
      .def_static(
          "import_file",
          [](const std::string& path, const std::string& clearance, const std::string& side,
             const std::string& side_file) {
            ImportedFile found = import_file(path, {clearance, side, side_file});
            return py::make_tuple(std::move(found.text), std::move(found.format), std::move(found.notes));
          },
          py::arg("path"), py::arg("clearance"), py::arg("side"), py::arg("side_file"),
          "Another program's file as a mechanism file: its text, the format, and notes")
      .def(
          "normalize",
          [](const Model& model) {
            NormalizedFile found = normalize(model);
            return py::make_tuple(std::move(found.text), std::move(found.notes));
          },
          "What is drawn as what is constructed: the text of a file, and notes")
      .def_property_readonly("name", &Model::name)
      .def_property_readonly("file", &Model::file)
      .def_property_readonly("text", &Model::text)
      .def_property_readonly("spatial", &Model::spatial)
      .def_property_readonly(
          "parameters",
          [](const Model& model) {
            py::dict all;
            for (const Model::Parameter& parameter : model.parameters())
              all[py::str(parameter.name)] = dict_of(parameter);
            return all;
          },
          "name -> {'exact': str, 'value': float}, SI units")
      .def_property_readonly(
          "coordinates",
          [](const Model& model) {
            py::dict all;
            for (const Model::Coordinate& coordinate : model.coordinates())
              all[py::str(coordinate.name)] = py::make_tuple(coordinate.lower, coordinate.upper);
            return all;
          },
          "free coordinate -> (lower, upper), m or, of an angle, rad")
      .def_property_readonly(
          "units",
          [](const Model& model) {
            const Units& units = model.units();
            const bool degrees = !units.angle_declared;
            py::dict all;
            all["length"] = py::make_tuple(units.length.name, units.length.size);
            all["angle"] = degrees ? py::make_tuple("deg", std::numbers::pi / 180)
                                   : py::make_tuple(units.angle.name, units.angle.size);
            all["force"] = py::make_tuple(units.force.name, units.force.size);
            return all;
          },
          "what tables and pictures speak in: (name, size in SI units)")
      .def_property_readonly(
          "angles",
          [](const Model& model) {
            std::vector<std::string> names;
            for (const Model::Coordinate& coordinate : model.coordinates())
              if (coordinate.angle) names.push_back(coordinate.name);
            return names;
          },
          "the free coordinates that are angles")
      .def("sketch", &sketch_of, py::arg("working_mode"), "a pose of the mechanism as it is drawn; None where none is")
      .def_property_readonly("joints",
                             [](const Model& model) {
                               std::vector<std::string> names;
                               for (const Model::Joint& joint : model.joints()) names.push_back(joint.name);
                               return names;
                             })
      .def_property_readonly(
          "working_mode",
          [](const Model& model) {
            py::dict all;
            for (const Model::Dyad& dyad : model.dyads())
              all[py::str(dyad.point)] = dyad.side > 0 ? dyad.left : dyad.right;
            return all;
          },
          "the file's: point -> side")
      .def("__repr__", [](const Model& model) { return "<clearloci.Model '" + model.name() + "'>"; })
      .def(py::pickle([](const Model& model) { return state_of(model); },
                      [](const py::tuple& state) { return model_of(state); }));
}

}  // namespace clearloci::python
