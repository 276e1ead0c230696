#include "loci/search/known_searches.hpp"

#include <algorithm>

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
  return key;
}

std::shared_ptr<const void> KnownSearches::known(const Key& key) const {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(all_.begin(), all_.end(), [&](const auto& candidate) { return candidate.first == key; });
  return found == all_.end() ? nullptr : found->second;
}

void KnownSearches::keep(const Key& key, std::shared_ptr<const void> result) {
  const std::lock_guard lock(mutex_);
  all_.emplace_back(key, std::move(result));
}

}  // namespace clearloci::loci::sheet
