// Independent pieces of work on all cores.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace clearloci::loci {

/// Calls task(0) to task(count - 1), each once, begun in this order, on as many threads as the machine has or the
/// caller's TBB arena allows. Where one throws no further one begins, and the first failure comes out.
void run_in_order(std::size_t count, const std::function<void(std::size_t)>& task);

/// Work on all cores makes threads, and ends in an exception where the system refuses one: to be called before any, it
/// keeps this process to as many as are to be had.
void keep_to_threads_to_be_had();

/// Calls look(worker, 0) to look(worker, count - 1), `at_a_time` by the worker of a thread, who has forgotten what it
/// saw before: what it sees does not depend on threads. `workers`: a tbb::enumerable_thread_specific.
template <class Workers, class Look>
void look_in_parts(std::size_t count, std::size_t at_a_time, Workers& workers, const Look& look) {
  run_in_order((count + at_a_time - 1) / at_a_time, [&](std::size_t part) {
    auto& worker = workers.local();
    worker.forget();
    for (std::size_t i = part * at_a_time; i < std::min(count, (part + 1) * at_a_time); ++i) look(worker, i);
  });
}

}  // namespace clearloci::loci
