// Reactions along a trajectory (paper (9), (10); method.md section 7):
//     A w_J = w_i - w_e,   w_i of a link: (m a_G, I α + p_EG × m a_G)
// In space A is that of equations.hpp, and the moment of a slender rod m/12 r × r'' of the way r between its ends; an
// `inertia` is the same about every axis, so that I α is its moment, with α of two directions that turn with the link.
// Every derivative is exact: the closure's tape runs over Taylor series in time. With time in parts τ of the period T,
// accelerations are those by τ divided by T², so that
//     w_J = w_s + w_i / T²
// with a static and an inertial part that do not depend on T: one pass over the path serves every period.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "numeric/pose_error.hpp"
#include "numeric/timeline.hpp"

namespace clearloci::numeric {

/// A mass without inertia at a point of a link.
struct PlacedMass {
  mechanism::LinkIndex link = 0;
  mechanism::PointIndex at = 0;
  double mass = 0;  ///< kg
};

/// Between two points of a link, or the axis of a joint that is fixed in it.
struct BodyDirection {
  mechanism::PointIndex from = 0, to = 0;
  std::optional<Triple> axis = {};
};

/// What is zero all along a path, at rest and in motion. Empty: not known.
struct Idle {
  std::vector<bool> unknowns = {};
  /// Of each joint's guide, what its ends bear, N + T/h ahead and N - T/h behind; of a pin or sleeve in space, twice,
  /// what presses its parts together across its axis.
  std::vector<std::array<bool, 2>> ends = {};
};

/// A mechanism on its way along a path.
struct Motion {
  NumericModel model;
  std::vector<int> mode;
  Timeline timeline;
  std::vector<PlacedMass> point_masses;
  std::vector<double> mass, inertia;  ///< of the links; inertia < 0: that of a slender rod between its first two points
  /// Of links with a single point: the joint whose guide they turn with; -1 of others.
  std::vector<mechanism::JointIndex> guide;
  /// In space: directions that turn with a link, the surest first.
  std::vector<std::vector<BodyDirection>> directions;
  std::vector<bool> still;  ///< links that do not turn: guides hold them to the ground
  std::vector<JointColumns> columns;
  std::vector<JointClearance> clearances;
  Idle idle = {};
};

/// Throws core::InputError where a link with inertia has neither a second point nor a guide that would show its
/// rotation.
Motion compile_motion(const mechanism::Mechanism& mechanism, const mechanism::Trajectory& trajectory,
                      std::vector<int> mode);

using PointSeries = std::array<Series, 3>;

/// The mechanism at one instant. Rates are by τ.
struct Instant {
  double tau = 0;
  std::size_t interval = 0;
  Series distance;                              ///< along the path
  std::vector<Series> coordinates;              ///< free coordinates
  std::vector<PointSeries> points;              ///< of the mechanism
  std::vector<Vector3d> axes, couple_axes;      ///< as Posture::axes and its couple_axes
  std::vector<Vector3d> axes_rate;              ///< derivatives of the axes
  std::optional<LimitEnd> broken;               ///< a limit that the pose is beyond; then not reachable
  bool reachable = false;                       ///< everything below only then
  std::vector<double> rooms;                    ///< squares of roots and what is left of limits: positive within reach
  double determinant = 0;                       ///< |A|
  Eigen::VectorXd at_rest, inertial;            ///< w_s, w_i in the order of the unknowns
  Eigen::VectorXd at_rest_rate, inertial_rate;  ///< their derivatives
  Influence influence;                          ///< H

  Eigen::VectorXd reactions(double period) const { return at_rest + inertial / (period * period); }
  /// By time, per second.
  Eigen::VectorXd reaction_rates(double period) const {
    return (at_rest_rate + inertial_rate / (period * period)) / period;
  }
};

/// The same without a path: for single instants with `instant_of`.
Motion compile_motion(const mechanism::Mechanism& mechanism, std::vector<int> mode);

/// With these coordinates as functions of time; time is in s and the period 1 s.
Instant instant_of(const Motion& motion, const std::vector<Series>& coordinates);

/// What is zero, to the rounding of the solution, at some instants of every interval: what the equations ask of it does
/// not depend on where these are. Instants out of reach or next to a singularity tell nothing.
Idle idle_parts(const Motion& motion);

/// A pin or sleeve in space whose force may be along its axis alone; whether it is, all along the path.
bool bears_across(const Motion& motion, std::size_t joint);
bool is_idle_across(const Motion& motion, std::size_t joint);

/// What joints exert at an instant, of a column of the unknowns: as of reactions.hpp.
std::vector<JointReaction> joint_reactions(const Motion& motion, const Instant& at, const Eigen::VectorXd& values);

/// What presses the parts of a joint together, of a column of the unknowns with its derivative by τ.
struct PressingForce {
  Vector3d value = Vector3d::Zero(), rate = Vector3d::Zero();
};
PressingForce pressing_force(const Motion& motion, const Instant& at, mechanism::JointIndex joint,
                             const Eigen::VectorXd& values, const Eigen::VectorXd& rates);

/// By the pieces of the given interval; at its ends the one-sided limit. Throws core::InputError where the path leaves
/// the workspace or is singular there.
Instant instant(const Motion& motion, std::size_t interval, double tau);

/// Take-up and pose error at an instant of a cycle of the given period; NaN where a take-up is undefined.
struct InstantError {
  std::vector<JointContact> contacts;
  std::vector<TakeUp> take_up;
  PoseError error;
};
InstantError instant_error(const Motion& motion, const Instant& at, double period);

/// Instants of every interval, both of its ends among them, about `count` in all and spread evenly over the cycle. In
/// parallel. Throws core::InputError where the path leaves the workspace or meets a direct singularity.
std::vector<std::vector<Instant>> sample(const Motion& motion, int count);

/// Whether accelerations of the coordinates between samples are near those of the samples beside them. Where they are
/// not the path turns round between samples, and what is looked for there may be missed.
bool are_dense(const Motion& motion, const std::vector<std::vector<Instant>>& samples);

}  // namespace clearloci::numeric
