// Limits of the workspace as natural polynomials. Private to symbolic/.
//
//   distance of A, B within [l, u]:         |B - A|^2 - l^2 >= 0,   u^2 - |B - A|^2 >= 0
//   torsion spring off its rest:            (v . w) / (|v| |w|) - c >= 0 for the directions v (turned by the rest), w
//   angle of the ways v, w within [a, b]:   cos a - (v . w) / (|v| |w|) >= 0,   (v . w) / (|v| |w|) - cos b >= 0
#pragma once

#include <string>
#include <vector>

#include "symbolic/geometry.hpp"

namespace clearloci::symbolic {

struct LimitCondition {
  Poly natural;       ///< >= 0 in the poses that keep the limit
  std::string words;  ///< "distance A1-P at 0.52 m"
  core::SourcePosition where;
  std::string bounds = {};  ///< core::Root::bounds
};

/// One for each end of a limit that some pose may be beyond.
std::vector<LimitCondition> limit_conditions(const Geometry& geometry);

}  // namespace clearloci::symbolic
