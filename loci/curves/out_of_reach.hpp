// What a curve has no part in: cells that are proven to hold none of it, or no pose.
#pragma once

#include "core/locus_factor.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {

/// Whether halves, halved again so often, prove that a cell holds no pose of the mode, or no zero of function 0 where
/// the program has one.
bool is_free(sheet::SheetCell& look, const sheet::PlaneCell& cell, int halvings);

/// Whether a plane curve is proven to have no point in the box, borders included, that any of the modes reaches.
bool is_out_of_reach(const core::LocusProblem& problem, const core::Polynomial& implicit);

}  // namespace clearloci::loci
