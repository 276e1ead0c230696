// Lengths of vectors that forces act along (method.md section 11).
#include <algorithm>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "symbolic/geometry.hpp"
#include "symbolic/ginac_number.hpp"

namespace clearloci::symbolic {

using core::Expression;
using core::Rational;

namespace {

/// Whether 1 / |v| enters the equations: with parameters kept, whatever the free length is now.
bool is_needed(const mechanism::Action& action, const mechanism::Mechanism& mechanism, bool keep_parameters) {
  if (action.needs_length(mechanism)) return true;
  return keep_parameters && action.law == mechanism::Action::Law::linear && !core::symbols(action.free_length).empty();
}

/// The direction of a link of a torsion spring's joint, turned a quarter about the axis in space.
mechanism::VectorExpression across_axis(const mechanism::Mechanism& mechanism, const mechanism::Spring& spring,
                                        bool second) {
  mechanism::VectorExpression expression = mechanism::direction_of(mechanism, second ? spring.to : spring.from);
  if (mechanism.space == mechanism::Space::planar) return expression;
  const auto& axis = mechanism.joints[static_cast<std::size_t>(spring.joint)].axes.at(0);
  return {mechanism::VectorExpression::Kind::cross, {}, 0, {axis, expression}};
}

const mechanism::VectorExpression& joint_axis(const mechanism::Mechanism& mechanism, const mechanism::Action& action) {
  const mechanism::JointIndex joint = mechanism.springs[action.index].joint;
  return mechanism.joints[static_cast<std::size_t>(joint)].axes.at(0);
}

}  // namespace

std::string Geometry::arm_name(std::size_t limit, bool second) {
  return "limit" + std::to_string(limit + 1) + (second ? ".b" : ".a");
}

std::string Geometry::arm_name(const mechanism::Spring& spring, bool second) {
  return "limit." + spring.name + (second ? ".b" : ".a");
}

bool Geometry::has_inverse_length(const std::string& name) const {
  return std::any_of(inverse_lengths_.begin(), inverse_lengths_.end(),
                     [&](const InverseLength& length) { return length.name == name; });
}

const InverseLength& Geometry::inverse_length(const std::string& name) const {
  const auto found = std::find_if(inverse_lengths_.begin(), inverse_lengths_.end(),
                                  [&](const InverseLength& length) { return length.name == name; });
  core::ensure(found != inverse_lengths_.end(), "a length that is known");
  return *found;
}

void Geometry::list_lengths() {
  for (const mechanism::Action& action : mechanism::actions(*mechanism_))
    if (is_needed(action, *mechanism_, keep_parameters_))
      inverse_lengths_.push_back({action.length_name(), *action.along});
    else if (action.law == mechanism::Action::Law::torsion && mechanism_->space == mechanism::Space::spatial)
      inverse_lengths_.push_back({action.length_name(), joint_axis(*mechanism_, action)});
  for (const mechanism::Joint& joint : mechanism_->joints)  // whose force is held against bounds
    if (joint.actuated && joint.within && !joint.effort && mechanism::actuator_quantity(joint) == core::Quantity::F)
      inverse_lengths_.push_back({joint.name + ".axis", joint.axes.at(0)});
  for (const mechanism::Spring& spring : mechanism_->springs)
    if (spring.kind == mechanism::Spring::Kind::torsion)
      for (const bool second : {false, true})
        inverse_lengths_.push_back({arm_name(spring, second), across_axis(*mechanism_, spring, second)});
  for (std::size_t i = 0; i < mechanism_->limits.size(); ++i) {
    const mechanism::Limit& limit = mechanism_->limits[i];
    if (!limit.is_angle()) continue;
    for (const bool second : {false, true})
      inverse_lengths_.push_back({arm_name(i, second), mechanism::way(limit.points[1], limit.points[second ? 2 : 0])});
  }
}

void Geometry::place_length(InverseLength& length) {
  const Poly t = Poly::variable(*ring_, auxiliary());
  // V . V + t over the tower: the coefficient of t is the common denominator.
  Poly square(*ring_);
  for (const GiNaC::ex& component : vector(length.along)) square += poly(component) * poly(component);
  Poly over = square + t;
  for (const Substitution& pair : substitutions()) {
    const int degree = degree_in(over, pair);
    if (degree > 0) over = substituted(over, pair, degree);
  }
  const std::vector<Poly> parts = over.coefficients(auxiliary());
  core::ensure(parts.size() == 2, "a squared length over its denominator");
  const Poly common = common_positive(parts[0], parts[1]);
  const Poly d = parts[0].exact_quotient(common), w = parts[1].exact_quotient(common);
  Poly constant(*ring_);
  const std::vector<int> free = tower_variables();
  const bool fixed = d.divides(w, constant) && std::none_of(free.begin(), free.end(), [&](int variable) {
                       return constant.depends_on(variable);
                     });
  if (fixed && constant.is_zero()) {  // on this side of a fold
    bool of_limit = false;
    for (std::size_t i = 0; i < mechanism_->limits.size(); ++i)
      of_limit = of_limit || length.name == arm_name(i, false) || length.name == arm_name(i, true);
    if (!of_limit)
      throw core::InputError({mechanism_->file},
                             "the ends of a spring, or of an arm of one, coincide in every pose on one side of the "
                             "poses in which the mechanism folds",
                             "move one of its ends by a little");
    length.natural = 0;  // bounding no angle: limits.hpp
    return;
  }
  if (fixed && constant.is_constant()) {
    const Rational inverse = mechanism::value_of(
        Expression::apply(Expression::Kind::divide,
                          {Expression::number(1),
                           Expression::apply(Expression::Kind::sqrt, {Expression::number(constant.constant())})}),
        *mechanism_);
    length.natural = number(inverse);
    return;
  }
  length.natural = GiNaC::ex(symbol(ring_->name(length.variable)));
  // |v|^2 = d w / w^2: with q^2 taken out of the radicand s = |v| w / q and 1 / |v| = q s / d.
  Poly radicand = reduce(d * w), scale = w, taken(*ring_, 1), less(*ring_), quotient(*ring_);
  for (const Poly& divisor : positive_)
    while (scale.divides(divisor, less) && radicand.divides(divisor * divisor, quotient)) {
      taken *= divisor;
      std::swap(scale, less);
      std::swap(radicand, quotient);
    }
  length.root = static_cast<int>(roots_.size());
  const Poly s = add_root({-1, next_root(), core::RootRole::length, radicand, scale});
  add_denominator(d);
  TowerPoint place{reduce(s * taken), Poly(*ring_), d};
  lighten(place);
  length.place = place;
}

}  // namespace clearloci::symbolic
