// The witness against the loci of free efforts (docs/background/method.md section 15): what the caller finds of the
// choice of efforts at every node of a grid, such as the order in which reactions vanish along the line of one effort.
// Between two neighbours that changes only where the edge meets one of the loci.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/task_conditions.hpp"
#include "numeric/reactions.hpp"
#include "numeric/validate.hpp"

namespace clearloci::numeric {

/// Of a pose; nothing where it is out of reach, or too near to a change for doubles.
using ChoiceOrder = std::optional<std::vector<int>>;
using FindChoice = std::function<ChoiceOrder(std::span<const Bounded> pose, const std::vector<int>& sides)>;

/// Of one free effort: the demands that end an interval of efforts at which they fail, by their places, in the order
/// along the efforts within `range`; those that doubles do not tell apart stand together behind a -1, and first -2 -
/// place those that fail at every effort. `none` and `one`: the mechanism with an effort of 0 and of 1; `gap`: efforts
/// at which the motor's own backlash is crossed.
ChoiceOrder order_of_efforts(const NumericModel& none, const NumericModel& one, std::span<const Bounded> pose,
                             const std::vector<int>& sides, const std::vector<core::TaskDemand>& demands,
                             const std::array<double, 2>& range, const std::optional<std::array<double, 2>>& gap);

/// `of`: by which the tallies are named. Two coordinates.
ValidationReport validate_preload(const NumericModel& model, const core::LocusMap& map, const GridSpec& spec,
                                  const FindChoice& choice, const TracedReaction& of);

}  // namespace clearloci::numeric
