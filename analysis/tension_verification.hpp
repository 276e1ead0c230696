// Whether cables have tensions within their bounds at every pose of a task, one choice a pose (docs/guide/preload.md,
// docs/background/method.md section 15):
//     pose -> the polytope of feasible efforts -> its deepest place -> a cell in which that choice is proven
// At one pose the bounds are linear in the free efforts, so that the feasible ones are convex: where every pose has
// some strictly within all bounds, some vary continuously with the pose. Private to analysis/.
#pragma once

#include "analysis/model.hpp"
#include "clearloci/verify.hpp"

namespace clearloci {

/// Of a mechanism whose free efforts are tensions (only_tensions_are_free). Throws core::InputError for tasks over
/// other designs and loads than the file's or loads_from, for joints with clearances, and as verify().
Verification verify_with_tensions(const Model& model, const Task& task, const VerifyRequest& request);

}  // namespace clearloci
