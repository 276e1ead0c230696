// Where a mechanism's points and vectors are in one working mode, in closed form over any algebra: in doubles for
// samples, and as the steps of a program over the pose. Plane and space are one here: a planar mechanism lies in z = 0,
// and its dyads turn about z (docs/background/method.md section 1).
//
//   dyad B on A, P about n with |AB| = a, |BP| = b:   w = P - A,  N = n . n,  h = n . w,
//       D = N w . w - h^2,  k = a^2 - b^2 + w . w,  s^2 = 4 a^2 D - N k^2
//       B = A + k / (2 D) (N w - h n) + s / (2 D) (n x w)
//   foot B of A on the way to P, |AB| = a:   k = 2 a^2, for a^2 + b^2 = D
//   crossing X of the line through Q along u and that through R along v:   X = Q + ((R - Q) x v) / (u x v) u
//   slider S on Q along u, |SC| = l:   r = C - Q,  S = Q + (u . r +- sqrt(l^2 - |u x r|^2)) u,  u of length one
//   points of a group:   unknowns of the algebra, with   |Q - P|^2 - l^2 = 0,  (P - Q) x u = 0
//
// An algebra is one of core/interpret.hpp with subtract(a, b), square(a), inverse(a) and square_root(a) besides, and of
// a mechanism with groups unknown(group, k), which is asked for in order, and close(group, equations). The
// witness (numeric/geometry.hpp) and the second opinion (check/statics.cpp) place points by means of their own.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "core/interpret.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

template <class Algebra>
class Placement {
 public:
  using Number = typename Algebra::Value;
  using Vector = std::array<Number, 3>;

  /// `sides`: one a point of dyad_points. The mechanism must outlive this.
  Placement(const Mechanism& mechanism, const std::vector<int>& sides, Algebra algebra)
      : m_(mechanism), algebra_(std::move(algebra)) {
    const std::vector<PointIndex> dyads = dyad_points(m_);
    core::ensure(dyads.size() == sides.size(), "a side for every dyad");
    for (std::size_t i = 0; i < dyads.size(); ++i) sides_[dyads[i]] = sides[i];
    for (std::size_t i = 0; i < m_.points.size(); ++i) {
      points_.push_back(place(static_cast<PointIndex>(i)));
      for (std::size_t g = 0; g < m_.groups.size(); ++g)
        if (m_.groups[g].last == static_cast<PointIndex>(i)) close(g);
    }
  }

  Algebra& algebra() { return algebra_; }
  const std::vector<Vector>& points() const { return points_; }
  const Vector& point(PointIndex index) const { return points_[static_cast<std::size_t>(index)]; }

  Number expression(const Expression& e) { return core::interpret(e, algebra_); }

  Vector components(const std::vector<Expression>& expressions) {
    Vector result = {constant(0), constant(0), constant(0)};
    for (std::size_t i = 0; i < expressions.size() && i < 3; ++i) result[i] = expression(expressions[i]);
    return result;
  }

  Vector vector(const VectorExpression& v) {
    using Kind = VectorExpression::Kind;
    const auto argument = [&](std::size_t i) { return vector(v.arguments[i]); };
    switch (v.kind) {
      case Kind::components:
        return components(v.numbers);
      case Kind::point:
        return point(v.point);
      case Kind::add: {
        const Vector a = argument(0);
        return plus(a, argument(1));
      }
      case Kind::negate:
        return times(constant(-1), argument(0));
      case Kind::scale: {
        const Number factor = expression(v.numbers.at(0));
        return times(factor, argument(0));
      }
      case Kind::cross: {
        const Vector a = argument(0);
        return cross(a, argument(1));
      }
    }
    core::ensure(false, "a vector of a known kind");
    return {};
  }

  Vector plus(const Vector& a, const Vector& b) {
    return {algebra_.add(a[0], b[0]), algebra_.add(a[1], b[1]), algebra_.add(a[2], b[2])};
  }
  Vector minus(const Vector& a, const Vector& b) {
    return {algebra_.subtract(a[0], b[0]), algebra_.subtract(a[1], b[1]), algebra_.subtract(a[2], b[2])};
  }
  Vector times(const Number& factor, const Vector& a) {
    return {algebra_.multiply(factor, a[0]), algebra_.multiply(factor, a[1]), algebra_.multiply(factor, a[2])};
  }
  Vector cross(const Vector& a, const Vector& b) {
    const auto minor = [&](std::size_t i, std::size_t k) {
      const Number ahead = algebra_.multiply(a[i], b[k]);
      return algebra_.subtract(ahead, algebra_.multiply(a[k], b[i]));
    };
    const Number x = minor(1, 2), y = minor(2, 0);
    return {x, y, minor(0, 1)};
  }
  Number dot(const Vector& a, const Vector& b) {
    Number sum = constant(0);
    for (std::size_t i = 0; i < 3; ++i) sum = algebra_.add(sum, algebra_.multiply(a[i], b[i]));
    return sum;
  }
  Number length(const Vector& a) { return algebra_.square_root(dot(a, a)); }
  Vector unit(const Vector& a) { return times(algebra_.inverse(length(a)), a); }

