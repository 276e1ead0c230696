#include "symbolic/margins.hpp"

#include <algorithm>

#include "mechanism/guide.hpp"

namespace clearloci::symbolic {
namespace {

using core::Quantity;
using core::Rational;

class Margins {
 public:
  Margins(const Geometry& geometry, const Elimination& elimination, const FactoredPoly& determinant,
          const std::vector<Reaction>& reactions)
      : geometry_(geometry), elimination_(elimination), determinant_(determinant), reactions_(reactions) {}

  void add_force(const mechanism::Joint& joint, const Rational& bound) {
    if (!mechanism::plays_across(geometry_.mechanism(), joint)) return;
    const PressingForce pressing = pressing_force(geometry_, reactions_, joint, determinant_);
    const std::vector<FactoredPoly>& force = pressing.parts;
    if (std::all_of(force.begin(), force.end(), [](const FactoredPoly& part) { return part.is_zero(); })) return;
    const FactoredPoly common = shared_factors(force);
    std::vector<Poly> left;  // of the force
    for (const FactoredPoly& part : force)
      if (!part.is_zero()) left.push_back(without(part, common, ring()));
    // Of a pin about an axis of constant length the force is w over that length.
    const auto axis = pressing.squared ? elimination_.constant_over_tower(*pressing.squared) : std::nullopt;
    const Rational over = axis.value_or(1);
    const Poly square = sum_of_squares(left).scaled(1 / over);
    const FactoredPoly shared = common_factors(common, determinant_);
    const Poly size = without(common, shared, ring()), d = without(determinant_, shared, ring());
    if (pressing.squared && !axis) {
      add(joint.name, Quantity::f, size * size * square - (d * d * *pressing.squared).scaled(bound * bound), bound,
          {cleared(shared), 2});
      return;
    }
    // A two-force link of the plane bears (x, y) of constant length: then |f| = f_min is two linear conditions.
    if (const auto length = constant_length(square)) {
      add(joint.name, Quantity::f, size.scaled(*length) - d.scaled(bound), bound, {cleared(shared), 1});
      add(joint.name, Quantity::f, size.scaled(*length) + d.scaled(bound), bound, {cleared(shared), 1});
    } else {
      // Of another w the direction is lost where |A| vanishes with w; then squares tell more than |w| does.
      const bool in_space = geometry_.mechanism().space != mechanism::Space::planar;
      const bool two_senses = !size.is_constant() && (in_space || is_way(left));
      Margin& added = add(joint.name, Quantity::f, size * size * square - (d * d).scaled(bound * bound), bound,
                          {cleared(shared), 2},
                          two_senses ? std::optional(TwoSenses{size, left, d.scaled(bound), over}) : std::nullopt);
      if (!two_senses && !pressing.squared && !added.force) added.force = squared_force(force, shared, bound);
    }
  }

  /// The couple or the force along an axis u: of an actuator or of teeth.
  void add_effort(const mechanism::Joint& joint, Quantity quantity, const Rational& bound) {
    const FactoredPoly* effort = numerator(reactions_, joint.name, quantity);
    const bool of_belt = quantity == Quantity::F && joint.type == mechanism::JointType::belt;
    if (effort == nullptr || effort->is_zero() || of_belt) return;
    const FactoredPoly shared = common_factors(*effort, determinant_);
    Poly n = without(*effort, shared, ring()), d = without(determinant_, shared, ring()).scaled(bound);
    const mechanism::Mechanism& mechanism = geometry_.mechanism();
    const bool is_number = quantity == Quantity::M && mechanism.space == mechanism::Space::planar;
    bool over_axis = quantity == Quantity::F && is_force_over_axis(mechanism, joint);
    const Poly axis2 = is_number ? geometry_.poly(1) : squared_axis(geometry_, joint);
    if (const auto square = elimination_.constant_over_tower(axis2)) {
      Poly& scaled = over_axis ? n : d;
      scaled = scaled.scaled(mechanism::near_root(*square));
      add(joint.name, quantity, n - d, bound, {cleared(shared), 1});
      add(joint.name, quantity, n + d, bound, {cleared(shared), 1});
      return;
    }
    // u . w of a force that keeps to u has |u|^2 as a factor.
    Poly along = n;
    if (!over_axis && n.divides(axis2, along)) {
      n = along;
      over_axis = true;
    }
    const Poly &size = over_axis ? n : d, &other = over_axis ? d : n;
    add(joint.name, quantity, size * size * axis2 - other * other, bound, {cleared(shared), 2},
        size.is_constant() ? std::nullopt
                           : std::optional(TwoSenses{size, components_of_axis(geometry_, joint), other}));
  }

