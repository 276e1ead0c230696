// A law of one free effort under which a task verifies: docs/background/method.md section 15. Private to analysis/.
//     poses of the task -> gaps of efforts -> for each pattern of signs what the effort is between -> a polynomial
//     between these -> verify(), which alone proves it
// A pattern fails where at one pose two reactions ask for efforts that exclude each other.
#pragma once

#include <string>
#include <vector>

#include "analysis/wanted_efforts.hpp"

namespace clearloci {

/// The task under the simplest law that was found to verify, or under no preload. Throws as verify(), and
/// core::InputError for several free efforts without a value.
Verification verify_with_law(const Model& model, const Task& task, const VerifyRequest& request);

}  // namespace clearloci
