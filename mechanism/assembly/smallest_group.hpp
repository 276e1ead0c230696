// Which points close together: of unknown points and the equations that hold them the smallest part that is determined
// by itself, as many equations as unknowns. Equations are matched to unknowns; what an unknown's equation uses besides
// has to be determined with it (Dulmage and Mendelsohn's decomposition). Private to mechanism/.
#pragma once

#include <cstddef>
#include <vector>

namespace clearloci::mechanism {

struct SmallestGroup {
  std::vector<std::size_t> points, equations;  ///< none: nothing is determined
};

/// `equations`: the points of each. Every point has `each` unknowns.
SmallestGroup smallest_group(std::size_t points, std::size_t each,
                             const std::vector<std::vector<std::size_t>>& equations);

}  // namespace clearloci::mechanism
