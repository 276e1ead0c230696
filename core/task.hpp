// What is asked about the shapes of tasks (clearloci/verify.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "clearloci/verify.hpp"

namespace clearloci::inline core {

/// "box", "ball", "polygon", "path" or "mesh"; of two coordinates "circle".
std::string kind_of(const TaskShape& shape);

/// With `to` + factor (v - from) in the place of every value v of a coordinate, and sizes times the factor, which is
/// above 0. `from`, `to`: a value a coordinate, or empty for zeros.
TaskShape placed(const TaskShape& shape, const RationalPose& from, const Rational& factor, const RationalPose& to);
TaskShape moved(const TaskShape& shape, const RationalPose& by);

/// Lower and upper corner of the smallest box around it. `weights`: of a ball, m a unit of each coordinate; empty for
/// ones.
std::array<RationalPose, 2> bounds(const TaskShape& shape, const std::vector<Rational>& weights = {});

/// Of two lengths, its outline, rounded, the first point repeated at the end, circles by chords; of a path the path.
Polyline outline(const TaskShape& shape);

/// The first side that meets another one than those next to it, or runs back on the next; corners are distinct from the
/// ones before.
std::optional<std::size_t> crossed_side(const TaskPolygon& polygon);

/// "is not closed: ...", where an edge is not passed as often one way as the other: else every point off the surface
/// has a number of times that the surface winds around it.
std::optional<std::string> open_surface(const TaskMesh& mesh);

/// Values rounded to doubles.
std::vector<double> rounded(const RationalPose& pose);

}  // namespace clearloci::inline core
