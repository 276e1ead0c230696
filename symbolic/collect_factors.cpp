#include "symbolic/collect_factors.hpp"

#include <algorithm>

#include "core/unloaded_words.hpp"

namespace clearloci::symbolic {

using core::FactorRole;
using core::Quantity;

namespace {

bool vanishes_everywhere(const FactoredPoly& p, const Elimination& elimination) {
  return p.is_zero() || std::any_of(p.factors.begin(), p.factors.end(), [&](const PolyFactor& factor) {
           return elimination.vanishes_everywhere(factor.poly);
         });
}

/// A note of the joints of which every part of the contact is zero, and one of each other reaction.
void tell_unloaded(Derivation& d, const std::vector<const Reaction*>& zero) {
  // The sheet is one side alone, and the joint may bear something on the other.
  const bool folds = !d.geometry.folds().empty();
  const auto is_zero = [&](const std::string& joint, Quantity quantity) {
    return std::any_of(zero.begin(), zero.end(), [&](const Reaction* reaction) {
      return reaction->joint == joint && reaction->quantity == quantity;
    });
  };
  std::vector<std::string> idle;
  for (const Reaction* const reaction : zero) {
    const std::string& joint = reaction->joint;
    std::vector<Quantity> contact = core::force_components(d.result.problem, joint);
    if (core::is_guide_end(reaction->quantity)) contact = {Quantity::end_ahead, Quantity::end_behind};
    const bool part = std::find(contact.begin(), contact.end(), reaction->quantity) != contact.end();
    const bool whole = std::all_of(contact.begin(), contact.end(), [&](Quantity q) { return is_zero(joint, q); });
    if (folds)
      d.result.notes.push_back(reaction->name +
                               " is zero in every pose on one side of those in which the mechanism folds, under these "
                               "loads");
    else if (!part || !whole)
      d.result.notes.push_back(reaction->name + core::unloaded_words);
    else if (std::find(idle.begin(), idle.end(), joint) == idle.end())
      idle.push_back(joint);
  }
  if (idle.empty()) return;
  d.result.notes.push_back(core::unloaded_note(idle) + (d.selection.min_force ? core::no_least_size_words : ""));
}

}  // namespace

void collect_factors(Derivation& d) {
  std::vector<const Reaction*> zero;
  for (const Reaction& reaction : d.reactions) {
    const std::string& joint = reaction.joint;
    const FactoredPoly& numerator = reaction.numerator;
    if (vanishes_everywhere(numerator, d.elimination)) {
      if (d.selected(joint) && d.is_asked_for(joint, reaction.quantity)) zero.push_back(&reaction);
      d.result.problem.always_zero.push_back({joint, reaction.quantity});
      continue;
    }
    d.result.problem.reactions.push_back({joint, reaction.quantity});
    for (const PolyFactor& factor : numerator.factors) {
      const int shared = std::min(factor.multiplicity, d.determinants.determinant.multiplicity(factor.poly));
      if (shared > 0) d.cancelled.push_back({factor.poly, {joint, reaction.quantity, shared}});
      const int multiplicity = factor.multiplicity - shared;
      if (multiplicity == 0) continue;
      auto found = std::find_if(d.factors.begin(), d.factors.end(),
                                [&](const SharedFactor& f) { return f.natural == factor.poly; });
      if (found == d.factors.end()) found = d.factors.insert(found, {factor.poly, {}});
      found->vanishing.push_back({joint, reaction.quantity, multiplicity});
    }
  }
  tell_unloaded(d, zero);
}

void take_determinant_apart(Derivation& d) {
  for (const PolyFactor& factor : d.determinants.determinant.factors) {
    std::vector<Poly> without_curves;
    std::vector<SheetFactor> sheets = d.elimination.natural_factors(factor.poly, true, &without_curves);
    d.keep_without_curves(FactorRole::direct_singularity, d.words.of(factor.poly), without_curves);
    const bool alone = sheets.size() == 1 && sheets.front().multiplicity == 1;
    const bool chosen = is_singular_by_choice(d.preload, d.mechanism, factor.poly, d.selection.controlled);
    for (SheetFactor& sheet : sheets) {
      if (sheet.of_divided) continue;
      const int times = sheet.multiplicity;
      DeterminantPart part{&factor, std::move(sheet), factor.multiplicity * times, alone, {}};
      part.chosen = chosen;
      for (const auto& [natural, vanishing] : d.cancelled)
        if (natural == factor.poly)
          part.cancelled.push_back({vanishing.joint, vanishing.quantity, vanishing.multiplicity * times});
      d.determinant_parts.push_back(std::move(part));
    }
  }
}

}  // namespace clearloci::symbolic
