#include "symbolic/factor_emission.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/append_roots.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/known_lines.hpp"

namespace clearloci::symbolic {

using core::FactorRole;
using core::LocusFactor;
using core::Quantity;
using core::Vanishing;

namespace {

/// Numbers n with n . f = 0 in every pose, by the coefficients of the numerators: where all moves and is loaded in one
/// plane, n is across it.
std::optional<std::array<core::Rational, 3>> constant_normal(const Ring& ring, const std::vector<Reaction>& reactions,
                                                             const std::string& joint) {
  std::vector<FactoredPoly> force;
  for (const Quantity part : {Quantity::fx, Quantity::fy, Quantity::fz})
    for (const Reaction& reaction : reactions)
      if (reaction.joint == joint && reaction.quantity == part && !reaction.numerator.is_zero())
        force.push_back(reaction.numerator);
  const auto terms_of = [](const FactoredPoly& product) {
    double terms = 1;
    for (const PolyFactor& factor : product.factors)
      terms *= std::pow(static_cast<double>(factor.poly.plain().terms.size()), factor.multiplicity);
    return terms;
  };
  constexpr double most_terms = 5000;  // before they are multiplied out
  if (force.size() != 3 ||
      std::any_of(force.begin(), force.end(), [&](const FactoredPoly& part) { return terms_of(part) > most_terms; }))
    return std::nullopt;
  std::map<std::vector<int>, std::array<core::Rational, 3>> coefficients;
  const FactoredPoly shared = shared_factors(force);
  for (std::size_t c = 0; c < 3; ++c)
    for (const core::Term& term : without(force[c], shared, ring).plain().terms)
      coefficients[term.exponents][c] = term.coefficient;
  std::vector<std::array<core::Rational, 3>> across = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& coefficient : coefficients) {
    const std::array<core::Rational, 3>& row = coefficient.second;
    const auto along = [&row](const std::array<core::Rational, 3>& n) -> core::Rational {
      return n[0] * row[0] + n[1] * row[1] + n[2] * row[2];
    };
    const auto pivot = std::find_if(across.begin(), across.end(), [&](const auto& n) { return along(n) != 0; });
    if (pivot == across.end()) continue;
    const std::array<core::Rational, 3> taken = *pivot;
    across.erase(pivot);
    if (across.empty()) return std::nullopt;
    for (std::array<core::Rational, 3>& n : across) {
      const core::Rational times = along(n) / along(taken);
      for (std::size_t c = 0; c < 3; ++c) n[c] -= times * taken[c];
    }
  }
  return across.front();
}

}  // namespace

void FactorEmission::add(FactorRole role, const Poly* natural, const Poly& sheet, bool with_implicit,
                         LocusFactor common) {
  common.role = role;
  add_parts(natural, d_.elimination.sheet_factors(sheet, with_implicit), common);
}

void FactorEmission::add_parts(const Poly* natural, const std::vector<SheetFactor>& parts, const LocusFactor& common) {
  const FactorRole role = common.role;
  const std::vector<int> variables = d_.geometry.tower_variables();
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const SheetFactor& part = parts[p];
    if (part.of_divided) continue;
    LocusFactor factor = common;
    if (natural != nullptr) factor.line = line_of(*natural, parts, p);
    for (Vanishing& v : factor.vanishing) v.multiplicity *= part.multiplicity;
    if (role == FactorRole::reaction) {
      const std::vector<Vanishing> natural_vanishing = factor.vanishing;
      factor.vanishing = without_determinant(part.sheet, std::move(factor.vanishing));
      is_cut_ = is_cut_ || factor.vanishing != natural_vanishing;
      if (factor.vanishing.empty()) continue;
    }
    factor.sheet = core::scaled_for_doubles(part.sheet.plain(variables));
    put_implicit(part, factor);
    d_.result.problem.factors.push_back(std::move(factor));
  }
}

