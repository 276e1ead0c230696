// Where something is, in words of a note: over lengths in m, over angles in degrees.
#pragma once

#include <array>
#include <string>

#include "core/locus_factor.hpp"

namespace clearloci::loci {

/// "in (0.25 to 0.26, -0.7 to -0.69)" of a box x0, x1, y0, y1, which its numbers hold; of a point "at (0.25, -0.7)".
/// The coordinates are the problem's: of angles the half tangents of its charts.
std::string place_words(const core::LocusProblem& problem, const std::array<double, 4>& box);

/// The same of angles in rad.
std::string place_words_of_angles(const core::LocusProblem& problem, const std::array<double, 4>& box);

}  // namespace clearloci::loci
