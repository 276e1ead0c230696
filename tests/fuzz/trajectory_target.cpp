#include <cmath>
#include <string>

#include "mechanism/trajectory.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/fuzz/sample_mechanisms.hpp"
#include "tests/fuzz/targets.hpp"

namespace clearloci::fuzz {
namespace {

bool is_finite(const core::Rational& value) { return std::isfinite(core::to_double(value)); }

void check_accepted(const mechanism::Trajectory& trajectory, const mechanism::Mechanism& mechanism) {
  const int count = static_cast<int>(trajectory.waypoints.size());
  require(count >= 2, "a path has two waypoints");
  core::Rational parts = 0;
  for (const mechanism::Waypoint& waypoint : trajectory.waypoints) {
    require(waypoint.at.size() == mechanism.coordinates.size(), "a waypoint has every coordinate");
    for (const core::Rational& value : waypoint.at) require(is_finite(value), "a waypoint is finite");
    require(waypoint.corner >= 0 && is_finite(waypoint.corner), "a corner is finite and not negative");
    require(waypoint.dwell >= 0 && waypoint.duration >= 0, "times are not negative");
    parts += waypoint.dwell + waypoint.duration;
  }
  require(parts <= 1, "the parts of the period fill it at most");
  require(trajectory.waypoints.front().stop, "the first waypoint is a stop");
  require(trajectory.period > 0 && is_finite(trajectory.period) && core::to_double(trajectory.period) > 0,
          "a period is finite and positive");
  for (const mechanism::Payload& payload : trajectory.payloads) {
    require(payload.link >= 0 && payload.link < static_cast<int>(mechanism.links.size()), "a payload's link is there");
    require(payload.at >= 0 && payload.at < static_cast<int>(mechanism.points.size()), "a payload's point is there");
    require(payload.picked >= 0 && payload.picked < count && payload.placed >= 0 && payload.placed < count,
            "a payload's stops are there");
    require(payload.mass >= 0 && is_finite(payload.mass) && payload.inertia >= 0 && is_finite(payload.inertia),
            "a payload's mass is finite and not negative");
  }
}

}  // namespace

void trajectory_target(std::string_view bytes) {
  const std::string text(bytes);
  for (const mechanism::Mechanism& mechanism : sample_mechanisms()) {
    const auto trajectory = value_or_complaint([&] { return mechanism::parse_trajectory(text, "t.yaml", mechanism); });
    if (trajectory) check_accepted(*trajectory, mechanism);
  }
}

}  // namespace clearloci::fuzz
