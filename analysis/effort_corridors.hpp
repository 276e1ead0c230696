// What one free effort has to be between at poses of a task, so that every demanded reaction keeps the sign that it has
// at the first pose: a pattern of signs (docs/background/method.md section 15). Private to analysis/.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/wanted_efforts.hpp"
#include "numeric/effort_gaps.hpp"

namespace clearloci {

/// An end of what an effort may be, and the reaction that asks for it.
struct CorridorEnd {
  double effort = 0;  ///< infinite where nothing does
  std::string reaction = {};
  double rounding = 0;
};

/// At one pose.
struct EffortCorridor {
  std::vector<double> at;
  CorridorEnd lower, upper;

  bool empty() const { return lower.effort >= upper.effort; }
};

/// Of one pattern, pose after pose.
struct EffortPattern {
  std::vector<EffortCorridor> corridors;
  /// The pose at which the efforts that two signs ask for exclude each other, for certain: no effort has the pattern.
  std::optional<EffortCorridor> excluded = {};
  double least = 0;  ///< the size of an effort with the pattern is not below this at each pose: for certain
};

/// The patterns that some effort has at the first pose, that of the smallest effort first, and what reactions are not
/// asked for. `wanted`: the one free effort. Poses at which |A| cannot be told from zero are left out.
std::vector<EffortPattern> effort_patterns(const mechanism::Mechanism& mechanism, const WantedEffort& wanted,
                                           const Task& task, const LociRequest& request,
                                           const std::vector<std::vector<double>>& poses);

}  // namespace clearloci
