// What is asked about the shapes of tasks (clearloci/verify.hpp).
#pragma once

#include <array>
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

/// Values rounded to doubles.
std::vector<double> rounded(const RationalPose& pose);

}  // namespace clearloci::inline core
