// Stars at points with irrational coordinates: cones, where the ends of a dyad meet that stands on another dyad, and
// nodes of functions that are quadratic forms. The apex is proven to exist and enclosed; what vanishes there does so
// because the way from end to end does, or the parts of the form do, which are recognised in the straight lines, so
// that powers of the distance are taken out exactly though no number there is.
#pragma once

#include <optional>
#include <vector>

#include "core/locus_factor.hpp"
#include "loci/search/isolated_zeros.hpp"
#include "loci/sheet/star.hpp"

namespace clearloci::loci::sheet {

/// The cones of the tower's dyads on dyads on the mode's sheet, in the box and a little around it.
std::vector<Star> enclosed_cones(const core::RootTower& tower, const core::WorkingMode& mode,
                                 const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper);

/// The nodes that forms of one problem with the same last part have in common, in the box and a little around it, each
/// proven to be one. Those at which roots vanish or are angles, or of which no proof is had, are left out.
std::vector<Star> enclosed_nodes(const core::RootTower& tower, const core::WorkingMode& mode,
                                 const std::vector<const core::NodeForm*>& forms,
                                 const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper,
                                 const ZeroOptions& options);

/// The power of u that is seen in a function; required: star.apex.
int power_at(const Star& star, const core::RootTower& tower, const core::StraightLine& function);

/// A function on the tower as a straight line in (u, X', Y', roots...) (star.hpp), without its own power of u or
/// without the given one; required: star.apex.
core::StraightLine polar_line(const Star& star, const core::RootTower& tower, const SheetFunction& function,
                              std::optional<int> power = std::nullopt);

/// The square of an angle's root likewise, which has no power of u.
core::StraightLine polar_angle(const Star& star, const core::RootTower& tower, const core::Root& root);

}  // namespace clearloci::loci::sheet
