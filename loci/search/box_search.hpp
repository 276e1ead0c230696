// Searches that cut boxes until something is known of each. Which box comes next is an order, what a search may cost is
// a budget; what is known, and where to cut, is the caller's:
//     SearchMeter meter(budget);
//     BoxSearch<Box> left(SearchOrder::breadth_first);
//     left.push(whole);
//     while (!left.empty() && meter.begin()) {
//       const Box box = left.take();
//       if (!is_known(box))
//         for (Box& half : halves_of(box, along)) left.push(std::move(half));
//     }
// Nothing is known of the boxes that are left then.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace clearloci::loci {

enum class SearchOrder {
  breadth_first,    ///< the first one pushed
  depth_first,      ///< the last one pushed: few are left at a time
  least_key_first,  ///< the one of the least key; which one of several is the same in every run
};

struct SearchBudget {
  long most_cells = std::numeric_limits<long>::max();
  long most_cells_in_vain = std::numeric_limits<long>::max();  ///< while nothing is proven of any cell
  std::optional<std::chrono::steady_clock::time_point> deadline = {};

  bool is_out_of_time() const { return deadline && std::chrono::steady_clock::now() >= *deadline; }
};

/// What a search has cost, and what ended it before its boxes did.
struct SearchCost {
  long cells = 0;  ///< that were looked at
  bool out_of_cells = false, out_of_time = false;
};

/// Counts what a search costs, from any thread.
class SearchMeter {
 public:
  explicit SearchMeter(const SearchBudget& budget) : budget_(budget) {}

  /// Counts cells that are about to be looked at. False, and no cells are counted, once the budget is spent or the
  /// search was stopped.
  bool begin(long cells = 1) {
    if (stopped_) return false;
    if (cells_ >= (proven_ == 0 ? std::min(budget_.most_cells, budget_.most_cells_in_vain) : budget_.most_cells))
      stopped_ = out_of_cells_ = true;
    else if (budget_.is_out_of_time())
      stopped_ = out_of_time_ = true;
    else
      cells_ += cells;
    return !stopped_;
  }
  /// Counts more of them.
  void add(long cells) { cells_ += cells; }
  /// Something is proven of a cell.
  void prove() { ++proven_; }
  void stop() { stopped_ = true; }
  bool is_stopped() const { return stopped_; }
  SearchCost cost() const { return {cells_, out_of_cells_, out_of_time_}; }

 private:
  SearchBudget budget_;
  std::atomic<long> cells_ = 0, proven_ = 0;
  std::atomic<bool> stopped_ = false, out_of_cells_ = false, out_of_time_ = false;
};

/// The boxes that are left, with the key of each.
template <class Box, class Key = double>
class BoxSearch {
 public:
  struct Left {
    Key key{};
    Box box;
  };
  explicit BoxSearch(SearchOrder order) : order_(order) {}

  void push(Box box, Key key = {}) {
    left_.push_back({std::move(key), std::move(box)});
    if (order_ == SearchOrder::least_key_first) std::push_heap(left_.begin(), left_.end(), is_later);
  }
  bool empty() const { return left_.empty(); }
  std::size_t size() const { return left_.size(); }
  const Left& next() const { return order_ == SearchOrder::depth_first ? left_.back() : left_.front(); }
  Box take() { return std::move(taken().box); }
  /// Up to so many boxes, with keys below one.
  std::vector<Left> take(std::size_t most, const Key& below) {
    std::vector<Left> some;
    while (!empty() && some.size() < most && next().key < below) some.push_back(taken());
    return some;
  }
  /// One of those that are left: the first are likely to come next, but for depth_first.
  Left& operator[](std::size_t i) { return left_[i]; }
  auto begin() const { return left_.begin(); }
  auto end() const { return left_.end(); }
  void clear() { left_.clear(); }

 private:
  static bool is_later(const Left& a, const Left& b) { return a.key > b.key; }

  Left taken() {
    const bool last = order_ != SearchOrder::breadth_first;
    if (order_ == SearchOrder::least_key_first) std::pop_heap(left_.begin(), left_.end(), is_later);
    Left one = std::move(last ? left_.back() : left_.front());
    last ? left_.pop_back() : left_.pop_front();
    return one;
  }

  SearchOrder order_;
  std::deque<Left> left_;
};

}  // namespace clearloci::loci
