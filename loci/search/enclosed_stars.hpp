// Stars at points with irrational coordinates: cones, where the ends of a dyad meet that stands on another dyad, and
// nodes of functions that are quadratic forms. The apex is proven to exist and enclosed; what vanishes there is written
// around it by loci/sheet/apex.hpp.
#pragma once

#include <vector>

#include "core/locus_factor.hpp"
#include "loci/search/isolated_zeros.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

/// The cones of the tower's dyads on dyads on the mode's sheet, in the box and a little around it.
std::vector<Star> enclosed_cones(const core::RootTower& tower, const core::WorkingMode& mode,
                                 const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper);

/// The nodes that forms of one problem with the same last part have in common, in the box and a little around it, each
/// proven to be one. Those at which roots are angles, or of which no proof is had, are left out, and where roots vanish
/// all but those on a rim along which all of the last part vanishes.
std::vector<Star> enclosed_nodes(const core::RootTower& tower, const core::WorkingMode& mode,
                                 const std::vector<const core::NodeForm*>& forms,
                                 const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper,
                                 const ZeroOptions& options);

}  // namespace clearloci::loci::sheet
