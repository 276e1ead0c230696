#include "loci/search/work_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace clearloci::loci {
namespace {

TEST(WorkQueue, DoesEveryTaskOnce) {
  std::vector<std::atomic<int>> done(1000);
  run_in_order(done.size(), [&](std::size_t i) { ++done[i]; });
  for (const std::atomic<int>& count : done) EXPECT_EQ(count, 1);
  run_in_order(0, [](std::size_t) { FAIL() << "there is nothing to do"; });
}

TEST(WorkQueue, BeginsNothingAfterAFailure) {
  std::atomic<int> begun = 0;
  try {
    run_in_order(100000, [&](std::size_t i) {
      ++begun;
      if (i == 3) throw std::runtime_error("the fourth");
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // all of them would take a minute
    });
    FAIL() << "the failure was lost";
  } catch (const std::runtime_error& failure) {
    EXPECT_STREQ(failure.what(), "the fourth");
  }
  EXPECT_GE(begun, 4);
  EXPECT_LT(begun, 100000);
}

// A thread that waits for its own tasks takes up none of its caller's, who may hold a lock.
TEST(WorkQueue, MayBeUsedWithinATaskThatHoldsALock) {
  std::mutex mutex;
  std::atomic<int> done = 0;
  run_in_order(8, [&](std::size_t) {
    const std::lock_guard lock(mutex);
    run_in_order(8, [&](std::size_t) { ++done; });
  });
  EXPECT_EQ(done, 64);
}

}  // namespace
}  // namespace clearloci::loci
