// Limits of the workspace as natural polynomials. Private to symbolic/.
//
//   distance of A, B within [l, u]:         |B - A|^2 - l^2 >= 0,   u^2 - |B - A|^2 >= 0
//   effort p(x, y) within [l, u]:           p - l >= 0,   u - p >= 0
//   torsion spring off its rest:            (v . w) / (|v| |w|) - c >= 0 for the directions v (turned by the rest), w
//   angle of the ways v, w within [a, b]:   cos a - (v . w) / (|v| |w|) >= 0,   (v . w) / (|v| |w|) - cos b >= 0
#pragma once

#include <string>
#include <vector>

#include "symbolic/elimination.hpp"
#include "symbolic/geometry.hpp"

namespace clearloci::symbolic {

struct LimitCondition {
  Poly natural;       ///< >= 0 in the poses that keep the limit
  std::string words;  ///< "distance A1-P at 0.52 m"
  core::SourcePosition where;
  std::string bounds = {};  ///< core::Root::bounds
  std::size_t limit = 0;    ///< of the mechanism; of a law or a torsion spring as many as there are
};

/// One for each end of a limit that some pose may be beyond.
std::vector<LimitCondition> limit_conditions(const Geometry& geometry);

/// Those that bound something: none of which what is left to the limit is the same number in every pose, 0 or more.
/// That is decided exactly over the tower; where roots depend on one another, over the sheets of the file's working
/// mode. Throws core::InputError where every pose is beyond one, and nothing folds: on one side of a fold that one is
/// the number -1.
std::vector<LimitCondition> bounding_limits(const Geometry& geometry, const Elimination& elimination);

}  // namespace clearloci::symbolic
