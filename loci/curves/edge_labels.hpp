// What every edge of the arrangement is in one working mode: inside the workspace or not, boundary, direct
// singularity, and which reactions vanish on it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"
#include "loci/curves/reaction_orders.hpp"
#include "loci/curves/sheet_sign.hpp"

namespace clearloci::loci {

/// One thing that an edge is part of. Equal labels on one curve make one LocusCurve.
struct EdgeLabel {
  core::LocusKind kind = core::LocusKind::contact_loss;
  std::vector<core::Vanishing> vanishing;
  std::string factor;
  std::string cause;
  bool excited = true;  ///< LocusCurve::excited
  bool proven = true;   ///< orders of vanishing were compared wherever that matters

  bool operator==(const EdgeLabel&) const = default;
};

struct EdgeInMode {
  bool in_workspace = false;  ///< every Q_j >= 0
  bool interior = false;      ///< every Q_j > 0
  bool decided = true;        ///< false: some sign was not decided, and is taken for one that says nothing of the edge
  std::vector<EdgeLabel> labels;
};

/// The loci of the wanted joints and quantities among components that vanish together; empty where none is wanted.
/// f_J vanishes where both components do. Kept apart: margins, which are not zeros of a reaction.
std::vector<core::Vanishing> wanted_vanishing(const core::LocusProblem& problem,
                                              const std::vector<core::Vanishing>& components);

/// The kind a curve takes from what vanishes on it: the gravest.
core::LocusKind gravest_kind(const std::vector<core::Vanishing>& vanishing);

/// Whether curves of a kind cut the workspace: component loci do not.
bool cuts_workspace(core::LocusKind kind);

/// What vanishes where all of the given reaction factors do; nothing is vanishing where none of it is wanted.
EdgeLabel reaction_label(const core::LocusProblem& problem, const std::vector<const core::LocusFactor*>& factors);

/// The same along an arc on which orders of vanishing were compared, from the reaction factors that vanish there.
EdgeLabel reaction_label(const core::LocusProblem& problem, const ReactionOrders& orders);

/// Whether an implicit polynomial is of both.
bool shares_curve(const core::LocusFactor& a, const core::LocusFactor& b);

/// What vanishes where all the given factors of the problem do; several are reactions.
EdgeLabel label_of(const core::LocusProblem& problem, const std::vector<int>& factors);

/// What a factor's curves may be called: alone, or where others that share them vanish too.
EdgeLabel widest_label(const core::LocusProblem& problem, std::size_t factor);

/// For every edge, in one mode. `curve_of`: arrangement curve of each factor's implicit polynomials.
std::vector<EdgeInMode> label_edges(const core::LocusProblem& problem, const core::WorkingMode& mode,
                                    const CurveArrangement& arrangement,
                                    const std::vector<std::vector<int>>& curves_of_factor, SheetSigns& signs,
                                    const std::vector<int>& sheet_of_factor);

}  // namespace clearloci::loci
