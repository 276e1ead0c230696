#include "clearloci/work_limit.hpp"

#include <algorithm>
#include <utility>

namespace clearloci::inline core {
namespace {

thread_local WorkLimit* innermost = nullptr;
thread_local unsigned calls = 0;

}  // namespace

std::chrono::steady_clock::time_point deadline_after(std::chrono::steady_clock::time_point begun, double seconds) {
  const std::chrono::duration<double> limit(std::min(seconds, longest_time_limit));
  return begun + std::chrono::duration_cast<std::chrono::steady_clock::duration>(limit);
}

WorkLimit::WorkLimit(std::chrono::steady_clock::time_point deadline, std::function<bool()> abandoned)
    : deadline_(deadline), abandoned_(std::move(abandoned)), outer_(std::exchange(innermost, this)) {}

WorkLimit::~WorkLimit() { innermost = outer_; }

void WorkLimit::check() {
  constexpr unsigned seldom = 64;
  if (innermost != nullptr && ++calls % seldom == 0) check_now();
}

void WorkLimit::check_now() {
  const auto now = std::chrono::steady_clock::now();
  for (const WorkLimit* limit = innermost; limit != nullptr; limit = limit->outer_) {
    if (now > limit->deadline_) throw LimitReached("the time limit was reached");
    if (limit->abandoned_()) throw LimitReached("a newer request has taken the place of this one");
  }
}

}  // namespace clearloci::inline core
