// The loci of one design carried over to another one of the same mechanism by Newton's method, place by place: what a
// hand that drags a length sees first. Nothing is proven: loci that are new are absent, and what has merged or come
// apart may look as before. The proof is that of loci/trace.hpp.
#pragma once

#include <vector>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"

namespace clearloci::loci {

/// `problems`: of the new design, one for each choice of charts and sheets; `last`: the loci of the other one, in the
/// same coordinates, angles in rad. Curves, surfaces and isolated points keep their order, ids and modes and go to the
/// factor of the same kind that is nearest to them. Arcs end where curves of their ends cross them now, and are cut
/// where a vertex finds no place on the sheet. Everything is marked as not certified, the map as not complete. One to
/// three coordinates.
core::LocusMap carried_loci(const std::vector<const core::LocusProblem*>& problems, const core::LocusMap& last);

}  // namespace clearloci::loci
