#include "symbolic/algebra_turn.hpp"

#include <chrono>

#include "clearloci/work_limit.hpp"

namespace clearloci::symbolic {

std::unique_lock<std::timed_mutex> algebra_turn() {
  constexpr std::chrono::milliseconds at_a_time{20};
  static std::timed_mutex one_at_a_time;
  std::unique_lock turn(one_at_a_time, std::defer_lock);
  while (!turn.try_lock_for(at_a_time)) core::WorkLimit::check_now();
  return turn;
}

}  // namespace clearloci::symbolic
