#include "loci/curves/out_of_reach.hpp"

#include <algorithm>
#include <array>

namespace clearloci::loci {
namespace {

using core::Interval;
using sheet::PlaneCell;

// Of the box: what is nearer to a curve than about a hundredth of it is not told apart from the curve.
constexpr int most_halvings_of_box = 14;

// What is looked at around the box, relative to it: its sides as doubles are on the safe side.
constexpr double around_box = 1e-6;

/// Divided by its largest coefficient: primitive polynomials may have some that no double holds.
core::Polynomial over_tower(const core::RootTower& tower, const core::Polynomial& implicit) {
  core::Rational largest = 0;
  for (const core::Term& term : implicit.terms) largest = std::max<core::Rational>(largest, abs(term.coefficient));
  core::Polynomial scaled{tower.variables(), implicit.terms};
  for (core::Term& term : scaled.terms) {
    term.exponents.resize(static_cast<std::size_t>(scaled.variables), 0);
    term.coefficient /= largest;
  }
  return scaled;
}

}  // namespace

bool is_free(sheet::SheetCell& look, const PlaneCell& cell, int halvings) {
  if (!look.enter(cell.x, cell.y)) return true;
  if (look.program().functions() > 0) {
    if (!look.value(0).contains_zero()) return true;
    look.differentiate();
    if (!look.centred(0).contains_zero()) return true;
  }
  if (halvings == 0) return false;
  const bool wide = cell.x.width() > cell.y.width();
  const Interval& range = wide ? cell.x : cell.y;
  const std::array parts = {Interval(range.lower(), range.middle()), Interval(range.middle(), range.upper())};
  return std::all_of(parts.begin(), parts.end(), [&](const Interval& part) {
    return is_free(look, wide ? PlaneCell{part, cell.y} : PlaneCell{cell.x, part}, halvings - 1);
  });
}

bool is_out_of_reach(const core::LocusProblem& problem, const core::Polynomial& implicit) {
  const auto range = [&](std::size_t c) {
    const double lower = core::to_double(problem.lower[c]), upper = core::to_double(problem.upper[c]);
    const double around = around_box * (upper - lower);
    return Interval(lower - around, upper + around);
  };
  const sheet::SheetProgram program(problem.tower, std::vector{over_tower(problem.tower, implicit)});
  return std::all_of(problem.modes.begin(), problem.modes.end(), [&](const core::WorkingMode& mode) {
    sheet::SheetCell look(program, mode);
    return is_free(look, {range(0), range(1)}, most_halvings_of_box);
  });
}

}  // namespace clearloci::loci
