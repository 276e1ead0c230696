// The second opinion: verifies a certificate (certificates.md) from the model, with statics, intervals and proofs
// of its own. Nothing of what wrote the certificate is used here: only the reader of mechanism files and plain data.
//
// In the order in which to read the folder:
//   interval, certificate         the arithmetic; what a file says
//   statics, sheet, identity      the model's equations; functions over cells; that the two are of one mechanism
//   zeros, curves                 zeros with proof; what the cells of a function prove about its curve
//   plane, labels, arcs, points   arcs along those curves, what vanishes there, and at points
//   zones, task, check            what rests on them; what is asked, one after the other
//   jet, pose_equations           over any coordinates, in the plane and in space: values with slopes; the equations
//   pose_cell, pose_task          reactions over a cell; that a task keeps clear of every locus
//   pose_range                    loci and zones over one coordinate
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace clearloci::check {

struct Examination {
  bool accepted = false;
  std::string why;  ///< the first claim that is false or could not be shown; empty where accepted
  std::size_t cells = 0, graphs = 0, crossings = 0, arcs = 0, points = 0, zones = 0;  ///< that were shown
  std::size_t task_cells = 0;                                                         ///< in which a task keeps clear
  std::size_t refuted_patterns = 0;                                                   ///< of signs, by their rows
  double open_share = 0;                                                              ///< of the area of all sheets
  std::vector<std::string> unchecked;  ///< what was not looked at, and why
};

using Deadline = std::optional<std::chrono::steady_clock::time_point>;

/// `model`, `certificate`: the files. Throws core::InputError where one of them cannot be read, core::LimitReached
/// where the deadline comes first.
Examination check_certificate(const std::string& model, const std::string& certificate, const Deadline& deadline = {});

/// The same for texts.
Examination check_certificate_text(const std::string& model_text, const std::string& model_file,
                                   const std::string& certificate_text, const std::string& certificate_file,
                                   const Deadline& deadline = {});

}  // namespace clearloci::check
