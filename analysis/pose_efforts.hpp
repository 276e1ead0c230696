// Efforts of free actuators at one pose (numeric/effort_gaps.hpp; docs/guide/preload.md). Private to analysis/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/pose.hpp"
#include "mechanism/mechanism.hpp"
#include "numeric/effort_gaps.hpp"

namespace clearloci {

/// Of a range the value next to zero.
inline core::Rational nearest_to_none(const core::Rational& lower, const core::Rational& upper) {
  return lower > 0 ? lower : upper < 0 ? upper : core::Rational();
}

/// The effort that counts as a size of 1, N or N m: the larger bound of `within`; 1 where there is none.
core::Rational reference_effort(const mechanism::FreeEffort& effort);

/// What is known of a free actuator at every pose: its joint, what it exerts and within which bounds.
FeasibleEfforts efforts_without_ranges(const mechanism::Joint& joint);

/// The ranges between the gaps, within the motor's own, or what fails at every effort. `efforts`: with `within`.
void set_ranges(const std::vector<numeric::EffortGap>& gaps, FeasibleEfforts& efforts);

/// The efforts of a free actuator at which its own backlash is crossed, or that are smaller than `request` asks; none
/// where it has no play.
std::optional<numeric::EffortGap> own_gap(const mechanism::Mechanism& mechanism, const std::string& joint,
                                          const LociRequest& request);

/// Whether an effort from one to the other is within that gap: larger than -to and smaller than to, or 0.
bool is_within_own_gap(const numeric::EffortGap& gap, double from, double to);

/// Of a mechanism some of whose efforts are free.
struct PoseEfforts {
  mechanism::Mechanism mechanism;        ///< with an effort where none was given
  std::vector<FeasibleEfforts> efforts;  ///< of every free actuator, without ranges where |A| vanishes
  std::vector<std::string> notes;        ///< what was chosen, and which reactions are not asked for
};

/// Where no effort is given the smallest feasible one is chosen, one actuator after the other; where none is, or |A|
/// vanishes, the one next to zero.
PoseEfforts pose_efforts(const mechanism::Mechanism& mechanism, const std::vector<numeric::Bounded>& at,
                         const DyadSides& sides, const PoseRequest& request);

}  // namespace clearloci
