#include "loci/search/work_queue.hpp"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>

namespace clearloci::loci {

void run_in_order(std::size_t count, const std::function<void(std::size_t)>& task) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) try {
        task(i);
      } catch (...) {
        next = count;
        throw;
      }
  };
  const auto threads = std::min(count, static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency())));
  // Isolated: while it waits, this thread takes up nothing of its caller's, who may hold a lock.
  tbb::this_task_arena::isolate([&] {
    tbb::task_group group;
    for (std::size_t i = 1; i < threads; ++i) group.run(work);
    group.run_and_wait(work);
  });
}

}  // namespace clearloci::loci
