// Newton-Euler equations in floating point (paper (9), (10), (13); method.md section 2), by the plain route of one LU:
//     A w_J = -w_e        (kinetostatic: no inertial loads)
// Rows of every link in the file's order: force (N), then moment about the end-effector point (N m); in the plane fx,
// fy, mz. A reaction is what `from` exerts on `to`: + in the rows of `to`, - in those of `from`. Columns: in the plane
// the unknowns in the order of mechanism::unknowns. In space, where no pair of directions across an axis is better than
// another, the force and the couple across it are resolved along two unit vectors of an orthonormal frame, and the
// actuators are unknowns of their own.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <span>
#include <vector>

#include "numeric/model.hpp"

namespace clearloci::numeric {

/// What a unit of one unknown exerts on `to` at the joint's point.
struct ReactionColumn {
  mechanism::JointIndex joint = 0;
  Vector3d force = Vector3d::Zero(), couple = Vector3d::Zero();
  bool actuator = false;  ///< the actuator's effort, along or about the axis
};

/// `axes`, `couple_axes`: of every joint, as Posture's.
std::vector<ReactionColumn> reaction_columns(const mechanism::Mechanism& mechanism, const std::vector<Vector3d>& axes,
                                             const std::vector<Vector3d>& couple_axes);
std::vector<ReactionColumn> reaction_columns(const NumericModel& model, const Posture& posture);

/// The same of the compiled equations (equations.hpp): in space with the Cartesian components of the whole force and
/// couple, an actuator's effort among them, and that effort once more.
std::vector<ReactionColumn> unknown_columns(const NumericModel& model, const std::vector<Vector3d>& axes,
                                            const std::vector<Vector3d>& couple_axes);

/// A. Requires a reachable posture, here and below.
Eigen::MatrixXd newton_euler_matrix(const NumericModel& model, const Posture& posture);

/// -w_e: forces, couples and weights, negated.
Eigen::VectorXd load_column(const NumericModel& model, const Posture& posture);

struct Reactions {
  Eigen::VectorXd values;  ///< N, N m, in the order of the columns; infinite or NaN where |A| = 0
  double determinant = 0;  ///< |A|
  double condition = 0;    ///< 2-norm condition number of A as it stands, in SI units (moment rows not scaled)
  double residual = 0;     ///< max |A w + w_e| / (|A| |w| + |w_e|), rows' greatest: a few unit roundoffs when balanced
};

/// What a joint's `from` exerts on its `to`, at the joint's point; the actuator's share apart.
struct JointReaction {
  Vector3d force = Vector3d::Zero();   ///< N
  Vector3d couple = Vector3d::Zero();  ///< N m
  double actuator = 0;  ///< N of a prismatic, N m of a revolute joint, along its axis; 0 where there is none
};

/// Of every joint of the mechanism.
std::vector<JointReaction> joint_reactions(std::size_t joints, const std::vector<ReactionColumn>& columns,
                                           const Eigen::VectorXd& values);

/// By LU with partial pivoting of the full matrix: the plain route.
Reactions solve_reactions(const NumericModel& model, const Posture& posture);

/// The same where A is factorised already.
Reactions solve_reactions(const Eigen::MatrixXd& A, const Eigen::VectorXd& load_column,
                          const Eigen::PartialPivLU<Eigen::MatrixXd>& lu);

/// Reactions of many poses by the route of elimination.hpp. Arrays of `poses` values, one an unknown, unknown after
/// unknown; NaN at unreachable poses.
struct ReactionField {
  std::size_t poses = 0;
  int unknowns = 0;
  std::vector<double> numerators;    ///< N_k = w_k |A|
  std::vector<double> determinants;  ///< |A|; NaN exactly at unreachable poses

  std::span<const double> numerator(int unknown) const {
    return {numerators.data() + static_cast<std::size_t>(unknown) * poses, poses};
  }
  double reaction(int unknown, std::size_t pose) const { return numerator(unknown)[pose] / determinants[pose]; }
  bool reachable(std::size_t pose) const { return determinants[pose] == determinants[pose]; }
};

/// `poses`: pose after pose, one value a free coordinate. One thread.
void reaction_field(const NumericModel& model, std::span<const double> poses, std::span<const int> mode,
                    ReactionField& field);

/// Numerators of one pose with a proven bound on their rounding errors.
struct BoundedNumerators {
  bool reachable = false;
  std::vector<Bounded> values;  ///< N_k
  Bounded determinant;          ///< |A|
  /// Of every joint in space the unit vector of its axis; empty in the plane.
  std::vector<std::array<Bounded, 3>> axes = {};
  /// Of a pose out of reach: a gear whose flank would have to pull, or a belt with a slack span.
  std::optional<mechanism::JointIndex> unmet = {};
};

/// u × f: as large as the part of a force f across the unit vector u.
std::array<Bounded, 3> across(const std::array<Bounded, 3>& u, std::span<const Bounded> f);

BoundedNumerators bounded_numerators(const NumericModel& model, std::span<const double> pose,
                                     std::span<const int> mode);
/// The same at every pose within the errors of the given one.
BoundedNumerators bounded_numerators(const NumericModel& model, std::span<const Bounded> pose,
                                     std::span<const int> mode);

/// From the first to the second of two points, m. Requires a reachable pose.
std::array<Bounded, 3> bounded_way(const NumericModel& model, const std::array<mechanism::PointIndex, 2>& points,
                                   std::span<const double> pose, std::span<const int> mode);

/// Whether every point can be placed.
bool reachable(const NumericModel& model, std::span<const double> pose, std::span<const int> mode);

}  // namespace clearloci::numeric