  std::vector<Margin> take() { return std::move(margins_); }

 private:
  const Ring& ring() const { return geometry_.ring(); }

  /// Along a line of the mechanism, as the way from one point to another is.
  static bool is_way(const std::vector<Poly>& w) {
    return std::all_of(w.begin(), w.end(), [](const Poly& component) { return component.total_degree() <= 1; });
  }

  /// Without what all of it shares.
  SquaredForce squared_force(const std::vector<FactoredPoly>& components, const FactoredPoly& shared,
                             const Rational& bound) const {
    SquaredForce force{{}, determinant_};
    multiply(force.bound, shared, -1);
    force.bound.constant *= bound;
    for (FactoredPoly part : components) {
      if (part.is_zero()) continue;
      multiply(part, shared, -1);
      force.components.push_back(std::move(part));
    }
    return force;
  }

  /// |A| without what a numerator shares with it.
  FactoredPoly cleared(const FactoredPoly& shared) const {
    FactoredPoly rest = determinant_;
    multiply(rest, shared, -1);
    return rest;
  }

  Margin& add(const std::string& joint, Quantity quantity, const Poly& polynomial, const Rational& bound,
              const std::pair<FactoredPoly, int>& below, std::optional<TwoSenses> senses = std::nullopt) {
    const Poly natural = polynomial.primitive();
    auto found = std::find_if(margins_.begin(), margins_.end(), [&](const Margin& m) {
      const bool couple = m.reactions.front().quantity == Quantity::M;
      return couple == (quantity == Quantity::M) && m.natural == natural;
    });
    if (found == margins_.end()) found = margins_.insert(found, {natural, bound, {}, below.first, below.second});
    if (!found->senses) found->senses = std::move(senses);
    const core::Vanishing reaction{joint, quantity, 1};
    if (found->reactions.empty() || found->reactions.back() != reaction) found->reactions.push_back(reaction);
    return *found;
  }

  std::optional<Rational> constant_length(const Poly& square) const {
    const std::optional<Rational> constant = elimination_.constant_over_tower(square);
    return constant ? rational_root(*constant) : std::nullopt;
  }

  const Geometry& geometry_;
  const Elimination& elimination_;
  const FactoredPoly& determinant_;
  const std::vector<Reaction>& reactions_;
  std::vector<Margin> margins_;
};

}  // namespace

std::optional<Rational> rational_root(const Rational& square) {
  if (square < 0 || !mpz_perfect_square_p(square.get_num_mpz_t()) || !mpz_perfect_square_p(square.get_den_mpz_t()))
    return std::nullopt;
  return Rational(sqrt(square.get_num()), sqrt(square.get_den()));
}

Poly TwoSenses::square() const { return sum_of_squares(w).scaled(1 / over); }

std::vector<Margin> margins(const Geometry& geometry, const Elimination& elimination, const FactoredPoly& determinant,
                            const std::vector<Reaction>& reactions, const Selection& selection,
                            const std::vector<std::string>& joints) {
  Margins result(geometry, elimination, determinant, reactions);
  for (const mechanism::Joint& joint : geometry.mechanism().joints) {
    if (std::find(joints.begin(), joints.end(), joint.name) == joints.end()) continue;
    if (selection.min_force) {
      result.add_force(joint, *selection.min_force);
      result.add_effort(joint, Quantity::F, *selection.min_force);
    }
    if (selection.min_couple) result.add_effort(joint, Quantity::M, *selection.min_couple);
  }
  return result.take();
}

}  // namespace clearloci::symbolic
