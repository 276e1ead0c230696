// Points that close together, over a cell of poses (method.md section 14), from the model alone. With u_m a solution at
// the cell's middle m, Y an inverse of J = dg/du there in doubles, and J over the cell and a box U around u_m,
//     K = -Y g(Q, u_m) + (1 - Y J)(U - u_m)  inside  U - u_m
// shows that the group closes once in U at every pose of the cell, in u_m + K, and that J is regular (Neumaier,
// Interval Methods for Systems of Equations, section 5.1). Its slopes are du/dq = -J^-1 dg/dq. Private to check/.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "check/pose_equations.hpp"

namespace clearloci::check {

/// One solution of all groups over a cell. Numbers are those of their points, one after another.
struct GroupCell {
  std::vector<std::array<Jet, 3>> places;  ///< in the cell
  std::vector<Interval> alone;  ///< U: there is no other solution in it at any pose of the cell; dimension() a point
  std::vector<double> middle;   ///< u_m
  std::vector<Interval> at_middle;  ///< the solution at the middle of the cell
};

/// Where it is shown; else `spreads`, what each coordinate does to it. `start`: near the solution at the middle.
std::optional<GroupCell> closed_over(const mechanism::Mechanism& m, const std::vector<int>& sides,
                                     const PoseVariables& variables, const Jet::Offsets& offsets,
                                     std::vector<double> start, std::vector<double>& spreads);

}  // namespace clearloci::check
