// What and where something is, in words of a note: places in m and rad, as core/shown_units.hpp finds and tells them in
// the file's units.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"

namespace clearloci::loci {

/// "in [0.25, 0.26] x [-0.7, -0.69]" of a box x0, x1, y0, y1, which its numbers hold; of a point "at (0.25, -0.7)".
/// The coordinates are the problem's: of angles the half tangents of its charts.
std::string place_words(const core::LocusProblem& problem, const std::array<double, 4>& box);

/// The same of angles in rad.
std::string place_words(const std::array<double, 4>& box);

/// Of which curve: what its factor means, else the factor itself, else, where that is too long to be read, what
/// vanishes there: "f_A3, f_B3 = 0". Of core::LocusCurve and core::OpenRegion.
std::string curve_words(core::LocusKind kind, const std::vector<core::Vanishing>& vanishing, const std::string& factor,
                        const std::string& cause);
template <class Located>
std::string curve_words(const Located& curve) {
  return curve_words(curve.kind, curve.vanishing, curve.factor, curve.cause);
}

}  // namespace clearloci::loci
