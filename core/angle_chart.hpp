// An angle among the free coordinates, made rational: over one half turn the angle is written
//     angle = half_turns π + 2 atan(t),   −1 ≤ t ≤ 1,
//     cos(angle) = ± (1 − t²) / (1 + t²),  sin(angle) = ± 2 t / (1 + t²),   + for an even number of half turns.
// Consecutive charts meet at t = 1 of the one and t = −1 of the next, an odd multiple of 90 deg.
#pragma once

#include <string>

namespace clearloci::inline core {

struct AngleChart {
  int half_turns = 0;
};

/// The angle at t, rad.
double angle_at(const AngleChart& chart, double t);

/// The t of an angle, rad; outside [−1, 1] where the angle is not in the chart's half turn.
double parameter_at(const AngleChart& chart, double angle);

/// How t is written in formulas: "tan(theta/2)", "tan((theta - pi)/2)".
std::string parameter_name(const AngleChart& chart, const std::string& angle);

}  // namespace clearloci::inline core
