#include "symbolic/newton_euler.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::symbolic {
namespace {

using core::Quantity;
using mechanism::LinkIndex;
using mechanism::Mechanism;

using Vector = std::array<GiNaC::ex, 3>;
/// Force x, y, z and moment x, y, z about the end-effector point.
using Wrench = std::array<GiNaC::ex, 6>;

/// The components of a wrench that a link's equations state, and their names.
struct Rows {
  std::vector<std::size_t> components;
  std::vector<std::string> names;
};

Rows rows_of(const Mechanism& m) {
  if (m.space == mechanism::Space::planar) return {{0, 1, 5}, {"force x", "force y", "moment"}};
  return {{0, 1, 2, 3, 4, 5}, {"force x", "force y", "force z", "moment x", "moment y", "moment z"}};
}

Vector cross(const Vector& a, const Vector& b) {
  return {(a[1] * b[2] - a[2] * b[1]).expand(), (a[2] * b[0] - a[0] * b[2]).expand(),
          (a[0] * b[1] - a[1] * b[0]).expand()};
}

Vector as_vector(const std::vector<GiNaC::ex>& components) {
  Vector result;
  std::copy(components.begin(), components.end(), result.begin());
  return result;
}

/// From the end-effector point, about which moments are taken, to a point.
Vector arm(const Geometry& geometry, mechanism::PointIndex point) {
  const Vector& p = geometry.natural(geometry.mechanism().end_effector_point);
  const Vector& q = geometry.natural(point);
  return {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
}

Wrench force_at(const Vector& r, const Vector& force) {
  const Vector moment = cross(r, force);
  return {force[0], force[1], force[2], moment[0], moment[1], moment[2]};
}

Wrench couple(const Vector& c) { return {0, 0, 0, c[0], c[1], c[2]}; }

Vector axis_vector(std::size_t axis) {
  Vector result;
  result[axis] = 1;
  return result;
}

/// Two vectors across an axis u, v_i = u_k e_i - u_i e_k for the two i other than k. Their cross product is u_k u:
/// where u_k is no constant they fall together where it vanishes. k is across_component's.
struct AcrossBasis {
  std::array<Vector, 2> vectors;
  GiNaC::ex divisor;  ///< u_k
};

AcrossBasis across(const Geometry& geometry, const Vector& u) {
  const std::size_t k = across_component(geometry, {u.begin(), u.end()});
  AcrossBasis basis;
  basis.divisor = u[k];
  std::size_t next = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == k) continue;
    Vector& v = basis.vectors[next++];
    v[i] = u[k];
    v[k] = -u[i];
  }
  return basis;
}

/// The wrench of a unit of an unknown. Along or across an axis the unit is made of the axis itself, so that no root of
/// its length enters: there the unknown is the reaction over that length.
Wrench unit_wrench(const Geometry& geometry, const mechanism::Joint& joint, Quantity quantity) {
  const Vector r = arm(geometry, joint.at);
  const auto axis = [&](std::size_t i) { return as_vector(geometry.vector(joint.axes.at(i))); };
  switch (quantity) {
    case Quantity::fx:
      return force_at(r, axis_vector(0));
    case Quantity::fy:
      return force_at(r, axis_vector(1));
    case Quantity::fz:
      return force_at(r, axis_vector(2));
    case Quantity::mx:
      return couple(axis_vector(0));
    case Quantity::my:
      return couple(axis_vector(1));
    case Quantity::mz:
    case Quantity::M:
      return couple(axis_vector(2));
    case Quantity::T:
      if (mechanism::traits(joint).couple != mechanism::BorneCouple::cross) return couple(axis_vector(2));
      if (mechanism::holds_idle_freedom(joint)) return couple(axis(0));
      return couple(cross(axis(0), axis(1)));
    case Quantity::N:
      return force_at(r, cross(axis_vector(2), axis(0)));
    case Quantity::F:
      return force_at(r, axis(0));
    case Quantity::f1:
    case Quantity::f2:
      return force_at(r, across(geometry, axis(0)).vectors[quantity == Quantity::f1 ? 0 : 1]);
    case Quantity::m1:
    case Quantity::m2:
      return couple(across(geometry, axis(0)).vectors[quantity == Quantity::m1 ? 0 : 1]);
    case Quantity::f:
    case Quantity::end_ahead:
    case Quantity::end_behind:
      break;
  }
  core::ensure(false, "an unknown of a joint");
  return {};
}

class Equations {
 public:
  explicit Equations(const Geometry& geometry) : geometry_(geometry), m_(geometry.mechanism()), rows_(rows_of(m_)) {}

  NewtonEulerEquations write() {
    result_.unknowns = mechanism::unknowns(m_);
    const auto size = static_cast<unsigned>(m_.links.size() * rows_.components.size());
    const auto columns = static_cast<unsigned>(result_.unknowns.size());
    core::ensure(size == columns, "mechanisms whose equations are not square are not read");
    result_.matrix = GiNaC::matrix(size, columns);
    result_.loads = GiNaC::matrix(size, 1);
    for (unsigned column = 0; column < columns; ++column) write_column(column);
    for (const mechanism::Link& link : m_.links)
      for (const std::string& name : rows_.names) result_.row_names.push_back(link.name + ": " + name);
    write_loads();
    return std::move(result_);
  }

 private:
  void add(GiNaC::matrix& matrix, LinkIndex link, unsigned column, const Wrench& wrench, int sign) const {
    if (link == mechanism::ground) return;
    const auto first = static_cast<unsigned>(static_cast<std::size_t>(link) * rows_.components.size());
    for (unsigned i = 0; i < rows_.components.size(); ++i)
      matrix(first + i, column) = (matrix(first + i, column) + sign * wrench[rows_.components[i]]).expand();
  }

