// Pose errors over the workspace (clearloci/error.hpp), together with the loci at which they jump:
//     Mechanism -> trace_loci, find_zones; numeric::error_map, numeric::error_range -> Errors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/loci.hpp"
#include "clearloci/error.hpp"

namespace clearloci {

/// As the public one.
Errors find_errors(const mechanism::Mechanism& mechanism, const ErrorRequest& request = {});

/// The cells along each coordinate that a request means.
std::vector<int> error_grid(const ErrorRequest& request, std::size_t coordinates);

/// Sizes of some values; `which`: those that count, null: all. Nothing where none is finite.
std::optional<ErrorSizes> sizes_of(const std::vector<double>& values, const std::vector<std::size_t>* which = nullptr);

/// Sides as a mode of that map.
core::WorkingMode mode_in(const core::LocusMap& loci, const DyadSides& sides);

}  // namespace clearloci
