// The Newton-Euler equations of the kinetostatic mechanism (paper (9), (10), (13); method.md section 2):
//     A w_J = -w_e
// One block row a link (fx, fy in N, moment about the end-effector point in N m; six rows in space), one column an
// unknown. A reaction is what `from` exerts on `to`: it enters the rows of `to` with + and those of `from` with -.
// Private to symbolic/.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "symbolic/geometry.hpp"

namespace clearloci::symbolic {

/// The two columns from `first` on are made of vectors across an axis that fall together where `divisor`, a component
/// of the axis, vanishes: it divides |A| and all numerators but these two columns' own. Divided out, the numerators of
/// these columns are those of the two Cartesian components of the reaction that are not along the divisor's.
struct ColumnDivisor {
  unsigned first = 0;
  Poly divisor;
};

struct NewtonEulerEquations {
  std::vector<mechanism::Unknown> unknowns;  ///< columns
  std::vector<std::string> unknown_names;    ///< "fA1x", "fA1y", ..., "MA1"
  std::vector<std::string> row_names;        ///< "A1B1: force x", ...
  GiNaC::matrix matrix;                      ///< A, in natural coordinates
  GiNaC::matrix loads;                       ///< the column -w_e
  /// A column -w_e a free effort without a value, of one N or N m of it alone; `loads` is without them.
  std::vector<GiNaC::matrix> efforts = {};
  std::vector<mechanism::JointIndex> free_joints = {};  ///< whose efforts those are
  std::vector<ColumnDivisor> divisors;
};

/// Which component u_k of an axis divides the columns of f1, f2 and m1, m2: the first that is constant and not zero,
/// else the first that is not zero everywhere. f1 and f2 are the components of the force along the other two
/// directions, over u_k where that is constant.
std::size_t across_component(const Geometry& geometry, const std::vector<GiNaC::ex>& axis);

/// Required: A is square; others are not read (mechanism::check_square). Whoever does not read `efforts` has to ask for
/// their values first (mechanism::require_preload).
NewtonEulerEquations newton_euler_equations(const Geometry& geometry);

}  // namespace clearloci::symbolic
