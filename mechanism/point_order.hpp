// Each point uses only points above it: cycles and uses of later points, before any point is read.
// Private to mechanism/.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism {

/// Throws core::InputError. `points`: the entries of the file; `links`: as they are written, to name those that a cycle
/// of points would close together.
void check_order(const std::vector<Entry>& points, const std::optional<Value>& links);

}  // namespace clearloci::mechanism
