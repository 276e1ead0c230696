#include "symbolic/factor_selection.hpp"

#include <algorithm>

namespace clearloci::symbolic {

using core::Quantity;
using core::Vanishing;

void FactorSelection::by_demand() {
  for (const std::string& joint : d_.result.problem.joints) {
    for (const Quantity component : core::all_quantities) {
      if (component != Quantity::f && d_.wanted(component)) want(factors_of(joint, component));
    }
    if (d_.wanted(Quantity::f)) mark_contact_loss(joint);
  }
}

std::vector<std::size_t> FactorSelection::factors_of(const std::string& joint, Quantity quantity) const {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < d_.factors.size(); ++i) {
    const auto& v = d_.factors[i].vanishing;
    if (std::any_of(v.begin(), v.end(),
                    [&](const Vanishing& w) { return w.joint == joint && w.quantity == quantity; })) {
      list.push_back(i);
    }
  }
  return list;
}

void FactorSelection::want(const std::vector<std::size_t>& list) {
  for (const std::size_t i : list) d_.factors[i].wanted_curve = true;
}

void FactorSelection::mark_contact_loss(const std::string& joint) {
  std::vector<std::vector<std::size_t>> components;
  for (const Quantity component : core::force_components(d_.result.problem, joint))
    if (!d_.is_always_zero(joint, component)) components.push_back(factors_of(joint, component));
  if (components.size() == 1) want(components.front());
  if (components.size() < 2) return;
  for (const std::size_t i : components.front()) {
    std::vector<std::size_t> sharing = {i};
    bool everywhere = true;
    for (std::size_t c = 1; c < components.size(); ++c) {
      const std::size_t before = sharing.size();
      for (const std::size_t k : components[c])
        if (i == k || (!never_both(i, k) && may_share_curve(i, k))) sharing.push_back(k);
      everywhere = everywhere && sharing.size() > before;
    }
    if (everywhere) want(sharing);
  }
  mark_points(components, 0, {});
}

void FactorSelection::mark_points(const std::vector<std::vector<std::size_t>>& components, std::size_t next,
                                  const std::vector<std::size_t>& chosen) {
  if (next == components.size()) {
    if (chosen.size() > 1)
      for (const std::size_t i : chosen) d_.factors[i].wanted_point = true;
    return;
  }
  const std::vector<std::size_t>& component = components[next];
  const auto in = [](const std::vector<std::size_t>& list, std::size_t i) {
    return std::find(list.begin(), list.end(), i) != list.end();
  };
  // Where a factor of several components vanishes the others need no zero of their own.
  if (std::any_of(chosen.begin(), chosen.end(), [&](std::size_t k) { return in(component, k); }))
    return mark_points(components, next + 1, chosen);
  for (const std::size_t i : component) {
    // Where a factor of all of them vanishes there is a curve of contact loss anyway.
    const bool is_possible = std::none_of(chosen.begin(), chosen.end(),
                                          [&](std::size_t k) { return never_both(k, i) || meet_nowhere(k, i); });
    const bool is_curve =
        std::all_of(components.begin(), components.end(), [&](const auto& list) { return in(list, i); });
    if (!is_possible || is_curve) continue;
    std::vector<std::size_t> more = chosen;
    more.push_back(i);
    mark_points(components, next + 1, more);
  }
}

bool FactorSelection::never_both(std::size_t i, std::size_t k) {
  const auto [found, fresh] = never_both_.try_emplace({i, k}, false);
  if (!fresh) return found->second;
  const Poly &a = d_.factors[i].natural, &b = d_.factors[k].natural;
  if (a.total_degree() > 1 || b.total_degree() > 1) return false;
  if (d_.elimination.are_components_of_link(a, b)) return found->second = true;
  const Poly squared = a * a + b * b;
  if (!shared_.may_be_constant(squared)) return false;
  const std::optional<core::Rational> length2 = d_.elimination.constant_over_tower(squared);
  return found->second = length2 && *length2 != 0;
}

bool FactorSelection::may_share_curve(std::size_t i, std::size_t k) {
  const auto [found, fresh] = may_share_.try_emplace({i, k}, false);
  // Curves are told to be the same by their polynomials: where one is too large to be had, norms say nothing of use.
  if (fresh && !is_heavy(i) && !is_heavy(k)) found->second = Elimination::may_share_curve(on_line(i), on_line(k));
  return found->second;
}

bool FactorSelection::meet_nowhere(std::size_t i, std::size_t k) {
  return d_.geometry.coordinates() == 1 && !d_.elimination.has_angle_over_tower(d_.factors[i].natural) &&
         !d_.elimination.has_angle_over_tower(d_.factors[k].natural) &&
         !Elimination::may_share_curve(on_line(i), on_line(k));
}

bool FactorSelection::is_heavy(std::size_t factor) {
  const auto [found, fresh] = heavy_.try_emplace(factor, false);
  if (fresh) found->second = d_.elimination.is_too_heavy_over_tower(d_.factors[factor].natural);
  return found->second;
}

const ResiduePoly& FactorSelection::on_line(std::size_t factor) {
  const auto found = on_line_.find(factor);
  if (found != on_line_.end()) return found->second;
  return on_line_.emplace(factor, d_.elimination.norm_on_line(d_.factors[factor].natural)).first->second;
}

void FactorSelection::by_order() {
  for (DeterminantPart& part : d_.determinant_parts) {
    if (part.sheet.too_heavy) continue;
    std::vector<std::size_t> involved;
    for (std::size_t i = 0; i < d_.factors.size(); ++i)
      if (shared_.may_vanish_along(part.sheet.implicit, part.sheet.sheet, d_.factors[i].natural)) involved.push_back(i);
    const auto among = [](const std::vector<Vanishing>& list, const Vanishing& reaction) {
      return std::any_of(list.begin(), list.end(), [&](const Vanishing& v) {
        return v.joint == reaction.joint && v.quantity == reaction.quantity;
      });
    };
    const auto is_finite_perhaps = [&](const Vanishing& reaction) {
      return among(part.cancelled, reaction) || std::any_of(involved.begin(), involved.end(), [&](std::size_t i) {
               return among(d_.factors[i].vanishing, reaction);
             });
    };
    const auto& all = d_.result.problem.reactions;
    part.may_be_idle = std::all_of(all.begin(), all.end(), [&](const Vanishing& reaction) {
      return core::is_guide_end(reaction.quantity) || is_finite_perhaps(reaction);  // ends are made of N and T
    });
    for (const std::size_t i : involved) {
      const auto& vanishing = d_.factors[i].vanishing;
      d_.factors[i].wanted_order = d_.factors[i].wanted_order || part.may_be_idle ||
                                   std::any_of(vanishing.begin(), vanishing.end(), [&](const Vanishing& v) {
                                     return d_.selected(v.joint) && d_.is_asked_for(v.joint, v.quantity);
                                   });
    }
  }
}

}  // namespace clearloci::symbolic
