#include "studies/work.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <exception>
#include <mutex>
#include <thread>

#include "core/errors.hpp"
#include "core/threads.hpp"
#include "studies/design_table.hpp"

namespace clearloci {
namespace {

using core::StudyDesign;
using Clock = std::chrono::steady_clock;

/// Items handed out at a time: work enough that threads seldom meet, little enough that they end together.
constexpr std::size_t piece = 32;
/// What another rank gets at a time takes it about so long: messages are few, whatever a design takes, and of a run
/// that is killed no more than that is lost.
constexpr std::chrono::duration<double> between_messages(0.1);
constexpr std::size_t largest_piece = 8192;
/// How often rank 0 looks for messages while its own threads work.
constexpr std::chrono::microseconds between_looks(500);

int threads_of(const StudyOptions& options) {
  if (options.threads > 0) return options.threads;
  // A rank is started for every core, as a rule.
  if (options.ranks != nullptr && options.ranks->size > 1) return 1;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Items to hand out and results as they come, whoever asks.
class Desk {
 public:
  Desk(const Work& work, const StudyOptions& options) : work_(work), options_(options) {}

  /// Empty: there are none left, or the time is up.
  std::vector<std::uint64_t> take(std::size_t most = piece) {
    const std::lock_guard lock(mutex_);
    std::vector<std::uint64_t> items;
    if (failed_) return items;
    if (options_.deadline && Clock::now() >= *options_.deadline) stopped_ = true;
    if (!stopped_) items.swap(put_back_);
    while (!stopped_ && items.size() < most) {
      const auto next = work_.next();
      if (!next) break;
      items.push_back(*next);
    }
    return items;
  }

  /// What was taken and is still to be done, before there is more to take.
  void put_back(std::vector<std::uint64_t> items) {
    const std::lock_guard lock(mutex_);
    put_back_ = std::move(items);
  }

  bool stopped() {
    if (options_.deadline && Clock::now() >= *options_.deadline) stopped_ = true;
    return stopped_;
  }

  void give(std::vector<StudyDesign> results) {
    const std::lock_guard lock(mutex_);
    work_.found(std::move(results));
  }

  void fail(std::exception_ptr why) {
    const std::lock_guard lock(mutex_);
    if (!failed_) failed_ = std::move(why);
    stopped_ = true;
  }

  bool end() {
    if (failed_) std::rethrow_exception(failed_);
    return !stopped_;
  }

 private:
  const Work& work_;
  const StudyOptions& options_;
  std::mutex mutex_;
  std::vector<std::uint64_t> put_back_;
  std::atomic<bool> stopped_ = false;
  std::exception_ptr failed_;
};

/// `items`: taken already.
void work_at(Desk& desk, const Work& work, std::vector<std::uint64_t> items) {
  if (items.empty()) return;
  try {
    const Worker worker = work.worker();
    for (; !items.empty(); items = desk.take()) {
      std::vector<StudyDesign> results;
      for (const std::uint64_t item : items) {
        if (desk.stopped()) break;
        results.push_back(worker(item));
      }
      desk.give(std::move(results));
    }
  } catch (...) {
    desk.fail(std::current_exception());
  }
}

std::string list_of(const std::vector<std::uint64_t>& items) {
  std::string text;
  for (const std::uint64_t item : items) text += std::to_string(item) + " ";
  return text;
}

std::vector<std::uint64_t> items_of(const std::string& text) {
  std::vector<std::uint64_t> items;
  const char *at = text.data(), *const end = at + text.size();
  while (at < end) {
    std::uint64_t item = 0;
    const auto [after, error] = std::from_chars(at, end, item);
    core::ensure(error == std::errc() && after < end && *after == ' ', "a list of items, each with a blank after it");
    items.push_back(item);
    at = after + 1;
  }
  return items;
}

std::vector<StudyDesign> results_of(const std::string& lines, std::size_t figures) {
  std::vector<StudyDesign> results;
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = lines.find('\n', at);
    StudyDesign design;
    core::ensure(
        end != std::string::npos && read_table_line(std::string_view(lines).substr(at, end - at), figures, design),
        "a rank sends whole lines");
    results.push_back(std::move(design));
    at = end + 1;
  }
  return results;
}

/// Hands out work to the other ranks until none is left and all have answered. A message is what a rank found since it
/// last asked; it asks for more by it. What is empty sends it to wait.
void hand_out(Desk& desk, const Work& work, const StudyRanks& ranks, const std::atomic<int>& busy) {
  struct Given {
    std::size_t items = piece;
    Clock::time_point at = {};
  };
  std::vector<Given> given(static_cast<std::size_t>(ranks.size));
  std::vector<int> waiting;
  int out = 0;
  for (int rank = 1; rank < ranks.size; ++rank) waiting.push_back(rank);
  while (true) {
    bool more = true;
    while (more && !waiting.empty()) {
      Given& order = given[static_cast<std::size_t>(waiting.back())];
      const std::vector<std::uint64_t> items = desk.take(order.items);
      more = !items.empty();
      if (!more) break;
      order.at = Clock::now();
      ranks.send(waiting.back(), list_of(items));
      waiting.pop_back();
      ++out;
    }
    if (const auto message = ranks.poll()) {
      Given& order = given[static_cast<std::size_t>(message->first)];
      const std::chrono::duration<double> took = Clock::now() - order.at;
      const double fitting =
          static_cast<double>(order.items) * (between_messages.count() / std::max(took.count(), 1e-6));
      // At most twice as many at a time: what is next may be harder.
      order.items = static_cast<std::size_t>(
          std::clamp(fitting, static_cast<double>(piece), 2.0 * static_cast<double>(order.items)));
      order.items = std::min(order.items, largest_piece);
      desk.give(results_of(message->second, work.figures));
      waiting.push_back(message->first);
      --out;
      continue;
    }
    if (out == 0 && !more && busy == 0) return;
    std::this_thread::sleep_for(between_looks);
  }
}

}  // namespace

bool do_work(const Work& work, const StudyOptions& options) {
  Desk desk(work, options);
  const bool ranks = options.ranks != nullptr && options.ranks->size > 1;
  std::atomic<int> busy = 0;
  core::Threads others;
  try {
    std::vector<std::uint64_t> own = ranks ? std::vector<std::uint64_t>{} : desk.take();
    // Each begins with what was taken for it: there are no more threads than pieces of work.
    for (int i = ranks ? 0 : 1; i < threads_of(options); ++i) {
      std::vector<std::uint64_t> items = desk.take();
      if (items.empty()) break;
      ++busy;
      if (others.start([&, items] {
            work_at(desk, work, items);
            --busy;
          }))
        continue;
      --busy;
      desk.put_back(std::move(items));
      break;
    }
    if (ranks)
      hand_out(desk, work, *options.ranks, busy);
    else
      work_at(desk, work, std::move(own));
  } catch (...) {
    desk.fail(std::current_exception());
  }
  others.join();
  return desk.end();
}

void serve(const Work& work, const StudyOptions& options) {
  const StudyRanks& ranks = *options.ranks;
  std::mutex mutex;
  std::vector<Worker> workers;  // made once: what they derive serves every message
  while (true) {
    const std::string message = ranks.receive();
    if (message.empty()) return;
    std::vector<std::uint64_t> items = items_of(message);
    std::size_t next = 0, taken = 0;
    std::string lines;
    Work rest = work;
    rest.worker = [&] {
      const std::lock_guard lock(mutex);
      if (taken == workers.size()) workers.push_back(work.worker());
      return workers[taken++];
    };
    rest.next = [&]() -> std::optional<std::uint64_t> {
      return next < items.size() ? std::optional(items[next++]) : std::nullopt;
    };
    rest.found = [&](std::vector<StudyDesign> results) {
      for (const StudyDesign& result : results) lines += table_line(result);
    };
    StudyOptions local;
    local.threads = threads_of(options);
    do_work(rest, local);
    ranks.send(0, lines);
  }
}

void dismiss(const StudyOptions& options) {
  if (options.ranks == nullptr) return;
  for (int rank = 1; rank < options.ranks->size; ++rank) options.ranks->send(rank, "");
}

}  // namespace clearloci
