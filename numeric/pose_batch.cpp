#include "numeric/pose_batch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/wrench_rows.hpp"

namespace clearloci::numeric {

namespace {

using core::Quantity;
using Lane = PoseBatch::Lane;
using Lanes3 = PoseBatch::Lanes3;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <class F>
void over_lanes(const F& of) {
  for (std::size_t l = 0; l < PoseBatch::lanes; ++l) of(l);
}

/// Whether two eliminations leave the same matrix, so that one factorisation serves both.
bool same_matrix(const Elimination& a, const Elimination& b) {
  if (a.core_unknowns != b.core_unknowns) return false;
  const std::size_t width = a.core_unknowns.size() + 1;
  for (std::size_t i = 0; i < a.core.size(); ++i)
    if (i % width + 1 != width && a.core[i] != b.core[i]) return false;
  return true;
}

/// Neither infinite nor NaN, as 0; else NaN: sums of it tell whether some was.
double finiteness(double x) { return x * 0; }

}  // namespace

PoseBatch::PoseBatch(const NumericModel& model, std::span<const int> mode)
    : model_(model),
      spatial_(model.mechanism.space == mechanism::Space::spatial),
      contacts_(joint_contacts(model.mechanism, std::vector<Vector3d>(model.axes.size(), Vector3d::Zero()))),
      unknowns_of_(contacts_.size()),
      evaluator_(model, mode, static_cast<int>(model.tape.code.size())),
      values_(model.unit_wrenches.size() + 1, std::vector<Lane>(model.unknowns.size())) {
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    ways_.push_back(way_of(model.unknowns[k]));
    unknowns_of_[static_cast<std::size_t>(model.unknowns[k].joint)].push_back(k);
  }
  for (std::size_t side = 0; side < values_.size(); ++side) add_system(side);
  determinant_.fill(1);  // of no core
}

/// As unknown_columns, with registers for what depends on the pose.
PoseBatch::Way PoseBatch::way_of(const mechanism::Unknown& unknown) const {
  const auto j = static_cast<std::size_t>(unknown.joint);
  const auto along = [](const Triple& u) { return std::vector<Part>{{0, 1, u[0]}, {1, 1, u[1]}, {2, 1, u[2]}}; };
  const Quantity quantity = unknown.quantity;
  const auto component = static_cast<std::size_t>(quantity);
  constexpr auto force = static_cast<std::size_t>(Quantity::fx), couple = static_cast<std::size_t>(Quantity::mx);
  if (component >= force && component < force + 3) return {false, false, {{component - force, 1, -1}}};
  if (component >= couple && component < couple + 3) return {true, false, {{component - couple, 1, -1}}};
  if (spatial_ && quantity == Quantity::T) return {true, false, along(*model_.couple_axes[j])};
  // In space the components above hold the actuator's effort too.
  if (spatial_) return {false, true, {}};
  const Triple& u = *model_.axes[j];
  if (quantity == Quantity::N) return {false, false, {{0, -1, u[1]}, {1, 1, u[0]}}};
  if (quantity == Quantity::F) return {false, true, along(u)};
  return {true, quantity == Quantity::M, {{2, 1, -1}}};
}

const Elimination& PoseBatch::elimination(std::size_t side) const {
  return side < model_.unit_wrenches.size() ? model_.unit_wrenches[side] : model_.elimination;
}

/// The loads apart: they are not always asked for.
void PoseBatch::add_system(std::size_t side) {
  for (System& system : systems_)
    if (side < model_.unit_wrenches.size() && same_matrix(elimination(system.sides.front()), elimination(side))) {
      system.sides.push_back(side);
      return;
    }
  systems_.push_back({{side}});
}

const double* PoseBatch::axis(std::size_t joint, std::size_t component) const {
  return at((*model_.axes[joint])[component]);
}

void PoseBatch::find_influence() {
  for (const System& system : systems_)
    if (system.sides.front() < model_.unit_wrenches.size()) solve(system);
}

void PoseBatch::solve(const System& system) {
  if (elimination(system.sides.front()).core_unknowns.size() <= 2)
    for (const std::size_t side : system.sides) solve_small_core(side);
  else
    solve_core(system);
  for (const std::size_t side : system.sides) substitute(side);
}

