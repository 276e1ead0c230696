// What the bindings of the questions have in common.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"

namespace clearloci::python {

namespace py = pybind11;

void bind_mechanism(py::module_& module);
void bind_loci(py::module_& module);
void bind_zones(py::module_& module);
void bind_verify(py::module_& module);
void bind_motion(py::module_& module);
void bind_design(py::module_& module);

/// A copy of vertices as an array (n, 2) of float64.
py::array_t<double> array_of(const Polyline& points);

/// "contact-loss f_A1": a vanishing reaction as its name.
std::string name_of(const Vanishing& reaction);
std::vector<std::string> names_of(const std::vector<Vanishing>& reactions);

/// Options of the command line by their names in Python: "--min-force" as "min_force".
std::string in_python(const std::string& text);
std::vector<std::string> in_python(const std::vector<std::string>& texts);

/// Adds dx, dy and dalpha, in space dx, dy, dz and dalpha_x, dalpha_y, dalpha_z.
void put_error(py::dict& to, const PoseError& error);

/// The keyword arguments of the command line as a request: working_mode ("all", "right,left" or a list), quantity
/// ("f,M" or a list), joint, min_force, min_couple, controlled, tolerance, mesh_size, engine, time_limit (s).
LociRequest request_of(const Model& model, const py::kwargs& options);

/// What a call pickles to: a model is its text, file and values.
py::tuple state_of(const Model& model);
Model model_of(const py::tuple& state);

/// Runs work without the interpreter's lock; Ctrl-C ends it at its next report of progress.
template <typename Work>
auto unlocked(LociRequest& request, Work work) {
  struct Interrupted {};
  request.progress = [](double, std::string_view) {
    const py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw Interrupted{};
  };
  try {
    const py::gil_scoped_release free;
    return work(request);
  } catch (const Interrupted&) {
    throw py::error_already_set();
  }
}

}  // namespace clearloci::python
