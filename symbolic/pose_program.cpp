#include "symbolic/pose_program.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"

namespace clearloci::symbolic {
namespace {

using core::Expression;
using core::Rational;
using mechanism::Mechanism;

}  // namespace

PosePoints::PosePoints(const Mechanism& mechanism, const std::vector<int>& sides) : m_(mechanism) {
  const std::vector<mechanism::PointIndex> dyads = mechanism::dyad_points(m_);
  core::ensure(dyads.size() == sides.size(), "a side for every dyad");
  for (std::size_t i = 0; i < dyads.size(); ++i) sides_[dyads[i]] = sides[i];
  for (std::size_t c = 0; c < m_.coordinates.size(); ++c)
    symbols_[m_.coordinates[c].name] = builder_.coordinate(static_cast<int>(c));
  for (std::size_t i = 0; i < m_.points.size(); ++i) points_.push_back(place(static_cast<int>(i)));
}

int PosePoints::expression(const Expression& e) {
  using Kind = Expression::Kind;
  const auto argument = [&](std::size_t i) { return expression(e.arguments()[i]); };
  switch (e.kind()) {
    case Kind::number:
      return builder_.constant(e.value());
    case Kind::pi:
      return builder_.pi();
    case Kind::symbol: {
      if (const auto known = symbols_.find(e.name()); known != symbols_.end()) return known->second;
      const auto own = std::find_if(m_.parameters.begin(), m_.parameters.end(),
                                    [&](const mechanism::Parameter& p) { return p.name == e.name(); });
      core::ensure(own != m_.parameters.end(), "a symbol is a coordinate or a parameter");
      // A parameter whose value is rational is that number, whatever roots it was written with.
      const int step = own->exact ? builder_.constant(own->value) : expression(own->expression);
      symbols_[e.name()] = step;
      return step;
    }
    case Kind::add: {
      const int a = argument(0);
      return builder_.add(a, argument(1));
    }
    case Kind::multiply: {
      const int a = argument(0);
      return builder_.multiply(a, argument(1));
    }
    case Kind::divide: {
      const int a = argument(0);
      return builder_.divide(a, argument(1));
    }
    case Kind::negate:
      return builder_.negate(argument(0));
    case Kind::power:
      return power(e.arguments()[0], e.arguments()[1]);
    case Kind::sqrt:
      return exact(e, builder_.square_root(argument(0)));
    case Kind::cos:
      return exact(e, builder_.cosine(argument(0)));
    case Kind::sin:
      return exact(e, builder_.sine(argument(0)));
  }
  core::ensure(false, "an expression of a known kind");
  return 0;
}

/// The step, or the rational number that it is: cos(90 deg) is 0.
int PosePoints::exact(const Expression& e, int step) {
  if (builder_.is_number(step) || builder_.varies(step)) return step;
  const mechanism::ExactValue own = mechanism::evaluate(e, m_.parameters);
  return own.exact ? builder_.constant(own.value) : step;
}

int PosePoints::power(const Expression& base, const Expression& exponent) {
  const Rational own = mechanism::value_of(exponent, m_), twice = 2 * own;
  core::ensure(twice.get_den() == 1, "exponents are whole or half of one");
  const bool whole = own.get_den() == 1;
  const Rational counted = abs(whole ? own : twice);
  const long size = counted.get_num().get_si();
  const int root = whole ? expression(base) : builder_.square_root(expression(base));
  const int raised = builder_.power(root, static_cast<int>(size));
  return own < 0 ? builder_.inverse(raised) : raised;
}

PosePoints::Vector PosePoints::components(const std::vector<Expression>& expressions) {
  Vector result = {builder_.zero(), builder_.zero(), builder_.zero()};
  for (std::size_t i = 0; i < expressions.size() && i < 3; ++i) result[i] = expression(expressions[i]);
  return result;
}

PosePoints::Vector PosePoints::plus(const Vector& a, const Vector& b) {
  return {builder_.add(a[0], b[0]), builder_.add(a[1], b[1]), builder_.add(a[2], b[2])};
}

PosePoints::Vector PosePoints::minus(const Vector& a, const Vector& b) {
  return {builder_.subtract(a[0], b[0]), builder_.subtract(a[1], b[1]), builder_.subtract(a[2], b[2])};
}

PosePoints::Vector PosePoints::times(int factor, const Vector& a) {
  return {builder_.multiply(factor, a[0]), builder_.multiply(factor, a[1]), builder_.multiply(factor, a[2])};
}

PosePoints::Vector PosePoints::cross(const Vector& a, const Vector& b) {
  const auto minor = [&](std::size_t i, std::size_t k) {
    const int ahead = builder_.multiply(a[i], b[k]);
    return builder_.subtract(ahead, builder_.multiply(a[k], b[i]));
  };
  const int x = minor(1, 2), y = minor(2, 0);
  return {x, y, minor(0, 1)};
}

int PosePoints::dot(const Vector& a, const Vector& b) {
  int sum = builder_.zero();
  for (std::size_t i = 0; i < 3; ++i) sum = builder_.add(sum, builder_.multiply(a[i], b[i]));
  return sum;
}

PosePoints::Vector PosePoints::vector(const mechanism::VectorExpression& v) {
  using Kind = mechanism::VectorExpression::Kind;
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
      return times(builder_.constant(-1), argument(0));
    case Kind::scale: {
      const int factor = expression(v.numbers.at(0));
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

PosePoints::Vector PosePoints::place(mechanism::PointIndex index) {
  const mechanism::PointForm& form = m_.points[static_cast<std::size_t>(index)].form;
  if (const auto* own = std::get_if<mechanism::ExplicitPoint>(&form)) return components(own->coordinates);
  if (const auto* own = std::get_if<mechanism::DyadPoint>(&form)) return elbow(*own, sides_.at(index));
  if (const auto* own = std::get_if<mechanism::SliderPoint>(&form)) return slide(*own, sides_.at(index));
  if (const auto* own = std::get_if<mechanism::OffsetPoint>(&form)) return beside(*own);
  const auto& mean = std::get<mechanism::MeanPoint>(form);
  return times(builder_.constant(Rational(1, 2)), plus(point(mean.first), point(mean.second)));
}

PosePoints::Vector PosePoints::elbow(const mechanism::DyadPoint& form, int side) {
  auto& b = builder_;
  const Vector& base = point(form.from);
  const Vector w = minus(point(form.to), base);
  const Vector n = form.axis ? vector(*form.axis) : Vector{b.zero(), b.zero(), b.one()};
  const int crank = expression(form.from_length), rod = expression(form.to_length);
  const int n2 = dot(n, n), h = dot(n, w), w2 = dot(w, w);
  const int d = b.subtract(b.multiply(n2, w2), b.square(h));
  const int sum = b.add(crank, rod), difference = b.subtract(crank, rod);
  const int k = b.add(b.multiply(sum, difference), w2);
  // Across n = z, in the plane, Q is a product, which is tighter near both ends of the reach.
  const bool in_plane = n2 == b.one() && h == b.zero();
  const int q =
      in_plane ? b.multiply(b.subtract(b.square(sum), w2), b.subtract(w2, b.square(difference)))
               : b.subtract(b.multiply(b.multiply(b.constant(4), b.square(crank)), d), b.multiply(n2, b.square(k)));
  const int s = b.multiply(b.constant(side), b.square_root(q));
  const int half = b.multiply(b.constant(Rational(1, 2)), b.inverse(d));
  const Vector along = minus(times(n2, w), times(h, n));
  const Vector step = plus(times(b.multiply(k, half), along), times(b.multiply(s, half), cross(n, w)));
  return plus(base, step);
}

PosePoints::Vector PosePoints::slide(const mechanism::SliderPoint& form, int side) {
  auto& b = builder_;
  const Vector& base = point(form.base);
  const Vector u = unit(vector(form.along)), r = minus(point(form.from), base), across = cross(u, r);
  const int q = b.subtract(b.square(expression(form.length)), dot(across, across));
  const int way = b.add(dot(u, r), b.multiply(b.constant(side), b.square_root(q)));
  return plus(base, times(way, u));
}

PosePoints::Vector PosePoints::beside(const mechanism::OffsetPoint& form) {
  auto& b = builder_;
  const Vector& first = point(form.first);
  const Vector u = unit(minus(point(form.second), first));
  const Vector along = plus(first, times(expression(form.along), u));
  if (m_.space == mechanism::Space::spatial) return along;
  return plus(along, times(expression(form.left), {b.negate(u[1]), u[0], b.zero()}));
}

}  // namespace clearloci::symbolic
