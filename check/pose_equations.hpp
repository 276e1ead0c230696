// The equations of a mechanism over a cell of poses, in the plane and in space, derived from the model alone: closure
// point by point, then A w = b with the unit wrenches of the joints as columns, b the opposite of the loads. Of designs
// within tolerances the parameters that vary are coordinates as well.
// Private to check/.
//
//   dyad B on A, P about n:   r = (P - A) - h n,  h = n . (P - A),  D = r . r,  b'^2 = b^2 - h^2,  k = a^2 - b'^2 + D
//                             B = A + (k r +- sqrt(4 a^2 D - k^2) n x r) / (2 D)
//   slider S on Q, C along u: S = Q + (u . r +- sqrt(l^2 - |u x r|^2)) u,  r = C - Q,  |u| = 1
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "check/jet.hpp"
#include "core/task_conditions.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::check {

/// An entry of A, or of a reaction c . w.
struct PoseEntry {
  std::size_t row = 0, unknown = 0;
  Jet value;
};

struct PoseEquations {
  std::size_t unknowns = 0;
  std::vector<PoseEntry> matrix;
  std::vector<Jet> right;  ///< b
  /// Of every demand the components along directions of length one, by `row`.
  std::vector<std::vector<PoseEntry>> demands;
};

/// What poses and designs are over a cell: coordinates of the model and parameters, by name.
struct PoseVariables {
  std::vector<std::string> names;
  std::vector<Jet> values;
};

/// Places, and what has to be above zero for them: under roots, divisors, what is left to limits.
struct PosePosture {
  std::vector<std::array<Jet, 3>> points;
  std::vector<Jet> positive;
  /// Each is above zero all over the cell.
  bool is_proven = true;
};

/// One sign a dyad or slider, in the file's order. It stops at the first that is not above zero for certain: the last
/// of `positive` then. Throws core::InputError for models whose points close together.
PosePosture posture_over(const mechanism::Mechanism& m, const std::vector<int>& sides, const PoseVariables& variables);

/// Required: a posture that is proven. Throws core::InputError for demands of what no joint bears.
PoseEquations equations_over(const mechanism::Mechanism& m, const PosePosture& posture, const PoseVariables& variables,
                             const std::vector<core::TaskDemand>& demands);

}  // namespace clearloci::check
