#include "symbolic/algebra_turn.hpp"

namespace clearloci::symbolic {

std::unique_lock<std::mutex> algebra_turn() {
  static std::mutex one_at_a_time;
  return std::unique_lock(one_at_a_time);
}

}  // namespace clearloci::symbolic
