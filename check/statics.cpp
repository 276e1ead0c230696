#include "check/statics.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/errors.hpp"
#include "core/interpret.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::check {
namespace {

using core::Expression;
using core::Quantity;
using mechanism::Mechanism;
using Vector = std::array<Interval, 2>;

Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1]}; }
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1]}; }
Vector operator*(const Interval& s, const Vector& a) { return {s * a[0], s * a[1]}; }
Vector left_of(const Vector& a) { return {-a[1], a[0]}; }
Interval dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1]; }
Interval cross(const Vector& a, const Vector& b) { return a[0] * b[1] - a[1] * b[0]; }
Interval square_of(const Vector& a) { return squared(a[0]) + squared(a[1]); }

class Pose {
 public:
  Pose(const Mechanism& m, const Interval& x, const Interval& y)
      : m_(m), bits_(x.bits()), x_(outside(0, x)), y_(outside(1, y)) {}

  Interval number(double value) const { return {value, bits_}; }

  Interval value(const Expression& e) const { return core::interpret(e, *this); }

  // Expressions in the free coordinates (core/interpret.hpp): polynomials over constants.
  using Value = Interval;
  std::optional<Interval> known(const Expression& e) const {
    const std::set<std::string> names = core::symbols(e);
    const bool free = std::any_of(m_.coordinates.begin(), m_.coordinates.end(),
                                  [&](const mechanism::Coordinate& own) { return names.contains(own.name); });
    return free ? std::nullopt : std::optional(Interval(mechanism::value_of(e, m_), bits_));
  }
  Interval number(const core::Rational& own) const { return {own, bits_}; }
  Interval symbol(const std::string& name) const { return name == m_.coordinates[0].name ? x_ : y_; }
  Interval negate(const Interval& a) const { return -a; }
  Interval add(const Interval& a, const Interval& b) const { return a + b; }
  Interval multiply(const Interval& a, const Interval& b) const { return a * b; }
  Interval divide(const Interval& a, const Interval& b, const Expression&) const { return a / b; }
  Interval power(const Interval& base, const Expression& e) const {
    const core::Rational exponent = mechanism::value_of(e.arguments()[1], m_);
    if (exponent.get_den() != 1 || exponent < 0 || exponent > 64)
      throw core::InputError({m_.file}, "a power that check does not know", "");
    Interval result = number(1.0);
    for (long i = 0; i < exponent.get_num().get_si(); ++i) result = result * base;
    return result;
  }
  Interval pi() const { return refuse_function(); }
  Interval sqrt(const Interval&, const Expression&) const { return refuse_function(); }
  Interval cos(const Interval&, const Expression&) const { return refuse_function(); }
  Interval sin(const Interval&, const Expression&) const { return refuse_function(); }
  Interval atan(const Interval& a, const Expression&) const { return angle_of(a, number(1.0)); }

  Vector vector(const mechanism::VectorExpression& v, const std::vector<Vector>& points) const {
    using Kind = mechanism::VectorExpression::Kind;
    const auto argument = [&](std::size_t i) { return vector(v.arguments[i], points); };
    switch (v.kind) {
      case Kind::components:
        return {value(v.numbers.at(0)), value(v.numbers.at(1))};
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
    throw core::InputError({m_.file}, "a cross product in the plane", "");
  }

 private:
  /// A coordinate of the frame that the certificate is in as that of the model.
  Interval outside(std::size_t coordinate, const Interval& inside) const {
    if (!m_.frame || m_.frame->is_usual()) return inside;
    return number(m_.frame->from[coordinate]) + number(m_.frame->scale) * inside;
  }

  [[noreturn]] Interval refuse_function() const {
    throw core::InputError({m_.file}, "a function of a coordinate that check does not know", "");
  }

  const Mechanism& m_;
  mpfr_prec_t bits_;
  Interval x_, y_;
};

/// Places the points one by one.
class Closure {
 public:
  Closure(const Mechanism& m, const Sides& sides, const Interval& x, const Interval& y)
      : pose_(m, x, y), sides_(sides) {}

  bool place(const mechanism::Point& point) {
    return std::visit([&](const auto& form) { return place(form); }, point.form);
  }

  Posture result;

