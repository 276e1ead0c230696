// How the reactions take up the clearances of the joints (paper (14)-(16); method.md section 6):
//     revolute:  d_J = -ρ f_J / |f_J|        displacement of `to` relative to `from`, m
//     actuated:  θ_J = -δ sign(M_J)          rotation of `to` relative to `from`, rad
//     tan β_J = f_J·i / f_J·j                direction of the take-up, from the y axis towards x, rad
//     prismatic: each end of the contact, at ±h along the axis, is pressed to one side by its share (N ± T/h)/2 of the
//                normal force and the couple: d± = -g sign(N ± T/h); normal (d+ + d-)/2, tilt (d+ - d-)/(2 h)
//     actuated along its axis:  -a sign(F), m
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
  double angular = 0;      ///< δ, rad; of an actuated joint; of a prismatic one its actuator's axial play a, m
  double gap = 0;          ///< g, m; of a prismatic joint
  double half_length = 0;  ///< h, m
};

/// Of every joint in the file's order.
std::vector<JointClearance> joint_clearances(const mechanism::Mechanism& mechanism);

/// Whether some joint has a clearance at all.
bool any_clearance(const std::vector<JointClearance>& clearances);

/// Columns of a joint's unknowns; -1 where it has none.
struct JointColumns {
  int fx = -1, fy = -1, couple = -1;  ///< `couple`: the actuator's, M or F
  int normal = -1, tilt = -1;         ///< N, T of a prismatic joint
};

std::vector<JointColumns> joint_columns(const NumericModel& model);

/// (N + T/h, N - T/h): twice what the two ends of a guide bear.
inline std::array<double, 2> guide_ends(double normal, double couple, double half_length) {
  return {normal + couple / half_length, normal - couple / half_length};
}

struct TakeUp {
  Point2 displacement{};       ///< d_J; zero without a clearance
  double rotation = 0;         ///< θ_J; of a prismatic joint the way along its axis, m; zero without a clearance
  std::optional<double> beta;  ///< β_J in (-π, π]; absent where f_J vanishes
  bool force_vanishes = false;
  bool couple_vanishes = false;
  double normal = 0, tilt = 0;         ///< of a prismatic joint, m and rad
  bool guide_vanishes = false;         ///< one of its ends is pressed to neither side
  std::array<bool, 2> end_vanishes{};  ///< which: ahead, behind

  bool operator==(const TakeUp&) const = default;
};

/// Unknowns whose reaction is zero, or cannot be told from it for the rounding errors of the pose and of the
/// arithmetic. `pose` with the error of each value. All of them where |A| cannot be told from zero.
std::vector<bool> vanishing_unknowns(const NumericModel& model, std::span<const Bounded> pose,
                                     std::span<const int> mode);

/// `reactions`: in the order of the unknowns; `vanishing`: as above, or empty: those that are exactly zero.
std::vector<TakeUp> take_up(const NumericModel& model, const std::vector<JointClearance>& clearances,
                            const Eigen::VectorXd& reactions, const std::vector<bool>& vanishing = {});

/// Reactions of joints that leave the take-up of their clearances undefined: f, M or F, an end of a guide.
std::vector<core::Vanishing> lost_reactions(const NumericModel& model, const std::vector<JointClearance>& clearances,
                                            const std::vector<TakeUp>& take_up);

/// Names of the joints whose take-up is undefined though they have a clearance.
std::vector<std::string> undefined_take_up(const NumericModel& model, const std::vector<JointClearance>& clearances,
                                           const std::vector<TakeUp>& take_up);

/// Δ_C: relative displacements of the joints in the order of the unknowns.
Eigen::VectorXd clearance_displacements(const NumericModel& model, const std::vector<TakeUp>& take_up);

}  // namespace clearloci::numeric
