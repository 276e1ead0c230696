#include "loci/curves/force_zeros.hpp"

#include <algorithm>
#include <set>

namespace clearloci::loci {
namespace {

using core::LocusFactor;
using core::LocusProblem;
using core::Quantity;
using core::Vanishing;

/// By their places among the problem's factors.
using FactorSet = std::set<std::size_t>;

bool has(const std::vector<Vanishing>& list, const std::string& joint, Quantity quantity) {
  return std::any_of(list.begin(), list.end(),
                     [&](const Vanishing& v) { return v.joint == joint && v.quantity == quantity; });
}

/// One factor of every component that is not zero in every pose; a factor of several components stands once.
std::set<FactorSet> sets_of(const LocusProblem& problem, const std::string& joint) {
  std::set<FactorSet> sets = {{}};
  for (const Quantity component : core::force_components(problem, joint)) {
    if (has(problem.always_zero, joint, component)) continue;
    std::set<FactorSet> next;
    for (std::size_t f = 0; f < problem.factors.size(); ++f) {
      const LocusFactor& factor = problem.factors[f];
      if (factor.role != core::FactorRole::reaction || !has(factor.vanishing, joint, component)) continue;
      for (FactorSet set : sets) {
        set.insert(f);
        next.insert(std::move(set));
      }
    }
    sets = std::move(next);
  }
  return sets;
}

/// Of three factors the third is that of the component which depends on the others by a normal of the fewest terms.
ForceZeros ordered(const LocusProblem& problem, const std::string& joint,
                   const std::vector<const LocusFactor*>& factors) {
  if (factors.size() == 2) return {{factors[0], factors[1]}};
  const auto plane = std::find_if(problem.force_planes.begin(), problem.force_planes.end(),
                                  [&](const core::ForcePlane& known) { return known.joint == joint; });
  const std::vector<Quantity> components = core::force_components(problem, joint);
  std::size_t third = 0;
  const core::Polynomial* normal = nullptr;
  for (std::size_t i = 0; i < 3 && plane != problem.force_planes.end(); ++i) {
    const auto component = std::find_if(components.begin(), components.end(),
                                        [&](Quantity q) { return has(factors[i]->vanishing, joint, q); });
    const core::Polynomial& part = plane->normal.at(static_cast<std::size_t>(component - components.begin()));
    if (part.terms.empty() || (normal != nullptr && normal->terms.size() <= part.terms.size())) continue;
    third = i;
    normal = &part;
  }
  for (std::size_t i = 1; i < 3 && normal == nullptr; ++i)
    if (factors[i]->sheet.terms.size() > factors[third]->sheet.terms.size()) third = i;
  return {{factors[third == 0 ? 1 : 0], factors[third == 2 ? 1 : 2]}, factors[third], normal};
}

}  // namespace

std::vector<const LocusFactor*> ForceZeros::factors() const {
  std::vector<const LocusFactor*> all(system.begin(), system.end());
  if (third != nullptr) all.push_back(third);
  return all;
}

std::vector<ForceZeros> zeros_of_force(const LocusProblem& problem, const std::string& joint) {
  for (const core::ForcePairs& known : problem.force_pairs) {
    if (known.joint != joint) continue;
    std::vector<ForceZeros> pairs;
    for (const core::ForcePair& pair : known.pairs)
      pairs.push_back({{&problem.pair_functions[pair.system[0]], &problem.pair_functions[pair.system[1]]},
                       pair.third ? &problem.pair_functions[*pair.third] : nullptr,
                       pair.third ? &pair.normal : nullptr});
    return pairs;
  }
  const std::set<FactorSet> sets = sets_of(problem, joint);
  const auto holds_another = [&sets](const FactorSet& set) {
    return std::any_of(sets.begin(), sets.end(), [&](const FactorSet& other) {
      return other.size() < set.size() && std::includes(set.begin(), set.end(), other.begin(), other.end());
    });
  };
  std::vector<ForceZeros> all;
  for (const FactorSet& set : sets) {
    if (set.size() < 2 || holds_another(set)) continue;
    std::vector<const LocusFactor*> factors;
    for (const std::size_t f : set) factors.push_back(&problem.factors[f]);
    all.push_back(ordered(problem, joint, factors));
  }
  return all;
}

}  // namespace clearloci::loci
