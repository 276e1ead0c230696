#include "loci/task_proof.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "loci/edge_labels.hpp"
#include "loci/sheet/sheet_cell.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusFactor;
using core::LocusProblem;
using core::Quantity;
using sheet::Interval;

int multiplicity(const LocusFactor& factor, const Component& component) {
  if (factor.role != FactorRole::reaction) return 0;
  for (const core::Vanishing& v : factor.vanishing)
    if (v.joint == component.first && v.quantity == component.second) return v.multiplicity;
  return 0;
}

bool always_zero(const LocusProblem& problem, const Component& component) {
  return std::any_of(problem.always_zero.begin(), problem.always_zero.end(), [&](const core::Vanishing& v) {
    return v.joint == component.first && v.quantity == component.second;
  });
}

bool wanted(const LocusProblem& problem, Quantity quantity) {
  return std::find(problem.quantities.begin(), problem.quantities.end(), quantity) != problem.quantities.end();
}

sheet::SheetProgram program_of(const LocusProblem& problem) {
  std::vector<sheet::SheetFunction> functions;
  for (const LocusFactor& factor : problem.factors) functions.push_back({factor.sheet, factor.line});
  return {problem.tower, functions};
}

/// One load's factors over cells.
class CaseCell {
 public:
  CaseCell(const LoadCase& load, const core::WorkingMode& mode)
      : load_(&load), problem_(*load.problem), program_(program_of(problem_)), cell_(program_, mode) {
    signs_.resize(problem_.factors.size());
  }
  CaseCell(const CaseCell&) = delete;
  CaseCell& operator=(const CaseCell&) = delete;

  /// False: nothing is proven of the cell. `outside`: set where it lies outside the workspace for certain.
  bool enter(const Interval& x, const Interval& y, bool& outside) {
    outside = !cell_.enter(x, y);
    if (outside) return false;
    for (int j = 0; j < program_.roots(); ++j)
      if (cell_.square(j).sign() <= 0) return false;
    bool differentiated = false;
    for (std::size_t f = 0; f < signs_.size(); ++f) {
      const int index = static_cast<int>(f);
      signs_[f] = cell_.value(index).sign();
      if (signs_[f] != 0) continue;
      if (!differentiated) cell_.differentiate();
      differentiated = true;
      signs_[f] = cell_.centred(index).sign();
    }
    return true;
  }

  /// |A|, margins and the closure's denominators.
  bool regular() const {
    for (std::size_t f = 0; f < signs_.size(); ++f) {
      const FactorRole role = problem_.factors[f].role;
      if (role != FactorRole::reaction && role != FactorRole::workspace_boundary && signs_[f] == 0) return false;
    }
    return true;
  }

  /// Sign of the product of its factors, 0 where one may vanish.
  int product(const Component& component) const {
    if (always_zero(problem_, component)) return 0;
    int sign = 1;
    for (std::size_t f = 0; f < signs_.size(); ++f) {
      const int times = multiplicity(problem_.factors[f], component);
      if (times > 0) sign *= times % 2 == 0 ? std::abs(signs_[f]) : signs_[f];
    }
    return sign;
  }

  /// Sign of the numerator, 0 where it is not known.
  int numerator(const Component& component) const {
    const auto known = load_->signs.find(component);
    return known == load_->signs.end() ? 0 : known->second * product(component);
  }

 private:
  const LoadCase* load_;
  const LocusProblem& problem_;
  sheet::SheetProgram program_;
  sheet::SheetCell cell_;
  std::vector<int> signs_;
};

bool holds(const Condition& condition, const std::vector<std::unique_ptr<CaseCell>>& cases) {
  const auto borne = [&](const CaseCell& first, const CaseCell& second) {
    return std::any_of(condition.components.begin(), condition.components.end(), [&](Quantity quantity) {
      const Component component = {condition.reaction.joint, quantity};
      if (&first == &second) return first.product(component) != 0;
      const int sign = first.numerator(component);
      return sign != 0 && sign == second.numerator(component);
    });
  };
  if (cases.size() == 1) return borne(*cases.front(), *cases.front());
  for (std::size_t k = 1; k < cases.size(); ++k)
    if (!borne(*cases[k - 1], *cases[k])) return false;
  return true;
}

}  // namespace

