#include "analysis/effort_polytope.hpp"

#include <cmath>

#include "analysis/idle_efforts.hpp"
#include "core/linear_program.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/model.hpp"

namespace clearloci {
namespace {

using core::Rational;
using mechanism::JointIndex;
using mechanism::Mechanism;
using numeric::Bounded;

bool may_be_zero(const Bounded& value) { return !(std::abs(value.value) > value.error); }

/// Efforts over all actuators that have bounds, under one choice of the free ones.
std::vector<Bounded> efforts_under(const numeric::NumericModel& model, const numeric::BoundedNumerators& solved,
                                   const std::vector<JointIndex>& bounded) {
  std::vector<Bounded> all;
  for (const JointIndex j : bounded) {
    const int column =
        numeric::column_of(model, j, mechanism::actuator_quantity(model.mechanism.joints[static_cast<std::size_t>(j)]));
    all.push_back(solved.values[static_cast<std::size_t>(column)] / solved.determinant);
  }
  return all;
}

void add_rows(const mechanism::Joint& joint, JointIndex index, const Bounded& offset, const std::vector<Bounded>& slope,
              std::vector<EffortRow>& rows) {
  const double least = core::to_double(joint.within->first), most = core::to_double(joint.within->second);
  const auto bound = [](double value) { return Bounded(value, numeric::unit_roundoff * std::abs(value)); };
  rows.push_back({index, 1, most - least, offset - bound(least), slope});
  std::vector<Bounded> opposite;
  for (const Bounded& value : slope) opposite.push_back(-value);
  rows.push_back({index, -1, most - least, bound(most) - offset, std::move(opposite)});
}

std::vector<std::size_t> binding_rows(const std::vector<Rational>& multipliers) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < multipliers.size(); ++i)
    if (multipliers[i] != 0) rows.push_back(i);
  return rows;
}

}  // namespace

std::optional<std::vector<EffortRow>> effort_rows(const Mechanism& mechanism, std::span<const Bounded> at,
                                                  std::span<const int> sides) {
  const std::vector<JointIndex> free = mechanism::joints_without_preload(mechanism);
  std::vector<JointIndex> bounded;
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    if (mechanism.joints[j].actuated && mechanism.joints[j].within) bounded.push_back(static_cast<JointIndex>(j));
  std::vector<std::vector<Bounded>> efforts;
  for (const numeric::NumericModel& model : models_under_efforts(mechanism, free)) {
    const numeric::BoundedNumerators solved = numeric::bounded_numerators(model, at, sides);
    if (!solved.reachable || may_be_zero(solved.determinant)) return std::nullopt;
    efforts.push_back(efforts_under(model, solved, bounded));
  }
  std::vector<EffortRow> rows;
  for (std::size_t b = 0; b < bounded.size(); ++b) {
    std::vector<Bounded> slope;
    for (std::size_t k = 1; k < efforts.size(); ++k) slope.push_back(efforts[k][b] - efforts[0][b]);
    add_rows(mechanism.joints[static_cast<std::size_t>(bounded[b])], bounded[b], efforts[0][b], slope, rows);
  }
  for (std::size_t i = 0; i < free.size(); ++i) {
    mechanism::Joint joint = mechanism.joints[static_cast<std::size_t>(free[i])];
    joint.within = joint.free_effort->within;
    if (!joint.within) continue;
    std::vector<Bounded> slope(free.size(), Bounded(0.0));
    slope[i] = Bounded(1.0);
    add_rows(joint, free[i], Bounded(0.0), slope, rows);
  }
  return rows;
}

EffortPolytope polytope_of(const std::vector<EffortRow>& rows) {
  EffortPolytope polytope;
  for (const EffortRow& row : rows) {
    polytope.efforts = row.slope.size();
    EffortPolytope::Row& exact = polytope.rows.emplace_back();
    exact.offset = Rational(row.offset.value);
    for (const Bounded& slope : row.slope) exact.slope.emplace_back(slope.value);
  }
  return polytope;
}

std::vector<Rational> widths_of(const std::vector<EffortRow>& rows) {
  std::vector<Rational> widths;
  for (const EffortRow& row : rows) widths.emplace_back(row.width);
  return widths;
}

/// max d, offset + slope lambda - width d >= 0; its dual program: min offset y, slope^T y = 0, width y = 1, y >= 0.
std::optional<EffortPolytope::Deepest> EffortPolytope::deepest(const std::vector<Rational>& widths) const {
  EffortPolytope lifted{rows, efforts + 1};
  for (std::size_t i = 0; i < rows.size(); ++i) lifted.rows[i].slope.emplace_back(-widths[i]);
  std::vector<Rational> of(efforts + 1);
  of.back() = -1;
  auto found = lifted.least(of);
  if (!found) return std::nullopt;
  found->depth = found->at.back();
  found->at.pop_back();
  return found;
}

/// min of . lambda; its dual program: min offset y, slope^T y = of, y >= 0, has its prices -lambda.
std::optional<EffortPolytope::Deepest> EffortPolytope::least(const std::vector<Rational>& of) const {
  core::LinearProgram dual;
  dual.right = of;
  dual.rows.assign(efforts, {});
  for (const Row& row : rows) {
    dual.costs.push_back(row.offset);
    for (std::size_t k = 0; k < efforts; ++k) dual.rows[k].push_back(row.slope[k]);
  }
  const auto found = core::minimise(dual);
  if (!found) return std::nullopt;
  Deepest deepest{-found->value, {}, binding_rows(found->solution), found->solution};
  for (const Rational& price : found->prices) deepest.at.emplace_back(-price);
  return deepest;
}

}  // namespace clearloci
