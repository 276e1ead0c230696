// Signs that reactions can have all over a task, by what they can have at one pose of it: a reaction that never
// vanishes keeps its sign (docs/background/method.md section 15). Private to analysis/.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/effort_system.hpp"

namespace clearloci {

struct SignPatterns {
  std::vector<SignPattern> possible;  ///< that are not proven to be impossible
  /// Some signs, and why nothing has them: each pattern is among the possible ones or begins like one of these.
  std::vector<std::pair<SignPattern, EffortExclusion>> impossible;
};

/// At some places of one pose, by all loads, or by one. Nothing where |A| cannot be told from zero, or where there are
/// too many.
std::optional<SignPatterns> sign_patterns(const EffortSystem& system, const std::vector<loci::pose::Pose>& places,
                                          const std::optional<EffortSystem::OneLoad>& load = {});

/// All rows of a pattern at some places, those of the efforts among them; nothing as EffortSystem::rows.
std::optional<std::vector<EffortInequality>> all_rows(const EffortSystem& system,
                                                      const std::vector<loci::pose::Pose>& places,
                                                      const SignPattern& signs,
                                                      const std::optional<EffortSystem::OneLoad>& load = {});

/// Why a pattern fails, or sizes below its own.
void tell_rows(const EffortSystem& system, const EffortExclusion& exclusion, core::PreloadPattern& pattern);

/// "at (0.1 m, 0.5 m) M_A1 > 0 for efforts above 12 N m, M_A2 < 0 for efforts below 7 N m: these exclude each other".
std::string exclusion_words(const EffortSystem& system, const EffortExclusion& exclusion);

}  // namespace clearloci
