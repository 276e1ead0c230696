#include "symbolic/derivation.hpp"

#include <algorithm>

#include "symbolic/demands.hpp"
#include "symbolic/determinants.hpp"

namespace clearloci::symbolic {

using core::FactorRole;
using core::LocusFactor;
using core::Quantity;
using core::Vanishing;

core::LocusProblem problem_without_modes(const Geometry& geometry, const std::vector<ChartRange>& pieces) {
  core::LocusProblem problem;
  problem.tower = StraightLines(geometry).tower();
  auto piece = pieces.begin();
  for (const auto& coordinate : geometry.mechanism().coordinates) {
    problem.lower.push_back(coordinate.angle ? piece->lower : coordinate.lower);
    problem.upper.push_back(coordinate.angle ? piece->upper : coordinate.upper);
    if (coordinate.angle) ++piece;
  }
  if (!pieces.empty()) problem.charts = geometry.charts();
  return problem;
}

Derivation::Derivation(const mechanism::Mechanism& m, const Selection& asked, const std::vector<ChartRange>& pieces,
                       FactoredDeterminants found, SheetGeometry sheet, KnownEliminations* known)
    : mechanism(m),
      selection(asked),
      modes(std::move(sheet.modes)),
      geometry(std::move(sheet.geometry)),
      determinants(std::move(found)),
      elimination(geometry, known),
      causes(geometry, &determinants.equations),
      words(mechanism, geometry),
      lines(geometry) {
  write_reactions();
  lines.know(determinants.forms);
  result.problem = problem_without_modes(geometry, pieces);
  result.problem.tower = lines.tower();
  state_demands(m, selection, result.problem);
  for (const Sides& sides : modes) result.problem.modes.push_back(mode_of(sides));
}

core::WorkingMode Derivation::mode_of(const Sides& sides) const {
  core::WorkingMode mode;
  std::size_t next = 0;
  for (const TowerRoot& root : geometry.roots()) {
    mode.push_back(root.role == core::RootRole::working_mode ? sides[next++] : 1);
  }
  return mode;
}

void Derivation::write_reactions() {
  if (!determinants.equations.free_joints.empty()) {
    preload = preload_columns(geometry, elimination, determinants);
    reactions = at_every_effort(preload);
    return;
  }
  reactions = symbolic::reactions(geometry, determinants);
  preload.reactions = {reactions};
  guides = symbolic::guides(geometry, elimination, reactions);
  add_pressing_reactions();
  for (const Guide& guide : guides)
    for (Reaction& end : end_reactions(guide, determinants.determinant)) reactions.push_back(std::move(end));
}

void Derivation::add_pressing_reactions() {
  const auto asked = [&](Quantity quantity) {
    return std::find(selection.quantities.begin(), selection.quantities.end(), quantity) != selection.quantities.end();
  };
  if (!asked(Quantity::f) && !asked(Quantity::f1) && !asked(Quantity::f2)) return;
  for (Reaction& part : pressing_reactions(geometry, determinants)) reactions.push_back(std::move(part));
}

bool Derivation::wanted(Quantity quantity) const {
  const auto& list = result.problem.quantities;
  return std::find(list.begin(), list.end(), quantity) != list.end();
}

bool Derivation::selected(const std::string& joint) const {
  const auto& joints = result.problem.joints;
  return std::find(joints.begin(), joints.end(), joint) != joints.end();
}

bool Derivation::is_asked_for(const std::string& joint, Quantity quantity) const {
  const std::vector<Quantity> parts = core::force_components(result.problem, joint);
  return wanted(quantity) || (wanted(Quantity::f) && std::find(parts.begin(), parts.end(), quantity) != parts.end());
}

bool Derivation::is_always_zero(const std::string& joint, Quantity quantity) const {
  const auto& list = result.problem.always_zero;
  return std::any_of(list.begin(), list.end(),
                     [&](const Vanishing& v) { return v.joint == joint && v.quantity == quantity; });
}

const std::string& Derivation::point_name(mechanism::PointIndex point) const {
  return mechanism.points[static_cast<std::size_t>(point)].name;
}

void Derivation::keep_without_curves(FactorRole role, const std::string& expression, const std::vector<Poly>& sheets) {
  if (result.problem.tower.coordinates.size() != 2) return;
  for (const Poly& sheet : sheets) {
    LocusFactor factor;
    factor.role = role;
    factor.expression = expression;
    factor.sheet = core::scaled_for_doubles(sheet.plain(geometry.tower_variables()));
    // Divided out of it is what may be zero at points, such as the squared distance of a dyad's ends.
    for (const Poly& divisor : elimination.implicit_of_divisor(sheet))
      factor.implicit.push_back(divisor.plain(geometry.tower_variables()));
    result.rest.push_back(std::move(factor));
  }
}

}  // namespace clearloci::symbolic