 private:
  Number constant(const Rational& value) { return algebra_.number(value); }

  Vector place(PointIndex index) {
    const PointForm& form = m_.points[static_cast<std::size_t>(index)].form;
    if (const auto* explicit_point = std::get_if<ExplicitPoint>(&form)) return components(explicit_point->coordinates);
    if (const auto* dyad_point = std::get_if<DyadPoint>(&form)) return elbow(*dyad_point, sides_.at(index));
    if (const auto* slider_point = std::get_if<SliderPoint>(&form)) return slide(*slider_point, sides_.at(index));
    if (const auto* offset_point = std::get_if<OffsetPoint>(&form)) return beside(*offset_point);
    if (const auto* shifted_point = std::get_if<ShiftedPoint>(&form))
      return plus(point(shifted_point->from), vector(shifted_point->by));
    if (const auto* crossing_point = std::get_if<CrossingPoint>(&form)) return cross_lines(*crossing_point);
    if (const auto* group_point = std::get_if<GroupPoint>(&form)) return unknown(*group_point, index);
    const auto& mean = std::get<MeanPoint>(form);
    return times(constant(Rational(1, 2)), plus(point(mean.first), point(mean.second)));
  }

  Vector elbow(const DyadPoint& form, int side) {
    Algebra& b = algebra_;
    const Vector& base = point(form.from);
    const Vector w = minus(point(form.to), base);
    const Vector n = form.axis ? vector(*form.axis) : Vector{constant(0), constant(0), constant(1)};
    const Number crank = expression(form.from_length), rod = expression(form.to_length);
    const Number n2 = dot(n, n), h = dot(n, w), w2 = dot(w, w);
    const Number d = b.subtract(b.multiply(n2, w2), b.square(h));
    const Number sum = b.add(crank, rod), difference = b.subtract(crank, rod);
    const Number k =
        form.right_angle ? b.multiply(constant(2), b.square(crank)) : b.add(b.multiply(sum, difference), w2);
    // Across n = z, in the plane, Q is a product, which is tighter near both ends of the reach.
    const bool in_plane = !form.right_angle && n2 == constant(1) && h == constant(0);
    const Number q =
        in_plane ? b.multiply(b.subtract(b.square(sum), w2), b.subtract(w2, b.square(difference)))
                 : b.subtract(b.multiply(b.multiply(constant(4), b.square(crank)), d), b.multiply(n2, b.square(k)));
    const Number s = b.multiply(constant(side), b.square_root(q));
    const Number half = b.multiply(constant(Rational(1, 2)), b.inverse(d));
    const Vector along = minus(times(n2, w), times(h, n));
    const Vector step = plus(times(b.multiply(k, half), along), times(b.multiply(s, half), cross(n, w)));
    return plus(base, step);
  }

  Vector slide(const SliderPoint& form, int side) {
    Algebra& b = algebra_;
    const Vector& base = point(form.base);
    const Vector u = unit(vector(form.along)), r = minus(point(form.from), base), across = cross(u, r);
    const Number q = b.subtract(b.square(expression(form.length)), dot(across, across));
    const Number way = b.add(dot(u, r), b.multiply(constant(side), b.square_root(q)));
    return plus(base, times(way, u));
  }

  Vector cross_lines(const CrossingPoint& form) {
    const Vector u = vector(form.along_first), v = vector(form.along_second);
    const Number way = cross(minus(point(form.second), point(form.first)), v)[2], turn = cross(u, v)[2];
    return plus(point(form.first), times(algebra_.multiply(way, algebra_.inverse(turn)), u));
  }

  Vector unknown(const GroupPoint& form, PointIndex index) {
    const auto group = static_cast<std::size_t>(form.group);
    const auto before = static_cast<std::size_t>(index - m_.groups[group].first) * dimension(m_);
    Vector unknown = {constant(0), constant(0), constant(0)};
    for (std::size_t i = 0; i < dimension(m_); ++i) unknown[i] = algebra_.unknown(group, before + i);
    return unknown;
  }

  void close(std::size_t group) {
    std::vector<Number> equations;
    for (const Group::Distance& distance : m_.groups[group].distances) {
      const Vector way = minus(point(distance.second), point(distance.first));
      equations.push_back(algebra_.subtract(dot(way, way), algebra_.square(expression(distance.length))));
    }
    for (const Group::Line& line : m_.groups[group].lines)
      equations.push_back(cross(minus(point(line.point), point(line.base)), vector(line.along))[2]);
    algebra_.close(group, equations);
  }

  Vector beside(const OffsetPoint& form) {
    const Vector& first = point(form.first);
    const Vector u = unit(minus(point(form.second), first));
    Vector result = plus(first, times(expression(form.along), u));
    if (m_.space != Space::spatial)
      result = plus(result, times(expression(form.left), {algebra_.negate(u[1]), u[0], constant(0)}));
    return result;
  }

  const Mechanism& m_;
  std::map<PointIndex, int> sides_;
  Algebra algebra_;
  std::vector<Vector> points_;
};

}  // namespace clearloci::mechanism
