// At one pose every reaction is affine in the effort e of a free actuator (docs/background/method.md section 15):
//     w(e) = a + e b
// so that the efforts at which it vanishes, or is too small, are an interval: a zero of one component, the part of a
// line that lies in a ball of several.
#pragma once

#include <span>
#include <vector>

#include "core/task_conditions.hpp"
#include "numeric/reactions.hpp"

namespace clearloci::numeric {

/// Efforts, N or N m, at which a demand fails: all of them lie between the ends, which are infinite where it fails at
/// every effort. A zero has both ends beside it, a few roundings apart.
struct EffortGap {
  double from = 0, to = 0;
  core::TaskDemand demand;
  double rounding = 0;  ///< how far the ends may be beyond the exact ones
  int sign_above = 0;   ///< of a reaction of one component, beyond `to`; 0 of several
};

/// `none` and `one`: the mechanism with an effort of 0 and of 1; `at`: one pose of it. Empty where |A| cannot be told
/// from zero.
std::vector<EffortGap> effort_gaps(const NumericModel& none, const NumericModel& one, std::span<const Bounded> at,
                                   std::span<const int> mode, const std::vector<core::TaskDemand>& demands);

}  // namespace clearloci::numeric
