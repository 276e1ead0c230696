// Where margin curves cross. Next to |A| = 0 those of several forces run side by side, and their functions
// |v|^2 - (f |A|)^2 and |w|^2 - (f |A|)^2 differ by little of themselves.
#pragma once

#include <optional>

#include "core/locus_factor.hpp"

namespace clearloci::loci {

/// Whether a margin is one of a reaction that vanishes wherever a factor does: a couple, or a force with all of its
/// components.
bool is_margin_of(const core::LocusProblem& problem, const core::LocusFactor& margin, const core::LocusFactor& factor);

/// What stands for the second of two functions where zeros of both are looked for: |v|^2 - |w|^2, far from zero but
/// where the curves cross. Empty: they are not such functions, or not with one f |A|.
core::StraightLine difference_of_margins(const core::LocusFactor& first, const core::LocusFactor& second);

/// With a number c, p = q = 0 where p and p - c q are zero: that element, over the tower, with the c for which f |A| or
/// its square cancels, which the two have in common. What it holds of |A| is left out: forces of links that bear known
/// loads differ by multiples of |A|, and no margin curve goes on beyond |A| = 0. Zero: none is known, or its norm is
/// too large.
core::Polynomial margins_apart(const core::LocusProblem& problem, const core::LocusFactor& first,
                               const core::LocusFactor& second);

/// A polynomial in the coordinates, without squares, on the curve of which every common zero of the two functions is,
/// on whatever sheet, but for those on |A| = 0. It is the norm of margins_apart, each factor once, however often it
/// vanishes there: a force and its part along a guide are equal where the other part vanishes, to the second order, so
/// that their margin curves touch and do not cross, but cross that curve. Nothing: they have a curve in common, or
/// nothing is known of how they differ.
std::optional<core::Polynomial> curve_through_crossings(const core::LocusProblem& problem,
                                                        const core::LocusFactor& first,
                                                        const core::LocusFactor& second);

}  // namespace clearloci::loci
