// What numeric/ finds at a pose as an answer tells it (clearloci/pose.hpp): by the names of points, joints and links,
// in the components of the plane or of space. Private to analysis/.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "clearloci/pose.hpp"
#include "mechanism/mechanism.hpp"
#include "numeric/displaced.hpp"
#include "numeric/pose_error.hpp"

namespace clearloci {

/// The shortest decimals that read back as the same doubles. Throws core::InputError where one is not finite.
std::vector<core::Rational> exact_values(const std::vector<double>& at);

/// Throws core::InputError where rates are not as many as coordinates, not finite, or not to be had with what is asked.
void require_rates(const mechanism::Mechanism& mechanism, const PoseRequest& request);

/// Throws core::InputError where an axis has no direction.
numeric::Posture posture_at(const numeric::NumericModel& model, std::span<const double> at, const DyadSides& sides);

std::string name_of(const mechanism::Mechanism& mechanism, mechanism::PointIndex point);
std::vector<double> components(mechanism::Space space, const Eigen::Vector3d& v);
std::vector<double> rotations(mechanism::Space space, const Eigen::Vector3d& v);
std::vector<PosePoint> named_points(const mechanism::Mechanism& mechanism, const std::vector<Eigen::Vector3d>& places);

/// Of the joints with a clearance.
std::vector<JointTakeUp> take_up_of(const mechanism::Mechanism& mechanism,
                                    const std::vector<numeric::JointContact>& contacts,
                                    const std::vector<numeric::TakeUp>& take_up);

/// The couple that holds a link without extent, which is zero.
bool is_held_turning(const mechanism::Mechanism& mechanism, const mechanism::Unknown& unknown);

/// A joint of space: its force and couple in Cartesian components, the actuator's share apart.
JointReaction reaction_in_space(const mechanism::Mechanism& mechanism, std::size_t joint,
                                const numeric::JointReaction& reaction);

/// In the plane by the unknowns, of which `values` has one each.
std::vector<JointReaction> reactions_of(const numeric::NumericModel& model, const Eigen::VectorXd& values,
                                        const std::vector<numeric::JointReaction>& of_joints);

ActualPose actual_of(const numeric::NumericModel& model, const std::vector<numeric::JointContact>& contacts,
                     const numeric::ActualPose& found);

}  // namespace clearloci
