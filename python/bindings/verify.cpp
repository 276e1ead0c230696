#include "clearloci/verify.hpp"

#include "bindings/bindings.hpp"
#include "bindings/maps.hpp"
#include "clearloci/export.hpp"

namespace clearloci::python {
namespace {

template <class Value>
py::object or_none(const std::optional<Value>& value) {
  return value ? py::cast(*value) : py::object(py::none());
}

py::tuple place(const std::vector<double>& at) { return py::cast(at).cast<py::tuple>(); }

py::object couple_of(const WitnessLoad& load) {
  return load.couple.size() == 1 ? py::cast(load.couple.front()) : py::object(place(load.couple));
}

const char* name_of(TaskWitness::Kind kind) {
  switch (kind) {
    case TaskWitness::Kind::unreachable:
      return "unreachable";
    case TaskWitness::Kind::boundary:
      return "boundary";
    case TaskWitness::Kind::singular:
      return "singular";
    case TaskWitness::Kind::vanishing:
      return "vanishing";
    case TaskWitness::Kind::displaced:
      return "displaced";
    case TaskWitness::Kind::beyond_bound:
      return "beyond bound";
    case TaskWitness::Kind::too_small:
      break;
  }
  return "too small";
}

py::object witness_of(const Verification& answer) {
  if (!answer.witness) return py::none();
  const TaskWitness& witness = *answer.witness;
  py::dict one, design;
  for (const auto& [name, value] : witness.design) design[py::str(name)] = value;
  py::list loads;
  for (const WitnessLoad& load : witness.loads)
    loads.append(py::dict(py::arg("load") = load.load + 1, py::arg("force") = place(load.force),
                          py::arg("couple") = couple_of(load)));
  one["at"] = place(witness.at);
  one["kind"] = name_of(witness.kind);
  one["vanishing"] = names_of(witness.vanishing);
  one["too_small"] = names_of(witness.too_small);
  one["beyond_bound"] = names_of(witness.beyond_bound);
  one["size"] = witness.size;
  one["load"] = witness.load.empty() ? py::object(py::none()) : py::object(place(witness.load));
  one["distance"] = witness.distance;
  one["design"] = design;
  one["loads"] = loads;
  return one;
}

py::object nearest_of(const Verification& answer) {
  if (!answer.nearest) return py::none();
  const NearestOfTask& nearest = *answer.nearest;
  return py::dict(py::arg("curve") = nearest.curve, py::arg("kind") = to_string(nearest.kind),
                  py::arg("vanishing") = names_of(nearest.vanishing), py::arg("at") = place(nearest.at),
                  py::arg("distance") = nearest.distance);
}

py::object open_of(const Verification& answer) {
  if (!answer.open) return py::none();
  const OpenTask& open = *answer.open;
  const char* const reason = open.reason == OpenTask::Reason::time    ? "time"
                             : open.reason == OpenTask::Reason::cells ? "cells"
                                                                      : "doubles";
  return py::dict(py::arg("cells") = open.cells, py::arg("lower") = place(open.lower),
                  py::arg("upper") = place(open.upper), py::arg("reason") = reason);
}

py::dict pattern_of(const PreloadPattern& pattern) {
  py::dict signs;
  for (const auto& [name, sign] : pattern.signs) signs[py::str(name)] = sign;
  py::list refutation;
  for (const PreloadRow& row : pattern.refutation)
    refutation.append(py::dict(py::arg("reaction") = row.reaction, py::arg("sign") = row.sign,
                               py::arg("bound") = row.bound, py::arg("at") = row.at, py::arg("load") = row.load,
                               py::arg("offset") = row.offset, py::arg("slope") = row.slope,
                               py::arg("multiplier") = row.multiplier));
  return py::dict(py::arg("signs") = signs, py::arg("verdict") = to_string(pattern.verdict),
                  py::arg("size") = py::make_tuple(pattern.size[0], pattern.size[1]),
                  py::arg("value") = pattern.value ? py::cast(*pattern.value) : py::object(py::none()),
                  py::arg("joints") = pattern.joints, py::arg("refutation") = refutation);
}

py::object preload_of(const Verification& answer) {
  if (!answer.preload) return py::none();
  const PreloadAnswer& preload = *answer.preload;
  py::dict looked_for, value;
  for (std::size_t i = 0; i < preload.joints.size(); ++i) {
    looked_for[py::str(preload.joints[i])] = py::make_tuple(preload.lower[i], preload.upper[i]);
    if (preload.value) value[py::str(preload.joints[i])] = (*preload.value)[i];
  }
  py::list ranges;
  for (const ProvenRange& range : preload.ranges)
    ranges.append(py::dict(py::arg("from") = range.from, py::arg("to") = range.to, py::arg("below") = range.below,
                           py::arg("above") = range.above));
  py::list patterns;
  for (const PreloadPattern& pattern : preload.patterns) patterns.append(pattern_of(pattern));
  py::dict one;
  one["patterns"] = patterns;
  one["law"] = py::none();
  if (preload.law) {
    py::dict law;
    law["expression"] = preload.law->expression;
    law["within"] = preload.law->within;
    one["law"] = law;
  }
  one["value"] = preload.value ? py::object(value) : py::none();
  one["size"] = py::make_tuple(preload.size[0], preload.size[1]);
  one["ranges"] = ranges;
  one["looked_for"] = looked_for;
  return one;
}

py::dict dict_of(const Verification& answer) {
  py::list least;
  for (const LeastReaction& reaction : answer.least)
    least.append(py::dict(py::arg("reaction") = python::name_of(reaction.reaction), py::arg("proven") = reaction.proven,
                          py::arg("met") = reaction.met));
  py::dict one;
  one["verdict"] = to_string(answer.verdict);
  one["coordinates"] = answer.coordinates;
  one["working_mode"] = mode_of(answer.working_mode);
  one["margin"] = or_none(answer.margin);
  one["angle_margin"] = or_none(answer.angle_margin);
  one["pose_error"] = or_none(answer.pose_error);
  one["zone"] = answer.zone.empty() ? py::object(py::none()) : py::cast(answer.zone);
  one["witness"] = witness_of(answer);
  one["nearest"] = nearest_of(answer);
  one["open"] = open_of(answer);
  one["preload"] = preload_of(answer);
  one["least"] = least;
  one["cells"] = answer.cells;
  one["notes"] = in_python(answer.notes);
  one["moved_by"] = py::none();
  if (answer.moved_by) {
    std::vector<double> by;
    for (const Rational& value : *answer.moved_by) by.push_back(to_double(value));
    one["moved_by"] = place(by);
  }
  one["scaled_by"] = answer.scaled_by ? py::object(py::float_(to_double(*answer.scaled_by))) : py::none();
  return one;
}

TaskFit fit_of(const std::string& word) {
  if (word.empty()) return TaskFit::none;
  if (word == "nearest") return TaskFit::nearest;
  if (word == "best") return TaskFit::best;
  if (word == "largest") return TaskFit::largest;
  throw InputError({"fit", 0, 0}, "unknown goal '" + word + "'", "choose nearest, best or largest");
}

}  // namespace

void bind_verify(py::module_& module) {
  bind_answer<Verification>(module, "Verification", [](const Verification& verification) {
    return dict_of(verification);
  }).def("svgs", [](const Verification& answer) { return std::vector<std::string>{to_svg(answer)}; });
  module.def("verify", [](const Model& model, const std::string& text, const std::string& file, const std::string& fit,
                          const py::kwargs& options) {
    VerifyRequest request{.loci = request_of(model, options), .fit = fit_of(fit)};
    const Task task = text.empty() ? read_task(file, model) : parse_task(text, model, file);
    return unlocked(request.loci, [&](const LociRequest&) { return verify(model, task, request); });
  });
}

}  // namespace clearloci::python
