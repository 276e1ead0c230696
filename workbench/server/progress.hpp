// How far long work is, told to the page that asked for it.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace clearloci::workbench {

class ProgressBoard {
 public:
  /// Of a client to which nobody listens nothing is kept.
  void tell(const std::string& client, const std::string& lane, double fraction, std::string_view stage);

  /// The client is listened to until what this returns is dropped. The board has to outlive it.
  std::shared_ptr<void> listen(const std::string& client);

  /// The news since the last call, the newest of each lane, as server-sent events; empty where there is none.
  std::string take(const std::string& client);

 private:
  std::mutex mutex_;
  std::map<std::string, std::map<std::string, std::string>> news_;  ///< by client, then lane
  std::map<std::string, int> listeners_;
};

}  // namespace clearloci::workbench
