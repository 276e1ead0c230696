#include "numeric/equations.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::numeric {

using core::Quantity;
using mechanism::JointIndex;

namespace {

constexpr std::array forces = {Quantity::fx, Quantity::fy, Quantity::fz};
constexpr std::array couples = {Quantity::mx, Quantity::my, Quantity::mz};

}  // namespace

Equations::Equations(Geometry& geometry, const mechanism::Mechanism& mechanism)
    : geometry_(geometry), tape_(geometry.tape()), m_(mechanism) {
  if (m_.space == mechanism::Space::planar) {
    rows_of_wrench_ = {0, 1, 5};
    add_planar_unknowns();
  } else {
    rows_of_wrench_ = {0, 1, 2, 3, 4, 5};
    for (std::size_t j = 0; j < m_.joints.size(); ++j) add_spatial_unknowns(static_cast<JointIndex>(j));
  }
  write_matrix();
}

WrenchRegisters Equations::force_at(mechanism::PointIndex at, const Triple& force) {
  const Triple moment = geometry_.cross(geometry_.arm(at), force);
  return {force[0], force[1], force[2], moment[0], moment[1], moment[2]};
}

WrenchRegisters Equations::couple(const Triple& couple) const {
  const Register zero = geometry_.zero();
  return {zero, zero, zero, couple[0], couple[1], couple[2]};
}

int Equations::add_unknown(JointIndex joint, Quantity quantity, const WrenchRegisters& wrench) {
  unknowns_.push_back({joint, quantity});
  wrenches_.push_back(wrench);
  side_equations_.emplace_back();
  return static_cast<int>(unknowns_.size()) - 1;
}

void Equations::add_planar_unknowns() {
  const Triple k = geometry_.direction(2);
  for (const auto& [j, quantity] : mechanism::unknowns(m_)) {
    const mechanism::PointIndex at = m_.joints[static_cast<std::size_t>(j)].at;
    const Triple& u = *geometry_.axes()[static_cast<std::size_t>(j)];
    const auto unit_wrench = [&, quantity = quantity] {
      if (quantity == Quantity::fx) return force_at(at, geometry_.direction(0));
      if (quantity == Quantity::fy) return force_at(at, geometry_.direction(1));
      if (quantity == Quantity::N) return force_at(at, geometry_.cross(k, u));
      if (quantity == Quantity::F) return force_at(at, u);
      return couple(k);
    };
    add_unknown(j, quantity, unit_wrench());
  }
}

void Equations::add_spatial_unknowns(JointIndex j) {
  const mechanism::Joint& joint = m_.joints[static_cast<std::size_t>(j)];
  const mechanism::JointTraits& traits = mechanism::traits(joint);
  if (mechanism::is_cable(joint)) {
    for (std::size_t c = 0; c < 3 && joint.holds_turning; ++c)
      add_unknown(j, couples[c], couple(geometry_.direction(c)));
    if (joint.actuated) add_unknown(j, Quantity::F, force_at(joint.at, *geometry_.axes()[static_cast<std::size_t>(j)]));
    return;
  }
  const auto first = static_cast<int>(unknowns_.size());
  for (std::size_t c = 0; c < 3; ++c) add_unknown(j, forces[c], force_at(joint.at, geometry_.direction(c)));
  if (traits.slides) add_side_equation(j, first, Quantity::F, joint.actuated);
  if (traits.couple == mechanism::BorneCouple::none) return;
  if (traits.couple == mechanism::BorneCouple::cross) {
    add_unknown(j, Quantity::T, couple(*geometry_.couple_axes()[static_cast<std::size_t>(j)]));
    return;
  }
  const auto first_couple = static_cast<int>(unknowns_.size());
  for (std::size_t c = 0; c < 3; ++c) add_unknown(j, couples[c], couple(geometry_.direction(c)));
  if (traits.turns_about_axis()) add_side_equation(j, first_couple, Quantity::M, joint.actuated && !traits.slides);
}

/// u · (three columns from `first` on) = 0, at the row of the last of them; where actuated the unknown F or M is that
/// product, at the row of its own column.
void Equations::add_side_equation(JointIndex joint, int first, Quantity actuator, bool actuated) {
  const Triple& u = *geometry_.axes()[static_cast<std::size_t>(joint)];
  std::map<int, Register> entries;
  for (std::size_t c = 0; c < 3; ++c) entries[first + static_cast<int>(c)] = actuated ? tape_.negate(u[c]) : u[c];
  int row = first + 2;
  if (actuated) {
    row = add_unknown(joint, actuator, couple({geometry_.zero(), geometry_.zero(), geometry_.zero()}));
    entries[row] = geometry_.one();
  }
  std::erase_if(entries, [&](const auto& entry) { return tape_.is_exactly(entry.second, 0); });
  side_equations_[static_cast<std::size_t>(row)] = std::move(entries);
}

void Equations::add(SparseEquations& e, mechanism::LinkIndex link, int column, const WrenchRegisters& wrench,
                    bool negative) {
  if (link == mechanism::ground) return;
  for (std::size_t c = 0; c < rows_of_wrench_.size(); ++c) {
    Register value = wrench[rows_of_wrench_[c]];
    if (tape_.is_exactly(value, 0)) continue;
    if (negative) value = tape_.negate(value);
    auto& entries = e.rows[link_rows_[rows_of_wrench_.size() * static_cast<std::size_t>(link) + c]];
    const auto [place, fresh] = entries.try_emplace(column, value);
    if (!fresh) place->second = tape_.add(place->second, value);
    if (tape_.is_exactly(place->second, 0)) entries.erase(place);
  }
}

void Equations::write_matrix() {
  matrix_.unknowns = static_cast<int>(unknowns_.size());
  matrix_.rows = side_equations_;
  for (std::size_t row = 0; row < matrix_.rows.size(); ++row)
    if (side_equations_[row].empty()) link_rows_.push_back(row);
  core::ensure(link_rows_.size() == rows_of_wrench_.size() * m_.links.size(), "the equations are square");
  for (int column = 0; column < matrix_.unknowns; ++column) {
    const mechanism::Unknown& unknown = unknowns_[static_cast<std::size_t>(column)];
    const mechanism::Joint& joint = m_.joints[static_cast<std::size_t>(unknown.joint)];
    add(matrix_, joint.to, column, wrenches_[static_cast<std::size_t>(column)], false);
    add(matrix_, joint.from, column, wrenches_[static_cast<std::size_t>(column)], true);
  }
}

SparseEquations Equations::under(const std::vector<LoadRegisters>& loads) {
  SparseEquations e = matrix_;
  for (const LoadRegisters& load : loads) {
    add(e, load.link, e.unknowns, couple(load.couple), true);
    if (load.at) add(e, load.link, e.unknowns, force_at(*load.at, load.force), true);
  }
  return e;
}

SparseEquations Equations::under_unit(std::size_t component) {
  SparseEquations e = matrix_;
  WrenchRegisters unit;
  unit.fill(geometry_.zero());
  unit[rows_of_wrench_[component]] = geometry_.one();
  add(e, m_.end_effector_link, e.unknowns, unit, false);
  add(e, m_.relative_to, e.unknowns, unit, true);
  return e;
}

}  // namespace clearloci::numeric
