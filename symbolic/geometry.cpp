#include "symbolic/geometry.hpp"

#include <algorithm>
#include <set>

#include "core/interpret.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/group_closing.hpp"
#include "mechanism/posture_sample.hpp"
#include "symbolic/ginac_number.hpp"
#include "symbolic/tower_steps.hpp"

namespace clearloci::symbolic {
namespace {

using core::Expression;
using core::Rational;
using mechanism::DyadPoint;
using mechanism::ExplicitPoint;
using mechanism::MeanPoint;
using mechanism::Mechanism;
using mechanism::OffsetPoint;
using mechanism::PointIndex;
using mechanism::SliderPoint;

struct PlacedExpression {
  Expression expression;
  core::SourcePosition where;
};

/// Every expression that the equations are made of.
std::vector<PlacedExpression> expressions_of(const Mechanism& m) {
  std::vector<PlacedExpression> all;
  const auto add = [&all](const std::vector<Expression>& expressions, const core::SourcePosition& where) {
    for (const Expression& e : expressions) all.push_back({e, where});
  };
  for (const mechanism::Point& point : m.points) {
    if (const auto* form = std::get_if<ExplicitPoint>(&point.form)) add(form->coordinates, point.where);
    if (const auto* dyad = std::get_if<DyadPoint>(&point.form)) add({dyad->from_length, dyad->to_length}, point.where);
    if (const auto* offset = std::get_if<OffsetPoint>(&point.form)) add({offset->along, offset->left}, point.where);
    if (const auto* slider = std::get_if<SliderPoint>(&point.form)) {
      add({slider->length}, point.where);
      add(numbers_of(slider->along), point.where);
    }
    if (const auto* shifted = std::get_if<mechanism::ShiftedPoint>(&point.form))
      add(numbers_of(shifted->by), point.where);
    if (const auto* crossing = std::get_if<mechanism::CrossingPoint>(&point.form)) {
      add(numbers_of(crossing->along_first), point.where);
      add(numbers_of(crossing->along_second), point.where);
    }
  }
  for (const mechanism::Joint& joint : m.joints)
    for (const mechanism::VectorExpression& axis : joint.axes) add(numbers_of(axis), joint.where);
  for (const mechanism::Load& load : m.loads) {
    add(load.force, load.where);
    add({load.couple}, load.where);
    add(load.couple_vector, load.where);
    if (load.force_vector) add(numbers_of(*load.force_vector), load.where);
  }
  for (const mechanism::Joint& joint : m.joints)
    if (joint.effort) add({*joint.effort}, joint.where);
  for (const mechanism::Spring& spring : m.springs)
    add({spring.stiffness, spring.free_length, spring.force, Expression::apply(Expression::Kind::cos, {spring.rest}),
         Expression::apply(Expression::Kind::sin, {spring.rest})},
        spring.where);
  if (!m.gravity.empty()) {
    add(m.gravity, {m.file});
    for (const mechanism::Mass& body : mechanism::masses(m))
      add({body.mass}, m.links[static_cast<std::size_t>(body.link)].where);
  }
  return all;
}

/// A free coordinate inside something that is no polynomial.
struct NotPolynomial {
  std::string expression;
};

}  // namespace

Geometry::Geometry(const Mechanism& mechanism, bool keep_parameters, Charts charts, SheetChoice sheet)
    : mechanism_(&mechanism), keep_parameters_(keep_parameters), charts_(std::move(charts)), sheet_(std::move(sheet)) {
  mechanism::require_closed_forms(mechanism, "the equations are written",
                                  "over groups ask for zones, verify, pose, error and trajectory, or loci over one "
                                  "coordinate");
  if (sheet_.sides.empty()) sheet_.sides = mechanism::working_mode(mechanism);
  charts_.resize(mechanism.coordinates.size());
  for (std::size_t i = 0; i < charts_.size(); ++i) {
    if (!mechanism.coordinates[i].angle)
      charts_[i].reset();
    else if (!charts_[i])
      charts_[i] = core::AngleChart{0};
  }
  for (const PlacedExpression& placed : expressions_of(mechanism)) {
    try {
      (void)expression(placed.expression);
    } catch (const NotPolynomial& found) {
      throw core::InputError(placed.where, "'" + found.expression + "' is no polynomial in the free coordinates",
                             "write it with + - * and whole powers of the coordinates");
    }
  }
  list_crank_lengths();
  list_lengths();
  list_torsion_angles();
  name_variables();
  place_angles();
  const std::size_t count = mechanism.points.size();
  take_samples();
  natural_.resize(count);
  tower_.resize(count, TowerPoint{Poly(*ring_), Poly(*ring_), Poly(*ring_)});
  for (PointIndex point = 0; point < static_cast<PointIndex>(count); ++point) place(point);
  for (const mechanism::Joint& joint : mechanism.joints)
    for (const mechanism::VectorExpression& axis : joint.axes) divide_by_length(axis);
  for (InverseLength& length : inverse_lengths_) place_length(length);
  for (TorsionAngle& angle : torsion_angles_) place_torsion_angle(angle);
}

GiNaC::symbol Geometry::symbol(const std::string& name) const {
  return symbols_.try_emplace(name, GiNaC::symbol(name)).first->second;
}

struct Geometry::Naturals {
  using Value = GiNaC::ex;
  using RightFirst = void;  // symbols are known, and printed, in the order in which they are met
  using Kind = Expression::Kind;
  const Geometry& geometry;

