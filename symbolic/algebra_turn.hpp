// GiNaC counts references without locks and shares its small numbers among all expressions, so that of the threads of a
// process only one at a time may hold an expression, to the last one's end. Every function of symbolic/ that others
// call takes this turn first; what it returns has no expression in it. Private to symbolic/.
#pragma once

#include <mutex>

namespace clearloci::symbolic {

/// Waits for the algebra of other threads to end, or throws core::LimitReached (clearloci/work_limit.hpp). To be taken
/// once on the way in, before any expression is made.
[[nodiscard]] std::unique_lock<std::timed_mutex> algebra_turn();

}  // namespace clearloci::symbolic
