// The natural coordinates of a mechanism in general position, modulo a prime. Private to symbolic/.
#pragma once

#include <vector>

#include "symbolic/geometry.hpp"
#include "symbolic/residue.hpp"

namespace clearloci::symbolic {

/// Numbers that follow no pattern, the same in every run, for all variables of a geometry's ring; the cosine and the
/// sine of an angle are a point of the unit circle.
class ResiduePose {
 public:
  /// `number`: another pose for each.
  ResiduePose(const Geometry& geometry, std::size_t number);

  /// In the ring's variables.
  Residue value(const core::Polynomial& polynomial) const;

 private:
  std::vector<Residue> at_;
};

}  // namespace clearloci::symbolic