 private:
  const Vector& at(mechanism::PointIndex point) const { return result.points.at(static_cast<std::size_t>(point)); }

  bool put(Vector place) {
    result.points.push_back(std::move(place));
    return true;
  }

  bool divides(const Interval& d) {
    result.divisors.push_back(d);
    return d.sign() != 0;
  }

  /// +- sqrt(Q); none: Q < 0.
  std::optional<Interval> branch(const Interval& q) {
    result.squares.push_back(q);
    if (q.below()) return std::nullopt;
    const Interval root = root_of(q);
    return sides_.at(result.squares.size() - 1) > 0 ? root : -root;
  }

  bool place(const mechanism::ExplicitPoint& form) {
    return put({pose_.value(form.coordinates.at(0)), pose_.value(form.coordinates.at(1))});
  }

  bool place(const mechanism::MeanPoint& form) { return put(pose_.number(0.5) * (at(form.first) + at(form.second))); }

  bool place(const mechanism::DyadPoint& form) {
    const Vector way = at(form.to) - at(form.from);
    const Interval d = square_of(way);
    const Interval a2 = squared(pose_.value(form.from_length)), b2 = squared(pose_.value(form.to_length));
    const Interval k = form.right_angle ? pose_.number(2.0) * a2 : a2 - b2 + d;
    const std::optional<Interval> s = branch(pose_.number(4.0) * a2 * d - squared(k));
    if (!s || !divides(d)) return false;
    const Interval half = pose_.number(0.5) / d;
    return put(at(form.from) + (k * half) * way + (*s * half) * left_of(way));
  }

  bool place(const mechanism::SliderPoint& form) {
    const Vector u = pose_.vector(form.along, result.points), way = at(form.from) - at(form.base);
    const Interval u2 = square_of(u);
    const std::optional<Interval> s = branch(squared(pose_.value(form.length)) * u2 - squared(cross(u, way)));
    if (!s || !divides(u2)) return false;
    return put(at(form.base) + ((dot(u, way) + *s) / u2) * u);
  }

  bool place(const mechanism::ShiftedPoint& form) { return put(at(form.from) + pose_.vector(form.by, result.points)); }

  bool place(const mechanism::CrossingPoint& form) {
    const Vector u = pose_.vector(form.along_first, result.points), v = pose_.vector(form.along_second, result.points);
    const Interval turn = cross(u, v);
    if (!divides(turn)) return false;
    return put(at(form.first) + (cross(at(form.second) - at(form.first), v) / turn) * u);
  }

  bool place(const mechanism::GroupPoint&) {
    throw core::InputError({}, "a certificate is of points with closed forms, and some of these close together", "");
  }

  bool place(const mechanism::OffsetPoint& form) {
    const Vector way = at(form.second) - at(form.first);
    const Interval d = square_of(way);
    if (!divides(d)) return false;
    const Interval length = root_of(d);
    return put(at(form.first) + (pose_.value(form.along) / length) * way +
               (pose_.value(form.left) / length) * left_of(way));
  }

  Pose pose_;
  const Sides& sides_;
};

/// A way at angle - rest of a torsion spring, from the direction of the first two points of `from` (the ground: x) to
/// that of `to`.
Vector off_rest(const Mechanism& m, const Pose& pose, const Posture& posture, const mechanism::Spring& spring) {
  const auto direction = [&](mechanism::LinkIndex link) -> Vector {
    if (link == mechanism::ground) return {pose.number(1), pose.number(0)};
    const auto& points = m.links.at(static_cast<std::size_t>(link)).points;
    const auto at = [&](std::size_t i) { return posture.points.at(static_cast<std::size_t>(points.at(i))); };
    return at(1) - at(0);
  };
  const auto of_rest = [&](Expression::Kind function) {
    return pose.value(Expression::apply(function, {spring.rest}));
  };
  const Interval c = of_rest(Expression::Kind::cos), s = of_rest(Expression::Kind::sin);
  const Vector a = direction(spring.from), b = direction(spring.to), rest = c * a + s * left_of(a);
  return {dot(rest, b), cross(rest, b)};
}

/// Its force is k v, whatever the length of v.
bool has_no_free_length(const Pose& pose, const mechanism::Spring& spring) {
  if (spring.kind != mechanism::Spring::Kind::linear) return false;
  const Interval l0 = pose.value(spring.free_length);
  return l0.lower() == 0 && l0.upper() == 0;
}

/// The matrix of the equations with the column -w_e behind it.
class Equations {
 public:
  Equations(const Mechanism& m, const Posture& posture, const Interval& x, const Interval& y)
      : m_(m), posture_(posture), pose_(m, x, y), unknowns_(mechanism::unknowns(m)) {
    rows.assign(3 * m.links.size(), std::vector<Interval>(unknowns_.size() + 1, Interval(x.bits())));
    core::ensure(rows.size() == unknowns_.size(), "mechanisms whose equations are not square are not read");
    for (std::size_t k = 0; k < unknowns_.size(); ++k) write_unknown(k);
    write_loads();
  }