std::vector<Condition> conditions_of(const LocusProblem& problem) {
  std::vector<Condition> conditions;
  const auto bears = [&](const std::string& joint, Quantity quantity) {
    return !always_zero(problem, {joint, quantity});
  };
  for (const std::string& joint : problem.joints) {
    const std::vector<Quantity> force = core::force_components(problem, joint);
    if (wanted(problem, Quantity::f) &&
        std::any_of(force.begin(), force.end(), [&](Quantity quantity) { return bears(joint, quantity); }))
      conditions.emplace_back(core::Vanishing{joint, Quantity::f, 1}, force);
  }
  // Couples, axial forces and what guides bear, wherever a factor says that they are loci.
  for (const LocusFactor& factor : problem.factors) {
    if (factor.role != FactorRole::reaction) continue;
    for (const core::Vanishing& v : wanted_vanishing(problem, factor.vanishing)) {
      const bool single = v.quantity != Quantity::f && gravest_kind({v}) < core::LocusKind::component;
      const bool known = std::any_of(conditions.begin(), conditions.end(), [&](const Condition& c) {
        return c.reaction.joint == v.joint && c.reaction.quantity == v.quantity;
      });
      if (single && !known && bears(v.joint, v.quantity)) conditions.emplace_back(v, std::vector{v.quantity});
    }
  }
  return conditions;
}

int product_sign(const LocusProblem& problem, const core::WorkingMode& mode, const Component& component,
                 const core::Point2& at) {
  if (always_zero(problem, component)) return 0;
  const sheet::SheetProgram program = program_of(problem);
  sheet::PointSign sign_at(program, mode);
  int sign = 1;
  for (std::size_t f = 0; f < problem.factors.size() && sign != 0; ++f) {
    const int times = multiplicity(problem.factors[f], component);
    if (times == 0) continue;
    const int own = sign_at(at[0], at[1], static_cast<int>(f)).value_or(0);
    sign *= times % 2 == 0 ? std::abs(own) : own;
  }
  return sign;
}

TaskProof prove_task(const std::vector<LoadCase>& loads, const core::WorkingMode& mode, const TaskRegion& region,
                     double margin, int most_cells) {
  struct Cell {
    Interval x, y;
  };
  std::vector<std::unique_ptr<CaseCell>> cases;
  for (const LoadCase& load : loads) cases.push_back(std::make_unique<CaseCell>(load, mode));
  const std::vector<Condition> conditions = conditions_of(*loads.front().problem);
  const double size = std::max({region.upper()[0] - region.lower()[0], region.upper()[1] - region.lower()[1], margin});
  // Doubles place the task and its margin to rounding; a hair more covers it.
  const double reach = margin + 1e-12 * (size + std::max(std::abs(region.upper()[0]), std::abs(region.upper()[1])));
  std::vector<Cell> open = {{Interval(region.lower()[0] - reach, region.upper()[0] + reach),
                             Interval(region.lower()[1] - reach, region.upper()[1] + reach)}};
  TaskProof proof;
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    if (region.distance(cell.x, cell.y) > reach) continue;
    const core::Point2 middle = {cell.x.middle(), cell.y.middle()};
    bool outside = false;
    const bool proven =
        std::all_of(cases.begin(), cases.end(),
                    [&](const auto& c) { return c->enter(cell.x, cell.y, outside) && c->regular(); }) &&
        std::all_of(conditions.begin(), conditions.end(), [&](const Condition& c) { return holds(c, cases); });
    if (proven) {
      ++proof.cells;
      continue;
    }
    const double width = std::max(cell.x.width(), cell.y.width());
    if (outside || ++proof.cells > most_cells || width < 1e-11 * size) {
      proof.open = middle;
      return proof;
    }
    // The half nearer to square.
    if (cell.x.width() >= cell.y.width()) {
      open.push_back({Interval(cell.x.lower(), middle[0]), cell.y});
      open.push_back({Interval(middle[0], cell.x.upper()), cell.y});
    } else {
      open.push_back({cell.x, Interval(cell.y.lower(), middle[1])});
      open.push_back({cell.x, Interval(middle[1], cell.y.upper())});
    }
  }
  proof.proven = true;
  return proof;
}

bool outside_workspace(const LocusProblem& problem, const core::WorkingMode& mode, const core::Point2& at) {
  const sheet::SheetProgram program(problem.tower, std::vector<sheet::SheetFunction>{});
  sheet::SheetCell cell(program, mode);
  return !cell.enter(Interval(at[0]), Interval(at[1]));
}

}  // namespace clearloci::loci
