// The witness against the traced loci: on every cell edge of a grid, the numerator N_q = w_q |A| of a reaction changes
// sign exactly if an odd number of arcs of that reaction cross the edge. N_q is continuous through direct singularities
// (w_q is not), so they need no care; the workspace boundary does, for there is no mechanism beyond it.
// Over one coordinate the arcs are points, over three surfaces, of which a triangle is taken to be off by some times
// the deviation that the map states. And along every arc, approached from the sides: what the map has vanish there
// tends to zero, and along direct singularities and the boundary, which no edge need cross, nothing else does
// (arc_witness.hpp).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "clearloci/validate.hpp"
#include "core/locus_map.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::numeric {

/// nx × ny nodes in the map's box; nx over one coordinate, nx × ny × nz over three. Node i of n stands at lower + (i +
/// δ)(upper - lower)/n, δ = √2 - 1 along the first coordinate, (√5 - 1)/2 along the second and √3 - 1 along the third:
/// symmetric mechanisms have loci through the points of a centred grid.
struct GridSpec {
  int nx = 400;
  int ny = 400;
  int threads = 0;                     ///< 0: as many as the machine has
  std::size_t listed_disputes = 1000;  ///< disputed edges listed at most; all are counted
  int nz = 40;
};

using core::DisputedArc;
using core::DisputedEdge;
using core::ReactionTally;
using core::TracedReaction;
using core::ValidationReport;

/// The reactions that some contact-loss, backlash or component curve of the map names, in order of first appearance.
std::vector<TracedReaction> named_reactions(const core::LocusMap& map);

/// Every working mode that the map's curves or workspace name is checked. `traced` empty: named_reactions(map).
/// A curve on which {joint, f} vanishes carries fx and fy too; f itself changes sign where the force's direction flips.
/// Throws core::InputError for an unknown joint, a map of other coordinates or a grid of fewer than two nodes along
/// one.
ValidationReport validate(const mechanism::Mechanism& mechanism, const core::LocusMap& map, const GridSpec& grid = {},
                          const std::vector<TracedReaction>& traced = {});

}  // namespace clearloci::numeric
