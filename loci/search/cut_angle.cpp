#include "loci/search/cut_angle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/errors.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::StraightLine;

/// The sine and the cosine of the angle that the square of a root is made of.
std::vector<SheetFunction> way_of(const core::RootTower& tower, int root) {
  const StraightLine& square = tower.roots[static_cast<std::size_t>(root)].line;
  const auto angle = std::find_if(square.steps.begin(), square.steps.end(), [](const StraightLine::Step& step) {
    return step.operation == StraightLine::Operation::angle;
  });
  core::ensure(angle != square.steps.end(), "the root of an angle is computed from it");
  const auto up_to = [&](int step) {
    return SheetFunction{core::Polynomial{tower.variables(), {}},
                         StraightLine{{square.steps.begin(), square.steps.begin() + step + 1}}};
  };
  return {up_to(angle->first), up_to(angle->second)};
}

}  // namespace

CutAngle::CutAngle(const SheetProgram& program, const core::WorkingMode& mode, int root)
    : root_(root), way_(program.tower(), way_of(program.tower(), root)), over_way_(way_, mode), over_(program, mode) {}

bool CutAngle::excludes(const PlaneCell& cell) {
  if (!over_way_.enter(cell.x, cell.y)) return false;
  const Interval &sine = over_way_.value(0), &cosine = over_way_.value(1);
  if (!sine.contains_zero() || !(cosine.upper() < 0)) return false;
  // Off the half turn, with room for the rounding of the arc tangent and of the sums below.
  constexpr double rounding = 0x1p-48;
  const double off = std::atan(sine.magnitude() / -cosine.upper()) + rounding;
  const Interval half_turn(std::numbers::pi - off, std::numbers::pi + rounding);
  return excludes(cell, half_turn) && excludes(cell, -half_turn);
}

bool CutAngle::excludes(const PlaneCell& cell, const Interval& angle) {
  const Interval everything(-std::numeric_limits<double>::max(), std::numeric_limits<double>::max());
  std::vector<Interval> ranges(static_cast<std::size_t>(over_.program().roots()), everything);
  ranges[static_cast<std::size_t>(root_)] = Interval(core::angle_shift) + angle;
  if (!over_.enter(std::array{cell.x, cell.y}, ranges) || !over_.value(0).contains_zero()) return true;
  over_.differentiate();
  return !over_.centred(0).contains_zero();
}

std::deque<CutAngle> cut_angles(const SheetProgram& program, const core::WorkingMode& mode) {
  std::deque<CutAngle> all;
  const std::vector<core::Root>& roots = program.tower().roots;
  for (std::size_t j = 0; j < roots.size(); ++j)
    if (roots[j].is_angle()) all.emplace_back(program, mode, static_cast<int>(j));
  return all;
}

}  // namespace clearloci::loci::sheet
