// A w = b at one instant of a motion, and its derivatives, from series of the closure's tape (dynamics.hpp).
// Private to numeric/.
#pragma once

#include <vector>

#include "numeric/dynamics.hpp"

namespace clearloci::numeric {

constexpr double slender_rod = -1;  ///< in place of an inertia: that of a rod between a link's first two points

[[noreturn]] void refuse_rotation(const mechanism::Link& link);

inline Vector3d values_of(const PointSeries& v) { return {v[0].value(), v[1].value(), v[2].value()}; }

/// Sets |A|, the static and the inertial part of the reactions with their derivatives, and H. `registers`: of the
/// model's tape at the instant; what is carried is that of the stretch. Those of idle unknowns are 0. `zero`: which
/// unknowns are zero in both parts, to the rounding of the solution.
void solve_equations(const Motion& motion, const Interval& stretch, const std::vector<Series>& registers,
                     Instant& instant, std::vector<bool>* zero = nullptr);

}  // namespace clearloci::numeric