  std::vector<std::vector<Interval>> rows;

 private:
  using Wrench = std::array<Interval, 3>;

  Vector arm(mechanism::PointIndex point) const {
    return posture_.points.at(static_cast<std::size_t>(point)) -
           posture_.points.at(static_cast<std::size_t>(m_.end_effector_point));
  }
  Wrench force_at(mechanism::PointIndex point, const Vector& force) const {
    return {force[0], force[1], cross(arm(point), force)};
  }
  Wrench couple(const Interval& moment) const { return {pose_.number(0.0), pose_.number(0.0), moment}; }

  void add(mechanism::LinkIndex link, std::size_t column, const Wrench& wrench, int sign) {
    if (link == mechanism::ground) return;
    for (std::size_t i = 0; i < 3; ++i) {
      Interval& entry = rows[3 * static_cast<std::size_t>(link) + i][column];
      entry = sign > 0 ? entry + wrench[i] : entry - wrench[i];
    }
  }

  Wrench unit(const mechanism::Joint& joint, Quantity quantity) const {
    switch (quantity) {
      case Quantity::fx:
        return force_at(joint.at, {pose_.number(1.0), pose_.number(0.0)});
      case Quantity::fy:
        return force_at(joint.at, {pose_.number(0.0), pose_.number(1.0)});
      case Quantity::M:
      case Quantity::T:
        return couple(pose_.number(1.0));
      case Quantity::N:
        return force_at(joint.at, left_of(pose_.vector(joint.axes.at(0), posture_.points)));
      case Quantity::F:
        return force_at(joint.at, pose_.vector(joint.axes.at(0), posture_.points));
      default:
        throw core::InputError({m_.file}, "a reaction that check does not know", "");
    }
  }

  void write_unknown(std::size_t k) {
    const mechanism::Joint& joint = m_.joints.at(static_cast<std::size_t>(unknowns_[k].joint));
    const Wrench wrench = unit(joint, unknowns_[k].quantity);
    add(joint.to, k, wrench, 1);
    add(joint.from, k, wrench, -1);
  }

  void write_loads() {
    const std::size_t last = unknowns_.size();
    for (const mechanism::Load& load : m_.loads) {
      add(load.link, last, couple(pose_.value(load.couple)), -1);
      if (load.force_vector)
        add(load.link, last, force_at(*load.at, pose_.vector(*load.force_vector, posture_.points)), -1);
      else if (!load.force.empty())
        add(load.link, last, force_at(*load.at, {pose_.value(load.force.at(0)), pose_.value(load.force.at(1))}), -1);
    }
    for (const mechanism::Spring& spring : m_.springs) write_spring(spring);
    for (const mechanism::Joint& joint : m_.joints)
      if (joint.effort) write_effort(joint);
    if (m_.gravity.empty()) return;
    const Vector g = {pose_.value(m_.gravity.at(0)), pose_.value(m_.gravity.at(1))};
    for (std::size_t i = 0; i < m_.links.size(); ++i) {
      const mechanism::Link& link = m_.links[i];
      const auto index = static_cast<mechanism::LinkIndex>(i);
      add(index, last, force_at(link.centre_of_mass, pose_.value(link.mass) * g), -1);
      for (const mechanism::PointMass& point : link.masses)
        add(index, last, force_at(point.at, pose_.value(point.mass) * g), -1);
    }
  }

