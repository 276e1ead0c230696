// What the independent witness finds of the choice of free efforts at a pose, for the validation of preload loci
// (numeric/validate_preload.hpp). Private to analysis/.
#pragma once

#include "clearloci/loci.hpp"
#include "mechanism/mechanism.hpp"
#include "numeric/validate_preload.hpp"

namespace clearloci {

/// Of one free motor the order in which demands fail along its effort. Of cables whether a linear program finds
/// tensions within their bounds and, where one is free, which bounds end what it may be. Throws core::InputError for
/// others. Mechanism and request have to outlive it.
numeric::FindChoice preload_choice(const mechanism::Mechanism& mechanism, const LociRequest& request);

}  // namespace clearloci
