// Whether a study is one of a mechanism and its numbers can be kept: asked once for every front end, at the public
// functions. The reader of study files says it before, in its words.
// Private to studies/.
#pragma once

#include "clearloci/study.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci {

/// Throws core::InputError.
void check_study(const mechanism::Mechanism& mechanism, const core::Study& study);

}  // namespace clearloci
