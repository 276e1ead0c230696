#include "symbolic/rigid_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "mechanism/evaluate.hpp"
#include "mechanism/posture_sample.hpp"
#include "symbolic/dependent_roots.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;
using mechanism::HeldDistance;
using mechanism::HeldTurn;

std::array<Poly, 3> way(const Geometry& geometry, mechanism::PointIndex from, mechanism::PointIndex to) {
  const auto &a = geometry.natural(from), &b = geometry.natural(to);
  return {geometry.poly((b[0] - a[0]).expand()), geometry.poly((b[1] - a[1]).expand()),
          geometry.poly((b[2] - a[2]).expand())};
}

Poly squared_distance(const Geometry& geometry, const HeldDistance& held) {
  Poly sum(geometry.ring());
  for (const Poly& part : way(geometry, held.first, held.second)) sum += part * part;
  return sum;
}

/// A pose, given by the values of the ring's coordinates: of an angle the half tangent of its chart.
std::vector<double> pose_of(const Geometry& geometry, const std::vector<double>& at) {
  std::vector<double> pose;
  for (std::size_t i = 0; i < geometry.charts().size(); ++i) {
    const auto& chart = geometry.charts()[i];
    pose.push_back(chart ? chart->half_turns * std::numbers::pi + 2 * std::atan(at[i]) : at[i]);
  }
  return pose;
}

/// Whether the roots exist at a pose, on the chosen sides of all folds: fills in their values.
bool put_roots(const Geometry& geometry, const std::vector<int>& sides, const std::vector<core::Polynomial>& squares,
               const std::vector<core::Polynomial>& folds, std::vector<double>& at) {
  std::size_t dyad = 0;
  for (std::size_t j = 0; j < squares.size(); ++j) {
    const TowerRoot& root = geometry.roots()[j];
    const double square = core::evaluate(squares[j], std::span<const double>(at));
    const int side = root.role == core::RootRole::working_mode ? sides[dyad++] : 1;
    if (!(square > 0)) return false;
    at[static_cast<std::size_t>(root.variable)] = (root.value ? 1 : side) * std::sqrt(square);
  }
  return std::all_of(folds.begin(), folds.end(), [&](const core::Polynomial& fold) {
    return core::evaluate(fold, std::span<const double>(at)) > 0;
  });
}

/// Some postures of a sheet in a mode. The points are placed one after the other: expanded over the tower their
/// coordinates would have numbers beyond the range of doubles.
std::vector<mechanism::PosturePoints> postures_of(const Geometry& geometry, const std::vector<int>& sides) {
  constexpr std::size_t tries = 4096, enough = 6;
  const mechanism::Mechanism& m = geometry.mechanism();
  std::vector<core::Polynomial> squares, folds;
  for (const TowerRoot& root : geometry.roots()) squares.push_back(root.square.plain());
  for (const Fold& fold : geometry.folds()) folds.push_back(core::scaled_for_doubles(fold.where.plain()));
  std::vector<mechanism::PosturePoints> found;
  for (const std::vector<double>& pose : mechanism::spread_poses(m, tries)) {
    std::vector<double> at(static_cast<std::size_t>(geometry.ring().size()), 0.0);
    for (std::size_t i = 0; i < pose.size(); ++i) {
      const double lower = core::to_double(m.coordinates[i].lower), upper = core::to_double(m.coordinates[i].upper);
      at[i] = geometry.charts()[i] ? 2 * (pose[i] - lower) / (upper - lower) - 1 : pose[i];  // from end to end
    }
    if (!put_roots(geometry, sides, squares, folds, at)) continue;
    if (auto posture = mechanism::sample_posture(m, pose_of(geometry, at), sides)) found.push_back(std::move(*posture));
    if (found.size() == enough) break;
  }
  return found;
}

/// A natural polynomial as a quotient of two elements over the tower.
struct Quotient {
  Poly above, below;
};

