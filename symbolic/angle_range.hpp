// The range of an angle, cut into charts (core/angle_chart.hpp). Private to symbolic/.
#pragma once

#include <vector>

#include "core/angle_chart.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::symbolic {

/// A piece of the range: t from `lower` to `upper`. An end of the range that is no multiple of 90 deg is a rational
/// within 1e-30 or so of it.
struct ChartRange {
  core::AngleChart chart;
  core::Rational lower, upper;
};

/// In the order of the angle; consecutive pieces meet at odd multiples of 90 deg.
std::vector<ChartRange> chart_ranges(const mechanism::Mechanism& mechanism, const mechanism::Coordinate& angle);

}  // namespace clearloci::symbolic
