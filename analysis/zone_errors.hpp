// Which cells of an error map lie in which discontinuity-free zone.
#pragma once

#include <cstddef>
#include <vector>

#include "clearloci/zones.hpp"
#include "core/field_map.hpp"

namespace clearloci {

/// The cells of the map whose place lies in the zone of that number, by their index, ascending: over two lengths by the
/// zone's rings, over a single coordinate by its ends, else by labels, which the zones have on the map's grid.
std::vector<std::size_t> cells_in(const core::Zones& zones, std::size_t number, const core::FieldMap& map);

}  // namespace clearloci
