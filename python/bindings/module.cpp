#include <algorithm>
#include <cctype>
#include <map>

#include "bindings/bindings.hpp"

namespace clearloci::python {
namespace {

/// Python's InputError carries the same parts as ours.
void bind_errors(py::module_& module) {
  static const py::handle input_error = py::exception<InputError>(module, "InputError", PyExc_ValueError).release();
  static const py::handle limit_reached =
      py::exception<LimitReached>(module, "LimitReached", PyExc_RuntimeError).release();
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      const py::object exception = input_error(in_python(error.what()));
      exception.attr("file") = in_python(error.position().file);
      exception.attr("line") = error.position().line;
      exception.attr("column") = error.position().column;
      exception.attr("what") = in_python(error.problem());
      exception.attr("mend") = in_python(error.mend());
      PyErr_SetObject(input_error.ptr(), exception.ptr());
    } catch (const py::cast_error& error) {  // of a value in an option, a dict or a list
      PyErr_SetObject(input_error.ptr(),
                      input_error(std::string("a value is of another type than is asked for: ") + error.what()).ptr());
    } catch (const LimitReached& limit) {
      PyErr_SetString(limit_reached.ptr(), in_python(limit.what()).c_str());
    }
  });
}

}  // namespace

std::string in_python(const std::string& text) {
  static const std::map<std::string, std::string> others = {{"set", "with_parameters"}, {"json", "json()"}};
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = text.compare(i, 2, "--") == 0 &&
                        (i == 0 || std::isalnum(static_cast<unsigned char>(text[i - 1])) == 0) && i + 2 < text.size() &&
                        std::islower(static_cast<unsigned char>(text[i + 2])) != 0;
    if (!begins) {
      result += text[i];
      continue;
    }
    std::size_t end = i + 2;
    while (end < text.size() && (std::islower(static_cast<unsigned char>(text[end])) != 0 || text[end] == '-')) ++end;
    std::string name = text.substr(i + 2, end - i - 2);
    const auto other = others.find(name);
    std::replace(name.begin(), name.end(), '-', '_');
    result += other == others.end() ? name : other->second;
    i = end - 1;
  }
  return result;
}

std::vector<std::string> in_python(const std::vector<std::string>& texts) {
  std::vector<std::string> result;
  for (const std::string& text : texts) result.push_back(in_python(text));
  return result;
}

py::array_t<double> array_of(const Polyline& points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  auto view = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t c = 0; c < 2; ++c) view(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(c)) = points[i][c];
  return array;
}

std::string name_of(const Vanishing& reaction) { return to_string(reaction.quantity) + "_" + reaction.joint; }

std::vector<std::string> names_of(const std::vector<Vanishing>& reactions) {
  std::vector<std::string> names;
  for (const Vanishing& reaction : reactions) names.push_back(name_of(reaction));
  return names;
}

}  // namespace clearloci::python

PYBIND11_MODULE(_clearloci, module) {
  using namespace clearloci::python;
  module.doc() = "Discontinuity loci of parallel mechanisms with joint clearances";
  module.attr("__version__") = CLEARLOCI_VERSION;
  bind_errors(module);
  bind_mechanism(module);
  bind_loci(module);
  bind_zones(module);
  bind_verify(module);
  bind_motion(module);
  bind_design(module);
}
