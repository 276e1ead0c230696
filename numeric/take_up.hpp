// How the reactions take up the clearances of the joints (paper (14)-(16); method.md section 6). Per joint, `to`
// relative to `from`, with the force f, the couple and the actuator's effort M or F of its reaction:
//     pin, ball, cross, sleeve:     d_J = -ρ f_⊥/|f_⊥|      m; f_⊥: the part of the force across the axis that the
//     joint
//                                                          turns about; all of it in the plane and in a ball
//     pin in a slot along u:        d_J = -ρ sign(N) k × u   m; ρ: half of the slot's gap
//     actuated, turning about u:    θ_J = -δ sign(M) u      rad
//     actuated, sliding along u:    d_J = -a sign(F) u      m
//     gear, u the line of action:   d_J = -a sign(F) u       m; a: half of the backlash, times cos(pressure angle)
//     block in a guide, planar:     each end of the contact, at ±h along the axis, is pressed to one side by its share
//                                   (N ± T/h)/2 of the normal force and the couple: d± = -g sign(N ± T/h); normal
//                                   (d+ + d-)/2 along k × u, tilt (d+ - d-)/(2 h) about k
//     tan β_J = f_J·i / f_J·j       direction of the take-up in the plane, from the y axis towards x, rad
// Where a reaction vanishes the take-up is undefined: the parts have lost contact.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/locus_factor.hpp"
#include "numeric/reactions.hpp"

namespace clearloci::numeric {

/// Clearances of one joint; 0 where it has none.
struct JointClearance {
  double radial = 0;       ///< ρ, m
  double angular = 0;      ///< δ, rad; of an actuated joint that turns
  double axial = 0;        ///< a, m; of an actuated joint that slides
  double gap = 0;          ///< g, m; of a block in a guide of the plane
  double half_length = 0;  ///< h, m

  bool any() const { return radial > 0 || angular > 0 || axial > 0 || gap > 0; }
};

/// Of every joint in the file's order.
std::vector<JointClearance> joint_clearances(const mechanism::Mechanism& mechanism);

/// Whether some joint has a clearance at all.
bool any_clearance(const std::vector<JointClearance>& clearances);

/// Columns of a joint's unknowns, in space those of equations.hpp; -1 where it has none.
struct JointColumns {
  int fx = -1, fy = -1, fz = -1, couple = -1;  ///< `couple`: the actuator's, M or F
  int normal = -1, tilt = -1;                  ///< N, T of a prismatic joint; N of a slot
};

std::vector<JointColumns> joint_columns(const NumericModel& model);

/// What rounding leaves of a guide's end that bears nothing, to |N| + |T|/h.
constexpr double guide_noise = 1e-12;

/// (N + T/h, N - T/h): twice what the two ends of a guide bear.
inline std::array<double, 2> guide_ends(double normal, double couple, double half_length) {
  return {normal + couple / half_length, normal - couple / half_length};
}

/// A joint at a pose, as far as its clearances go.
struct JointContact {
  mechanism::JointType type = mechanism::JointType::revolute;
  bool actuated = false;
  bool in_plane = false;
  JointClearance clearance;
  Vector3d axis = Vector3d::Zero();  ///< as Posture::axes

  bool presses() const { return clearance.radial > 0; }
  bool plays() const { return clearance.angular > 0 || clearance.axial > 0; }
  bool is_guided() const { return in_plane && clearance.gap > 0; }
  /// The part of a force that presses the joint's parts together.
  Vector3d pressing(const Vector3d& force) const;
  /// Across a guide.
  Vector3d normal() const { return {-axis.y(), axis.x(), 0}; }
};

/// Of every joint. `axes`: as Posture's.
std::vector<JointContact> joint_contacts(const mechanism::Mechanism& mechanism, const std::vector<Vector3d>& axes);

struct TakeUp {
  Vector3d displacement = Vector3d::Zero();  ///< d_J, m: all that the clearances allow
  Vector3d rotation = Vector3d::Zero();      ///< θ_J, rad, likewise
  double turn = 0;                           ///< of an actuator about its axis, rad
  double travel = 0;                         ///< of an actuator along its axis, m
  double normal = 0;                         ///< of a guide, m
  double tilt = 0;                           ///< of a guide, rad
  std::optional<double> beta;                ///< β_J in (-π, π], of a pin in the plane; absent where f_J vanishes
  bool force_vanishes = false;               ///< nothing presses it, with a clearance or without
  bool actuator_vanishes = false;            ///< it has an actuator, and that bears nothing
  std::array<bool, 2> end_vanishes{};  ///< ends of a guide with a gap that are pressed to neither side: ahead, behind

  bool guide_vanishes() const { return end_vanishes[0] || end_vanishes[1]; }
};

/// What of a joint's reaction is known to be zero though rounding says otherwise.
struct LostContact {
  bool force = false, actuator = false;
  bool guide = false;  ///< N and T
};

/// What of every joint's reactions is zero, or cannot be told from it for the rounding errors of the pose and of the
/// arithmetic. `pose` with the error of each value. All where |A| cannot be told from zero.
std::vector<LostContact> lost_contacts(const NumericModel& model, std::span<const Bounded> pose,
                                       std::span<const int> mode);

/// `lost`: known of it; without, what is exactly zero.
TakeUp take_up(const JointContact& joint, const JointReaction& reaction, const LostContact& lost = {});

/// Of every joint. `lost`: as above, or empty.
std::vector<TakeUp> take_up(const std::vector<JointContact>& joints, const std::vector<JointReaction>& reactions,
                            const std::vector<LostContact>& lost = {});

/// Reactions of joints that leave the take-up of their clearances undefined: f, M or F, an end of a guide.
std::vector<core::Vanishing> lost_reactions(const mechanism::Mechanism& mechanism,
                                            const std::vector<JointContact>& joints,
                                            const std::vector<TakeUp>& take_up);

/// Names of the joints whose take-up is undefined though they have a clearance.
std::vector<std::string> undefined_take_up(const mechanism::Mechanism& mechanism,
                                           const std::vector<JointContact>& joints, const std::vector<TakeUp>& take_up);

/// Δ_C: relative displacements of the joints in the directions of the columns.
Eigen::VectorXd clearance_displacements(const std::vector<ReactionColumn>& columns, const std::vector<TakeUp>& take_up);

}  // namespace clearloci::numeric
