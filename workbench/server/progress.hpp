// How far long work is, told to the page that asked for it.
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace clearloci::workbench {

class ProgressBoard {
 public:
  void tell(const std::string& client, const std::string& lane, double fraction, std::string_view stage);

  /// The next event for the client as a server-sent event, the newest of each lane; a comment that keeps the line open
  /// after some seconds without any. Nothing once the server stops.
  std::optional<std::string> next(const std::string& client);

  void stop();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, std::map<std::string, std::string>> news_;  ///< by client, then lane
  std::map<std::string, int> listeners_;
  bool stopped_ = false;
};

}  // namespace clearloci::workbench
