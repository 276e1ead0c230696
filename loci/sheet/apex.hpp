// The sheet around stars at points with irrational coordinates (loci/search/enclosed_stars.hpp): what vanishes there
// does so because the way from end to end does, or the parts of the form do, which are recognised in the straight
// lines, so that powers of the distance are taken out exactly though no number there is.
#pragma once

#include <optional>
#include <vector>

#include "core/locus_factor.hpp"
#include "loci/sheet/star.hpp"

namespace clearloci::loci::sheet {

/// Which of the tower's roots vanish at the apex, and with which powers: those whose squares do. Required: star.apex.
void find_roots_of(Star& star, const core::RootTower& tower);

/// The power of u that is seen in a function; required: star.apex.
int power_at(const Star& star, const core::RootTower& tower, const core::StraightLine& function);

/// A function on the tower as a straight line in (u, X', Y', roots...) (star.hpp), without its own power of u or
/// without the given one; required: star.apex.
core::StraightLine polar_line(const Star& star, const core::RootTower& tower, const SheetFunction& function,
                              std::optional<int> power = std::nullopt);

/// The square of a root on a star that is a touch, without its two powers of u. Required: star.apex, and a polynomial
/// in (x, y) that vanishes there with a gradient across the star's tangent.
core::StraightLine boundary_line(const Star& star, const core::Polynomial& square);

/// The square of an angle's root likewise, which has no power of u.
core::StraightLine polar_angle(const Star& star, const core::RootTower& tower, const core::Root& root);

}  // namespace clearloci::loci::sheet
