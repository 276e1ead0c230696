#include <algorithm>

#include "symbolic/factor_emission.hpp"

namespace clearloci::symbolic {

using core::LocusFactor;
using core::Quantity;

bool is_of(const std::vector<core::Vanishing>& list, const std::string& joint, Quantity quantity) {
  return std::any_of(list.begin(), list.end(),
                     [&](const core::Vanishing& v) { return v.joint == joint && v.quantity == quantity; });
}

std::size_t FactorEmission::pair_function(std::size_t factor) {
  const auto [found, fresh] = pair_functions_of_factors_.try_emplace(factor, d_.result.problem.pair_functions.size());
  if (fresh) {
    LocusFactor function;
    function.sheet = d_.result.problem.factors[factor].sheet;
    function.line = d_.result.problem.factors[factor].line;
    d_.result.problem.pair_functions.push_back(std::move(function));
  }
  return found->second;
}

const std::vector<std::size_t>* FactorEmission::pair_functions(const Poly& natural) {
  const auto known = std::find_if(pair_functions_of_natural_.begin(), pair_functions_of_natural_.end(),
                                  [&](const auto& one) { return one.first == natural; });
  if (known != pair_functions_of_natural_.end()) return &known->second;
  if (d_.elimination.vanishes_everywhere(natural)) return nullptr;
  std::vector<std::size_t> places;
  const std::vector<SheetFactor> parts = d_.elimination.natural_factors(natural, false);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].of_divided) continue;
    LocusFactor function;
    function.sheet = core::scaled_for_doubles(parts[p].sheet.plain(d_.geometry.tower_variables()));
    function.line = line_of(natural, parts, p);
    places.push_back(d_.result.problem.pair_functions.size());
    d_.result.problem.pair_functions.push_back(std::move(function));
  }
  return &pair_functions_of_natural_.emplace_back(natural, std::move(places)).second;
}

std::vector<std::size_t> FactorEmission::parts_of(std::size_t factor, const std::string& joint,
                                                  Quantity component) const {
  std::vector<std::size_t> parts;
  for (std::size_t f = ranges_[factor][0]; f < ranges_[factor][1]; ++f)
    if (is_of(d_.result.problem.factors[f].vanishing, joint, component)) parts.push_back(f);
  return parts;
}

bool FactorEmission::add_pairs(const LowerPair& pair, const std::array<std::size_t, 2>& factors,
                               core::ForcePairs& of_joint) {
  const std::vector<std::size_t>* const a = pair_functions(pair.first);
  if (a == nullptr) return false;
  const auto& functions = d_.result.problem.pair_functions;
  std::vector<core::ForcePair> pairs;
  if (pair.normal) {
    const bool by_x = pair.normal->component == Quantity::fx;
    const core::Polynomial normal =
        core::scaled_for_doubles(d_.elimination.over_tower(pair.normal->way).plain(d_.geometry.tower_variables()));
    for (const std::size_t i : *a)
      for (const std::size_t k : parts_of(factors[by_x ? 0 : 1], of_joint.joint, by_x ? Quantity::fx : Quantity::fy))
        for (const std::size_t third :
             parts_of(factors[by_x ? 1 : 0], of_joint.joint, by_x ? Quantity::fy : Quantity::fx))
          pairs.push_back({{i, pair_function(k)}, pair_function(third), normal});
  } else {
    const std::vector<std::size_t>* const b = pair_functions(pair.second);
    if (b == nullptr) return false;
    for (const std::size_t i : *a)
      for (const std::size_t k : *b) pairs.push_back({{i, k}, {}, {}});
  }
  // The first one is that of which touches are told: a linear one seldom has a double zero.
  for (core::ForcePair& one : pairs) {
    const auto& [i, k] = one.system;
    if (functions[i].sheet == functions[k].sheet) return false;
    const core::ForcePair turned = {{k, i}, one.third, one.normal};
    const bool known = std::any_of(of_joint.pairs.begin(), of_joint.pairs.end(),
                                   [&](const auto& other) { return other == one || other == turned; });
    if (!known) of_joint.pairs.push_back(std::move(one));
  }
  return true;
}

void FactorEmission::force_pairs() {
  if (!d_.wanted(Quantity::f) || !d_.preload.joints.empty() || d_.geometry.coordinates() != 2 ||
      d_.mechanism.space != mechanism::Space::planar)
    return;
  PairReduction reduction(d_.geometry, d_.elimination, d_.determinants.determinant);
  std::vector<std::pair<PolyPair, std::optional<std::vector<LowerPair>>>> known;
  for (const std::string& joint : d_.result.problem.joints) {
    if (core::force_components(d_.result.problem, joint) != std::vector{Quantity::fx, Quantity::fy}) continue;
    const FactoredPoly* const x = numerator(d_.reactions, joint, Quantity::fx);
    const FactoredPoly* const y = numerator(d_.reactions, joint, Quantity::fy);
    if (x == nullptr || y == nullptr || d_.is_always_zero(joint, Quantity::fx) ||
        d_.is_always_zero(joint, Quantity::fy))
      continue;
    const auto factors_of = [&](Quantity one, Quantity other) {
      std::vector<std::size_t> list;
      for (std::size_t i = 0; i < d_.factors.size(); ++i)
        if (is_of(d_.factors[i].vanishing, joint, one) && !is_of(d_.factors[i].vanishing, joint, other))
          list.push_back(i);
      return list;
    };
    core::ForcePairs of_joint{joint, {}};
    bool is_lower = false;
    const auto add_as_it_is = [&](std::size_t i, std::size_t k) {
      for (const std::size_t a : parts_of(i, joint, Quantity::fx))
        for (const std::size_t b : parts_of(k, joint, Quantity::fy))
          of_joint.pairs.push_back({{pair_function(a), pair_function(b)}, {}, {}});
    };
    for (const std::size_t i : factors_of(Quantity::fx, Quantity::fy))
      for (const std::size_t k : factors_of(Quantity::fy, Quantity::fx)) {
        // Lower functions of what |A| holds too over the tower alone hold that again.
        if (!d_.factors[i].wanted_point || !d_.factors[k].wanted_point || cut_.contains(i) || cut_.contains(k)) {
          add_as_it_is(i, k);
          continue;
        }
        const PolyPair asked = {d_.factors[i].natural, d_.factors[k].natural};
        auto found = std::find_if(known.begin(), known.end(), [&](const auto& one) { return one.first == asked; });
        if (found == known.end()) found = known.insert(found, {asked, reduction.lowered(asked[0], asked[1], {*x, *y})});
        core::ForcePairs lower{joint, of_joint.pairs};
        const bool all_added =
            found->second && std::all_of(found->second->begin(), found->second->end(), [&](const LowerPair& pair) {
              return add_pairs(pair, {i, k}, lower);
            });
        if (all_added)
          of_joint = std::move(lower);
        else
          add_as_it_is(i, k);
        is_lower = is_lower || all_added;
      }
    if (is_lower) d_.result.problem.force_pairs.push_back(std::move(of_joint));
  }
}

}  // namespace clearloci::symbolic