core::StraightLine FactorEmission::line_of(const Poly& natural, const std::vector<SheetFactor>& parts,
                                           std::size_t part) {
  if (parts[part].multiplicity != 1) return {};
  if (parts.size() == 1) return d_.lines.of(natural);
  // Where the sheet splits, the natural form has the zeros of all parts.
  if (parts.size() != 2) return {};
  const SheetFactor& other = parts[1 - part];
  return fold_quotients_.of(natural, {other.sheet, other.multiplicity});
}

void FactorEmission::put_implicit(const SheetFactor& part, LocusFactor& factor) const {
  const std::vector<int> variables = d_.geometry.tower_variables();
  const std::vector<int> free(variables.begin(), variables.begin() + d_.geometry.coordinates());
  for (const Poly& curve : part.implicit) factor.implicit.push_back(curve.plain(free));
  factor.implicit_too_heavy = factor.implicit_too_heavy || part.too_heavy;
}

std::vector<Vanishing> FactorEmission::without_determinant(const Poly& sheet, std::vector<Vanishing> vanishing) {
  for (DeterminantPart& part : d_.determinant_parts) {
    if (!(part.sheet.sheet == sheet)) continue;
    for (Vanishing& v : vanishing) {
      auto found = std::find_if(part.cancelled.begin(), part.cancelled.end(), [&](const Vanishing& candidate) {
        return candidate.joint == v.joint && candidate.quantity == v.quantity;
      });
      if (found == part.cancelled.end()) found = part.cancelled.insert(found, {v.joint, v.quantity, 0});
      const int shared = std::min(v.multiplicity, part.multiplicity - found->multiplicity);
      found->multiplicity += shared;
      v.multiplicity -= shared;
      if (found->multiplicity == 0) part.cancelled.erase(found);
    }
  }
  std::erase_if(vanishing, [](const Vanishing& v) { return v.multiplicity == 0; });
  return vanishing;
}

void FactorEmission::reactions() {
  for (const SharedFactor& shared : d_.factors) {
    const std::size_t first = d_.result.problem.factors.size();
    ranges_.push_back({first, first});
    is_cut_ = false;
    LocusFactor factor;
    if (!shared.wanted_curve && !shared.wanted_point && !shared.wanted_order) {
      const bool asked_for = std::any_of(shared.vanishing.begin(), shared.vanishing.end(), [&](const Vanishing& v) {
        return d_.selected(v.joint) && d_.is_asked_for(v.joint, v.quantity);
      });
      if (!asked_for || d_.result.problem.tower.coordinates.size() != 2) continue;
      factor.expression = d_.words.of(shared.natural);
      add_rest(shared.natural, std::move(factor));
      continue;
    }
    factor.expression = d_.words.of(shared.natural);
    factor.cause = d_.causes.of(shared.natural);
    factor.vanishing = shared.vanishing;
    factor.role = FactorRole::reaction;
    std::vector<Poly> without_curves;
    const std::vector<SheetFactor> parts =
        d_.elimination.natural_factors(shared.natural, shared.wanted_curve, &without_curves);
    d_.keep_without_curves(factor.role, factor.expression, without_curves);
    add_parts(&shared.natural, parts, factor);
    ranges_.back()[1] = d_.result.problem.factors.size();
    if (is_cut_) cut_.insert(ranges_.size() - 1);
  }
}

void FactorEmission::add_rest(const Poly& natural, LocusFactor factor) {
  const std::vector<SheetFactor> parts = d_.elimination.divided_roots().empty()
                                             ? std::vector<SheetFactor>{}
                                             : d_.elimination.natural_factors(natural, false);
  if (std::none_of(parts.begin(), parts.end(), [](const SheetFactor& part) { return part.of_divided; })) {
    factor.line = d_.lines.of(natural);
    d_.result.rest.push_back(std::move(factor));
    return;
  }
  for (const SheetFactor& part : parts) {
    if (part.of_divided) continue;
    factor.line = d_.lines.over_roots(part.sheet);
    d_.result.rest.push_back(factor);
  }
}

