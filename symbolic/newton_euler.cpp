#include "symbolic/newton_euler.hpp"

#include "core/errors.hpp"

namespace clearloci::symbolic {
namespace {

using mechanism::LinkIndex;
using mechanism::Mechanism;

constexpr unsigned rows_per_link = 3;

unsigned row(LinkIndex link, unsigned component) { return static_cast<unsigned>(link) * rows_per_link + component; }

using Vector = std::array<GiNaC::ex, 2>;

/// From the end-effector point, about which moments are taken, to a point.
Vector arm(const Geometry& geometry, mechanism::PointIndex point) {
  const Vector& p = geometry.natural(geometry.mechanism().end_effector_point);
  const Vector& q = geometry.natural(point);
  return {q[0] - p[0], q[1] - p[1]};
}

/// Force x, y and moment about the end-effector point.
using Wrench = std::array<GiNaC::ex, rows_per_link>;

Wrench at_point(const Vector& r, const Vector& force) {
  return {force[0], force[1], r[0] * force[1] - r[1] * force[0]};
}

/// The wrench of a unit of an unknown. Along or across an axis the unit is the axis itself, B - A, so that no root of
/// its length enters: there the unknown is the reaction over |B - A|.
Wrench unit_wrench(const Geometry& geometry, const mechanism::Joint& joint, core::Quantity quantity) {
  using core::Quantity;
  const Vector r = arm(geometry, joint.at);
  if (quantity == Quantity::fx) return at_point(r, {1, 0});
  if (quantity == Quantity::fy) return at_point(r, {0, 1});
  if (quantity == Quantity::M || quantity == Quantity::T) return {0, 0, 1};
  const std::vector<GiNaC::ex> axis = geometry.vector(joint.axes.at(0));
  if (quantity == Quantity::F) return at_point(r, {axis[0], axis[1]});
  core::ensure(quantity == Quantity::N, "an unknown of a planar joint");
  return at_point(r, {-axis[1], axis[0]});
}

void add_force(GiNaC::matrix& column, LinkIndex link, const Vector& r, const Vector& force, const GiNaC::ex& sign) {
  column(row(link, 0), 0) += sign * force[0];
  column(row(link, 1), 0) += sign * force[1];
  column(row(link, 2), 0) += sign * (r[0] * force[1] - r[1] * force[0]);
}

}  // namespace

NewtonEulerEquations newton_euler_equations(const Geometry& geometry) {
  const Mechanism& m = geometry.mechanism();
  NewtonEulerEquations equations;
  equations.unknowns = mechanism::unknowns(m);
  const unsigned rows = static_cast<unsigned>(m.links.size()) * rows_per_link;
  const unsigned columns = static_cast<unsigned>(equations.unknowns.size());
  if (rows != columns) {
    throw core::InputError({m.file},
                           "the equations are not square: " + std::to_string(columns) + " unknown reactions, " +
                               std::to_string(rows) + " equations (" + std::to_string(m.links.size()) + " links)",
                           columns > rows ? "remove constraints or actuators: the mechanism is over-constrained"
                                          : "add actuators or joints: the mechanism is under-actuated");
  }
  equations.matrix = GiNaC::matrix(rows, columns);
  for (unsigned column = 0; column < columns; ++column) {
    const mechanism::Unknown& unknown = equations.unknowns[column];
    equations.unknown_names.push_back(mechanism::unknown_name(m, unknown));
    const mechanism::Joint& joint = m.joints[static_cast<std::size_t>(unknown.joint)];
    const Wrench wrench = unit_wrench(geometry, joint, unknown.quantity);
    for (const auto& [link, sign] : {std::pair{joint.to, 1}, std::pair{joint.from, -1}}) {
      if (link == mechanism::ground) continue;
      for (unsigned component = 0; component < rows_per_link; ++component)
        equations.matrix(row(link, component), column) = (sign * wrench[component]).expand();
    }
  }
  for (const mechanism::Link& link : m.links) {
    for (const char* component : {"force x", "force y", "moment"}) {
      equations.row_names.push_back(link.name + ": " + component);
    }
  }
  equations.loads = GiNaC::matrix(rows, 1);
  for (const mechanism::Load& load : m.loads) {
    equations.loads(row(load.link, 2), 0) -= geometry.expression(load.couple);
    if (load.force.empty()) continue;
    const Vector force = {geometry.expression(load.force[0]), geometry.expression(load.force[1])};
    add_force(equations.loads, load.link, arm(geometry, *load.at), force, -1);
  }
  if (!m.gravity.empty()) {
    const Vector g = {geometry.expression(m.gravity[0]), geometry.expression(m.gravity[1])};
    for (std::size_t i = 0; i < m.links.size(); ++i) {
      const GiNaC::ex mass = geometry.expression(m.links[i].mass);
      if (mass.is_zero()) continue;
      add_force(equations.loads, static_cast<LinkIndex>(i), arm(geometry, m.links[i].centre_of_mass),
                {mass * g[0], mass * g[1]}, -1);
    }
  }
  for (unsigned i = 0; i < rows; ++i) equations.loads(i, 0) = equations.loads(i, 0).expand();
  return equations;
}

}  // namespace clearloci::symbolic
