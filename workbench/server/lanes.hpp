// Of questions that follow one another, such as the loci while a slider moves, only the newest matters. A lane answers
// one at a time: whoever enters it abandons the work before it, and of those that wait for that to end the newest alone
// goes on.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace clearloci::workbench {

class Lanes {
 public:
  class Turn {
   public:
    Turn(Lanes& lanes, std::string name, std::shared_ptr<std::atomic<bool>> abandoned)
        : lanes_(lanes), name_(std::move(name)), abandoned_(std::move(abandoned)) {}
    ~Turn() { lanes_.leave(name_, abandoned_.get()); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

    bool abandoned() const { return *abandoned_; }

   private:
    Lanes& lanes_;
    std::string name_;
    std::shared_ptr<std::atomic<bool>> abandoned_;
  };

  /// Waits for the work before; throws Refusal 409 where a newer request comes meanwhile.
  std::unique_ptr<Turn> enter(const std::string& lane);

 private:
  struct Lane {
    std::uint64_t newest = 0;
    std::shared_ptr<std::atomic<bool>> running;
    int waiting = 0;
  };
  void leave(const std::string& lane, const std::atomic<bool>* turn);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Lane> lanes_;
};

}  // namespace clearloci::workbench