bool FactorEmission::is_inverse_length(const Poly& p) const {
  const std::vector<InverseLength>& all = d_.geometry.inverse_lengths();
  return std::any_of(all.begin(), all.end(), [&](const InverseLength& length) {
    return length.variable >= 0 && p == Poly::variable(d_.geometry.ring(), length.variable);
  });
}

void FactorEmission::drop_known(std::size_t first) {
  std::vector<LocusFactor>& factors = d_.result.problem.factors;
  const auto is_known = [&](const LocusFactor& factor) {
    const bool singular =
        std::any_of(d_.determinant_parts.begin(), d_.determinant_parts.end(), [&](const DeterminantPart& part) {
          return !part.chosen &&
                 core::scaled_for_doubles(part.sheet.sheet.plain(d_.geometry.tower_variables())) == factor.sheet;
        });
    return singular ||
           std::any_of(
               factors.begin(), factors.begin() + static_cast<std::ptrdiff_t>(first), [&](const LocusFactor& other) {
                 return other.role == FactorRole::reaction && other.sheet == factor.sheet && !other.implicit.empty();
               });
  };
  factors.erase(std::remove_if(factors.begin() + static_cast<std::ptrdiff_t>(first), factors.end(), is_known),
                factors.end());
}

void FactorEmission::preload() {
  std::vector<std::string>& notes = d_.result.notes;
  notes.insert(notes.end(), d_.preload.notes.begin(), d_.preload.notes.end());
  if (!d_.preload.joints.empty() &&
      (d_.selection.min_force || (d_.selection.min_couple && d_.mechanism.space == mechanism::Space::spatial)))
    notes.emplace_back(
        "with free efforts no curves are traced on which the force of a pin or at an end of a guide, or in space a "
        "couple, has its least size: "
        "the efforts of a zone are those at its sample");
  if (!d_.preload.joints.empty() &&
      std::any_of(d_.mechanism.joints.begin(), d_.mechanism.joints.end(),
                  [](const mechanism::Joint& joint) { return joint.meshing.has_value(); }))
    notes.emplace_back("flanks of gears and spans of belts bound no preload here");
  const std::size_t efforts = d_.preload.joints.size();
  const std::string motors = d_.preload.motors(d_.mechanism);
  const PreloadDeterminants all =
      preload_determinants(d_.geometry.ring(), d_.determinants.determinant, efforts,
                           preload_constraints(d_.geometry, d_.elimination, d_.preload, d_.determinants.determinant,
                                               d_.result.problem, d_.selection, notes));
  for (const std::string& names : all.left_out)
    notes.push_back("where " + names + " vanish together is too long a determinant to be derived");
  for (const PreloadFactor& preload_factor : all.factors) {
    const Poly sheet = d_.elimination.over_tower(preload_factor.natural);
    if (sheet.is_zero() || is_inverse_length(preload_factor.natural)) continue;
    LocusFactor factor;
    factor.expression = d_.words.of(preload_factor.natural);
    for (const PreloadEvent& event : preload_factor.events) {
      factor.cause += (factor.cause.empty() ? "" : "; ") + words_of(event, motors, efforts);
      for (const std::vector<Vanishing>* list : {&event.vanishing, &event.bounded})
        for (const Vanishing& one : *list)
          if (std::find(factor.vanishing.begin(), factor.vanishing.end(), one) == factor.vanishing.end())
            factor.vanishing.push_back(one);
    }
    const std::size_t before = d_.result.problem.factors.size();
    add(FactorRole::preload, &preload_factor.natural, sheet, true, factor);
    drop_known(before);
  }
}

