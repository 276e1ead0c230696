#include <algorithm>

#include "symbolic/factor_emission.hpp"
#include "symbolic/force_pairs.hpp"

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
  const Poly& sheet = d_.elimination.over_tower(natural);
  if (sheet.is_zero()) return nullptr;
  std::vector<std::size_t> places;
  const std::vector<SheetFactor> parts = d_.elimination.sheet_factors(sheet, false);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    LocusFactor function;
    function.sheet = core::scaled_for_doubles(parts[p].sheet.plain(d_.geometry.tower_variables()));
    function.line = line_of(natural, parts, p);
    places.push_back(d_.result.problem.pair_functions.size());
    d_.result.problem.pair_functions.push_back(std::move(function));
  }
  return &pair_functions_of_natural_.emplace_back(natural, std::move(places)).second;
}

bool FactorEmission::add_pairs(const Poly& first, const Poly& second, core::ForcePairs& of_joint) {
  const std::vector<std::size_t>* const a = pair_functions(first);
  const std::vector<std::size_t>* const b = pair_functions(second);
  if (a == nullptr || b == nullptr) return false;
  const auto& functions = d_.result.problem.pair_functions;
  std::vector<std::array<std::size_t, 2>> pairs;
  for (const std::size_t i : *a)
    for (const std::size_t k : *b) {
      if (functions[i].sheet == functions[k].sheet) return false;
      pairs.push_back({i, k});
    }
  // The first one is that of which touches are told: a linear one seldom has a double zero.
  for (const auto& [i, k] : pairs) {
    const bool known = std::any_of(of_joint.pairs.begin(), of_joint.pairs.end(), [i = i, k = k](const auto& other) {
      return other == std::array{i, k} || other == std::array{k, i};
    });
    if (!known) of_joint.pairs.push_back({i, k});
  }
  return true;
}

void FactorEmission::force_pairs() {
  if (!d_.wanted(Quantity::f) || !d_.preload.joints.empty() || d_.geometry.coordinates() != 2 ||
      d_.mechanism.space != mechanism::Space::planar)
    return;
  PairReduction reduction(d_.geometry, d_.elimination, d_.determinants.determinant);
  std::vector<std::pair<PolyPair, std::optional<std::vector<PolyPair>>>> known;
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
      for (std::size_t a = ranges_[i][0]; a < ranges_[i][1]; ++a)
        for (std::size_t b = ranges_[k][0]; b < ranges_[k][1]; ++b) {
          const auto& factors = d_.result.problem.factors;
          if (!is_of(factors[a].vanishing, joint, Quantity::fx) || !is_of(factors[b].vanishing, joint, Quantity::fy))
            continue;
          of_joint.pairs.push_back({pair_function(a), pair_function(b)});
        }
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
            found->second && std::all_of(found->second->begin(), found->second->end(),
                                         [&](const PolyPair& pair) { return add_pairs(pair[0], pair[1], lower); });
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
