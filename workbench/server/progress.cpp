#include "workbench/server/progress.hpp"

#include <nlohmann/json.hpp>

namespace clearloci::workbench {

void ProgressBoard::tell(const std::string& client, const std::string& lane, double fraction, std::string_view stage) {
  const nlohmann::ordered_json event = {{"lane", lane}, {"fraction", fraction}, {"stage", stage}};
  const std::lock_guard lock(mutex_);
  if (!listeners_.contains(client)) return;
  news_[client][lane] = event.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::shared_ptr<void> ProgressBoard::listen(const std::string& client) {
  const std::lock_guard lock(mutex_);
  ++listeners_[client];
  return {nullptr, [this, client](void*) {
            const std::lock_guard own_lock(mutex_);
            if (--listeners_[client] > 0) return;
            listeners_.erase(client);
            news_.erase(client);
          }};
}

std::string ProgressBoard::take(const std::string& client) {
  const std::lock_guard lock(mutex_);
  const auto found = news_.find(client);
  if (found == news_.end()) return {};
  std::string events;
  for (const auto& [lane, event] : found->second) events += "data: " + event + "\n\n";
  news_.erase(found);
  return events;
}

}  // namespace clearloci::workbench
