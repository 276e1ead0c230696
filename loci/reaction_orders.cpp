#include "loci/reaction_orders.hpp"

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

/// The order to which a factor vanishes on one side. Zero all along: higher than any that occurs.
std::optional<Rational> order_of(const core::Polynomial& sheet, ArcOrders& arc, int side) {
  constexpr int everywhere = 1 << 20;
  const std::optional<Germ> germ = arc.germ(sheet, side);
  if (!germ) return std::nullopt;
  return germ->is_zero() ? Rational(everywhere) : germ->order;
}

}  // namespace

std::vector<int> factors_on(const LocusProblem& problem, const core::Polynomial& curve) {
  std::vector<int> list;
  for (std::size_t f = 0; f < problem.factors.size(); ++f) {
    const LocusFactor& factor = problem.factors[f];
    if (factor.role != FactorRole::reaction && factor.role != FactorRole::direct_singularity) continue;
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
  std::vector<Vanishing> reactions = problem.reactions;
  for (const int f : candidates)
    for (const Vanishing& v : problem.factors[static_cast<std::size_t>(f)].vanishing)
      if (times(reactions, {v.joint, v.quantity, 1}) == 0) reactions.push_back({v.joint, v.quantity, 1});
  std::vector<Rational> least(reactions.size());
  bool first_side = true;
  for (const int side : arc.sides()) {
    std::vector<Rational> orders(reactions.size(), Rational(0));
    for (const int f : candidates) {
      const LocusFactor& factor = problem.factors[static_cast<std::size_t>(f)];
      const std::optional<Rational> order = order_of(factor.sheet, arc, side);
      if (!order) {
        result.decided = false;
        return result;
      }
      if (*order == 0) continue;
      if (std::find(result.vanishes.begin(), result.vanishes.end(), f) == result.vanishes.end())
        result.vanishes.push_back(f);
      const bool singular = factor.role == FactorRole::direct_singularity;
      result.singular = result.singular || singular;
      for (std::size_t k = 0; k < reactions.size(); ++k) {
        const int own = singular ? times(factor.cancelled, reactions[k]) - factor.multiplicity
                                 : times(factor.vanishing, reactions[k]);
        orders[k] += own * *order;
      }
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

std::optional<bool> is_margin(const LocusFactor& margin, ArcOrders& arc) {
  if (!arc.decided()) return std::nullopt;
  for (const int side : arc.sides()) {
    std::optional<Rational> own = order_of(margin.sheet, arc, side);
    if (!own) return std::nullopt;
    for (const auto& [sheet, power] : margin.cleared) {
      const std::optional<Rational> order = order_of(sheet, arc, side);
      if (!order) return std::nullopt;
      *own -= power * *order;
    }
    if (*own <= 0) return false;
  }
  return true;
}

}  // namespace clearloci::loci
