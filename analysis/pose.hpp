// The posture of a mechanism with its reactions, take-up and pose error (clearloci/pose.hpp):
//     Mechanism -> numeric::posture -> reactions -> take-up -> pose error
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "clearloci/pose.hpp"
#include "mechanism/mechanism.hpp"
#include "numeric/pose_error.hpp"

namespace clearloci {

/// `at`: exact values, of which one that is no double gets the error of its rounding: a pose on a locus is told to be
/// on it. Throws as the public one.
Pose solve_pose(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                const PoseRequest& request = {});

/// In every working mode. Throws as the public one.
PoseInModes solve_pose_in_modes(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                                const PoseRequest& request = {});

/// Components of the plane or of space.
PoseError error_of(mechanism::Space space, const numeric::PoseError& error);

/// {{"B1", "right"}, ...}.
std::vector<std::pair<std::string, std::string>> named_mode(const mechanism::Mechanism& mechanism,
                                                            const DyadSides& sides);

/// The sides that are meant: the file's where none are given. Throws core::InputError where their number is wrong.
DyadSides sides_of(const mechanism::Mechanism& mechanism, const DyadSides& sides);

/// Of a mechanism that reaches no pose: `what` and why, "no pose is reached: the mechanism does not close in the
/// workspace", or the limit that the middle of the workspace is beyond.
std::string words_of_no_pose(const mechanism::Mechanism& mechanism, const std::string& what = "no pose is reached");

/// Throws core::InputError where a pose has not one value for each free coordinate.
void require_values(const mechanism::Mechanism& mechanism, std::size_t count);

}  // namespace clearloci