bool FactorEmission::is_passed_by_tensions(const DeterminantPart& part) const {
  return part.chosen &&
         std::all_of(d_.preload.joints.begin(), d_.preload.joints.end(), [&](mechanism::JointIndex joint) {
           return mechanism::is_cable(d_.mechanism.joints[static_cast<std::size_t>(joint)]);
         });
}

void FactorEmission::name_motors(LocusFactor& factor) const {
  for (const mechanism::JointIndex joint : d_.preload.joints) {
    const mechanism::Joint& joint_data = d_.mechanism.joints[static_cast<std::size_t>(joint)];
    factor.vanishing.push_back({joint_data.name, mechanism::actuator_quantity(joint_data), 1});
  }
  factor.cause += (factor.cause.empty() ? "" : "; ") + std::string("singular with a constant effort of ") +
                  d_.preload.motors(d_.mechanism);
}

void FactorEmission::direct_singularities() {
  const std::vector<int> variables = d_.geometry.tower_variables();
  for (const DeterminantPart& part : d_.determinant_parts) {
    if (is_passed_by_tensions(part)) continue;
    LocusFactor factor;
    factor.role = part.chosen ? FactorRole::preload : FactorRole::direct_singularity;
    factor.expression = d_.words.of(part.natural->poly);
    factor.cause = d_.causes.of_determinant(part.natural->poly);
    if (part.chosen) name_motors(factor);
    factor.sheet = core::scaled_for_doubles(part.sheet.sheet.plain(variables));
    put_implicit(part.sheet, factor);
    if (part.alone) factor.line = d_.lines.of(part.natural->poly);
    factor.multiplicity = part.multiplicity;
    factor.cancelled = part.cancelled;
    factor.may_be_idle = part.may_be_idle;
    d_.result.problem.factors.push_back(std::move(factor));
  }
}

int FactorEmission::order_along(const FactoredPoly& product, const DividedRoot& divided) const {
  int order = 0;
  for (const PolyFactor& factor : product.factors)
    order += factor.multiplicity * d_.elimination.order_along(factor.poly, divided);
  return order;
}

int FactorEmission::order_of_axis(const mechanism::Joint& joint, const DividedRoot& divided) const {
  if (joint.axes.empty()) return 0;
  return d_.elimination.order_along(squared_axis(d_.geometry, joint), divided) / 2;
}

int FactorEmission::order_along(const Reaction& reaction, const DividedRoot& divided) const {
  const int order = order_along(reaction.numerator, divided);
  const auto joint = std::find_if(d_.mechanism.joints.begin(), d_.mechanism.joints.end(),
                                  [&](const mechanism::Joint& candidate) { return candidate.name == reaction.joint; });
  const auto guide = std::find_if(d_.guides.begin(), d_.guides.end(),
                                  [&](const Guide& candidate) { return candidate.joint == reaction.joint; });
  if (core::is_guide_end(reaction.quantity) && guide != d_.guides.end()) {
    if (guide->length || guide->bears.is_zero()) return order;
    const int axis = order_of_axis(*joint, divided);
    if (guide->turns.is_zero()) return order + axis;
    // What the two summands do not share is no factor of the numerator.
    return order + std::min(d_.elimination.order_along(guide->bears, divided) + axis,
                            d_.elimination.order_along(guide->turns, divided));
  }
  const bool actuator = joint->actuated && reaction.quantity == mechanism::actuator_quantity(*joint);
  if (is_force_over_axis(d_.mechanism, *joint))
    return reaction.quantity == Quantity::N || reaction.quantity == Quantity::F ? order + order_of_axis(*joint, divided)
                                                                                : order;
  // In space the force or couple of an actuator is what the joint bears, times the axis as it is written.
  return actuator ? order - order_of_axis(*joint, divided) : order;
}

