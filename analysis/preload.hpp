// Which constant efforts of the free actuators make a task verify (docs/guide/preload.md)?
//     Mechanism, Task -> PreloadJudge, the efforts left open -> boxes of efforts
// A box whose every effort verifies, and one whose every effort fails, are proven; others are cut. Private to
// analysis/.
#pragma once

#include <optional>
#include <vector>

#include "analysis/model.hpp"
#include "clearloci/verify.hpp"

namespace clearloci {

/// The task with the efforts that it gives. Throws as verify().
Verification verify_preloaded(const Model& model, const Task& task, const VerifyRequest& request);

/// The task as it is verified with the smallest preload that was found, and what is known of all preloads. Of a
/// mechanism some of whose free efforts have no value. Throws as verify().
Verification verify_with_preload(const Model& model, const Task& task, const VerifyRequest& request);

}  // namespace clearloci
