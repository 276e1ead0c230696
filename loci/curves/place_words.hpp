// Where something is, in words of a note: in m and rad, as core/shown_units.hpp finds and tells them in the file's
// units.
#pragma once

#include <array>
#include <string>

#include "core/locus_factor.hpp"

namespace clearloci::loci {

/// "in [0.25, 0.26] x [-0.7, -0.69]" of a box x0, x1, y0, y1, which its numbers hold; of a point "at (0.25, -0.7)".
/// The coordinates are the problem's: of angles the half tangents of its charts.
std::string place_words(const core::LocusProblem& problem, const std::array<double, 4>& box);

/// The same of angles in rad.
std::string place_words(const std::array<double, 4>& box);

}  // namespace clearloci::loci