std::optional<Quotient> over_tower(const Geometry& geometry, const Elimination& elimination, const Poly& natural) {
  const int t = geometry.auxiliary();
  std::vector<Poly> parts = elimination.over_tower(natural + Poly::variable(geometry.ring(), t)).coefficients(t);
  if (parts.size() != 2) return std::nullopt;
  return Quotient{std::move(parts[0]), std::move(parts[1])};
}

/// Whether a quotient of elements is one number, rational or made of roots of numbers, all over the tower.
bool is_constant(const Geometry& geometry, const Elimination& elimination, const Poly& natural) {
  if (elimination.constant_over_tower(natural)) return true;
  const std::optional<Quotient> quotient = over_tower(geometry, elimination, natural);
  if (!quotient) return false;
  std::vector<TowerRoot> roots;
  for (const TowerRoot& root : geometry.roots())
    if (!root.is_angle() && (!root.value || root.square.constant() != 1)) roots.push_back(root);
  const std::optional<Poly> whole = quotient_over_tower(quotient->above, quotient->below, roots);
  if (!whole) return false;
  const std::vector<int> variables = geometry.tower_variables();
  return std::none_of(variables.begin(), variables.end(), [&](int variable) {
    const bool of_number = std::any_of(roots.begin(), roots.end(), [&](const TowerRoot& root) {
      return root.variable == variable && root.square.is_constant();
    });
    return !of_number && whole->depends_on(variable);
  });
}

/// Whether some number of the construction is a rational that stands for an irrational one, within 1e-30: what is
/// constant in the mechanism that is written need not be so over the tower then.
bool stands_for_irrational(const mechanism::Mechanism& m) {
  const auto is_parameter = [&](const std::string& name) {
    return std::any_of(m.parameters.begin(), m.parameters.end(), [&](const auto& p) { return p.name == name; });
  };
  const auto rounded = [&](const core::Expression& e) {
    const auto names = core::symbols(e);  // variables of an open design are none
    return std::all_of(names.begin(), names.end(), is_parameter) && !mechanism::evaluate(e, m.parameters).exact;
  };
  if (std::any_of(m.parameters.begin(), m.parameters.end(), [](const auto& p) { return !p.exact; })) return true;
  return std::any_of(m.points.begin(), m.points.end(), [&](const mechanism::Point& point) {
    if (const auto* dyad = std::get_if<mechanism::DyadPoint>(&point.form))
      return rounded(dyad->from_length) || rounded(dyad->to_length);
    if (const auto* offset = std::get_if<mechanism::OffsetPoint>(&point.form))
      return rounded(offset->along) || rounded(offset->left);
    if (const auto* shifted = std::get_if<mechanism::ShiftedPoint>(&point.form)) {
      const std::vector<core::Expression> numbers = mechanism::numbers_of(shifted->by);
      return std::any_of(numbers.begin(), numbers.end(), rounded);
    }
    const auto* slider = std::get_if<mechanism::SliderPoint>(&point.form);
    return slider != nullptr && rounded(slider->length);
  });
}

}  // namespace

std::optional<std::string> what_bends(const Geometry& geometry, const Elimination& elimination,
                                      const mechanism::HeldByLinks& held, const std::vector<int>& sides) {
  const mechanism::Mechanism& m = geometry.mechanism();
  const std::vector<mechanism::PosturePoints> postures = postures_of(geometry, sides);
  if (postures.empty()) return std::nullopt;  // nothing of the sheet is in the box
  const auto kept = [&](const auto& candidate) {
    return std::all_of(postures.begin(), postures.end(),
                       [&](const mechanism::PosturePoints& points) { return mechanism::keeps(candidate, points); });
  };
  for (const HeldDistance& distance : held.distances)
    if (!kept(distance) ||
        (!is_constant(geometry, elimination, squared_distance(geometry, distance)) && !stands_for_irrational(m)))
      return "the " + mechanism::words_of(m, distance) + " changes";
  // Constants on the sheet, since the distances are.
  for (const HeldTurn& turn : held.turns)
    if (!kept(turn)) return "the " + mechanism::words_of(m, turn) + " is the other one";
  return std::nullopt;
}

}  // namespace clearloci::symbolic
