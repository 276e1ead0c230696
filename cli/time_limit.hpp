// --time-limit: of every command, and kept whatever the command is doing.
//
// The work itself asks deadline() where it can, and then ends early with what it has. Where it cannot ask (the computer
// algebra derives, a picture is painted), a watching thread ends the process a little later: it first writes what the
// command said is known by then. A thread, not a child process that is killed: what is known lies in this process's
// memory, nothing needs to be sent, and ending the process takes every other thread with it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <thread>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "report/files.hpp"

namespace clearloci::cli {

class TimeLimit {
 public:
  using Clock = std::chrono::steady_clock;

  /// Throws core::InputError where --time-limit is no positive number. Without one, nothing is watched.
  explicit TimeLimit(const CommonArguments& arguments);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

  /// When the work should end by itself.
  std::optional<Clock::time_point> deadline() const { return deadline_; }

  /// What to write where the work does not end by itself; takes the place of what was set before. Called in another
  /// thread, or in this one by run_within, so it holds what it needs by value.
  void known(std::function<void()> write);

  /// The result is whole and being printed: nothing is known that would not be in it.
  void writing() { known({}); }

  /// The files of the result are made and take their places. Until here the limit still writes what was known, since
  /// pictures may take longer than the work that they show.
  void commit(report::StagedFiles& staged);

  /// Stops watching; what was last given to known().
  std::function<void()> stop();

 private:
  void watch(Clock::time_point end);

  std::string text_;
  std::optional<Clock::time_point> deadline_;
  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stop_ = false;
  std::function<void()> write_;
  std::thread watcher_;
};

/// Runs a command's work. Where it ends with core::LimitReached, what is known is written before that goes on.
int run_within(const CommonArguments& arguments, const std::function<int(TimeLimit&)>& work);

/// A command whose work is `run`.
template <class Arguments>
Command within_limit(CLI::App* app, const std::shared_ptr<Arguments>& arguments,
                     int (*run)(const Arguments&, TimeLimit&)) {
  return {app, [arguments, run] {
            return run_within(arguments->common, [&](TimeLimit& limit) { return run(*arguments, limit); });
          }};
}

/// What is left of a result that did not come in time: `file` in the output folder (where a command writes without -o
/// only if `always`), and with --json the same on standard output. `body`: what is known; "complete": false is added.
void write_incomplete(const CommonArguments& arguments, const std::string& file, const nlohmann::ordered_json& body,
                      bool always = true);

/// The usual body: format, mechanism and a note.
nlohmann::ordered_json incomplete_body(const std::string& mechanism, const std::string& what);

}  // namespace clearloci::cli
