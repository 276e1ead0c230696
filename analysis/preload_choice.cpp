#include "analysis/preload_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "analysis/effort_polytope.hpp"
#include "analysis/idle_efforts.hpp"
#include "analysis/pose_efforts.hpp"
#include "analysis/pose_tensions.hpp"
#include "analysis/task_demands.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"

namespace clearloci {
namespace {

using mechanism::JointIndex;
using mechanism::Mechanism;
using numeric::ChoiceOrder;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double too_near = 1e-9;  ///< relative: doubles do not tell which of two bounds comes first

bool are_near(double a, double b) {
  return std::isfinite(a) && std::isfinite(b) && std::abs(a - b) <= too_near * (1 + std::abs(a) + std::abs(b));
}

/// The farthest of the bounds on one effort to one side, and which row it is of.
struct Bound {
  double at = 0;
  int row = -1;
  bool shared = false;  ///< by another, as far as doubles tell
};

void tighten(Bound& bound, double at, int row, bool lower) {
  bound.shared = are_near(bound.at, at) || (bound.shared && (lower ? at < bound.at : at > bound.at));
  if (lower ? at > bound.at : at < bound.at) bound = {at, row, bound.shared};
}

/// Feasible or not and, of one free effort, the rows that end what it may be.
ChoiceOrder choice_of(const std::vector<EffortRow>& rows) {
  if (rows.front().slope.size() != 1) {
    const auto deepest = polytope_of(rows).deepest(widths_of(rows));
    const double depth = deepest ? core::to_double(deepest->depth) : -1;
    if (std::abs(depth) < too_near) return std::nullopt;
    return std::vector<int>{depth > 0 ? 1 : 0};
  }
  Bound low{-infinity, -1, false}, high{infinity, -1, false};
  for (const EffortRow& effort_row : rows) {
    const double slope = effort_row.slope[0].value, offset = effort_row.offset.value;
    if (!(std::abs(slope) > effort_row.slope[0].error)) return std::nullopt;
    const int row = 2 * static_cast<int>(effort_row.joint) + (effort_row.side > 0 ? 1 : 0);
    tighten(slope > 0 ? low : high, -offset / slope, row, slope > 0);
  }
  if (are_near(low.at, high.at)) return std::nullopt;
  if (low.at > high.at) return std::vector<int>{0};
  if (low.shared || high.shared) return std::nullopt;
  // Which end is the lower one is a matter of which tension is free.
  return std::vector<int>{1, std::min(low.row, high.row), std::max(low.row, high.row)};
}

numeric::FindChoice choice_of_effort(const Mechanism& mechanism, JointIndex index, const LociRequest& request) {
  const mechanism::Joint& joint = mechanism.joints[static_cast<std::size_t>(index)];
  std::array<double, 2> range = {-infinity, infinity};
  if (const auto& within = joint.free_effort->within)
    range = {core::to_double(within->first), core::to_double(within->second)};
  std::optional<std::array<double, 2>> gap;
  if (const auto found_gap = own_gap(mechanism, joint.name, request)) gap = {found_gap->from, found_gap->to};
  return [models = models_under_efforts(mechanism, {index}), demands = demands_of(mechanism, request), range, gap](
             std::span<const numeric::Bounded> pose, const std::vector<int>& sides) {
    return numeric::order_of_efforts(models[0], models[1], pose, sides, demands, range, gap);
  };
}

}  // namespace

numeric::FindChoice preload_choice(const Mechanism& mechanism, const LociRequest& request) {
  const std::vector<JointIndex> free = mechanism::joints_without_preload(mechanism);
  if (only_tensions_are_free(mechanism))
    return [&mechanism](std::span<const numeric::Bounded> pose, const std::vector<int>& sides) -> ChoiceOrder {
      const auto rows = effort_rows(mechanism, pose, sides);
      return rows ? choice_of(*rows) : std::nullopt;
    };
  if (free.size() != 1)
    throw core::InputError({mechanism.file},
                           "loci of free efforts are compared with the efforts of one motor, or of cables",
                           "give the efforts by --preload");
  return choice_of_effort(mechanism, free.front(), request);
}

}  // namespace clearloci
