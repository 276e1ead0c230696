// Maps as dictionaries of plain Python and NumPy values.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bindings/bindings.hpp"
#include "clearloci/export.hpp"

namespace clearloci::python {

/// {"B1": "right"}
py::dict mode_of(const TowerNames& tower, const WorkingMode& mode);

py::dict dict_of(const LocusMap& map);

/// {"B1": "right"} of a mode that is described already.
py::dict mode_of(const std::vector<std::pair<std::string, std::string>>& mode);

/// Paths as text.
std::vector<std::string> names_of(const std::vector<std::filesystem::path>& files);

/// An answer as the library holds it: its values by `data`, and what the program prints and writes of it.
template <class Answer, class Data>
py::class_<Answer> bind_answer(py::module_& module, const char* name, Data data) {
  py::class_<Answer> bound(module, name);
  bound.def("data", [data](const Answer& answer) { return data(answer); });
  bound.def("json", [](const Answer& answer) { return to_json(answer); });
  bound.def("table", [](const Answer& answer) {
    if constexpr (requires { to_text(answer); })
      return to_text(answer);
    else
      return to_table(answer);
  });
  if constexpr (requires(const Answer& answer) { export_to(answer, std::string(), std::set<std::string>()); })
    bound.def("export",
              [](const Answer& answer, const Model&, const std::string& folder, const std::set<std::string>& formats) {
                return names_of(export_to(answer, folder, formats));
              });
  return bound;
}

}  // namespace clearloci::python