  std::optional<GiNaC::ex> known(const Expression& e) const {
    const mechanism::Mechanism& m = geometry.mechanism();
    const bool free = geometry.is_free(e);
    const bool stays = free || geometry.keep_parameters_;
    const bool is_number = !stays || (core::symbols(e).empty() && mechanism::evaluate(e, m.parameters).exact);
    if (is_number) return clearloci::symbolic::number(mechanism::value_of(e, m));
    const bool turns = e.kind() == Kind::cos || e.kind() == Kind::sin;
    if (e.kind() == Kind::atan) return geometry.arc_tangent(e.arguments()[0]);
    if (turns && free) return geometry.circle(e.arguments()[0])[e.kind() == Kind::cos ? 0 : 1];
    if (turns || e.kind() == Kind::pi || e.kind() == Kind::sqrt) return kept(core::to_string(e), e, e);
    if (e.kind() == Kind::power && !is_whole(core::interpret(e.arguments()[1], *this)))
      return kept("(" + core::to_string(e) + ")", e, e);
    return std::nullopt;
  }

  GiNaC::ex number(const Rational& value) const { return clearloci::symbolic::number(value); }
  GiNaC::ex symbol(const std::string& name) const {
    const auto& all = geometry.mechanism().coordinates;
    const auto coordinate = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
    const Expression symbol = Expression::symbol(name);
    if (coordinate == all.end() || coordinate->angle) return kept(name, symbol, symbol);
    return geometry.symbol(name);
  }
  GiNaC::ex negate(const GiNaC::ex& a) const { return -a; }
  GiNaC::ex add(const GiNaC::ex& a, const GiNaC::ex& b) const { return a + b; }
  GiNaC::ex multiply(const GiNaC::ex& a, const GiNaC::ex& b) const { return a * b; }
  GiNaC::ex divide(const GiNaC::ex& a, const GiNaC::ex& b, const Expression& e) const {
    if (GiNaC::is_a<GiNaC::numeric>(b)) return a / b;
    return a * kept("1/(" + core::to_string(e.arguments()[1]) + ")", e,
                    Expression::apply(Kind::divide, {Expression::number(1), e.arguments()[1]}));
  }
  GiNaC::ex power(const GiNaC::ex& a, const Expression& e) const {
    return GiNaC::pow(a, core::interpret(e.arguments()[1], *this));
  }
  GiNaC::ex pi() const { return 0; }  // known, as what follows
  GiNaC::ex sqrt(const GiNaC::ex& a, const Expression&) const { return a; }
  GiNaC::ex cos(const GiNaC::ex& a, const Expression&) const { return a; }
  GiNaC::ex sin(const GiNaC::ex& a, const Expression&) const { return a; }
  GiNaC::ex atan(const GiNaC::ex& a, const Expression&) const { return a; }

 private:
  static bool is_whole(const GiNaC::ex& exponent) { return exponent.info(GiNaC::info_flags::nonnegint); }

