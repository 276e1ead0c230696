// Which cells of an error map lie in which discontinuity-free zone.
#pragma once

#include <cstddef>
#include <vector>

#include "clearloci/zones.hpp"
#include "core/field_map.hpp"

namespace clearloci {

/// The cells whose middle lies in the zone, by their index in the map's fields, ascending.
std::vector<std::size_t> cells_in(const core::Zone& zone, const core::FieldMap& map);

}  // namespace clearloci
