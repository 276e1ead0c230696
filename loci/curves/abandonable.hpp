// Work that cannot be interrupted (a call into CGAL asks nobody) under a deadline that must be kept.
//
// It runs in a thread of its own on data of its own, and is left behind where it does not end in time. A thread rather
// than a child process: its result needs no way back through a pipe, and the thread pool of the caller, of which a
// forked child would inherit locks without their owners, stays out of it. The price: what was left behind goes on
// until it ends or the process does, and holds its memory so long.
#pragma once

#include <chrono>
#include <future>
#include <system_error>
#include <thread>
#include <utility>

#include "core/errors.hpp"

namespace clearloci::loci {

/// The result of `work()`, or core::LimitReached where it does not come by `deadline`, or no thread is to be had.
/// Required: `work` holds whatever it uses by value, for it may outlive the caller. What it throws is thrown here.
template <class Work>
auto within(std::chrono::steady_clock::time_point deadline, Work work) -> decltype(work()) {
  std::packaged_task<decltype(work())()> task(std::move(work));
  auto result = task.get_future();
  try {
    std::thread(std::move(task)).detach();
  } catch (const std::system_error&) {
    throw core::LimitReached("no thread is to be had for the exact engine");
  }
  if (result.wait_until(deadline) != std::future_status::ready)
    throw core::LimitReached("the time limit was reached in the exact engine");
  return result.get();
}

}  // namespace clearloci::loci
