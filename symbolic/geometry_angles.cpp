// Angles that torsion springs turn with, and arc tangents in loads (method.md section 11).
#include <algorithm>
#include <cmath>
#include <span>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "symbolic/geometry.hpp"

namespace clearloci::symbolic {
namespace {

using Vector = std::vector<GiNaC::ex>;

GiNaC::ex dot(const Vector& a, const Vector& b) {
  GiNaC::ex sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// The arguments of arc tangents, each once.
void collect_tangents(const core::Expression& e, std::vector<core::Expression>& tangents) {
  for (const core::Expression& argument : e.arguments()) collect_tangents(argument, tangents);
  if (e.kind() != core::Expression::Kind::atan) return;
  const std::string text = core::to_string(e.arguments()[0]);
  const bool is_turned = std::any_of(tangents.begin(), tangents.end(),
                                     [&](const core::Expression& tangent) { return core::to_string(tangent) == text; });
  if (!is_turned) tangents.push_back(e.arguments()[0]);
}

/// A power of two that takes the largest coefficient of the two to about 1: enclosures with a fixed number of digits
/// (loci/numbers/multi_interval.hpp) would know nothing of a way that is too short.
core::Rational unit_of(const Poly& x, const Poly& y) {
  core::Rational unit = 0;
  for (const Poly* const part : {&x, &y}) {
    if (part->is_zero()) continue;
    const core::Polynomial plain = part->plain();
    const core::Rational own =
        core::scaled_for_doubles(plain).terms.front().coefficient / plain.terms.front().coefficient;
    if (unit == 0 || own < unit) unit = own;
  }
  return unit == 0 ? core::Rational(1) : unit;
}

}  // namespace

const TorsionAngle& Geometry::torsion_angle(std::size_t spring) const {
  const auto found = std::find_if(torsion_angles_.begin(), torsion_angles_.end(),
                                  [&](const TorsionAngle& angle) { return !angle.tangent && angle.spring == spring; });
  core::ensure(found != torsion_angles_.end(), "a torsion spring that is known");
  return *found;
}

void Geometry::list_torsion_angles() {
  for (const mechanism::Action& action : mechanism::actions(*mechanism_))
    if (action.law == mechanism::Action::Law::torsion) torsion_angles_.push_back({action.index});
  std::vector<core::Expression> tangents;
  for (const mechanism::Load& load : mechanism_->loads) {
    for (const core::Expression& component : load.force) collect_tangents(component, tangents);
    for (const core::Expression& component : load.couple_vector) collect_tangents(component, tangents);
    collect_tangents(load.couple, tangents);
  }
  for (const mechanism::Joint& joint : mechanism_->joints)
    if (joint.effort) collect_tangents(*joint.effort, tangents);
  for (std::size_t i = 0; i < tangents.size(); ++i)
    torsion_angles_.push_back({0, tangents[i], "atan" + std::to_string(i + 1)});
}

const std::string& Geometry::name_of(const TorsionAngle& angle) const {
  return angle.tangent ? angle.name : mechanism_->springs[angle.spring].name;
}

GiNaC::ex Geometry::arc_tangent(const core::Expression& tangent) const {
  const std::string text = core::to_string(tangent);
  const auto torsion_angle =
      std::find_if(torsion_angles_.begin(), torsion_angles_.end(),
                   [&](const TorsionAngle& angle) { return angle.tangent && core::to_string(*angle.tangent) == text; });
  if (torsion_angle != torsion_angles_.end()) return GiNaC::ex(symbol(torsion_angle->name));
  (void)expression(tangent);  // throws where it is no polynomial
  return GiNaC::ex(0);        // not listed yet
}

std::array<Poly, 2> Geometry::numerators(const std::array<GiNaC::ex, 2>& way) const {
  // X + Y t: the coefficients of t^0 and t^1 over the tower have one denominator.
  Poly over = poly(way[0].expand()) + poly(way[1].expand()) * Poly::variable(*ring_, auxiliary());
  for (const Substitution& pair : substitutions()) {
    const int degree = degree_in(over, pair);
    if (degree > 0) over = substituted(over, pair, degree);
  }
  std::vector<Poly> parts = over.coefficients(auxiliary());
  parts.resize(2, Poly(*ring_));
  return {parts[0], parts[1]};
}

std::array<GiNaC::ex, 2> Geometry::way_off_rest(const mechanism::Spring& spring) const {
  using core::Expression;
  const Vector a = vector(mechanism::direction_of(*mechanism_, spring.from));
  const Vector b = vector(mechanism::direction_of(*mechanism_, spring.to));
  GiNaC::ex along = dot(a, b), across;
  if (mechanism_->space == mechanism::Space::planar) {
    across = a[0] * b[1] - a[1] * b[0];
  } else {
    const Vector u = vector(mechanism_->joints[static_cast<std::size_t>(spring.joint)].axes.at(0));
    const Vector turned = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    along = dot(u, u) * along - dot(u, a) * dot(u, b);
    across = dot(u, u) * inverse_length(spring.name).natural * dot(u, turned);
  }
  const GiNaC::ex cosine = expression(Expression::apply(Expression::Kind::cos, {spring.rest}));
  const GiNaC::ex sine = expression(Expression::apply(Expression::Kind::sin, {spring.rest}));
  return {(along * cosine + across * sine).expand(), (across * cosine - along * sine).expand()};
}

std::optional<TowerPoint> Geometry::same_angle(const Poly& x, const Poly& y) const {
  // The angle of (X, Y) is that of (c X, c Y), c > 0, and the opposite of that of (c X, -c Y): of fingers that mirror
  // each other, say. As elements of their own they would hide that what the springs exert cancels out.
  if (keep_parameters_ || sheet_.all_sheets || y.is_zero()) return std::nullopt;
  for (const TorsionAngle& earlier : torsion_angles_) {
    if (earlier.root < 0 || !earlier.place) continue;
    const std::vector<Poly>& cosine_and_sine = roots_[static_cast<std::size_t>(earlier.root)].cosine_and_sine;
    const bool opposite = (x * cosine_and_sine[1] + y * cosine_and_sine[0]).is_zero();
    if (!opposite && !(x * cosine_and_sine[1] - y * cosine_and_sine[0]).is_zero()) continue;
    Poly times(*ring_);
    if (!y.divides(cosine_and_sine[1], times) || !times.is_constant()) continue;
    if ((times.constant() > 0) == opposite) continue;  // half a turn apart
    TowerPoint place = *earlier.place;
    if (opposite) place.x = -place.x;
    return place;
  }
  return std::nullopt;
}

void Geometry::place_torsion_angle(TorsionAngle& angle) {
  angle.way = angle.tangent ? std::array<GiNaC::ex, 2>{GiNaC::ex(1), expression(*angle.tangent).expand()}
                            : way_off_rest(mechanism_->springs[angle.spring]);
  auto [x, y] = numerators(angle.way);
  if (const Poly common = common_positive(x, y); !common.is_constant()) {
    x = x.exact_quotient(common);
    y = y.exact_quotient(common);
  }
  const core::Rational unit = unit_of(x, y);
  x = x.scaled(unit);
  y = y.scaled(unit);
  angle.natural = GiNaC::ex(symbol(ring_->name(angle.variable)));
  if (const std::optional<TowerPoint> same = same_angle(x, y)) {
    angle.place = same;
    return;
  }
  angle.root = static_cast<int>(roots_.size());
  // Not reduced: then it holds every variable that the cosine or the sine holds.
  TowerRoot root{-1, next_root(), core::RootRole::length, x * x + y * y};
  if (root.square.is_zero()) {
    const mechanism::Spring& spring = mechanism_->springs[angle.spring];
    throw core::InputError(spring.where, "the torsion spring " + spring.name + " turns with links without a direction",
                           "name two points of each link that are apart, across the joint's axis");
  }
  root.cosine_and_sine = {x, y};
  roots_.push_back(root);
  const auto value = [](const Poly& p, const std::vector<double>& at) {
    return core::evaluate(p.plain(), std::span<const double>(at));
  };
  for (Sample& sample : samples_)
    sample.at[static_cast<std::size_t>(root.variable)] =
        core::angle_shift + std::atan2(value(y, sample.at), value(x, sample.at));
  const Poly s = Poly::variable(*ring_, root.variable);
  angle.place = TowerPoint{s - Poly(*ring_, core::angle_shift), Poly(*ring_), Poly(*ring_, 1)};
}

}  // namespace clearloci::symbolic
