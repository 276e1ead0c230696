#include "loci/curves/reaction_orders.hpp"

#include <algorithm>

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusFactor;
using core::LocusProblem;
using core::Rational;
using core::Vanishing;

int times(const std::vector<Vanishing>& list, const Vanishing& reaction) {
  for (const Vanishing& v : list)
    if (v.joint == reaction.joint && v.quantity == reaction.quantity) return v.multiplicity;
  return 0;
}

bool is_singular(const LocusFactor& factor) { return factor.role == FactorRole::direct_singularity; }

/// How often a factor is in w = N / |A|.
int exponent_in(const LocusFactor& factor, const Vanishing& reaction) {
  return is_singular(factor) ? times(factor.cancelled, reaction) - factor.multiplicity
                             : times(factor.vanishing, reaction);
}

/// The problem's reactions, and what else vanishes with one of the factors.
std::vector<Vanishing> reactions_with(const LocusProblem& problem, const std::vector<int>& factors) {
  std::vector<Vanishing> reactions = problem.reactions;
  for (const int f : factors)
    for (const Vanishing& v : problem.factors[static_cast<std::size_t>(f)].vanishing)
      if (times(reactions, {v.joint, v.quantity, 1}) == 0) reactions.push_back({v.joint, v.quantity, 1});
  return reactions;
}

/// The order to which a factor vanishes on one side. Zero all along: higher than any that occurs.
std::optional<Rational> order_of(const auto& factor, ArcOrders& arc, int side) {
  constexpr int everywhere = 1 << 20;
  const std::optional<Germ> germ = arc.germ(factor, side);
  if (!germ) return std::nullopt;
  return germ->is_zero() ? Rational(everywhere) : germ->order;
}

}  // namespace

std::vector<int> factors_on(const LocusProblem& problem, const core::Polynomial& curve) {
  std::vector<int> list;
  for (std::size_t f = 0; f < problem.factors.size(); ++f) {
    const LocusFactor& factor = problem.factors[f];
    if (!core::is_of_determinants(factor.role)) continue;
    if (factor.implicit.empty() ||
        std::find(factor.implicit.begin(), factor.implicit.end(), curve) != factor.implicit.end())
      list.push_back(static_cast<int>(f));
  }
  return list;
}

bool needs_orders(const LocusProblem& problem, const core::Polynomial& curve) {
  return std::any_of(problem.factors.begin(), problem.factors.end(), [&](const LocusFactor& factor) {
    if (factor.role == FactorRole::direct_singularity && factor.implicit_too_heavy) return true;
    return (factor.role == FactorRole::direct_singularity || factor.role == FactorRole::workspace_boundary) &&
           std::find(factor.implicit.begin(), factor.implicit.end(), curve) != factor.implicit.end();
  });
}

ReactionOrders reaction_orders(const LocusProblem& problem, ArcOrders& arc, const std::vector<int>& candidates) {
  ReactionOrders result;
  result.decided = arc.decided() && !arc.sides().empty();
  if (!result.decided) return result;
  const std::vector<Vanishing> reactions = reactions_with(problem, candidates);
  std::vector<Rational> least(reactions.size());
  bool first_side = true;
  for (const int side : arc.sides()) {
    std::vector<Rational> orders(reactions.size(), Rational(0));
    for (const int f : candidates) {
      const LocusFactor& factor = problem.factors[static_cast<std::size_t>(f)];
      // A polynomial of thousands of terms is not looked at where a few steps tell that it does not vanish.
      if (factor.sheet.terms.size() > factor.line.steps.size() && arc.is_nonzero(factor.line)) continue;
      const std::optional<Rational> order = order_of(factor, arc, side);
      if (!order) {
        result.decided = false;
        return result;
      }
      if (*order == 0) continue;
      if (std::find(result.vanishes.begin(), result.vanishes.end(), f) == result.vanishes.end())
        result.vanishes.push_back(f);
      result.singular = result.singular || is_singular(factor);
      for (std::size_t k = 0; k < reactions.size(); ++k) orders[k] += exponent_in(factor, reactions[k]) * *order;
    }
    for (std::size_t k = 0; k < reactions.size(); ++k) {
      least[k] = first_side ? orders[k] : std::min(least[k], orders[k]);
      result.excited = result.excited || (orders[k] < 0 && !core::is_guide_end(reactions[k].quantity));
    }
    first_side = false;
  }
  std::sort(result.vanishes.begin(), result.vanishes.end());
  for (std::size_t k = 0; k < reactions.size(); ++k) {
    if (least[k] <= 0) continue;
    const Rational counted = least[k] * arc.ramification();
    result.vanishing.push_back(
        {reactions[k].joint, reactions[k].quantity, static_cast<int>(core::Integer(counted.get_num()).get_si())});
  }
  return result;
}

ReactionOrders orders_at_simple_zero(const LocusProblem& problem, int factor) {
  const LocusFactor& locus_factor = problem.factors[static_cast<std::size_t>(factor)];
  ReactionOrders result;
  result.singular = is_singular(locus_factor);
  result.vanishes = {factor};
  for (const Vanishing& reaction : reactions_with(problem, {factor})) {
    const int order = exponent_in(locus_factor, reaction);
    if (order > 0) result.vanishing.push_back({reaction.joint, reaction.quantity, order});
    result.excited = result.excited || (order < 0 && !core::is_guide_end(reaction.quantity));
  }
  return result;
}

std::optional<bool> is_margin(const LocusFactor& margin, ArcOrders& arc) {
  if (!arc.decided()) return std::nullopt;
  for (const int side : arc.sides()) {
    std::optional<Rational> value = order_of(margin, arc, side);
    if (!value) return std::nullopt;
    for (const auto& [sheet, power] : margin.cleared) {
      const std::optional<Rational> order = order_of(sheet, arc, side);
      if (!order) return std::nullopt;
      *value -= power * *order;
    }
    if (*value <= 0) return false;
  }
  return true;
}

}  // namespace clearloci::loci
