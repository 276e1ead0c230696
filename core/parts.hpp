// Numbers that are joined to parts: disjoint sets as a forest.
#pragma once

#include <concepts>
#include <cstddef>
#include <numeric>
#include <vector>

namespace clearloci::inline core {

template <std::integral Number = int>
class Parts {
 public:
  /// Of 0 to `count` - 1, each a part by itself.
  explicit Parts(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), Number{0}); }

  /// The one that stands for the part that holds `number`.
  Number of(Number number) {
    for (Number above = parent(number); above != number; above = parent(number))
      number = parent(number) = parent(above);
    return number;
  }
  /// What stands for the part of `kept` then stands for both. False: they are one part already.
  bool join(Number kept, Number other) {
    kept = of(kept), other = of(other);
    parent(other) = kept;
    return kept != other;
  }

 private:
  Number& parent(Number number) { return parents_[static_cast<std::size_t>(number)]; }

  std::vector<Number> parents_;
};

}  // namespace clearloci::inline core
