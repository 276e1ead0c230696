#include "cli/time_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "clearloci/work_limit.hpp"
#include "cli/program.hpp"
#include "cli/standard_streams.hpp"
#include "core/errors.hpp"
#include "report/loci_json.hpp"

namespace clearloci::cli {
namespace {

/// How long work that was asked to end may take to do so and to write its files, before it is ended. With it a limit
/// is kept within twice its time, or a second where that is longer.
double grace(double limit) {
  constexpr double least_in_all = 0.8, part = 0.6, most = 5;
  return std::max(least_in_all - limit, std::min(part * limit, most));
}

}  // namespace

TimeLimit::TimeLimit(const CommonArguments& arguments) : text_(arguments.time_limit) {
  if (text_.empty()) return;
  const double limit = core::to_double(parse_positive(text_, "--time-limit", mechanism::Mechanism{}));
  if (limit >= core::longest_time_limit) return;
  deadline_ = core::deadline_after(arguments.started, limit);
  watcher_ = std::thread(&TimeLimit::watch, this, core::deadline_after(arguments.started, limit + grace(limit)));
}

TimeLimit::~TimeLimit() { stop(); }

void TimeLimit::known(std::function<void()> write) {
  const std::lock_guard lock(mutex_);
  write_ = std::move(write);
}

void TimeLimit::commit(report::StagedFiles& staged) {
  writing();
  staged.commit();
}

std::function<void()> TimeLimit::stop() {
  std::function<void()> write;
  {
    const std::lock_guard lock(mutex_);  // waits where the process is being ended
    stop_ = true;
    write = std::exchange(write_, {});
  }
  stopped_.notify_all();
  if (watcher_.joinable()) watcher_.join();
  return write;
}

void TimeLimit::watch(Clock::time_point end) {
  std::unique_lock lock(mutex_);
  if (stopped_.wait_until(lock, end, [this] { return stop_; })) return;
  // The lock stays held: whoever would end the process otherwise waits for its end here.
  int status = exit_limit_reached;
  if (write_) {
    try {
      write_();
      if (!flush_standard_output()) status = exit_wrong_input;
    } catch (const std::exception& error) {
      complain(error.what());
      status = exit_wrong_input;
    }
    complain(fmt::format("the time limit of {} s was reached; what is known is marked incomplete", text_));
  } else {
    complain(fmt::format("the time limit of {} s was reached before everything was written", text_));
  }
  // Standard output is not flushed where the work may be printing: it may hold the stream and wait for its reader.
  report::remove_temporaries();
  std::_Exit(status);
}

int run_within(const CommonArguments& arguments, const std::function<int(TimeLimit&)>& work) {
  TimeLimit limit(arguments);
  try {
    return work(limit);
  } catch (const core::LimitReached&) {
    if (const std::function<void()> write = limit.stop()) write();
    throw;
  }
}

void write_incomplete(const CommonArguments& arguments, const std::string& file, const nlohmann::ordered_json& body,
                      bool always) {
  nlohmann::ordered_json whole = body;
  whole["complete"] = false;
  const std::string text = report::json_text(whole);
  if (always || !arguments.output.empty()) report::write_atomically(output_folder(arguments) / file, text);
  if (arguments.json) fmt::print("{}", text);
}

nlohmann::ordered_json incomplete_body(const std::string& mechanism, const std::string& what) {
  return {{"format", 1},
          {"mechanism", mechanism},
          {"notes", {fmt::format("the time limit was reached before {} known", what)}}};
}

}  // namespace clearloci::cli
