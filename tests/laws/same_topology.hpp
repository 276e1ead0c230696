// Whether two maps of one problem tell the same: curves, components, closed or open, ends and what they end on,
// isolated points.
#pragma once

#include <string>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::test {

/// What differs, one line each; empty where nothing does. Places count as equal within 1e-8 of the box, lengths within
/// what the chord tolerance explains.
std::vector<std::string> differences(const core::LocusMap& a, const core::LocusMap& b);

}  // namespace clearloci::test