  /// A symbol for something that parameters alone make; `within` is what it was met in.
  GiNaC::ex kept(const std::string& name, const Expression& within, const Expression& meaning) const {
    if (geometry.is_free(within)) throw NotPolynomial{core::to_string(within)};
    std::vector<std::string>& all = geometry.kept_;
    if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
    geometry.kept_expressions_.emplace(name, meaning);
    return geometry.symbol(name);
  }
};

GiNaC::ex Geometry::expression(const Expression& e) const { return core::interpret(e, Naturals{*this}); }

bool Geometry::is_free(const Expression& e) const {
  const std::set<std::string> names = core::symbols(e);
  return std::any_of(mechanism_->coordinates.begin(), mechanism_->coordinates.end(),
                     [&](const auto& coordinate) { return names.contains(coordinate.name); });
}

std::array<GiNaC::ex, 2> Geometry::circle(const Expression& angle) const {
  using Kind = Expression::Kind;
  using Pair = std::array<GiNaC::ex, 2>;
  if (!is_free(angle)) {
    return {expression(Expression::apply(Kind::cos, {angle})), expression(Expression::apply(Kind::sin, {angle}))};
  }
  const auto sum = [](const Pair& a, const Pair& b) {
    return Pair{(a[0] * b[0] - a[1] * b[1]).expand(), (a[1] * b[0] + a[0] * b[1]).expand()};
  };
  const std::vector<Expression>& arguments = angle.arguments();
  switch (angle.kind()) {
    case Kind::symbol:
      return {GiNaC::ex(symbol("cos(" + angle.name() + ")")), GiNaC::ex(symbol("sin(" + angle.name() + ")"))};
    case Kind::add:
      return sum(circle(arguments[0]), circle(arguments[1]));
    case Kind::negate: {
      const Pair turned = circle(arguments[0]);
      return {turned[0], -turned[1]};
    }
    case Kind::multiply: {
      const std::size_t free = is_free(arguments[0]) ? 0 : 1;
      if (is_free(arguments[1 - free])) break;
      const Rational factor = mechanism::value_of(arguments[1 - free], *mechanism_);
      if (factor.get_den() != 1 || abs(factor) > 100) break;
      Pair result = {GiNaC::ex(1), GiNaC::ex(0)}, step = circle(arguments[free]);
      if (factor < 0) step[1] = -step[1];
      for (Rational i = 0; i < abs(factor); ++i) result = sum(result, step);
      return result;
    }
    default:
      break;
  }
  throw NotPolynomial{core::to_string(angle)};
}

void Geometry::name_variables() {
  std::vector<std::string> names;
  const auto add = [&names](std::string name) {
    while (std::find(names.begin(), names.end(), name) != names.end()) name += '_';
    names.push_back(name);
    return static_cast<int>(names.size()) - 1;
  };
  for (std::size_t i = 0; i < mechanism_->coordinates.size(); ++i) {
    const std::string& name = mechanism_->coordinates[i].name;
    variable_of_symbol_[name] = add(charts_[i] ? core::parameter_name(*charts_[i], name) : name);
  }
  std::set<std::string> taken(kept_.begin(), kept_.end());
  const auto add_untaken = [&](std::string name) {
    while (taken.contains(name)) name += '_';
    return add(name);
  };
  for (PointIndex i = 0; i < static_cast<PointIndex>(mechanism_->points.size()); ++i) {
    const mechanism::Point& point = mechanism_->points[index(i)];
    if (std::holds_alternative<ExplicitPoint>(point.form) || std::holds_alternative<MeanPoint>(point.form) ||
        std::holds_alternative<mechanism::ShiftedPoint>(point.form))
      continue;
    const int x = add_untaken("x" + point.name);
    const int y = add_untaken("y" + point.name);
    const bool spatial = mechanism_->space == mechanism::Space::spatial;
    constructed_.push_back({i, x, y, spatial ? add_untaken("z" + point.name) : -1});
  }
  for (InverseLength& length : inverse_lengths_) {
    std::string name = "i" + length.name;
    std::erase(name, '.');
    length.variable = add_untaken(name);
  }
  for (TorsionAngle& angle : torsion_angles_) {
    std::string name = angle.tangent ? angle.name : "a" + mechanism_->springs[angle.spring].name;
    std::erase(name, '.');
    angle.variable = add_untaken(name);
    if (angle.tangent) angle.name = names.back();
  }
  std::vector<std::pair<std::string, std::array<int, 2>>> circles;
  for (std::size_t i = 0; i < charts_.size(); ++i) {
    if (!charts_[i]) continue;
    const std::string& name = mechanism_->coordinates[i].name;
    const int cosine = add("cos(" + name + ")");
    circles.push_back({name, {cosine, add("sin(" + name + ")")}});
  }
  first_root_ = static_cast<int>(names.size());
  const std::size_t most_roots = constructed_.size() + inverse_lengths_.size() + torsion_angles_.size();
  for (std::size_t i = 1; i <= most_roots; ++i) add_untaken("s" + std::to_string(i));
  for (const std::string& name : kept_) variable_of_symbol_[name] = add(name);
  add_untaken("t");
  ring_ = std::make_unique<Ring>(names);
  for (const ConstructedPoint& c : constructed_) {
    for (const int variable : {c.x, c.y, c.z})
      if (variable >= 0) variable_of_symbol_[ring_->name(variable)] = variable;
  }
  for (const InverseLength& length : inverse_lengths_)
    variable_of_symbol_[ring_->name(length.variable)] = length.variable;
  for (const TorsionAngle& angle : torsion_angles_) variable_of_symbol_[ring_->name(angle.variable)] = angle.variable;
  for (const auto& [name, variables] : circles) {
    for (const int variable : variables) variable_of_symbol_[ring_->name(variable)] = variable;
  }
}

void Geometry::take_samples() {
  constexpr std::size_t poses = 16;
  if (keep_parameters_) return;
  for (const std::vector<double>& pose : mechanism::spread_poses(*mechanism_, poses)) {
    samples_.push_back({std::vector<double>(static_cast<std::size_t>(ring_->size()), 0.0)});
    std::vector<double>& at = samples_.back().at;
    for (std::size_t i = 0; i < pose.size(); ++i) {
      const double lower = core::to_double(mechanism_->coordinates[i].lower);
      const double upper = core::to_double(mechanism_->coordinates[i].upper);
      at[i] = charts_[i] ? 2 * (pose[i] - lower) / (upper - lower) - 1 : pose[i];  // the t of a chart runs over [-1, 1]
    }
  }
}

void Geometry::place_angles() {
  int variable = first_root_;
  for (const auto& chart : charts_) variable -= chart ? 2 : 0;
  for (std::size_t i = 0; i < charts_.size(); ++i) {
    if (!charts_[i]) continue;
    const Poly t = Poly::variable(*ring_, static_cast<int>(i));
    const Poly one(*ring_, 1);
    const int sign = charts_[i]->half_turns % 2 == 0 ? 1 : -1;
    angles_.push_back({variable, variable + 1, {(one - t * t).scaled(sign), t.scaled(2 * sign), one + t * t}});
    positive_units_.push_back(angles_.back().place.w);
    positive_.push_back(angles_.back().place.w);
    variable += 2;
  }
}

std::vector<Substitution> Geometry::substitutions() const {
  std::vector<Substitution> list;
  // What closes a loop is written by the others first: together they have fewer terms.
  for (auto c = constructed_.rbegin(); c != constructed_.rend(); ++c)
    if (const auto closing = closings_.find(c->point); closing != closings_.end())
      list.push_back({c->x, c->y, closing->second.place});
  list.insert(list.end(), angles_.begin(), angles_.end());
  for (const TorsionAngle& angle : torsion_angles_)
    if (angle.place) list.push_back({angle.variable, -1, *angle.place});
  for (const InverseLength& length : inverse_lengths_)
    if (length.place) list.push_back({length.variable, -1, *length.place});
  for (const ConstructedPoint& c : constructed_) {
    if (tower(c.point).w.is_zero()) continue;  // not placed yet
    const auto frame = frames_.find(c.point);
    const auto closing = closings_.find(c.point);
    if (frame != frames_.end()) {
      for (const TowerPoint& place : frame->second) list.push_back({c.x, c.y, place});
    } else if (closing == closings_.end()) {
      list.push_back({c.x, c.y, tower(c.point), c.z});
    } else if (closing->second.part) {
      list.push_back({c.x, c.y, *closing->second.part});
    }
  }
  return list;
}

int Geometry::degree_in(const Poly& natural, const Substitution& pair) {
  std::vector<int> variables = {pair.x};
  if (pair.y >= 0) variables.push_back(pair.y);
  if (pair.z >= 0) variables.push_back(pair.z);
  return natural.degree(variables);
}

Poly Geometry::substituted(const Poly& natural, const Substitution& pair, int degree) const {
  return with_place(natural, pair, degree, roots_);
}

Poly Geometry::poly(const GiNaC::ex& e) const {
  if (GiNaC::is_a<GiNaC::numeric>(e)) {
    const auto& value = GiNaC::ex_to<GiNaC::numeric>(e);
    core::ensure(value.is_rational(), "a rational coefficient");
    return Poly(*ring_, rational(value));
  }
  if (GiNaC::is_a<GiNaC::symbol>(e)) {
    return Poly::variable(*ring_, variable_of_symbol_.at(GiNaC::ex_to<GiNaC::symbol>(e).get_name()));
  }
  if (GiNaC::is_a<GiNaC::add>(e)) {
    Poly sum(*ring_);
    for (const GiNaC::ex& term : e) sum += poly(term);
    return sum;
  }
  if (GiNaC::is_a<GiNaC::mul>(e)) {
    Poly product(*ring_, 1);
    for (const GiNaC::ex& factor : e) product *= poly(factor);
    return product;
  }
  core::ensure(GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::nonnegint), "a polynomial expression");
  return poly(e.op(0)).pow(static_cast<unsigned>(GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int()));
}

