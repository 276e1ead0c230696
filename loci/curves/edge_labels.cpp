#include "loci/curves/edge_labels.hpp"

#include <algorithm>
#include <functional>

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusKind;
using core::LocusProblem;
using core::Quantity;
using core::Vanishing;

template <class T>
bool contains(const std::vector<T>& list, const T& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

/// Sums the multiplicities of components that several factors make vanish.
void merge(std::vector<Vanishing>& components, const std::vector<Vanishing>& more) {
  for (const Vanishing& v : more) {
    const auto found = std::find_if(components.begin(), components.end(),
                                    [&](const Vanishing& w) { return w.joint == v.joint && w.quantity == v.quantity; });
    if (found == components.end())
      components.push_back(v);
    else
      found->multiplicity += v.multiplicity;
  }
}

void append(std::string& list, const std::string& item) {
  if (item.empty()) return;
  if (!list.empty()) list += "; ";
  list += item;
}

}  // namespace

LocusKind gravest_kind(const std::vector<Vanishing>& vanishing) {
  LocusKind kind = LocusKind::component;
  for (const Vanishing& v : vanishing) {
    const Quantity q = v.quantity;
    if (q == Quantity::f || core::is_guide_end(q)) kind = std::min(kind, LocusKind::contact_loss);
    if (q == Quantity::M || q == Quantity::F) kind = std::min(kind, LocusKind::backlash);
  }
  return kind;
}

bool cuts_workspace(LocusKind kind) { return kind != LocusKind::component; }

std::vector<Vanishing> wanted_vanishing(const LocusProblem& problem, const std::vector<Vanishing>& components) {
  const auto multiplicity = [&](const std::string& joint, Quantity quantity) {
    for (const Vanishing& v : components) {
      if (v.joint == joint && v.quantity == quantity) return v.multiplicity;
    }
    return 0;
  };
  const auto always = [&](const std::string& joint, Quantity quantity) {
    return std::any_of(problem.always_zero.begin(), problem.always_zero.end(),
                       [&](const Vanishing& v) { return v.joint == joint && v.quantity == quantity; });
  };
  const auto wanted = [&](Quantity quantity) {
    return std::find(problem.quantities.begin(), problem.quantities.end(), quantity) != problem.quantities.end();
  };
  std::vector<Vanishing> forces, couples, single;
  bool any = false;
  const auto take = [&](std::vector<Vanishing>& list, const std::string& joint, Quantity quantity, int times) {
    list.push_back({joint, quantity, times});
    any = any || (wanted(quantity) && contains(problem.joints, joint));
  };
  for (const std::string& joint : problem.joint_order) {
    const std::vector<Quantity> components_of_f = core::force_components(problem, joint);
    int least = 0, most = 0;
    bool all_zero = !components_of_f.empty();
    for (const Quantity component : components_of_f) {
      const int times = multiplicity(joint, component);
      if (times == 0 && !always(joint, component)) all_zero = false;
      if (times > 0) least = least == 0 ? times : std::min(least, times);
      most = std::max(most, times);
    }
    if (all_zero && most > 0) take(forces, joint, Quantity::f, least);
    // Components are named where they vanish alone, or more often than the force they belong to.
    const bool together = all_zero && least == most;
    for (const Quantity component :
         {Quantity::N, Quantity::T, Quantity::fx, Quantity::fy, Quantity::fz, Quantity::f1, Quantity::f2, Quantity::mx,
          Quantity::my, Quantity::mz, Quantity::m1, Quantity::m2}) {
      const int times = multiplicity(joint, component);
      const bool part = contains(components_of_f, component);
      if (times == 0 || !wanted(component)) continue;
      if (part && together)
        any = any || contains(problem.joints, joint);
      else
        take(single, joint, component, times);
    }
    for (const Quantity quantity : {Quantity::end_ahead, Quantity::end_behind})
      if (const int times = multiplicity(joint, quantity); times > 0) take(forces, joint, quantity, times);
    for (const Quantity quantity : {Quantity::M, Quantity::F})
      if (const int times = multiplicity(joint, quantity); times > 0) take(couples, joint, quantity, times);
  }
  if (!any) return {};
  forces.insert(forces.end(), couples.begin(), couples.end());
  forces.insert(forces.end(), single.begin(), single.end());
  return forces;
}

