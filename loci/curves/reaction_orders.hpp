// What the reactions themselves do along an arc on which numerators vanish, and |A| perhaps too (method.md section 10):
// w = N / |A| with orders p of N and q of |A| tends to zero for p > q, to a finite value for p = q, to infinity for
// p < q. A numerator's order is the sum of those of its factors.
#pragma once

#include <vector>

#include "core/locus_factor.hpp"
#include "loci/curves/arc_orders.hpp"

namespace clearloci::loci {

struct ReactionOrders {
  bool decided = true;  ///< every order is known; otherwise nothing below is claimed
  /// Scalar reactions that tend to zero from every side, with p - q, in multiples of the root's order on the boundary.
  std::vector<core::Vanishing> vanishing;
  bool excited = false;       ///< some reaction grows without bound
  bool singular = false;      ///< |A| vanishes
  std::vector<int> vanishes;  ///< factors of the problem that vanish along the arc, in their order
};

/// `candidates`: which factors of the problem may vanish along the arc; the others are known not to.
ReactionOrders reaction_orders(const core::LocusProblem& problem, ArcOrders& arc, const std::vector<int>& candidates);

/// At a simple zero of one factor, a reaction's or |A|'s, at which no other one vanishes and no root is zero.
ReactionOrders orders_at_simple_zero(const core::LocusProblem& problem, int factor);

/// Factors of the problem that may vanish along an irreducible curve: those that have it among their polynomials, and
/// those whose polynomials are not known.
std::vector<int> factors_on(const core::LocusProblem& problem, const core::Polynomial& curve);

/// Whether orders have to be compared on a curve: |A| may vanish on it, or a root.
bool needs_orders(const core::LocusProblem& problem, const core::Polynomial& curve);

/// Whether a margin's equation says anything of the reactions along the arc: it vanishes to a higher order than what it
/// was multiplied by. Nothing: not decided.
std::optional<bool> is_margin(const core::LocusFactor& margin, ArcOrders& arc);

}  // namespace clearloci::loci
