#include "symbolic/unloaded_reactions.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "symbolic/algebra_turn.hpp"
#include "symbolic/newton_euler.hpp"
#include "symbolic/residue_pose.hpp"

namespace clearloci::symbolic {
namespace {

using Rows = std::vector<std::vector<Residue>>;

/// [A | right sides] at one pose.
Rows rows_at(const Geometry& geometry, const NewtonEulerEquations& equations) {
  const ResiduePose pose(geometry, 0);
  const auto value = [&](const GiNaC::ex& entry) {
    return entry.is_zero() ? Residue{} : pose.value(geometry.poly(entry).plain());
  };
  Rows rows;
  for (unsigned i = 0; i < equations.matrix.rows(); ++i) {
    std::vector<Residue>& row = rows.emplace_back();
    for (unsigned j = 0; j < equations.matrix.cols(); ++j) row.push_back(value(equations.matrix(i, j)));
    row.push_back(value(equations.loads(i, 0)));
    for (const GiNaC::matrix& effort : equations.efforts) row.push_back(value(effort(i, 0)));
  }
  return rows;
}

/// Of every unknown whether it is zero for all right sides; nothing where A is singular.
std::vector<bool> zeros_of(Rows rows, std::size_t unknowns) {
  if (rows.size() != unknowns) return {};
  for (std::size_t k = 0; k < unknowns; ++k) {
    const auto pivot = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(k), rows.end(),
                                    [&](const std::vector<Residue>& row) { return !row[k].is_zero(); });
    if (pivot == rows.end()) return {};
    std::iter_swap(rows.begin() + static_cast<std::ptrdiff_t>(k), pivot);
    const Residue over = inverse(rows[k][k]);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == k || rows[i][k].is_zero()) continue;
      const Residue times = -(rows[i][k] * over);
      for (std::size_t j = k; j < rows[i].size(); ++j) rows[i][j] = rows[i][j] + times * rows[k][j];
    }
  }
  std::vector<bool> zeros;
  for (const std::vector<Residue>& row : rows)
    zeros.push_back(std::all_of(row.begin() + static_cast<std::ptrdiff_t>(unknowns), row.end(),
                                [](const Residue& value) { return value.is_zero(); }));
  return zeros;
}

/// What is made of several unknowns is zero where all that the joint bears beside its actuator is.
bool is_unloaded(const mechanism::Mechanism& mechanism, const core::TaskDemand& demand,
                 const std::vector<mechanism::Unknown>& unknowns, const std::vector<bool>& zeros) {
  bool any = false, all = true;
  for (std::size_t k = 0; k < zeros.size(); ++k) {
    const core::Quantity quantity = unknowns[k].quantity;
    if (mechanism.joints[static_cast<std::size_t>(unknowns[k].joint)].name != demand.joint) continue;
    if (quantity == demand.quantity) return zeros[k];
    if (quantity == core::Quantity::M || quantity == core::Quantity::F) continue;
    any = true;
    all = all && zeros[k];
  }
  const bool effort = demand.quantity == core::Quantity::M || demand.quantity == core::Quantity::F;
  return any && all && !effort;
}

}  // namespace

std::vector<bool> unloaded_reactions(const mechanism::Mechanism& mechanism,
                                     const std::vector<core::TaskDemand>& demands) {
  const auto turn = algebra_turn();
  std::vector<bool> unloaded(demands.size(), false);
  try {
    const Geometry geometry(mechanism, false, {}, {.all_sheets = true});
    const NewtonEulerEquations equations = newton_euler_equations(geometry);
    const std::vector<bool> zeros = zeros_of(rows_at(geometry, equations), equations.unknowns.size());
    for (std::size_t d = 0; d < demands.size(); ++d)
      unloaded[d] = is_unloaded(mechanism, demands[d], equations.unknowns, zeros);
  } catch (const core::InputError&) {
    // What has no formulas is not known here.
  }
  return unloaded;
}

}  // namespace clearloci::symbolic
