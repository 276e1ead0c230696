// Pose errors over the workspace (clearloci/error.hpp), together with the loci at which they jump:
//     Mechanism -> trace_loci, find_zones; numeric::error_map, numeric::error_range -> ErrorMap, CoordinateErrors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/loci.hpp"
#include "clearloci/error.hpp"

namespace clearloci {

/// As the public ones.
ErrorMap error_map(const mechanism::Mechanism& mechanism, const ErrorRequest& request = {});
VolumeErrors error_volume(const mechanism::Mechanism& mechanism, const ErrorRequest& request = {});
CoordinateErrors coordinate_errors(const mechanism::Mechanism& mechanism, const ErrorRequest& request = {});

/// Sizes of some values; `which`: those that count, null: all. Nothing where none is finite.
std::optional<ErrorSizes> sizes_of(const std::vector<double>& values, const std::vector<std::size_t>* which = nullptr);

/// The loci that are drawn below the errors, or a map without any, complete with the names of the working modes.
core::LocusMap loci_below(const mechanism::Mechanism& mechanism, const ErrorRequest& request);

/// Sides as a mode of that map.
core::WorkingMode mode_in(const core::LocusMap& loci, const DyadSides& sides);

}  // namespace clearloci
