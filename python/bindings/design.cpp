#include "bindings/bindings.hpp"
#include "clearloci/study.hpp"

namespace clearloci::python {
namespace {

template <class T, class Get>
py::array_t<T> column(const StudyResult& result, const Get& get) {
  py::array_t<T> array(static_cast<py::ssize_t>(result.designs.size()));
  auto view = array.template mutable_unchecked<1>();
  for (std::size_t i = 0; i < result.designs.size(); ++i) view(static_cast<py::ssize_t>(i)) = get(result.designs[i]);
  return array;
}

py::list cells_of(const StudyResult& result) {
  py::list cells;
  for (const StudyCell& cell : result.cells)
    cells.append(py::make_tuple(cell.lower, cell.upper, to_string(cell.status), cell.reason));
  return cells;
}

py::list ranges_of(const StudyResult& result) {
  py::list ranges;
  for (const ProvenRange& range : result.ranges)
    ranges.append(py::make_tuple(range.from, range.to, range.below, range.above));
  return ranges;
}

/// Columns by name: what a data frame takes.
py::dict data_of(const Model& model, const StudyResult& result) {
  py::dict one, columns;
  for (std::size_t p = 0; p < result.parameters.size(); ++p)
    columns[py::str(result.parameters[p])] =
        column<double>(result, [p](const StudyDesign& design) { return design.values[p]; });
  for (std::size_t f = 0; f < result.figures.size(); ++f)
    columns[py::str(to_string(result.figures[f]))] = column<double>(result, [f](const StudyDesign& design) {
      return f < design.figures.size() ? design.figures[f] : std::nan("");
    });
  py::list status, reason;
  for (const StudyDesign& design : result.designs) {
    status.append(to_string(design.status));
    reason.append(design.reason);
  }
  columns["status"] = status;
  columns["reason"] = reason;
  one["columns"] = columns;
  one["parameters"] = result.parameters;
  std::vector<std::string> figures;
  for (const Figure figure : result.figures) figures.push_back(to_string(figure));
  one["figures"] = figures;
  one["best"] = result.best ? py::cast(*result.best) : py::object(py::none());
  one["best_model"] =
      result.best ? py::cast(design_text(model, result, result.designs[*result.best])) : py::object(py::none());
  one["front"] = result.front;
  one["cells"] = cells_of(result);
  one["ranges"] = ranges_of(result);
  one["tolerances"] =
      result.tolerances ? py::object(py::make_tuple(result.tolerances->lower, result.tolerances->upper)) : py::none();
  one["best_goal"] = result.best_goal ? py::cast(*result.best_goal) : py::object(py::none());
  one["complete"] = result.complete;
  return one;
}

}  // namespace

void bind_design(py::module_& module) {
  module.def("run_study", [](const Model& model, const std::string& text, const std::string& file, int threads,
                             const std::string& table, bool resume) {
    const Study study = parse_study(text, model, file);
    StudyOptions options;
    options.threads = threads;
    options.table = table;
    options.resume = resume;
    std::atomic<bool> interrupted = false;
    options.progress = [&](const StudyProgress&) {
      const py::gil_scoped_acquire locked;
      if (PyErr_CheckSignals() != 0) {
        interrupted = true;
        throw LimitReached("interrupted");
      }
    };
    std::optional<StudyResult> result;
    try {
      const py::gil_scoped_release free;
      result = run_study(model, study, options);
    } catch (const LimitReached&) {
      if (interrupted) throw py::error_already_set();
      throw;
    }
    return data_of(model, *result);
  });
  module.def("design_count", [](const Model& model, const std::string& text, const std::string& file) {
    return design_count(parse_study(text, model, file));
  });
  module.def("judge_designs", [](const Model& model, const std::string& text, const std::string& file,
                                 std::uint64_t first, std::uint64_t count) {
    const Study study = parse_study(text, model, file);
    const py::gil_scoped_release free;
    return judge_designs(model, study, first, count);
  });
  module.def("study_result",
             [](const Model& model, const std::string& text, const std::string& file, const std::string& lines) {
               return data_of(model, study_result(model, parse_study(text, model, file), lines));
             });
}

}  // namespace clearloci::python
