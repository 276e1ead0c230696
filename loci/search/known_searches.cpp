#include "loci/search/known_searches.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::loci::sheet {

KnownSearches::Key KnownSearches::key(Key::Kind kind, const core::RootTower& tower, const core::WorkingMode& mode,
                                      const std::vector<core::Rational>& lower,
                                      const std::vector<core::Rational>& upper) {
  Key key{kind, mode, lower, {}, {static_cast<int>(tower.roots.size())}};
  key.box.insert(key.box.end(), upper.begin(), upper.end());
  for (const core::Root& root : tower.roots) {
    key.polynomials.push_back(root.square);
    key.polynomials.insert(key.polynomials.end(), root.cosine_and_sine.begin(), root.cosine_and_sine.end());
  }
  key.polynomials.insert(key.polynomials.end(), tower.denominators.begin(), tower.denominators.end());
  return key;
}

KnownSearches::Key KnownSearches::key(Key::Kind kind, const core::RootTower& tower, const core::WorkingMode& mode,
                                      const std::vector<core::Rational>& lower,
                                      const std::vector<core::Rational>& upper, const std::vector<Star>& stars) {
  Key result = key(kind, tower, mode, lower, upper);
  for (const Star& star : stars) {
    result.box.insert(result.box.end(), {star.x, star.y, star.slope});
    if (std::isfinite(star.room)) result.box.emplace_back(star.room);
    result.numbers.insert(
        result.numbers.end(),
        {static_cast<int>(star.shape), star.along_y ? 1 : 0, star.singular ? 1 : 0, star.no_length ? 1 : 0,
         std::isfinite(star.room) ? 1 : 0, star.apex ? 1 : 0, static_cast<int>(star.roots.size())});
    result.numbers.insert(result.numbers.end(), star.roots.begin(), star.roots.end());
    result.numbers.push_back(static_cast<int>(star.tangential.size()));
    for (const Star& along : star.tangential) {
      result.box.push_back(along.slope);
      result.numbers.insert(result.numbers.end(), {along.along_y ? 1 : 0, static_cast<int>(along.roots.size())});
      result.numbers.insert(result.numbers.end(), along.roots.begin(), along.roots.end());
    }
    if (!star.apex) continue;
    result.box.insert(result.box.end(), {star.apex->radius, star.apex->slope_radius});
    for (const Apex::Value& root : star.apex->roots) {
      result.box.insert(result.box.end(), {root.middle, root.radius});
      result.numbers.push_back(root.known ? 1 : 0);
    }
  }
  return result;
}

KnownSearches::Found KnownSearches::known(const Key& key, const std::function<Found()>& find) {
  std::promise<Found> promise;
  {
    std::unique_lock lock(mutex_);
    const auto known = std::find_if(all_.begin(), all_.end(), [&](const auto& other) { return other.first == key; });
    if (known != all_.end()) {
      const std::shared_future<Found> found = known->second;
      lock.unlock();
      return found.get();
    }
    all_.emplace_back(key, promise.get_future().share());
  }
  try {
    Found found = find();
    promise.set_value(found);
    return found;
  } catch (...) {
    promise.set_exception(std::current_exception());
    throw;
  }
}

}  // namespace clearloci::loci::sheet
