// A limit of the caller's for work whose request takes none: algebra, whose single steps are short and whose whole may
// take hours.
//     const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
//     const clearloci::WorkLimit limit(deadline, [] { return false; });
#pragma once

#include <chrono>
#include <functional>

#include "clearloci/errors.hpp"

namespace clearloci::inline core {

/// Seconds after a time. More than a century is a century: beyond it the clock's ticks would overflow.
constexpr double longest_time_limit = 3e9;
std::chrono::steady_clock::time_point deadline_after(std::chrono::steady_clock::time_point begun, double seconds);

/// While it lives, `check` of this thread ends what runs beyond the deadline, or is no longer wanted.
class WorkLimit {
 public:
  WorkLimit(std::chrono::steady_clock::time_point deadline, std::function<bool()> abandoned);
  ~WorkLimit();
  WorkLimit(const WorkLimit&) = delete;
  WorkLimit& operator=(const WorkLimit&) = delete;

  /// Throws LimitReached. For loops of short steps: most calls cost nothing.
  static void check();
  /// The same without saving on calls, where a thread waits.
  static void check_now();

 private:
  std::chrono::steady_clock::time_point deadline_;
  std::function<bool()> abandoned_;
  WorkLimit* outer_;
};

}  // namespace clearloci::inline core
