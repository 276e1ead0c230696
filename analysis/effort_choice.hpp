// Efforts that are chosen for the poses of a task: `preload: controlled` by cells (docs/guide/preload.md,
// docs/background/method.md section 15):
//     pose -> the polytope of efforts with one pattern of signs -> its deepest place -> a cell in which that is proven
// A pattern fails where at one pose its rows exclude each other. Private to analysis/.
#pragma once

#include <vector>

#include "analysis/model.hpp"
#include "clearloci/verify.hpp"

namespace clearloci {

/// Of any number of free efforts. Throws core::InputError for tasks that ask for a
/// pose error or are to be moved, and as verify().
Verification verify_with_choices(const Model& model, const Task& task, const VerifyRequest& request);

}  // namespace clearloci