  /// k v - k l0 v / |v| on the first end, v the way to the second one; F v / |v| of a constant force.
  void write_spring(const mechanism::Spring& spring) {
    const std::size_t last = unknowns_.size();
    if (spring.kind == mechanism::Spring::Kind::torsion) {
      const Vector way = off_rest(m_, pose_, posture_, spring);
      const Wrench back = couple(pose_.value(spring.stiffness) * angle_of(way[1], way[0]));
      add(spring.to, last, back, 1);
      add(spring.from, last, back, -1);
      return;
    }
    const Vector v = arm(spring.to_point) - arm(spring.from_point);
    const bool linear = spring.kind == mechanism::Spring::Kind::linear;
    const Interval k = pose_.value(spring.stiffness), l0 = pose_.value(spring.free_length);
    const Interval per_length = has_no_free_length(pose_, spring) ? k
                                : linear                          ? k - k * l0 / root_of(square_of(v))
                                                                  : pose_.value(spring.force) / root_of(square_of(v));
    add(spring.from, last, force_at(spring.from_point, per_length * v), -1);
    add(spring.to, last, force_at(spring.to_point, per_length * v), 1);
  }

  void write_effort(const mechanism::Joint& joint) {
    Wrench wrench = couple(pose_.value(*joint.effort));
    if (!joint.axes.empty()) {
      const Vector u = pose_.vector(joint.axes.at(0), posture_.points);
      wrench = force_at(joint.at, (pose_.value(*joint.effort) / root_of(square_of(u))) * u);
    }
    add(joint.to, unknowns_.size(), wrench, -1);
    add(joint.from, unknowns_.size(), wrench, 1);
  }

  const Mechanism& m_;
  const Posture& posture_;
  Pose pose_;
  std::vector<mechanism::Unknown> unknowns_;
};

/// (N + T/h)/2 and (N - T/h)/2. The unknown N is the normal force over the length of the axis.
void add_guide_ends(const Mechanism& m, const Posture& posture, const Interval& x, const Interval& y,
                    Solution& solution) {
  const Pose pose(m, x, y);
  const std::vector<mechanism::Unknown> unknowns = mechanism::unknowns(m);
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    const mechanism::Joint& joint = m.joints[j];
    if (!mechanism::has_guide_ends(m, joint)) continue;
    const Interval length = root_of(square_of(pose.vector(joint.axes.at(0), posture.points)));
    const Interval h = pose.value(joint.clearance->half_length);
    Interval normal = pose.number(0.0), tilt = pose.number(0.0);
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      if (unknowns[k].joint != static_cast<int>(j)) continue;
      if (unknowns[k].quantity == Quantity::N) normal = solution.reactions[k] * length;
      if (unknowns[k].quantity == Quantity::T) tilt = solution.reactions[k] / h;
    }
    for (const auto& [end, sign] : mechanism::guide_end_signs)
      solution.reactions.push_back(pose.number(0.5) * (sign > 0 ? normal + tilt : normal - tilt));
  }
}

/// What is left to half a turn off the rest, in the cosine.
void add_reach(const Mechanism& m, const mechanism::Spring& spring, const Pose& pose, Posture& posture) {
  const Vector way = off_rest(m, pose, posture, spring);
  const Interval least = pose.value(Expression::number(mechanism::least_torsion_cosine()));
  posture.squares.push_back(way[0] / root_of(square_of(way)) - least);
}

/// l^2 - |B - A|^2 and so on (docs/mechanism-file.md); of an angle in its cosine. False: a way may have no length.
bool add_limit(const mechanism::Limit& limit, const Pose& pose, Posture& posture) {
  const auto at = [&](std::size_t i) { return posture.points.at(static_cast<std::size_t>(limit.points.at(i))); };
  if (!limit.is_angle()) {
    const Interval square = square_of(at(1) - at(0));
    if (limit.keeps_lower()) posture.squares.push_back(square - squared(pose.value(limit.lower)));
    posture.squares.push_back(squared(pose.value(limit.upper)) - square);
    return true;
  }
  const Vector a = at(0) - at(1), b = at(2) - at(1);
  const auto cosine_of = [&](const Expression& angle) {
    return pose.value(Expression::apply(Expression::Kind::cos, {angle}));
  };
  for (const Interval& divisor : {square_of(a), square_of(b)}) {
    posture.divisors.push_back(divisor);
    if (divisor.sign() == 0) return false;
  }
  const Interval cosine = dot(a, b) / (root_of(square_of(a)) * root_of(square_of(b)));
  if (limit.keeps_lower()) posture.squares.push_back(cosine_of(limit.lower) - cosine);
  if (limit.keeps_upper()) posture.squares.push_back(cosine - cosine_of(limit.upper));
  return true;
}

}  // namespace

