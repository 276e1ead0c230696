// What is asked about the shapes of tasks (clearloci/verify.hpp).
#pragma once

#include <array>
#include <string>

#include "clearloci/verify.hpp"

namespace clearloci::inline core {

/// "box", "circle", "polygon" or "path".
std::string kind_of(const TaskShape& shape);

TaskShape translated(const TaskShape& shape, const RationalPoint& by);

/// Its outline, rounded, the first point repeated at the end, circles by chords; of a path the path.
Polyline outline(const TaskShape& shape);

/// The corners of the smallest box around it.
std::array<RationalPoint, 2> bounds(const TaskShape& shape);

}  // namespace clearloci::inline core