Poly Geometry::reduce(Poly p) const { return reduced_in(std::move(p), roots_); }

std::vector<int> Geometry::tower_variables() const {
  std::vector<int> variables;
  for (int i = 0; i < coordinates(); ++i) variables.push_back(i);
  for (const TowerRoot& root : roots_) variables.push_back(root.variable);
  return variables;
}

core::RootTower Geometry::plain_tower() const {
  core::RootTower tower;
  for (int i = 0; i < coordinates(); ++i) tower.coordinates.push_back(ring_->name(i));
  const std::vector<int> variables = tower_variables();
  for (const TowerRoot& root : roots_) {
    const std::string name = "s" + std::to_string(tower.roots.size() + 1);
    if (root.is_angle()) {
      const auto torsion_angle =
          std::find_if(torsion_angles_.begin(), torsion_angles_.end(),
                       [&](const TorsionAngle& angle) { return angle.root == static_cast<int>(tower.roots.size()); });
      tower.roots.push_back({name, name_of(*torsion_angle), root.role, root.square.plain(variables)});
      for (const Poly& part : root.cosine_and_sine) tower.roots.back().cosine_and_sine.push_back(part.plain(variables));
      continue;
    }
    if (root.point < 0) {
      const auto found = std::find_if(
          inverse_lengths_.begin(), inverse_lengths_.end(),
          [&](const InverseLength& length) { return length.root == static_cast<int>(tower.roots.size()); });
      tower.roots.push_back({name, found->name, root.role, root.square.plain(variables)});
      continue;
    }
    tower.roots.push_back({name, mechanism_->points[index(root.point)].name, root.role, root.square.plain(variables)});
    if (std::holds_alternative<SliderPoint>(mechanism_->points[index(root.point)].form))
      tower.roots.back().sides = {"ahead", "behind"};
  }
  for (const Poly& denominator : denominators_) tower.denominators.push_back(denominator.plain(variables));
  return tower;
}