void PoseBatch::solve_small_core(std::size_t side) {
  const Elimination& e = elimination(side);
  const auto value = [&](std::size_t i) { return at(e.core[i]); };
  const auto result = [&](std::size_t i) -> Lane& {
    return values_[side][static_cast<std::size_t>(e.core_unknowns[i])];
  };
  if (e.core_unknowns.size() == 1) {
    const double *m = value(0), *b = value(1);
    over_lanes([&, &w = result(0)](std::size_t l) {
      determinant_[l] = m[l];
      w[l] = b[l] / m[l];
    });
  } else if (e.core_unknowns.size() == 2) {
    const double *m00 = value(0), *m01 = value(1), *b0 = value(2), *m10 = value(3), *m11 = value(4), *b1 = value(5);
    over_lanes([&, &w0 = result(0), &w1 = result(1)](std::size_t l) {
      const double determinant = m00[l] * m11[l] - m01[l] * m10[l];
      w0[l] = (b0[l] * m11[l] - m01[l] * b1[l]) / determinant;
      w1[l] = (m00[l] * b1[l] - b0[l] * m10[l]) / determinant;
      determinant_[l] = determinant;
    });
  }
}

void PoseBatch::solve_core(const System& system) {
  const Elimination& first = elimination(system.sides.front());
  const auto size = static_cast<Eigen::Index>(first.core_unknowns.size());
  const auto entry = [&](const Elimination& e, Eigen::Index row, Eigen::Index column, int lane) {
    return evaluator_.value(e.core[static_cast<std::size_t>(row * (size + 1) + column)], lane);
  };
  matrix_.resize(size, size);
  right_.resize(size, static_cast<Eigen::Index>(system.sides.size()));
  for (int lane = 0; lane < lanes; ++lane) {
    for (Eigen::Index row = 0; row < size; ++row) {
      for (Eigen::Index column = 0; column < size; ++column) matrix_(row, column) = entry(first, row, column, lane);
      for (Eigen::Index s = 0; s < right_.cols(); ++s)
        right_(row, s) = entry(elimination(system.sides[static_cast<std::size_t>(s)]), row, size, lane);
    }
    lu_.compute(matrix_);
    determinant_[static_cast<std::size_t>(lane)] = lu_.matrixLU().diagonal().prod();
    solved_ = lu_.solve(right_);
    for (std::size_t s = 0; s < system.sides.size(); ++s)
      for (Eigen::Index i = 0; i < size; ++i)
        values_[system.sides[s]][static_cast<std::size_t>(first.core_unknowns[static_cast<std::size_t>(i)])]
               [static_cast<std::size_t>(lane)] = solved_(i, static_cast<Eigen::Index>(s));
  }
}

void PoseBatch::substitute(std::size_t side) {
  std::vector<Lane>& values = values_[side];
  for (const BackSubstitution& step : elimination(side).steps) {
    Lane sum{};
    if (step.load >= 0) std::copy_n(at(step.load), lanes, sum.begin());
    for (const auto& [factor, unknown] : step.terms)
      over_lanes([&, a = at(factor), &w = values[static_cast<std::size_t>(unknown)]](std::size_t l) {
        sum[l] -= a[l] * w[l];
      });
    over_lanes([&, &w = values[static_cast<std::size_t>(step.unknown)]](std::size_t l) { w[l] = step.pivot * sum[l]; });
  }
}

void PoseBatch::add(const Part& part, const Lane& by, Lanes3& sum) const {
  Lane& component = sum[part.component];
  if (part.value < 0)
    over_lanes([&](std::size_t l) { component[l] += by[l]; });
  else
    over_lanes([&, value = at(part.value)](std::size_t l) { component[l] += part.sign * value[l] * by[l]; });
}

/// What of a vector is across the axis that the joint turns about; all of it in the plane and in a ball.
Lanes3 PoseBatch::across_axis(std::size_t joint, const Lanes3& v) const {
  if (!spatial_ || !mechanism::traits(contacts_[joint].type).turns_about_axis()) return v;
  Lanes3 result = v;
  Lane along{};
  for (std::size_t c = 0; c < 3; ++c)
    over_lanes([&, u = axis(joint, c)](std::size_t l) { along[l] += u[l] * v[c][l]; });
  for (std::size_t c = 0; c < 3; ++c)
    over_lanes([&, u = axis(joint, c)](std::size_t l) { result[c][l] -= along[l] * u[l]; });
  return result;
}

Lanes3 PoseBatch::guide_normal(std::size_t joint) const {
  Lanes3 normal{};
  over_lanes(
      [&, ux = axis(joint, 0), uy = axis(joint, 1)](std::size_t l) { normal[0][l] = -uy[l], normal[1][l] = ux[l]; });
  return normal;
}

