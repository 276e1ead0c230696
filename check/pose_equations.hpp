// The equations of a mechanism over a cell of poses, in the plane and in space, derived from the model alone: closure
// point by point (method.md section 1), then A w = b with the unit wrenches of the joints as columns, three or six
// rows a link (notation.md), b the opposite of the loads. Of designs within tolerances the parameters that vary
// are coordinates as well. Private to check/.
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

/// An entry of A, or of a reaction c . w. Number: Jet over a cell of poses, Interval where no slopes are wanted.
template <class Number>
struct EntryOf {
  std::size_t row = 0, unknown = 0;
  Number value;
};

/// Unknowns are those of mechanism::unknowns in its order; those of a guide are along and across an axis of length one.
template <class Number>
struct EquationsOf {
  std::size_t unknowns = 0;
  std::vector<EntryOf<Number>> matrix;
  std::vector<Number> right;  ///< b
  /// Of every demand the components along directions of length one, by `row`.
  std::vector<std::vector<EntryOf<Number>>> demands;
  /// What the model itself asks: constant + sum of its entries is above zero. Teeth push, both spans of a belt pull,
  /// efforts keep to their bounds.
  struct Positive {
    std::vector<EntryOf<Number>> entries;
    Number constant;
  };
  std::vector<Positive> positive;
};

/// What poses and designs are over a cell: coordinates of the model and parameters, by name.
template <class Number>
struct VariablesOf {
  std::vector<std::string> names;
  std::vector<Number> values;
};

/// Places, and what has to be above zero for them.
template <class Number>
struct PostureOf {
  std::vector<std::array<Number, 3>> points;
  /// Under the root of every dyad and slider; then, of every limit, what is left to its lower and its upper end where
  /// it has one, and to half a turn of torsion springs.
  std::vector<Number> squares;
  /// What the closure, the unit vectors along guides and the forces of springs divide by, or its square.
  std::vector<Number> divisors;
  /// The first that is not above zero all over the cell, where it stops. Intervals stop at divisors that may be zero
  /// and at squares that are negative for certain.
  std::optional<Number> stopped_by;
};

using PoseEntry = EntryOf<Jet>;
using PoseEquations = EquationsOf<Jet>;
using PoseVariables = VariablesOf<Jet>;
using PosePosture = PostureOf<Jet>;

/// One sign a dyad or slider, in the file's order. `groups`: the places of all points of groups, one after another.
/// Throws core::InputError where one of them is missing.
template <class Number>
PostureOf<Number> posture_over(const mechanism::Mechanism& m, const std::vector<int>& sides,
                               const VariablesOf<Number>& variables,
                               const std::vector<std::array<Number, 3>>& groups = {});

/// The first `count` points alone, without what limits and springs ask of them.
template <class Number>
PostureOf<Number> first_points_over(const mechanism::Mechanism& m, std::size_t count, const std::vector<int>& sides,
                                    const VariablesOf<Number>& variables,
                                    const std::vector<std::array<Number, 3>>& groups);

/// Required: a posture that nothing stopped. Throws core::InputError for demands of what no joint bears.
template <class Number>
EquationsOf<Number> equations_over(const mechanism::Mechanism& m, const PostureOf<Number>& posture,
                                   const VariablesOf<Number>& variables, const std::vector<core::TaskDemand>& demands);

}  // namespace clearloci::check
