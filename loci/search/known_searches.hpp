// What searches on sheets have found, for those who trace one problem again with another tolerance, as zones do where
// polylines of curves that nearly touch are not told apart: topology and zeros do not depend on it. Also for sheets of
// one mechanism on which points are placed otherwise, where those below them are the same. May be shared by threads.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/polynomial.hpp"
#include "core/root_tower.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

class KnownSearches {
 public:
  /// All that a search of one kind depends on. A function's straight line comes with its polynomial.
  struct Key {
    enum class Kind { curve, zeros, algebra, arrangement } kind = Kind::curve;
    core::WorkingMode mode;
    std::vector<core::Rational> box;            ///< its sides, then what the stars are
    std::vector<core::Polynomial> polynomials;  ///< squares and denominators of the tower, then functions
    std::vector<int> numbers;                   ///< budgets and labels

    bool operator==(const Key&) const = default;
  };

  static Key key(Key::Kind kind, const core::RootTower& tower, const core::WorkingMode& mode,
                 const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper);

  /// With the stars that a search knows beforehand.
  static Key key(Key::Kind kind, const core::RootTower& tower, const core::WorkingMode& mode,
                 const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper,
                 const std::vector<Star>& stars);

  /// What was found, or else what `find` finds now. What another thread is finding is waited for. Required: `find` does
  /// not ask for the same key.
  template <class Result>
  std::shared_ptr<const Result> get(const Key& key, const std::function<std::shared_ptr<const Result>()>& find) {
    return std::static_pointer_cast<const Result>(known(key, [&]() -> std::shared_ptr<const void> { return find(); }));
  }

 private:
  using Found = std::shared_ptr<const void>;
  Found known(const Key& key, const std::function<Found()>& find);

  std::mutex mutex_;
  std::vector<std::pair<Key, std::shared_future<Found>>> all_;
};

}  // namespace clearloci::loci::sheet
