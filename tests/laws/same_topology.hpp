// Whether two maps of one problem tell the same: curves, components, closed or open, ends and what they end on,
// isolated points.
#pragma once

#include <string>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::test {

/// What an end on a side of the box is named after, where something else ends in the same point too.
enum class EndsOnSides { strict, by_place };

/// What differs, one line each; empty where nothing does. Places count as equal within 1e-8 of the box, lengths within
/// what the chord tolerance explains.
std::vector<std::string> differences(const core::LocusMap& a, const core::LocusMap& b,
                                     EndsOnSides ends = EndsOnSides::strict);

}  // namespace clearloci::test
