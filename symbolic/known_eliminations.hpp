// What eliminations over the sheets of one mechanism have in common: points placed otherwise on another sheet occur in
// few of the polynomials. Private to symbolic/.
#pragma once

#include <list>
#include <optional>
#include <vector>

#include "symbolic/ring.hpp"

namespace clearloci::symbolic {

/// For one thread.
class KnownEliminations {
 public:
  /// Polynomials on which a result depends, those on which all results do left out.
  using Sources = std::vector<Poly>;

  /// Whether an elimination may look up and keep results here: what all results depend on is what it was for the first
  /// one. Rings of the same variables.
  bool is_for(const Ring& ring, const Sources& common);

  enum class Kind { over_tower, factors };
  /// In the ring given.
  std::optional<std::vector<PolyFactor>> find(Kind kind, const Sources& sources, const Ring& ring) const;
  void keep(Kind kind, const Sources& sources, const std::vector<PolyFactor>& result);

 private:
  struct Entry {
    Kind kind;
    Sources sources;
    std::vector<PolyFactor> result;
  };
  Sources in_own_ring(const Sources& polynomials) const;

  std::optional<Ring> ring_;  ///< outlives those of the geometries
  std::optional<Sources> common_;
  std::list<Entry> known_;
};

}  // namespace clearloci::symbolic
