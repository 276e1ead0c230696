#include "numeric/geometry.hpp"

#include "core/errors.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::numeric {

using mechanism::Space;

Geometry::Geometry(const mechanism::Mechanism& mechanism)
    : m_(mechanism), named_(mechanism), tape_(named_.builder()), zero_(tape_.constant(0.0)), one_(tape_.constant(1.0)) {
  groups_.resize(m_.groups.size());
  for (std::size_t i = 0; i < m_.points.size(); ++i) {
    points_.push_back(place(static_cast<mechanism::PointIndex>(i)));
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (m_.groups[g].last == static_cast<mechanism::PointIndex>(i)) close(m_.groups[g], groups_[g]);
  }
  for (const mechanism::Joint& joint : m_.joints) add_axes(joint);
}

Triple Geometry::components(const std::vector<core::Expression>& expressions) {
  Triple result = {zero_, zero_, zero_};
  for (std::size_t c = 0; c < expressions.size(); ++c) result[c] = compile(expressions[c]);
  return result;
}

Triple Geometry::direction(std::size_t component) const {
  Triple e = {zero_, zero_, zero_};
  e[component] = one_;
  return e;
}

Triple Geometry::direction_of(mechanism::LinkIndex link) {
  if (link == mechanism::ground) return direction(0);
  const auto& points = m_.links[static_cast<std::size_t>(link)].points;
  return minus(point(points.at(1)), point(points.at(0)));
}

Triple Geometry::plus(const Triple& a, const Triple& b) {
  return {tape_.add(a[0], b[0]), tape_.add(a[1], b[1]), tape_.add(a[2], b[2])};
}

Triple Geometry::minus(const Triple& a, const Triple& b) {
  return {tape_.subtract(a[0], b[0]), tape_.subtract(a[1], b[1]), tape_.subtract(a[2], b[2])};
}

Triple Geometry::times(Register s, const Triple& a) {
  return {tape_.multiply(s, a[0]), tape_.multiply(s, a[1]), tape_.multiply(s, a[2])};
}

Triple Geometry::negative(const Triple& a) { return {tape_.negate(a[0]), tape_.negate(a[1]), tape_.negate(a[2])}; }

Triple Geometry::cross(const Triple& a, const Triple& b) {
  const auto minor = [&](std::size_t i, std::size_t k) {
    return tape_.subtract(tape_.multiply(a[i], b[k]), tape_.multiply(a[k], b[i]));
  };
  const Register x = minor(1, 2), y = minor(2, 0);
  return {x, y, minor(0, 1)};
}

Register Geometry::dot(const Triple& a, const Triple& b) {
  return tape_.add(tape_.add(tape_.multiply(a[0], b[0]), tape_.multiply(a[1], b[1])), tape_.multiply(a[2], b[2]));
}

Register Geometry::length(const Triple& a) { return tape_.sqrt(dot(a, a)); }

Triple Geometry::unit(const Triple& a) {
  const Register register_index = length(a);
  const auto part = [&](Register c) { return tape_.is_exactly(c, 0) ? zero_ : tape_.divide(c, register_index); };
  return {part(a[0]), part(a[1]), part(a[2])};
}

Triple Geometry::place(mechanism::PointIndex index) {
  const mechanism::PointForm& form = m_.points[static_cast<std::size_t>(index)].form;
  if (const auto* e = std::get_if<mechanism::ExplicitPoint>(&form)) return components(e->coordinates);
  if (const auto* d = std::get_if<mechanism::DyadPoint>(&form)) return dyad(*d, named_.sign_of(index));
  if (const auto* s = std::get_if<mechanism::SliderPoint>(&form)) return slider(*s, named_.sign_of(index));
  if (const auto* o = std::get_if<mechanism::OffsetPoint>(&form)) return offset(*o);
  if (const auto* s = std::get_if<mechanism::ShiftedPoint>(&form)) return plus(point(s->from), vector(s->by));
  if (const auto* c = std::get_if<mechanism::CrossingPoint>(&form)) return crossing(*c);
  if (const auto* g = std::get_if<mechanism::GroupPoint>(&form)) return unknown(*g);
  const auto& mean = std::get<mechanism::MeanPoint>(form);
  return times(tape_.constant(0.5), plus(point(mean.first), point(mean.second)));
}

/// first + along u + left k × u, u from first to second; k × u in the plane alone.
Triple Geometry::offset(const mechanism::OffsetPoint& form) {
  const Triple u = unit(minus(point(form.second), point(form.first)));
  Triple way = times(compile(form.along), u);
  if (m_.space == Space::planar) way = plus(way, times(compile(form.left), cross(direction(2), u)));
  return plus(point(form.first), way);
}

