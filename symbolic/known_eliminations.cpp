#include "symbolic/known_eliminations.hpp"

#include <algorithm>

namespace clearloci::symbolic {

KnownEliminations::Sources KnownEliminations::in_own_ring(const Sources& polynomials) const {
  Sources own;
  for (const Poly& p : polynomials) own.push_back(p.in(*ring_));
  return own;
}

bool KnownEliminations::is_for(const Ring& ring, const Sources& common) {
  if (!ring_) ring_.emplace(ring.names());
  if (ring_->names() != ring.names()) return false;
  if (!common_) common_ = in_own_ring(common);
  return *common_ == common;
}

std::optional<std::vector<PolyFactor>> KnownEliminations::find(Kind kind, const Sources& sources,
                                                               const Ring& ring) const {
  const auto found = std::find_if(known_.begin(), known_.end(),
                                  [&](const Entry& entry) { return entry.kind == kind && entry.sources == sources; });
  if (found == known_.end()) return std::nullopt;
  std::vector<PolyFactor> result;
  for (const PolyFactor& factor : found->result) result.push_back({factor.poly.in(ring), factor.multiplicity});
  return result;
}

void KnownEliminations::keep(Kind kind, const Sources& sources, const std::vector<PolyFactor>& result) {
  Entry entry{kind, in_own_ring(sources), {}};
  for (const PolyFactor& factor : result) entry.result.push_back({factor.poly.in(*ring_), factor.multiplicity});
  known_.push_back(std::move(entry));
}

}  // namespace clearloci::symbolic
