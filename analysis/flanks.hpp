// Flanks of gears: teeth push, so that of the working modes that differ in the sides of gears alone, the load chooses
// one (mechanism/read_gears.cpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clearloci/pose.hpp"
#include "core/task.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci {

/// Whether it has gears or belts.
bool meshes(const mechanism::Mechanism& mechanism);
/// Of a gear.
bool has_teeth(const mechanism::Joint& joint);
/// Of a belt: what it carries at most before a span is slack, N m or N; none of other joints.
std::optional<double> most_of_belt(const mechanism::Mechanism& mechanism, const mechanism::Joint& joint);

/// Gears whose teeth would have to pull in a pose: the load presses the other flanks.
std::vector<std::string> pulled_gears(const mechanism::Mechanism& mechanism, const Pose& pose);

/// `sides` with the gears' flanks on every side, the given ones first.
std::vector<DyadSides> modes_of_flanks(const mechanism::Mechanism& mechanism, const DyadSides& sides);

/// That of them in which the teeth push at a pose; `sides` where none is.
DyadSides sides_that_push(const mechanism::Mechanism& mechanism, const DyadSides& sides,
                          const std::vector<double>& pose);

/// That of them in which the teeth push at a pose of a task, under a load of it; `sides` without gears.
DyadSides sides_that_push(const mechanism::Mechanism& mechanism, const core::Task& task, const DyadSides& sides);

/// "the load presses the other flank of gear W".
std::string words_of_pulled(const std::vector<std::string>& gears);

/// Belts of which a span would have to push.
std::vector<std::string> slack_belts(const mechanism::Mechanism& mechanism, const Pose& pose);

/// Throws core::InputError where the mechanism has gears or belts. `what`: "trajectories are followed".
void refuse_gears(const mechanism::Mechanism& mechanism, const std::string& what, const std::string& mend);

}  // namespace clearloci
