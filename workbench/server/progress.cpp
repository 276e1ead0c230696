#include "workbench/server/progress.hpp"

#include <chrono>
#include <nlohmann/json.hpp>

namespace clearloci::workbench {

void ProgressBoard::tell(const std::string& client, const std::string& lane, double fraction, std::string_view stage) {
  const nlohmann::ordered_json event = {{"lane", lane}, {"fraction", fraction}, {"stage", stage}};
  const std::lock_guard lock(mutex_);
  if (!listeners_.contains(client)) return;
  news_[client][lane] = event.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  changed_.notify_all();
}

std::optional<std::string> ProgressBoard::next(const std::string& client) {
  constexpr std::chrono::seconds patience{10};
  std::unique_lock lock(mutex_);
  constexpr std::size_t most_pages = 256;
  if (listeners_.size() > most_pages) std::erase_if(listeners_, [](const auto& one) { return one.second == 0; });
  ++listeners_[client];
  changed_.wait_for(lock, patience, [&] { return stopped_ || news_.contains(client); });
  --listeners_[client];
  if (stopped_) return std::nullopt;
  const auto own = news_.find(client);
  if (own == news_.end()) return ": still here\n\n";
  std::string events;
  for (const auto& [lane, event] : own->second) events += "data: " + event + "\n\n";
  news_.erase(own);
  return events;
}

void ProgressBoard::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

}  // namespace clearloci::workbench
