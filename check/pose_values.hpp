// Vectors, and expressions of a model, over a cell of poses: what places and equations are written in.
// Private to check/.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "check/jet.hpp"
#include "check/pose_equations.hpp"
#include "core/errors.hpp"
#include "core/interpret.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::check {

using core::Expression;
using mechanism::Mechanism;

template <class Number>
using VectorOf = std::array<Number, 3>;

template <class Number>
VectorOf<Number> operator+(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class Number>
VectorOf<Number> operator-(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Number>
VectorOf<Number> operator*(const Number& s, const VectorOf<Number>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class Number>
Number dot(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
VectorOf<Number> cross(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Number>
Number square_of(const VectorOf<Number>& a) {
  return squared(a[0]) + squared(a[1]) + squared(a[2]);
}

inline mpfr_prec_t bits_of(const Interval& a) { return a.bits(); }
inline mpfr_prec_t bits_of(const Jet& a) { return a.value().bits(); }

/// Expressions and vectors of the model over the cell (core/interpret.hpp).
template <class Number>
class Values {
 public:
  using Vector = VectorOf<Number>;

  Values(const Mechanism& m, const VariablesOf<Number>& variables)
      : m_(m), variables_(variables), bits_(bits_of(variables.values.at(0))) {
    for (const mechanism::Parameter& parameter : m.parameters)
      if (varies(parameter.expression) && !is_variable(parameter.name)) dependent_.insert(parameter.name);
  }

  using Value = Number;
  std::optional<Number> known(const Expression& e) const {
    return varies(e) ? std::nullopt : std::optional(number(mechanism::value_of(e, m_)));
  }
  static Number number(double value) { return Number(Interval(value, cell_bits)); }
  Number number(const core::Rational& value) const { return Number(Interval(value, bits_)); }
  Number symbol(const std::string& name) const {
    for (std::size_t v = 0; v < variables_.names.size(); ++v)
      if (variables_.names[v] == name) return variables_.values[v];
    const auto found = std::find_if(m_.parameters.begin(), m_.parameters.end(),
                                    [&](const mechanism::Parameter& parameter) { return parameter.name == name; });
    if (found == m_.parameters.end()) throw core::InputError({m_.file}, "a name that check does not know", "");
    return value(found->expression);
  }
  static Number negate(const Number& a) { return -a; }
  static Number add(const Number& a, const Number& b) { return a + b; }
  static Number multiply(const Number& a, const Number& b) { return a * b; }
  static Number divide(const Number& a, const Number& b, const Expression&) { return a / b; }
  Number power(const Number& base, const Expression& e) const {
    const core::Rational exponent = mechanism::value_of(e.arguments()[1], m_);
    constexpr long most = 64;
    if (exponent.get_den() != 1 || abs(exponent) > most)
      throw core::InputError({m_.file}, "a power that check does not know", "");
    Number result = number(1.0);
    const long times = exponent.get_num().get_si();
    for (long i = 0; i < std::abs(times); ++i) result = result * base;
    return times < 0 ? inverse(result) : result;
  }
  Number pi() const {
    Interval interval(bits_);
    mpfi_const_pi(interval.get());
    return Number(interval);
  }
  static Number sqrt(const Number& a, const Expression&) { return root_of(a); }
  static Number cos(const Number& a, const Expression&) { return cosine_of(a); }
  static Number sin(const Number& a, const Expression&) { return sine_of(a); }
  static Number atan(const Number& a, const Expression&) { return angle_of(a, number(1.0)); }

  Number value(const Expression& e) const { return core::interpret(e, *this); }
  Number function(Expression::Kind kind, const Expression& argument) const {
    return value(Expression::apply(kind, {argument}));
  }

  Vector components(const std::vector<Expression>& numbers) const {
    Vector components;
    for (std::size_t c = 0; c < numbers.size(); ++c) components[c] = value(numbers[c]);
    return components;
  }

  Vector vector(const mechanism::VectorExpression& v, const std::vector<Vector>& points) const {
    using Kind = mechanism::VectorExpression::Kind;
    const auto argument = [&](std::size_t i) { return vector(v.arguments.at(i), points); };
    switch (v.kind) {
      case Kind::components:
        return components(v.numbers);
      case Kind::point:
        return points.at(static_cast<std::size_t>(v.point));
      case Kind::add:
        return argument(0) + argument(1);
      case Kind::negate:
        return number(-1.0) * argument(0);
      case Kind::scale:
        return value(v.numbers.at(0)) * argument(0);
      case Kind::cross:
        break;
    }
    return cross(argument(0), argument(1));
  }

 private:
  bool is_variable(const std::string& name) const {
    return std::find(variables_.names.begin(), variables_.names.end(), name) != variables_.names.end();
  }
  /// Parameters stand behind those that they are made of.
  bool varies(const Expression& e) const {
    const std::set<std::string> names = core::symbols(e);
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return is_variable(name) || dependent_.contains(name); });
  }

  const Mechanism& m_;
  const VariablesOf<Number>& variables_;
  mpfr_prec_t bits_;
  std::set<std::string> dependent_;
};

template <class Number>
VectorOf<Number> unit_along(std::size_t c) {
  VectorOf<Number> unit;
  unit[c] = Number(Interval(1.0, cell_bits));
  return unit;
}

/// The joint's axis, of length one; in the plane that of a joint that turns is z.
template <class Number>
VectorOf<Number> axis_of(const Mechanism& m, const Values<Number>& values, const std::vector<VectorOf<Number>>& points,
                         const mechanism::Joint& joint) {
  using Vector = VectorOf<Number>;
  if (joint.axes.empty()) return unit_along<Number>(m.space == mechanism::Space::planar ? 2 : 0);
  const Vector v = values.vector(joint.axes.front(), points);
  return inverse(root_of(square_of(v))) * v;
}

/// A way (x, y) at angle - rest of a torsion spring.
template <class Number>
std::array<Number, 2> off_rest(const Mechanism& m, const Values<Number>& values,
                               const std::vector<VectorOf<Number>>& points, const mechanism::Spring& spring) {
  using Vector = VectorOf<Number>;
  const auto direction = [&](mechanism::LinkIndex link) {
    if (link == mechanism::ground) return unit_along<Number>(0);
    const auto& link_points = m.links.at(static_cast<std::size_t>(link)).points;
    return points.at(static_cast<std::size_t>(link_points.at(1))) -
           points.at(static_cast<std::size_t>(link_points.at(0)));
  };
  const Vector u = axis_of(m, values, points, m.joints.at(static_cast<std::size_t>(spring.joint)));
  const Vector a = direction(spring.from), b = direction(spring.to);
  const Number sine = dot(u, cross(a, b)), cosine = dot(a, b) - dot(u, a) * dot(u, b);
  const Number c = values.function(Expression::Kind::cos, spring.rest);
  const Number s = values.function(Expression::Kind::sin, spring.rest);
  return {c * cosine + s * sine, c * sine - s * cosine};
}

}  // namespace clearloci::check
