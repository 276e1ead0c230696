// Whether every design within tolerances keeps clear over a task, under every load of some balls, and whether its
// clearances displace the end effector no farther than they may (method.md section 12):
//     DesignTask -> loci::DesignJudge <-> numeric::DesignWitness
// Private to analysis/.
#pragma once

#include "analysis/verification.hpp"

namespace clearloci {

/// Whether a task speaks of more designs or loads than the file's, or of pose errors.
bool is_tolerant(const core::Task& task);

/// The task without its tolerances, balls of loads and pose error.
core::Task nominal(core::Task task);

/// Verdict, margin, witness and open part, for all designs and loads at once. A verdict of `refuted` has a witness.
void decide_tolerant(const mechanism::Mechanism& mechanism, const core::Task& task, const LociRequest& request,
                     Verification& result);

}  // namespace clearloci
