// The sheet on which the points of groups are meant (loci/sheet/block_sheet.hpp), as the statics of a mechanism need
// it. Private to analysis/.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "core/pose_statics.hpp"
#include "loci/sheet/sheet.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci {

/// Whether a range of an angle ends where it begins, but for the roundings of its ends.
bool is_full_turn(double lower, double upper);

/// "group hip", "groups hip, knee".
std::string names_of_groups(const mechanism::Mechanism& mechanism);

/// Covers a box of poses, of every coordinate of the statics; adds to the notes what is left open. Nothing happens
/// without groups. Throws core::InputError where no way leads from the groups' posture into the box.
std::optional<loci::pose::CoveredBox> cover_groups(const mechanism::Mechanism& mechanism,
                                                   const std::vector<double>& lower, const std::vector<double>& upper,
                                                   const std::optional<std::chrono::steady_clock::time_point>& deadline,
                                                   core::PoseStatics& statics, std::vector<std::string>& notes);

}  // namespace clearloci