EdgeLabel reaction_label(const LocusProblem& problem, const std::vector<const core::LocusFactor*>& factors) {
  EdgeLabel label;
  std::vector<Vanishing> components;
  for (const core::LocusFactor* factor : factors) {
    merge(components, factor->vanishing);
    append(label.factor, factor->expression);
    append(label.cause, factor->cause);
  }
  label.vanishing = wanted_vanishing(problem, components);
  label.kind = gravest_kind(label.vanishing);
  return label;
}

EdgeLabel reaction_label(const LocusProblem& problem, const ReactionOrders& orders) {
  EdgeLabel label;
  for (const int f : orders.vanishes) {
    const core::LocusFactor& factor = problem.factors[static_cast<std::size_t>(f)];
    if (factor.role != FactorRole::reaction) continue;
    append(label.factor, factor.expression);
    append(label.cause, factor.cause);
  }
  label.vanishing = wanted_vanishing(problem, orders.vanishing);
  label.kind = gravest_kind(label.vanishing);
  return label;
}

bool shares_curve(const core::LocusFactor& a, const core::LocusFactor& b) {
  return std::any_of(a.implicit.begin(), a.implicit.end(), [&](const core::Polynomial& p) {
    return std::find(b.implicit.begin(), b.implicit.end(), p) != b.implicit.end();
  });
}

EdgeLabel label_of(const LocusProblem& problem, const std::vector<int>& factors) {
  const core::LocusFactor& first = problem.factors[static_cast<std::size_t>(factors.front())];
  switch (first.role) {
    case FactorRole::margin:
      return {LocusKind::margin, first.vanishing, first.expression, first.cause};
    case FactorRole::preload:
      return {LocusKind::preload, first.vanishing, first.expression, first.cause};
    case FactorRole::direct_singularity:
      return {LocusKind::direct_singularity, {}, first.expression, first.cause};
    case FactorRole::workspace_boundary:
      return {LocusKind::workspace_boundary, {}, first.expression, first.cause};
    default:
      break;
  }
  std::vector<const core::LocusFactor*> all;
  for (const int f : factors) all.push_back(&problem.factors[static_cast<std::size_t>(f)]);
  return reaction_label(problem, all);
}

EdgeLabel widest_label(const LocusProblem& problem, std::size_t f) {
  const core::LocusFactor& factor = problem.factors[f];
  std::vector<int> together = {static_cast<int>(f)};
  for (std::size_t k = 0; factor.role == FactorRole::reaction && k < problem.factors.size(); ++k) {
    const core::LocusFactor& other = problem.factors[k];
    if (k != f && other.role == FactorRole::reaction && shares_curve(factor, other))
      together.push_back(static_cast<int>(k));
  }
  EdgeLabel label = label_of(problem, {static_cast<int>(f)});
  return label.vanishing.empty() && together.size() > 1 ? label_of(problem, together) : label;
}

namespace {

/// An edge's points are in general position for all but a few polynomials: another one is tried where one of these
/// vanishes there.
constexpr int attempts = 4;

/// The orders along an edge of the arrangement.
ReactionOrders orders_along(const LocusProblem& problem, const core::WorkingMode& mode,
                            const CurveArrangement& arrangement, int edge, const std::shared_ptr<CurveAlgebra>& algebra,
                            const std::function<void(ArcOrders&)>& look) {
  const auto curve = static_cast<std::size_t>(arrangement.edges()[static_cast<std::size_t>(edge)].curve);
  const core::Polynomial& polynomial = arrangement.curves()[curve];
  ReactionOrders orders;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const PointEnclosure at = arrangement.sample(edge, attempt);
    ArcOrders arc(problem.tower, mode, algebra, {{at.lower[0], at.upper[0]}, {at.lower[1], at.upper[1]}});
    orders = reaction_orders(problem, arc, factors_on(problem, polynomial));
    if (!orders.decided) continue;
    look(arc);
    break;
  }
  return orders;
}

}  // namespace

