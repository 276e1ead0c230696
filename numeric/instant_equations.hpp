// A w = b at one instant of a motion, and its derivatives, from series of the closure's tape (dynamics.hpp).
// Private to numeric/.
#pragma once

#include <vector>

#include "numeric/dynamics.hpp"

namespace clearloci::numeric {

/// Of each unknown, what rounding may leave of it where it is zero.
struct Roundings {
  Eigen::VectorXd at_rest, inertial;
};

constexpr double slender_rod = -1;  ///< in place of an inertia: that of a rod between a link's first two points

[[noreturn]] void refuse_rotation(const mechanism::Link& link);

inline Vector3d values_of(const PointSeries& v) { return {v[0].value(), v[1].value(), v[2].value()}; }

/// Sets |A|, the static and the inertial part of the reactions with their derivatives, and H. `registers`: of the
/// model's tape at the instant; what is carried is that of the stretch. Those of idle unknowns are 0.
void solve_equations(const Motion& motion, const Interval& stretch, const std::vector<Series>& registers,
                     Instant& instant, Roundings* roundings = nullptr);

}  // namespace clearloci::numeric