void FactorEmission::along_divided_roots() {
  for (const DividedRoot& divided : d_.elimination.divided_roots()) {
    const TowerRoot& root = d_.geometry.roots()[divided.root];
    LocusFactor singular = stretched(root);
    singular.sheet = core::scaled_for_doubles(
        Poly::variable(d_.geometry.ring(), root.variable).plain(d_.geometry.tower_variables()));
    put_implicit({divided.divisor, 1, d_.elimination.implicit_of_divisor(divided.divisor)}, singular);
    LocusFactor reaction = singular;
    const int below = order_along(d_.determinants.determinant, divided);
    int with_axes = below;  // columns of |A| are written over the lengths of their axes
    for (const mechanism::Unknown& unknown : d_.determinants.equations.unknowns) {
      const mechanism::Joint& joint = d_.mechanism.joints[static_cast<std::size_t>(unknown.joint)];
      if (is_force_over_axis(d_.mechanism, joint) &&
          (unknown.quantity == Quantity::N || unknown.quantity == Quantity::F))
        with_axes -= order_of_axis(joint, divided);
    }
    for (const Reaction& one : d_.reactions) {
      if (d_.is_always_zero(one.joint, one.quantity)) continue;
      const int order = order_along(one, divided) - below;
      if (order > 0) reaction.vanishing.push_back({one.joint, one.quantity, order});
      if (const int shared = std::min(order + with_axes, with_axes); shared > 0)
        singular.cancelled.push_back({one.joint, one.quantity, shared});
    }
    const bool wanted = std::any_of(reaction.vanishing.begin(), reaction.vanishing.end(), [&](const Vanishing& v) {
      return d_.selected(v.joint) && d_.is_asked_for(v.joint, v.quantity);
    });
    reaction.role = FactorRole::reaction;
    if (wanted) d_.result.problem.factors.push_back(std::move(reaction));
    singular.role = FactorRole::direct_singularity;
    singular.multiplicity = with_axes;
    if (with_axes > 0) d_.result.problem.factors.push_back(std::move(singular));
  }
}

void FactorEmission::undirected() {
  for (const mechanism::Joint& joint : d_.mechanism.joints) {
    if (!mechanism::presses_across_axis(d_.mechanism, joint) || !d_.selected(joint.name)) continue;
    GiNaC::ex where;
    if (has_pressing_parts(d_.mechanism, joint)) {
      where = across_pin(d_.geometry, joint).squared;
    } else {
      const std::vector<GiNaC::ex> u = d_.geometry.vector(joint.axes.at(0));
      where = u[across_component(d_.geometry, u)];
    }
    const Poly natural = d_.geometry.poly(where);
    const Poly sheet = d_.elimination.over_tower(natural);
    if (sheet.is_constant()) continue;
    LocusFactor factor;
    factor.role = FactorRole::construction;
    factor.vanishing = {{joint.name, Quantity::f, 1}};
    factor.sheet = core::scaled_for_doubles(sheet.plain(d_.geometry.tower_variables()));
    factor.line = d_.lines.of(natural);
    d_.result.problem.factors.push_back(std::move(factor));
  }
}

void FactorEmission::force_planes() {
  if (!d_.wanted(Quantity::f) || d_.result.problem.tower.coordinates.size() < 2) return;
  for (const mechanism::Joint& joint : d_.mechanism.joints) {
    if (!d_.selected(joint.name) || core::force_components(d_.result.problem, joint.name).size() != 3) continue;
    std::vector<GiNaC::ex> normal;
    if (const auto known = mechanism::normal_of_force(d_.mechanism, joint))
      normal = d_.geometry.vector(*known);
    else if (const auto constant = constant_normal(d_.geometry.ring(), d_.reactions, joint.name))
      for (const core::Rational& part : *constant)
        normal.push_back(d_.geometry.expression(core::Expression::number(part)));
    if (normal.empty()) continue;
    core::ForcePlane plane{joint.name, {}};
    for (std::size_t i = 0; i < 3; ++i)
      plane.normal[i] = core::scaled_for_doubles(
          d_.elimination.over_tower(d_.geometry.poly(normal[i].expand())).plain(d_.geometry.tower_variables()));
    d_.result.problem.force_planes.push_back(std::move(plane));
  }
}

