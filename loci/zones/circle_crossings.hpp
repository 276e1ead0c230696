// Where lines and circles meet, in closed form: whether they do is told exactly.
#pragma once

#include <optional>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::loci {

/// The points of two different lines or circles; nothing where one of them is neither. A touch is one point.
std::optional<std::vector<core::Point2>> circle_crossings(const core::ClosedForm& a, const core::ClosedForm& b);

/// Where the two circles of one curve meet; empty where it is no pair of circles, and where they stay apart.
std::vector<core::Point2> own_crossings(const core::ClosedForm& form);

}  // namespace clearloci::loci