void PoseBatch::take_up_actuator(std::size_t joint, const Lane& effort, TakenUp& result) {
  const double angular = contacts_[joint].clearance.angular, axial = contacts_[joint].clearance.axial;
  for (std::size_t c = 0; c < 3; ++c) {
    over_lanes([&, u = axis(joint, c)](std::size_t l) {
      result.rotation[c][l] -= std::copysign(angular, effort[l]) * u[l];
      result.displacement[c][l] -= std::copysign(axial, effort[l]) * u[l];
    });
  }
  over_lanes([&](std::size_t l) { lost_[l] += effort[l] == 0 ? nan : finiteness(effort[l]); });
}

/// As take_up of a guide (take_up.cpp).
void PoseBatch::take_up_guide(std::size_t joint, const Lanes3& force, const Lane& couple, TakenUp& result) {
  const JointClearance& clearance = contacts_[joint].clearance;
  const double h = clearance.half_length, g = clearance.gap;
  const Lanes3 normal = guide_normal(joint);
  over_lanes([&](std::size_t l) {
    const double N = force[0][l] * normal[0][l] + force[1][l] * normal[1][l], T = couple[l];
    const std::array<double, 2> ends = guide_ends(N, T, h);
    const double noise = guide_noise * (std::abs(N) + std::abs(T) / h);
    lost_[l] += std::abs(ends[0]) > noise && std::abs(ends[1]) > noise ? 0 : nan;
    const double far = -std::copysign(g, ends[0]), near = -std::copysign(g, ends[1]);
    for (std::size_t c = 0; c < 2; ++c) result.displacement[c][l] += (far + near) / 2 * normal[c][l];
    result.rotation[2][l] += (far - near) / (2 * h);
  });
}

/// As take_up of a joint, from the reactions to the loads.
PoseBatch::TakenUp PoseBatch::taken_up(std::size_t joint) {
  const JointContact& contact = contacts_[joint];
  Lanes3 force{}, couple{};
  const Lane* effort = nullptr;
  for (const std::size_t k : unknowns_of_[joint]) {
    const Lane& lane = values_.back()[k];
    if (ways_[k].effort) {
      effort = &lane;
      continue;
    }
    for (const Part& part : ways_[k].parts) add(part, lane, ways_[k].couple ? couple : force);
  }
  TakenUp result;
  if (contact.presses()) {
    const Lanes3 pressing = across_axis(joint, force);
    Lane by{};
    over_lanes([&](std::size_t l) {
      const double size = std::sqrt(pressing[0][l] * pressing[0][l] + pressing[1][l] * pressing[1][l] +
                                    pressing[2][l] * pressing[2][l]);
      by[l] = -contact.clearance.radial / size;
      lost_[l] += size > 0 ? finiteness(size) : nan;
    });
    for (std::size_t c = 0; c < 3; ++c)
      over_lanes([&](std::size_t l) { result.displacement[c][l] += by[l] * pressing[c][l]; });
  }
  if (effort != nullptr && contact.plays()) take_up_actuator(joint, *effort, result);
  if (contact.is_guided()) take_up_guide(joint, force, couple[2], result);
  return result;
}

/// Adds H Δ_C of one joint.
void PoseBatch::move_by(std::size_t joint, const TakenUp& taken_up) {
  const std::vector<Eigen::Index>& rows = wrench_rows(model_.mechanism.space);
  for (const std::size_t k : unknowns_of_[joint]) {
    const Lanes3& way = ways_[k].couple ? taken_up.rotation : taken_up.displacement;
    Lane along{};
    for (const Part& part : ways_[k].parts) {
      const Lane& component = way[part.component];
      if (part.value < 0)
        over_lanes([&](std::size_t l) { along[l] += component[l]; });
      else
        over_lanes([&, value = at(part.value)](std::size_t l) { along[l] += part.sign * value[l] * component[l]; });
    }
    for (std::size_t row = 0; row < rows.size(); ++row)
      over_lanes([&, &h = values_[row][k], &sum = error_[static_cast<std::size_t>(rows[row])]](std::size_t l) {
        sum[l] += h[l] * along[l];
      });
  }
}