void FactorEmission::force_probes() {
  core::LocusProblem& problem = d_.result.problem;
  const bool singular = std::any_of(problem.factors.begin(), problem.factors.end(), [](const LocusFactor& factor) {
    return factor.role == FactorRole::direct_singularity;
  });
  if (!singular || !d_.wanted(Quantity::f) || problem.tower.coordinates.size() != 2 || !d_.preload.joints.empty())
    return;
  // Where one component has no factor of its own the whole force vanishes along curves alone.
  const auto has_own = [&](const std::string& joint, Quantity component) {
    const Quantity other = component == Quantity::fx ? Quantity::fy : Quantity::fx;
    return std::any_of(problem.factors.begin(), problem.factors.end(), [&](const LocusFactor& factor) {
      return factor.role == FactorRole::reaction && is_of(factor.vanishing, joint, component) &&
             !is_of(factor.vanishing, joint, other);
    });
  };
  for (const mechanism::Joint& joint : d_.mechanism.joints) {
    const std::vector<Quantity> components = core::force_components(problem, joint.name);
    if (!d_.selected(joint.name) || components != std::vector{Quantity::fx, Quantity::fy}) continue;
    if (!has_own(joint.name, Quantity::fx) || !has_own(joint.name, Quantity::fy)) continue;
    core::ForceProbe probe{joint.name, {}, {}};
    std::vector<FactoredPoly> own;
    bool known = true;
    for (std::size_t c = 0; c < components.size() && known; ++c) {
      const FactoredPoly* const part = numerator(d_.reactions, joint.name, components[c]);
      const FactoredPoly* const other = numerator(margin_nodes_.probed(), joint.name, components[c]);
      known = part != nullptr && !part->is_zero() && other != nullptr && !other->is_zero();
      if (!known) break;
      own.push_back(*part);
      probe.probes[c] = d_.lines.of(other->constant, other->factors);
    }
    if (!known) continue;
    // What both and |A| have in common and is no singularity, such as the square of a leg's length, hides where they
    // cross each other.
    FactoredPoly common = shared_factors({own[0], own[1], d_.determinants.determinant});
    std::erase_if(common.factors, [&](const PolyFactor& factor) {
      return std::any_of(d_.determinant_parts.begin(), d_.determinant_parts.end(),
                         [&](const DeterminantPart& part) { return part.natural->poly == factor.poly; });
    });
    for (std::size_t c = 0; c < own.size(); ++c) {
      multiply(own[c], common, -1);
      probe.numerators[c] = d_.lines.of(own[c].constant, own[c].factors);
    }
    problem.force_probes.push_back(std::move(probe));
  }
}

void FactorEmission::append_roots() {
  if (more_roots_.empty()) return;
  core::LocusProblem& problem = d_.result.problem;
  core::append_roots(problem.tower, more_roots_);
  const auto widen = [&](core::Polynomial& p) { p = core::with_variables(p, problem.tower.variables()); };
  for (LocusFactor& factor : problem.factors) {
    widen(factor.sheet);
    for (auto& [sheet, times] : factor.cleared) widen(sheet);
    if (factor.nodes)
      for (core::NodeForm::Part& part : factor.nodes->parts) widen(part.sheet);
  }
  for (LocusFactor& function : problem.pair_functions) widen(function.sheet);
  for (core::ForcePairs& of_joint : problem.force_pairs)
    for (core::ForcePair& pair : of_joint.pairs)
      if (pair.third) widen(pair.normal);
  for (core::ForcePlane& plane : problem.force_planes)
    for (core::Polynomial& part : plane.normal) widen(part);
  for (core::WorkingMode& mode : problem.modes) mode.resize(problem.tower.roots.size(), 1);
}

}  // namespace clearloci::symbolic
