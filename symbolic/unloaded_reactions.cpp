#include "symbolic/unloaded_reactions.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"
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

/// Of every unknown its values, one a right side; nothing where A is singular.
Rows solved(Rows rows, std::size_t unknowns) {
  if (rows.size() != unknowns) return {};
  Rows values;
  for (std::size_t k = 0; k < unknowns; ++k) {
    const auto pivot = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(k), rows.end(),
                                    [&](const std::vector<Residue>& row) { return !row[k].is_zero(); });
    if (pivot == rows.end()) return {};
    std::iter_swap(rows.begin() + static_cast<std::ptrdiff_t>(k), pivot);
    const Residue over = inverse(rows[k][k]);
    for (Residue& value : rows[k]) value = value * over;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == k || rows[i][k].is_zero()) continue;
      const Residue times = -rows[i][k];
      for (std::size_t j = k; j < rows[i].size(); ++j) rows[i][j] = rows[i][j] + times * rows[k][j];
    }
  }
  for (const std::vector<Residue>& row : rows)
    values.emplace_back(row.begin() + static_cast<std::ptrdiff_t>(unknowns), row.end());
  return values;
}

using Vector = std::array<Residue, 3>;

/// What joints bear at one pose.
class Borne {
 public:
  explicit Borne(const Geometry& geometry) : geometry_(geometry), mechanism_(geometry.mechanism()), pose_(geometry, 0) {
    const NewtonEulerEquations equations = newton_euler_equations(geometry);
    unknowns_ = equations.unknowns;
    sides_ = 1 + equations.efforts.size();
    values_ = solved(rows_at(geometry, equations), unknowns_.size());
  }

  bool is_known() const { return !values_.empty(); }

  bool is_zero(const core::TaskDemand& demand) const {
    const mechanism::Joint& joint = mechanism::joint_named(mechanism_, demand.joint);
    if (const auto own = column(joint, demand.quantity)) return is_zero(*own);
    if (demand.quantity == core::Quantity::F) return is_zero_along(joint, forces);
    if (demand.quantity == core::Quantity::M) return is_zero_along(joint, couples);
    if (demand.quantity == core::Quantity::f && mechanism::presses_across_axis(mechanism_, joint) && has(joint, forces))
      return is_zero_across(joint);
    bool any = false, all = true;
    for (const core::Quantity quantity : parts_of(joint, demand.quantity))
      if (const auto part = column(joint, quantity)) {
        any = true;
        all = all && is_zero(*part);
      }
    return any && all;
  }

 private:
  using Components = std::array<core::Quantity, 3>;
  static constexpr Components forces = {core::Quantity::fx, core::Quantity::fy, core::Quantity::fz};
  static constexpr Components couples = {core::Quantity::mx, core::Quantity::my, core::Quantity::mz};

  /// What a force, or the force at an end of a guide, is made of.
  std::vector<core::Quantity> parts_of(const mechanism::Joint& joint, core::Quantity quantity) const {
    const bool whole = core::is_guide_end(quantity) || mechanism::is_guide(mechanism_, joint);
    return whole ? mechanism::reaction_components(mechanism_, joint) : mechanism::force_unknowns(mechanism_, joint);
  }

  std::optional<std::size_t> column(const mechanism::Joint& joint, core::Quantity quantity) const {
    for (std::size_t k = 0; k < unknowns_.size(); ++k)
      if (unknowns_[k].quantity == quantity &&
          mechanism_.joints[static_cast<std::size_t>(unknowns_[k].joint)].name == joint.name)
        return k;
    return std::nullopt;
  }

  bool has(const mechanism::Joint& joint, const Components& components) const {
    return std::all_of(components.begin(), components.end(),
                       [&](core::Quantity quantity) { return column(joint, quantity).has_value(); });
  }

  bool is_zero(std::size_t column) const {
    return std::all_of(values_[column].begin(), values_[column].end(),
                       [](const Residue& value) { return value.is_zero(); });
  }

  Vector axis_of(const mechanism::Joint& joint) const {
    Vector axis;
    const std::vector<GiNaC::ex> components = geometry_.vector(joint.axes.at(0));
    for (std::size_t c = 0; c < axis.size(); ++c)
      axis[c] = pose_.value(geometry_.poly(components.at(c).expand()).plain());
    return axis;
  }

  Vector value(const mechanism::Joint& joint, const Components& components, std::size_t side) const {
    Vector vector;
    for (std::size_t c = 0; c < vector.size(); ++c) vector[c] = values_[*column(joint, components[c])][side];
    return vector;
  }

  bool is_zero_along(const mechanism::Joint& joint, const Components& components) const {
    if (joint.axes.empty() || !has(joint, components)) return false;
    const Vector u = axis_of(joint);
    for (std::size_t side = 0; side < sides_; ++side) {
      const Vector w = value(joint, components, side);
      if (!(u[0] * w[0] + u[1] * w[1] + u[2] * w[2]).is_zero()) return false;
    }
    return true;
  }

  bool is_zero_across(const mechanism::Joint& joint) const {
    const Vector u = axis_of(joint);
    for (std::size_t side = 0; side < sides_; ++side) {
      const Vector f = value(joint, forces, side);
      for (std::size_t c = 0; c < f.size(); ++c) {
        const std::size_t a = (c + 1) % 3, b = (c + 2) % 3;
        if (!(u[a] * f[b] + -(u[b] * f[a])).is_zero()) return false;
      }
    }
    return true;
  }

  const Geometry& geometry_;
  const mechanism::Mechanism& mechanism_;
  ResiduePose pose_;
  std::vector<mechanism::Unknown> unknowns_;
  std::size_t sides_ = 0;
  Rows values_;
};

}  // namespace

std::vector<bool> unloaded_reactions(const mechanism::Mechanism& mechanism,
                                     const std::vector<core::TaskDemand>& demands) {
  const auto turn = algebra_turn();
  std::vector<bool> unloaded(demands.size(), false);
  try {
    const Geometry geometry(mechanism, false, {}, {.all_sheets = true});
    const Borne borne(geometry);
    for (std::size_t d = 0; borne.is_known() && d < demands.size(); ++d) unloaded[d] = borne.is_zero(demands[d]);
  } catch (const core::InputError&) {
    // What has no formulas is not known here.
  }
  return unloaded;
}

std::vector<bool> unloaded_reactions(const std::vector<const mechanism::Mechanism*>& loads,
                                     const std::vector<core::TaskDemand>& demands) {
  std::vector<bool> unloaded(demands.size(), true);
  for (const mechanism::Mechanism* const load : loads) {
    if (std::find(unloaded.begin(), unloaded.end(), true) == unloaded.end()) break;
    const std::vector<bool> here = unloaded_reactions(*load, demands);
    for (std::size_t d = 0; d < demands.size(); ++d) unloaded[d] = unloaded[d] && here[d];
  }
  return unloaded;
}

}  // namespace clearloci::symbolic
