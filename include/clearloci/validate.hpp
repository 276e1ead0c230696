// Do the loci hold? Traced loci against reactions that are solved numerically, by means that share nothing with the
// tracing: between the nodes of a grid every reaction changes its sign exactly where it crosses one of its loci, and
// along the loci what is said to vanish does (docs/background/notation.md, the numeric witness).
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     const clearloci::Validation validation = clearloci::validate_loci(model, {.nodes = {100, 100}});
//     std::cout << validation.report.held << " edges held, " << validation.report.disputed << " disputed\n";
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "clearloci/loci.hpp"

namespace clearloci::inline core {

/// A reaction whose zero set the map claims to hold completely.
struct TracedReaction {
  std::string joint;
  Quantity quantity = Quantity::f;

  bool operator==(const TracedReaction&) const = default;
};

/// What became of the edges between neighbouring nodes, for one reaction in one mode.
struct ReactionTally {
  WorkingMode mode;  ///< as in the map
  TracedReaction reaction;
  std::size_t held = 0;
  std::size_t disputed = 0;
  std::size_t undecided = 0;      ///< the edge meets the boundary, or nothing was decided above rounding errors
  std::size_t outside = 0;        ///< both nodes unreachable and no arc there: no reaction, no claim
  bool identically_zero = false;  ///< the numerator is zero to rounding at every node: nothing to cross, not counted
};

struct DisputedEdge {
  std::vector<double> from, to;  ///< one value a coordinate: rad of an angle (LocusMap::angles), else m
  WorkingMode mode;
  TracedReaction reaction;
  int crossings = 0;  ///< of arcs, with multiplicity
  bool sign_change = false;
};

/// An arc, point or surface of which the map says another thing than the reactions beside it do.
struct DisputedArc {
  std::string curve;       ///< its id; of a point over one coordinate its number, "p1"
  std::vector<double> at;  ///< one of the arc's points that were approached, as of DisputedEdge
  WorkingMode mode;
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

/// Nothing is disputed: validated.
struct Validation {
  LocusMap map;
  std::vector<int> nodes;  ///< of the grid, along each coordinate
  ValidationReport report;

  bool validated() const { return report.disputed == 0; }
};

}  // namespace clearloci::inline core

namespace clearloci {

struct ValidationRequest {
  std::vector<int> nodes = {};  ///< one a coordinate; empty: 400 each over two, 4000 over one, 40 each over three
  LociRequest loci = {};
};

/// Traces every scalar reaction of the request's joints and holds the points, arcs or surfaces over one to three free
/// coordinates against reactions at the nodes. Throws InputError where nodes are not two at least along each
/// coordinate, and as trace_loci; LimitReached where the request's deadline comes before the loci are complete.
Validation validate_loci(const Model& model, const ValidationRequest& request = {});

}  // namespace clearloci