void PoseBatch::find_errors_under_load() {
  solve(systems_.back());
  error_ = {};
  lost_ = {};
  for (std::size_t j = 0; j < contacts_.size(); ++j)
    if (contacts_[j].clearance.any()) move_by(j, taken_up(j));
  for (const Lane& component : error_) over_lanes([&](std::size_t l) { lost_[l] += finiteness(component[l]); });
  // Teeth push: where they would have to pull it is another working mode.
  for (std::size_t j = 0; j < contacts_.size(); ++j)
    if (contacts_[j].type == mechanism::JointType::gear)
      for (const std::size_t k : unknowns_of_[j])
        over_lanes([&, &force = values_.back()[k]](std::size_t l) { lost_[l] += force[l] < 0 ? nan : 0; });
}

PoseError PoseBatch::error(int lane) const {
  const auto l = static_cast<std::size_t>(lane);
  if (lost_[l] != 0) return {Vector3d::Constant(nan), Vector3d::Constant(nan)};
  const auto three = [&](std::size_t first) {
    return Vector3d(error_[first][l], error_[first + 1][l], error_[first + 2][l]);
  };
  return {three(3), three(0)};
}

PoseBatch::LaneReach& PoseBatch::next_reach(std::size_t width) {
  if (reaches_used_ == reaches_.size()) reaches_.emplace_back();
  LaneReach& reach = reaches_[reaches_used_++];
  reach.width = width;
  return reach;
}

/// `influence`: of a vector in each row; along the joint's axis.
void PoseBatch::add_reach_along(std::size_t joint, double size, const std::array<Lanes3, 6>& influence) {
  LaneReach& reach = next_reach(1);
  for (std::size_t row = 0; row < model_.unit_wrenches.size(); ++row) {
    Lane& result = reach.rows[row][0] = {};
    for (std::size_t c = 0; c < 3; ++c)
      over_lanes([&, u = axis(joint, c), &v = influence[row][c]](std::size_t l) { result[l] += size * u[l] * v[l]; });
  }
}

/// As worst_case.cpp.
void PoseBatch::add_reaches(std::size_t joint) {
  const JointContact& contact = contacts_[joint];
  const std::size_t rows = model_.unit_wrenches.size();
  std::array<Lanes3, 6> force{}, couple{};
  for (const std::size_t k : unknowns_of_[joint])
    for (const Part& part : ways_[k].parts)
      for (std::size_t row = 0; row < rows; ++row)
        add(part, values_[row][k], ways_[k].couple ? couple[row] : force[row]);
  if (contact.presses()) {
    LaneReach& reach = next_reach(spatial_ ? 3 : 2);
    for (std::size_t row = 0; row < rows; ++row) {
      const Lanes3 across = across_axis(joint, force[row]);
      for (std::size_t c = 0; c < reach.width; ++c)
        over_lanes([&](std::size_t l) { reach.rows[row][c][l] = contact.clearance.radial * across[c][l]; });
    }
  }
  if (contact.clearance.angular > 0) add_reach_along(joint, contact.clearance.angular, couple);
  if (contact.clearance.axial > 0) add_reach_along(joint, contact.clearance.axial, force);
  if (!contact.is_guided()) return;
  // Each end moves by ±g: half along the normal, and a tilt of ±g/(2 h).
  const Lanes3 normal = guide_normal(joint);
  for (const double sign : {1.0, -1.0}) {
    LaneReach& reach = next_reach(1);
    for (std::size_t row = 0; row < rows; ++row)
      over_lanes([&](std::size_t l) {
        const double shift = force[row][0][l] * normal[0][l] + force[row][1][l] * normal[1][l];
        const double tilt = couple[row][2][l] / contact.clearance.half_length;
        reach.rows[row][0][l] = contact.clearance.gap / 2 * (shift + sign * tilt);
      });
  }
}

void PoseBatch::find_reaches() {
  reaches_used_ = 0;
  for (std::size_t j = 0; j < contacts_.size(); ++j)
    if (contacts_[j].clearance.any()) add_reaches(j);
  of_one_.assign(reaches_used_, Reach::Zero());
}

WorstCase PoseBatch::worst(int lane, double accuracy) {
  const std::vector<Eigen::Index>& rows = wrench_rows(model_.mechanism.space);
  for (std::size_t i = 0; i < reaches_used_; ++i)
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::size_t c = 0; c < reaches_[i].width; ++c)
        of_one_[i](rows[row], static_cast<Eigen::Index>(c)) = reaches_[i].rows[row][c][static_cast<std::size_t>(lane)];
  return worst_case(of_one_, accuracy, false);
}

}  // namespace clearloci::numeric
