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

/// A reaction whose zero set the map claims to hold completely.
struct TracedReaction {
  std::string joint;
  core::Quantity quantity = core::Quantity::f;

  bool operator==(const TracedReaction&) const = default;
};

/// What became of the edges, for one reaction in one mode.
struct ReactionTally {
  core::WorkingMode mode;  ///< as in the map
  TracedReaction reaction;
  std::size_t held = 0;
  std::size_t disputed = 0;
  std::size_t undecided = 0;      ///< the edge meets the boundary, or nothing was decided above rounding errors
  std::size_t outside = 0;        ///< both nodes unreachable and no arc there: no reaction, no claim
  bool identically_zero = false;  ///< the numerator is zero to rounding at every node: nothing to cross, not counted
};

struct DisputedEdge {
  std::vector<double> from, to;  ///< one value a coordinate
  core::WorkingMode mode;
  TracedReaction reaction;
  int crossings = 0;  ///< of arcs, with multiplicity
  bool sign_change = false;
};

/// An arc, point or surface of which the map says another thing than the reactions beside it do.
struct DisputedArc {
  std::string curve;       ///< its id; of a point over one coordinate its number, "p1"
  std::vector<double> at;  ///< one of the arc's points that were approached
  core::WorkingMode mode;
  TracedReaction reaction;
  bool claimed = false;    ///< the map has the reaction vanish there; or, with `unbounded`, says that none is unbounded
  bool unbounded = false;  ///< the reaction grows without bound there
};

struct ValidationReport {
  std::vector<ReactionTally> tallies;  ///< by mode, then reaction
  std::size_t held = 0, disputed = 0, undecided = 0, outside = 0;
  std::vector<DisputedEdge> disputed_edges;
  std::size_t arcs_held = 0, arcs_undecided = 0;  ///< claims of a reaction's vanishing along an arc, one by one
  std::vector<DisputedArc> disputed_arcs;         ///< all of them; counted in `disputed` too
};

/// The reactions that some contact-loss, backlash or component curve of the map names, in order of first appearance.
std::vector<TracedReaction> named_reactions(const core::LocusMap& map);

/// Every working mode that the map's curves or workspace name is checked. `traced` empty: named_reactions(map).
/// A curve on which {joint, f} vanishes carries fx and fy too; f itself changes sign where the force's direction flips.
/// Throws core::InputError for an unknown joint, a map of other coordinates or a grid of fewer than two nodes along
/// one.
ValidationReport validate(const mechanism::Mechanism& mechanism, const core::LocusMap& map, const GridSpec& grid = {},
                          const std::vector<TracedReaction>& traced = {});

}  // namespace clearloci::numeric
