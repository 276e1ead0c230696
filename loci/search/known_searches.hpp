// What searches on sheets have found, for those who trace one problem again with another tolerance, as zones do where
// polylines of curves that nearly touch are not told apart: topology and zeros do not depend on it. May be shared by
// threads.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/polynomial.hpp"
#include "core/root_tower.hpp"

namespace clearloci::loci::sheet {

class KnownSearches {
 public:
  /// All that a search of one kind depends on. A function's straight line comes with its polynomial.
  struct Key {
    enum class Kind { curve, zeros, algebra } kind = Kind::curve;
    core::WorkingMode mode;
    std::vector<core::Rational> box;
    std::vector<core::Polynomial> polynomials;  ///< squares of the tower, then functions
    std::vector<int> numbers;                   ///< budgets and labels

    bool operator==(const Key&) const = default;
  };

  static Key key(Key::Kind kind, const core::RootTower& tower, const core::WorkingMode& mode,
                 const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper);

  /// What was found, or else what `find` finds now.
  template <class Result>
  std::shared_ptr<const Result> get(const Key& key, const std::function<std::shared_ptr<const Result>()>& find) {
    if (std::shared_ptr<const void> found = known(key)) return std::static_pointer_cast<const Result>(std::move(found));
    std::shared_ptr<const Result> result = find();
    keep(key, result);
    return result;
  }

 private:
  std::shared_ptr<const void> known(const Key& key) const;
  void keep(const Key& key, std::shared_ptr<const void> result);

  mutable std::mutex mutex_;
  std::vector<std::pair<Key, std::shared_ptr<const void>>> all_;
};

}  // namespace clearloci::loci::sheet
