// Independent pieces of work on all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace clearloci::loci {

/// Calls task(0) to task(count - 1), each once, begun in this order, on as many threads as the machine has or the
/// caller's TBB arena allows. Where one throws no further one begins, and the first failure comes out.
void run_in_order(std::size_t count, const std::function<void(std::size_t)>& task);

}  // namespace clearloci::loci