  void write_column(unsigned column) {
    const mechanism::Unknown& unknown = result_.unknowns[column];
    result_.unknown_names.push_back(mechanism::unknown_name(m_, unknown));
    const mechanism::Joint& joint = m_.joints[static_cast<std::size_t>(unknown.joint)];
    const Wrench wrench = unit_wrench(geometry_, joint, unknown.quantity);
    add(result_.matrix, joint.to, column, wrench, 1);
    add(result_.matrix, joint.from, column, wrench, -1);
    if (unknown.quantity == Quantity::f1 || unknown.quantity == Quantity::m1) {
      const Poly divisor = geometry_.poly(across(geometry_, as_vector(geometry_.vector(joint.axes.at(0)))).divisor);
      if (!divisor.is_constant()) result_.divisors.push_back({column, divisor});
    }
  }

  Vector components(const std::vector<core::Expression>& expressions) const {
    Vector result;
    for (std::size_t i = 0; i < expressions.size(); ++i) result[i] = geometry_.expression(expressions[i]);
    return result;
  }

  void write_loads() {
    for (const mechanism::Load& load : m_.loads) {
      Vector c = components(load.couple_vector);
      if (m_.space == mechanism::Space::planar) c[2] = geometry_.expression(load.couple);
      add(result_.loads, load.link, 0, couple(c), -1);
      if (!load.has_force()) continue;
      const Vector force = as_vector(geometry_.vector(mechanism::force_of(load)));
      add(result_.loads, load.link, 0, force_at(arm(geometry_, *load.at), force), -1);
    }
    result_.free_joints = mechanism::joints_without_preload(m_);
    for (const mechanism::Action& action : mechanism::actions(m_))
      if (!is_free(action)) write_action(action, result_.loads);
    for (const mechanism::JointIndex joint : result_.free_joints) write_effort(joint);
    if (m_.gravity.empty()) return;
    const Vector g = components(m_.gravity);
    for (const mechanism::Mass& body : mechanism::masses(m_)) {
      const GiNaC::ex mass = geometry_.expression(body.mass);
      if (mass.is_zero()) continue;
      const Vector weight = {mass * g[0], mass * g[1], mass * g[2]};
      add(result_.loads, body.link, 0, force_at(arm(geometry_, body.at), weight), -1);
    }
  }

  bool is_free(const mechanism::Action& action) const {
    const auto& free = result_.free_joints;
    return action.source == mechanism::Action::Source::actuator &&
           std::find(free.begin(), free.end(), static_cast<mechanism::JointIndex>(action.index)) != free.end();
  }

  /// What one N or N m of a free effort exerts.
  void write_effort(mechanism::JointIndex joint) {
    GiNaC::matrix& column = result_.efforts.emplace_back(result_.loads.rows(), 1);
    for (mechanism::Action action : mechanism::actions(m_)) {
      if (!is_free(action) || static_cast<mechanism::JointIndex>(action.index) != joint) continue;
      action.effort = core::Expression::number(1);
      write_action(action, column);
    }
  }

  /// What a spring or an actuator of known effort exerts on its two links (method.md section 11).
  void write_action(const mechanism::Action& action, GiNaC::matrix& loads) {
    using Law = mechanism::Action::Law;
    const auto value = [&](const core::Expression& e) { return geometry_.expression(e); };
    if (action.law == Law::torsion) {
      const GiNaC::ex size = -value(action.stiffness) * geometry_.torsion_angle(action.index).natural;
      if (m_.space == mechanism::Space::planar) return write_couple(action, loads, {0, 0, size});
      Vector c =
          as_vector(geometry_.vector(m_.joints[static_cast<std::size_t>(m_.springs[action.index].joint)].axes.at(0)));
      for (GiNaC::ex& component : c)
        component = (size * geometry_.inverse_length(action.length_name()).natural * component).expand();
      return write_couple(action, loads, c);
    }
    if (!action.along) return write_couple(action, loads, {0, 0, value(action.effort)});
    const auto inverse = [&] { return geometry_.inverse_length(action.length_name()).natural; };
    GiNaC::ex per_length;
    if (action.law == Law::constant)
      per_length = value(action.effort) * inverse();
    else if (geometry_.has_inverse_length(action.length_name()))
      per_length = value(action.stiffness) * (1 - value(action.free_length) * inverse());
    else
      per_length = value(action.stiffness);
    Vector force = as_vector(geometry_.vector(*action.along));
    for (GiNaC::ex& component : force) component = (per_length * component).expand();
    if (action.couple) return write_couple(action, loads, force);
    add(loads, action.on, 0, force_at(arm(geometry_, action.on_point), force), -1);
    add(loads, action.by, 0, force_at(arm(geometry_, action.by_point), force), 1);
  }

  void write_couple(const mechanism::Action& action, GiNaC::matrix& loads, const Vector& c) {
    add(loads, action.on, 0, couple(c), -1);
    add(loads, action.by, 0, couple(c), 1);
  }

  const Geometry& geometry_;
  const Mechanism& m_;
  Rows rows_;
  NewtonEulerEquations result_;
};

}  // namespace

std::size_t across_component(const Geometry& geometry, const std::vector<GiNaC::ex>& axis) {
  std::size_t k = 3;
  for (std::size_t i = 3; i-- > 0;)
    if (!axis[i].is_zero()) k = i;
  for (std::size_t i = 3; i-- > 0;)
    if (!axis[i].is_zero() && geometry.poly(axis[i]).is_constant()) k = i;
  core::ensure(k < 3, "an axis with a direction");
  return k;
}

NewtonEulerEquations newton_euler_equations(const Geometry& geometry) { return Equations(geometry).write(); }

}  // namespace clearloci::symbolic