std::vector<EdgeInMode> label_edges(const LocusProblem& problem, const core::WorkingMode& mode,
                                    const CurveArrangement& arrangement,
                                    const std::vector<std::vector<int>>& curves_of_factor, SheetSigns& signs,
                                    const std::vector<int>& sheet_of_factor) {
  std::vector<EdgeInMode> result(arrangement.edges().size());
  std::vector<std::shared_ptr<CurveAlgebra>> algebra;  // of every curve
  for (const core::Polynomial& curve : arrangement.curves())
    algebra.push_back(std::make_shared<CurveAlgebra>(problem.tower, curve));
  for (std::size_t e = 0; e < result.size(); ++e) {
    EdgeInMode& edge = result[e];
    const int index = static_cast<int>(e);
    edge.in_workspace = edge.interior = true;
    for (std::size_t j = 0; j < problem.tower.roots.size() && edge.in_workspace; ++j) {
      const std::optional<int> sign = signs.square_sign(static_cast<int>(j), mode, index);
      edge.decided = edge.decided && sign;
      if (!sign || *sign < 0) edge.in_workspace = false;
      if (!sign || *sign <= 0) edge.interior = false;
    }
    if (!edge.in_workspace) continue;
    std::vector<const core::LocusFactor*> vanishing, reactions;
    bool singular = false, idle = false;
    for (std::size_t f = 0; f < problem.factors.size(); ++f) {
      const core::LocusFactor& factor = problem.factors[f];
      const auto& curves = curves_of_factor[f];
      if (std::find(curves.begin(), curves.end(), arrangement.edges()[e].curve) == curves.end()) continue;
      if (factor.role == FactorRole::construction) continue;
      const std::optional<int> sign = signs.sign(sheet_of_factor[f], mode, index);
      edge.decided = edge.decided && sign;
      if (sign != std::optional<int>(0)) continue;
      (factor.role == FactorRole::reaction ? reactions : vanishing).push_back(&factor);
      singular = singular || factor.role == FactorRole::direct_singularity;
      idle = idle || factor.may_be_idle;
    }
    // Where |A| does not vanish every factor counts once; on the boundary orders are those in the root.
    std::map<const core::LocusFactor*, std::optional<bool>> margin;
    ReactionOrders orders;
    const bool margins = std::any_of(vanishing.begin(), vanishing.end(), [](const core::LocusFactor* factor) {
      return factor->role == FactorRole::margin;
    });
    const bool compared = (singular && (idle || margins)) || ((singular || !edge.interior) && !reactions.empty());
    if (compared)
      orders = orders_along(problem, mode, arrangement, index,
                            algebra[static_cast<std::size_t>(arrangement.edges()[e].curve)], [&](ArcOrders& arc) {
                              for (const core::LocusFactor* factor : vanishing)
                                if (factor->role == FactorRole::margin) margin[factor] = is_margin(*factor, arc);
                            });
    // Along |A| = 0 a reaction need not vanish where its numerator does: nothing is claimed without orders.
    const bool is_unknown = compared && singular && !orders.decided;
    const auto is_open_margin = [&](const core::LocusFactor* factor) {
      return is_unknown || (margin.contains(factor) && !margin.at(factor));
    };
    if (is_unknown || std::any_of(vanishing.begin(), vanishing.end(), is_open_margin)) edge.decided = false;
    for (const core::LocusFactor* factor : vanishing) {
      if (factor->role == FactorRole::margin && !is_open_margin(factor) &&
          !(margin.contains(factor) && margin.at(factor) == false))
        edge.labels.push_back({LocusKind::margin, factor->vanishing, factor->expression, factor->cause});
      if (factor->role == FactorRole::preload)
        edge.labels.push_back({LocusKind::preload, factor->vanishing, factor->expression, factor->cause});
      if (factor->role == FactorRole::direct_singularity)
        edge.labels.push_back({LocusKind::direct_singularity,
                               {},
                               factor->expression,
                               factor->cause,
                               !factor->may_be_idle || !orders.decided || orders.excited});
      if (factor->role == FactorRole::workspace_boundary)
        edge.labels.push_back({LocusKind::workspace_boundary, {}, factor->expression, factor->cause});
    }
    if (is_unknown) continue;
    EdgeLabel label = compared && orders.decided ? reaction_label(problem, orders) : reaction_label(problem, reactions);
    label.proven = !compared || orders.decided;
    if (!label.vanishing.empty()) edge.labels.push_back(std::move(label));
  }
  return result;
}

}  // namespace clearloci::loci
