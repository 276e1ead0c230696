// What a function of exact data gave for its last arguments. The curves of a mechanism lie on parts of one tower, and
// each asks the same of them. Private to sheet/.
#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <tuple>
#include <utility>

namespace clearloci::loci::sheet {

/// For one thread.
template <class Value, class... Arguments>
class Remembered {
 public:
  /// Valid until the next call.
  template <class Compute>
  const Value& operator()(const Compute& compute, const Arguments&... arguments) {
    const auto known = std::find_if(known_.begin(), known_.end(),
                                    [&](const auto& entry) { return entry.first == std::tie(arguments...); });
    if (known != known_.end()) {
      known_.splice(known_.begin(), known_, known);
      return known->second;
    }
    Value value = compute();
    if (known_.size() == most) known_.pop_back();
    known_.emplace_front(std::tuple<Arguments...>(arguments...), std::move(value));
    return known_.front().second;
  }

 private:
  static constexpr std::size_t most = 128;
  std::list<std::pair<std::tuple<Arguments...>, Value>> known_;  ///< the last asked for first
};

/// Terms of a polynomial that is worth the memory.
inline constexpr std::size_t most_terms_remembered = 300;

}  // namespace clearloci::loci::sheet
