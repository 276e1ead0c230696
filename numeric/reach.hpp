// What a clearance can do to the end effector, and how far the sum of all leads. Private to numeric/.
#pragma once

#include <limits>
#include <vector>

#include "numeric/worst_case.hpp"

namespace clearloci::numeric {

/// One clearance: the end effector moves by this times any vector of length up to one.
using Reach = Eigen::Matrix<double, 6, 3>;

/// Bounds are handed out above what doubles make of their operations.
inline double rounded_up(double bound, double operations) {
  return bound * (1 + operations * std::numeric_limits<double>::epsilon());
}

/// As worst_case of the clearances that lead there.
WorstCase worst_case(const std::vector<Reach>& all, double accuracy, bool rotation);

/// Not less than the largest distance that the reaches lead to, all together, and mostly not more than `accuracy` above
/// it. Of the three components from `row` on; in the plane of the first two of them, where all reaches lie there.
double farthest_in_space(const std::vector<Reach>& all, int row, double accuracy);
double farthest_in_plane(const std::vector<Reach>& all, int row, double accuracy);

}  // namespace clearloci::numeric