std::optional<Posture> posture(const Mechanism& m, const Sides& sides, const Interval& x, const Interval& y) {
  Closure closure(m, sides, x, y);
  for (const mechanism::Point& point : m.points)
    if (!closure.place(point)) return std::nullopt;
  const Pose pose(m, x, y);
  for (const mechanism::Spring& spring : m.springs) {
    if (spring.kind == mechanism::Spring::Kind::torsion || has_no_free_length(pose, spring)) continue;
    const auto at = [&](mechanism::PointIndex point) {
      return closure.result.points.at(static_cast<std::size_t>(point));
    };
    closure.result.divisors.push_back(square_of(at(spring.to_point) - at(spring.from_point)));
    if (closure.result.divisors.back().sign() == 0) return std::nullopt;
  }
  const std::size_t before = closure.result.squares.size();
  for (const mechanism::Limit& limit : m.limits)
    if (!add_limit(limit, pose, closure.result)) return std::nullopt;
  for (const mechanism::Spring& spring : m.springs)
    if (spring.kind == mechanism::Spring::Kind::torsion) add_reach(m, spring, pose, closure.result);
  for (std::size_t j = before; j < closure.result.squares.size(); ++j)
    if (closure.result.squares[j].below()) return std::nullopt;
  for (const mechanism::Joint& joint : m.joints)
    if (mechanism::traits(joint).slides)
      closure.result.divisors.push_back(square_of(pose.vector(joint.axes.at(0), closure.result.points)));
  return std::move(closure.result);
}

std::size_t limit_ends(const Mechanism& m) {
  std::size_t count = 0;
  for (const mechanism::Spring& spring : m.springs) count += spring.kind == mechanism::Spring::Kind::torsion ? 1U : 0U;
  for (const mechanism::Limit& limit : m.limits)
    count += (limit.keeps_lower() ? 1U : 0U) + (limit.keeps_upper() ? 1U : 0U);
  return count;
}

std::vector<mechanism::Unknown> reactions_of(const Mechanism& m) {
  std::vector<mechanism::Unknown> list = mechanism::unknowns(m);
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (mechanism::has_guide_ends(m, m.joints[j]))
      for (const auto& [end, sign] : mechanism::guide_end_signs) list.push_back({static_cast<int>(j), end});
  return list;
}

std::optional<Solution> solve(const Mechanism& m, const Posture& posture, const Interval& x, const Interval& y) {
  auto rows = Equations(m, posture, x, y).rows;
  const std::size_t n = rows.size();
  Solution solution{{}, Interval(1.0, x.bits())};
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    double best = 0;
    for (std::size_t i = k; i < n; ++i)
      if (rows[i][k].sign() != 0 && std::abs(rows[i][k].middle()) > best) {
        best = std::abs(rows[i][k].middle());
        pivot = i;
      }
    if (rows[pivot][k].sign() == 0) return std::nullopt;
    if (pivot != k) {
      std::swap(rows[pivot], rows[k]);
      solution.determinant = -solution.determinant;
    }
    solution.determinant = solution.determinant * rows[k][k];
    for (std::size_t i = k + 1; i < n; ++i) {
      if (rows[i][k].lower() == 0 && rows[i][k].upper() == 0) continue;
      const Interval factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k + 1; j <= n; ++j) rows[i][j] = rows[i][j] - factor * rows[k][j];
    }
  }
  solution.reactions.assign(n, Interval(x.bits()));
  for (std::size_t k = n; k-- > 0;) {
    Interval sum = rows[k][n];
    for (std::size_t j = k + 1; j < n; ++j) sum = sum - rows[k][j] * solution.reactions[j];
    solution.reactions[k] = sum / rows[k][k];
  }
  add_guide_ends(m, posture, x, y, solution);
  return solution;
}

}  // namespace clearloci::check
