// Free efforts without a value, and what they are looked for in. Private to analysis/.
#pragma once

#include <string>
#include <vector>

#include "analysis/model.hpp"
#include "clearloci/verify.hpp"

namespace clearloci {

/// A free effort without a value, and where it is looked for.
struct WantedEffort {
  std::string joint, parameter;
  bool force = false;
  core::Rational lower = {}, upper = {};
  double size_of_one = 1;  ///< what an effort of 1 N or 1 N m counts
};

/// Where there is no `within`, eight times as far as an effort at which a reaction was seen to change its sign.
std::vector<WantedEffort> wanted_efforts(const Model& model, const Task& task, const VerifyRequest& request);

Model with_efforts(const Model& model, const std::vector<WantedEffort>& wanted,
                   const std::vector<core::Rational>& efforts);

/// The mechanism under its loads, and with each part of a load that a task lets differ as much larger and smaller as
/// it may be.
std::vector<mechanism::Mechanism> under_larger_loads(const mechanism::Mechanism& mechanism, const Task& task);

/// "B2, A4".
std::string named_efforts(const std::vector<WantedEffort>& wanted);

}  // namespace clearloci