/// The circle of radius a about A across the axis n meets the sphere of radius b about P. In the circle's plane P is
/// seen at r, h off that plane, and b' off the elbow, b'² = b² - h²:
///     B = A + (k r ± s n × r) / (2 D),   D = r²,   k = a² - b'² + D,   s² = 4 a² D - k²
/// with s² written as ((a + b')² - D)(D - (a - b')²), which loses no digits at either end of the reach. In the plane n
/// is k, h is 0 and the law is that of method.md section 1.
Triple Geometry::dyad(const mechanism::DyadPoint& form, Register sign) {
  auto& t = tape_;
  const Triple way = minus(point(form.to), point(form.from));
  const Triple n = form.axis ? unit(vector(*form.axis)) : direction(2);
  const Register a = compile(form.from_length), b = compile(form.to_length);
  const Register h = dot(n, way);
  const bool in_plane = t.is_exactly(h, 0);
  const Triple r = in_plane ? way : minus(way, times(h, n));
  const Register D = dot(r, r);
  Register seen = in_plane ? b : t.sqrt(t.multiply(t.subtract(b, h), t.add(b, h)));
  if (form.right_angle) seen = t.sqrt(t.subtract(D, t.square(a)));  // b² = D - a²
  const Register sum = t.add(a, seen), difference = t.subtract(a, seen);
  const Register Q = t.multiply(t.subtract(t.square(sum), D), t.subtract(D, t.square(difference)));
  const Register k = t.add(t.multiply(sum, difference), D);
  const Register s = t.multiply(sign, t.sqrt(Q));
  const Register twice_D = t.add(D, D);
  return plus(point(form.from), plus(times(t.divide(k, twice_D), r), times(t.divide(s, twice_D), cross(n, r))));
}

/// With the unit vector u of the line and r = C - Q:
///     S = Q + (r · u ± sqrt(l² - |r × u|²)) u
/// one component of r × u with l² as a product, which loses no digits at the end of the reach; in the plane it has one.
Triple Geometry::slider(const mechanism::SliderPoint& form, Register sign) {
  auto& t = tape_;
  const Triple u = unit(vector(form.along));
  const Triple r = minus(point(form.from), point(form.base));
  const Triple across = cross(r, u);
  const Register l = compile(form.length);
  Register square = t.multiply(t.subtract(l, across[2]), t.add(l, across[2]));
  for (const std::size_t c : {0u, 1u}) square = t.subtract(square, t.square(across[c]));
  return plus(point(form.base), times(t.add(dot(r, u), t.multiply(sign, t.sqrt(square))), u));
}

/// X = Q + t u with (X - R) x v = 0:  t = ((R - Q) x v) / (u x v).
Triple Geometry::crossing(const mechanism::CrossingPoint& form) {
  const Triple u = vector(form.along_first), v = vector(form.along_second);
  const Triple way = minus(point(form.second), point(form.first));
  return plus(point(form.first), times(tape_.divide(cross(way, v)[2], cross(u, v)[2]), u));
}

Triple Geometry::unknown(const mechanism::GroupPoint& form) {
  int input = named_.first_unknown();
  for (const GroupBlock& block : groups_) input += static_cast<int>(block.unknowns.size());
  GroupBlock& block = groups_[static_cast<std::size_t>(form.group)];
  if (block.unknowns.empty()) {
    block.first_input = input;
    block.begin = tape_.size();
  }
  Triple place = {zero_, zero_, zero_};
  for (std::size_t c = 0; c < mechanism::dimension(m_); ++c) block.unknowns.push_back(place[c] = tape_.input(input++));
  return place;
}

/// |Q - P|² - l² of every distance, in the plane the moment of u about P from the line through Q along u; in the order
/// of the unknowns' equations of mechanism.hpp.
void Geometry::close(const mechanism::Group& group, GroupBlock& block) {
  for (const mechanism::Group::Distance& distance : group.distances) {
    const Triple way = minus(point(distance.second), point(distance.first));
    block.equations.push_back(tape_.subtract(dot(way, way), tape_.square(compile(distance.length))));
  }
  for (const mechanism::Group::Line& line : group.lines)
    block.equations.push_back(cross(minus(point(line.point), point(line.base)), vector(line.along))[2]);
  for (const Register g : block.equations)
    for (const Register u : block.unknowns) block.jacobian.push_back(tape_.derivative(g, u));
  block.end = tape_.size();
}

Triple Geometry::vector(const mechanism::VectorExpression& v) {
  using Kind = mechanism::VectorExpression::Kind;
  std::vector<Triple> a;
  for (const auto& argument : v.arguments) a.push_back(vector(argument));
  switch (v.kind) {
    case Kind::components:
      return components(v.numbers);
    case Kind::point:
      return point(v.point);
    case Kind::add:
      return plus(a[0], a[1]);
    case Kind::negate:
      return negative(a[0]);
    case Kind::scale:
      return times(compile(v.numbers.at(0)), a[0]);
    case Kind::cross:
      return cross(a[0], a[1]);
  }
  return {};
}

void Geometry::add_axes(const mechanism::Joint& joint) {
  const mechanism::JointTraits& traits = mechanism::traits(joint);
  const bool written = !joint.axes.empty(), planar = m_.space == Space::planar;
  ways_.push_back(written ? vector(joint.axes.front()) : direction(0));
  axes_.emplace_back();
  couple_axes_.emplace_back();
  if (written)
    axes_.back() = unit(ways_.back());
  else if (planar)
    axes_.back() = direction(2);
  if (planar && traits.slides) couple_axes_.back() = direction(2);
  if (!planar && traits.couple == mechanism::BorneCouple::cross)
    couple_axes_.back() =
        mechanism::holds_idle_freedom(joint) ? *axes_.back() : unit(cross(ways_.back(), vector(joint.axes.at(1))));
}

}  // namespace clearloci::numeric