std::vector<GiNaC::ex> Geometry::vector(const mechanism::VectorExpression& v) const {
  using Kind = mechanism::VectorExpression::Kind;
  std::vector<std::vector<GiNaC::ex>> a;
  for (const auto& argument : v.arguments) a.push_back(vector(argument));
  std::vector<GiNaC::ex> result;
  switch (v.kind) {
    case Kind::components:
      for (const Expression& number : v.numbers) result.push_back(expression(number));
      break;
    case Kind::point:
      for (std::size_t i = 0; i < mechanism::dimension(*mechanism_); ++i) result.push_back(natural(v.point)[i]);
      break;
    case Kind::add:
      for (std::size_t i = 0; i < a[0].size(); ++i) result.push_back(a[0][i] + a[1][i]);
      break;
    case Kind::negate:
      for (const GiNaC::ex& component : a[0]) result.push_back(-component);
      break;
    case Kind::scale:
      for (const GiNaC::ex& component : a[0]) result.push_back(expression(v.numbers[0]) * component);
      break;
    case Kind::cross:
      result = {a[0][1] * a[1][2] - a[0][2] * a[1][1], a[0][2] * a[1][0] - a[0][0] * a[1][2],
                a[0][0] * a[1][1] - a[0][1] * a[1][0]};
      break;
  }
  for (GiNaC::ex& component : result) component = component.expand();
  return result;
}

}  // namespace clearloci::symbolic
