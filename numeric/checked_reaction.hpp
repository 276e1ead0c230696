// What the witness holds against the map, reaction by reaction.
// Private to numeric/.
#pragma once

#include <array>
#include <vector>

#include "numeric/arc_witness.hpp"
#include "numeric/edge_judge.hpp"
#include "numeric/line_witness.hpp"
#include "numeric/validate.hpp"

namespace clearloci::numeric {

struct CheckedReaction {
  TracedReaction reaction;
  WitnessColumns columns;
  std::vector<core::Quantity> force;  ///< components of the joint's f
  std::vector<int> weights;           ///< a curve, surface or point of the map each, in the mode at hand
};

/// Without weights. Throws core::InputError for a reaction that the mechanism does not have.
CheckedReaction checked_reaction(const NumericModel& model, const TracedReaction& reaction);

/// Whether what a locus names vanishes on it. On margins it has its least size, on loci of preload it is at a bound.
bool tells_zeros(core::LocusKind kind);

/// How often the reaction vanishes on a locus.
int times_vanishing(core::LocusKind kind, const std::vector<core::Vanishing>& vanishing,
                    const CheckedReaction& checked);

/// Two neighbouring nodes from the fast route. The turn of a force of several components between nodes that are not
/// near enough has to be followed: `change` is then unknown.
EdgeNodes edge_nodes(const ReactionField& of_first, std::size_t first, const ReactionField& of_second,
                     std::size_t second, const WitnessColumns& columns);

/// Adds what became of a reaction's edges to the report: `counts` by Outcome.
void add_tally(ValidationReport& report, const core::WorkingMode& mode, const TracedReaction& reaction,
               const std::array<std::size_t, 4>& counts, bool identically_zero);

/// What a reaction does along some ways towards a locus.
struct TendencyTally {
  std::size_t zero = 0, other = 0, unbounded = 0;
};
TendencyTally tally_of(const std::vector<Approach>& ways, const WitnessColumns& columns);

}  // namespace clearloci::numeric
