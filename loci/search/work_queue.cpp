#include "loci/search/work_queue.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>

#include "core/threads.hpp"

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

namespace {

/// Of `wanted` threads, how many are to be had at the same time.
int threads_to_be_had(int wanted) {
  std::mutex gate;
  core::Threads threads;
  const std::lock_guard closed(gate);  // opened before they are waited for
  while (threads.count() < wanted && threads.start([&gate] { const std::lock_guard passed(gate); })) continue;
  return threads.count();
}

}  // namespace

void keep_to_threads_to_be_had() {
  // It stays to the end of the process: where it ends TBB makes the threads that it has kept it from.
  [[maybe_unused]] static const tbb::global_control* const bound = []() -> tbb::global_control* {
    // One is left for pictures, or for work under a deadline.
    const int others = tbb::info::default_concurrency() - 1, found = threads_to_be_had(others + 1);
    if (found > others) return nullptr;
    return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                 static_cast<std::size_t>(std::max(1, found)))
        .release();
  }();
}

}  // namespace clearloci::loci
