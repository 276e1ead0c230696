#include "workbench/server/lanes.hpp"

#include "workbench/server/refusal.hpp"

namespace clearloci::workbench {

std::unique_ptr<Lanes::Turn> Lanes::enter(const std::string& name) {
  std::unique_lock lock(mutex_);
  Lane& lane = lanes_[name];
  const std::uint64_t mine = ++lane.newest;
  if (lane.running) *lane.running = true;
  changed_.notify_all();  // those that wait already are no longer the newest
  ++lane.waiting;
  changed_.wait(lock, [&] { return lane.running == nullptr || lane.newest != mine; });
  --lane.waiting;
  if (lane.newest != mine) throw Refusal(409, "a newer request has taken the place of this one");
  lane.running = std::make_shared<std::atomic<bool>>(false);
  return std::make_unique<Turn>(*this, name, lane.running);
}

void Lanes::leave(const std::string& name, const std::atomic<bool>* turn) {
  const std::lock_guard lock(mutex_);
  const auto found = lanes_.find(name);
  if (found == lanes_.end() || found->second.running.get() != turn) return;
  found->second.running = nullptr;
  if (found->second.waiting == 0) lanes_.erase(found);  // lanes are named by pages, which come and go
  changed_.notify_all();
}

}  // namespace clearloci::workbench
