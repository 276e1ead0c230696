#include "clearloci/verify.hpp"

#include "bindings/bindings.hpp"
#include "bindings/maps.hpp"
#include "clearloci/export.hpp"

namespace clearloci::python {
namespace {

py::tuple pair_of(const Point2& at) { return py::make_tuple(at[0], at[1]); }

py::object witness_of(const Verification& answer) {
  if (!answer.witness) return py::none();
  const TaskWitness& witness = *answer.witness;
  py::dict one;
  one["at"] = pair_of(witness.at);
  one["kind"] = witness.kind == TaskWitness::Kind::unreachable ? "unreachable"
                : witness.kind == TaskWitness::Kind::boundary  ? "boundary"
                : witness.kind == TaskWitness::Kind::singular  ? "singular"
                : witness.kind == TaskWitness::Kind::vanishing ? "vanishing"
                : witness.kind == TaskWitness::Kind::displaced ? "displaced"
                                                               : "too small";
  one["vanishing"] = names_of(witness.vanishing);
  one["too_small"] = names_of(witness.too_small);
  one["size"] = witness.size;
  one["load"] = witness.load ? py::object(pair_of(*witness.load)) : py::none();
  one["distance"] = witness.distance;
  py::dict design;
  for (const auto& [name, value] : witness.design) design[py::str(name)] = value;
  one["design"] = design;
  py::list loads;
  for (const WitnessLoad& own : witness.loads)
    loads.append(py::dict(py::arg("load") = own.load + 1, py::arg("force") = pair_of(own.force),
                          py::arg("couple") = own.couple));
  one["loads"] = loads;
  return one;
}

py::object nearest_of(const Verification& answer) {
  if (!answer.nearest) return py::none();
  const NearestOfTask& nearest = *answer.nearest;
  py::dict one;
  one["curve"] = nearest.curve;
  one["kind"] = to_string(nearest.kind);
  one["vanishing"] = names_of(nearest.vanishing);
  one["at"] = pair_of(nearest.at);
  one["distance"] = nearest.distance;
  return one;
}

py::object open_of(const Verification& answer) {
  if (!answer.open) return py::none();
  const OpenTask& open = *answer.open;
  return py::dict(py::arg("cells") = open.cells, py::arg("lower") = pair_of(open.lower),
                  py::arg("upper") = pair_of(open.upper), py::arg("reason") = word_of(open.reason));
}

}  // namespace

std::string word_of(OpenTask::Reason reason) {
  return reason == OpenTask::Reason::time ? "time" : reason == OpenTask::Reason::cells ? "cells" : "doubles";
}

void bind_verify(py::module_& module) {
  py::class_<Task>(module, "Task", "What a design is verified for.").def("__repr__", [](const Task& task) {
    return "<clearloci task of '" + task.file + "'>";
  });
  module.def("read_task", [](const std::string& path, const Model& model) { return read_task(path, model); });
  module.def("parse_task", [](const std::string& text, const Model& model) { return parse_task(text, model); });
  py::class_<Verification>(module, "Answer", "A verification as the library holds it.")
      .def("data",
           [](const Verification& answer) {
             py::dict one;
             one["verdict"] = to_string(answer.verdict);
             one["margin"] = answer.verified() ? py::cast(answer.margin) : py::object(py::none());
             one["pose_error"] = answer.pose_error ? py::cast(*answer.pose_error) : py::object(py::none());
             one["zone"] = answer.zone.empty() ? py::object(py::none()) : py::cast(answer.zone);
             one["witness"] = witness_of(answer);
             one["nearest"] = nearest_of(answer);
             one["moved_by"] = answer.by
                                   ? py::object(py::make_tuple(to_double((*answer.by)[0]), to_double((*answer.by)[1])))
                                   : py::none();
             one["open"] = open_of(answer);
             const TowerNames& tower = answer.map.loci.tower;
             one["working_mode"] = tower.roots.size() == answer.mode.size() ? mode_of(tower, answer.mode) : py::dict();
             one["notes"] = in_python(answer.notes);
             return one;
           })
      .def("json", [](const Verification& answer) { return to_json(answer); })
      .def("table", [](const Verification& answer) { return to_text(answer); })
      .def("svgs", [](const Verification& answer) { return std::vector<std::string>{to_svg(answer)}; })
      .def("export",
           [](const Verification& answer, const Model&, const std::string& folder,
              const std::set<std::string>& formats) { return names_of(export_verification(answer, folder, formats)); });
  module.def(
      "verify_task",
      [](const Model& model, const Task& task, const py::object& fit, const py::kwargs& options) {
        LociRequest request = request_of(model, options);
        if (fit.is_none())
          return unlocked(request, [&](const LociRequest& own) { return verify_task(model, task, own); });
        const std::string goal = fit.cast<std::string>();
        if (goal != "nearest" && goal != "best")
          throw InputError({"fit", 0, 0}, "unknown goal '" + goal + "'", "choose nearest or best");
        return unlocked(request, [&](const LociRequest& own) {
          return fit_task(model, task, own, goal == "best" ? FitGoal::best : FitGoal::nearest);
        });
      },
      py::arg("model"), py::arg("task"), py::arg("fit") = py::none());
}

}  // namespace clearloci::python
