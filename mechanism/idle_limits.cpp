#include "mechanism/idle_limits.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/posture_sample.hpp"
#include "mechanism/rigidity.hpp"

namespace clearloci::mechanism {
namespace {

/// What rounding makes of a number, as a part of it: a motion is far more.
constexpr double rounding = 1e-12;

using Vector = std::array<double, 3>;

double distance(const Vector& a, const Vector& b) { return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]); }

/// The distance, or the cosine of the angle, that a limit keeps.
double kept(const Limit& limit, const PosturePoints& points) {
  const auto at = [&](std::size_t i) { return points[static_cast<std::size_t>(limit.points[i])]; };
  if (!limit.is_angle()) return distance(at(0), at(1));
  const Vector a = at(0), b = at(1), c = at(2);
  double product = 0;
  for (std::size_t i = 0; i < 3; ++i) product += (a[i] - b[i]) * (c[i] - b[i]);
  return product / (distance(a, b) * distance(c, b));
}

/// Working modes that are looked at: all of them where there are no more than so many dyads, else those that differ
/// from the file's in one side.
std::vector<std::vector<int>> modes_of(const Mechanism& mechanism) {
  constexpr std::size_t most_dyads = 4;
  const std::vector<int> mode = working_mode(mechanism);
  std::vector<std::vector<int>> modes = {mode};
  for (std::size_t j = 0; j < mode.size(); ++j) {
    const std::size_t tried = mode.size() <= most_dyads ? modes.size() : 1;
    for (std::size_t i = 0; i < tried; ++i) {
      modes.push_back(modes[i]);
      modes.back()[j] = -modes.back()[j];
    }
  }
  return modes;
}

}  // namespace

std::vector<bool> idle_limits(const Mechanism& mechanism) {
  constexpr std::size_t postures = 12;
  std::vector<bool> idle(mechanism.limits.size(), !mechanism.limits.empty());
  if (mechanism.limits.empty()) return idle;
  const HeldByLinks held = held_by_links(mechanism);
  std::vector<double> least(idle.size(), INFINITY), greatest(idle.size(), -INFINITY);
  for (const std::vector<int>& mode : modes_of(mechanism))
    for (const SampledPosture& posture : sample_poses(mechanism, mode, postures))
      for (std::size_t i = 0; i < idle.size() && keeps(held, posture.points); ++i) {
        const double value = kept(mechanism.limits[i], posture.points);
        idle[i] = idle[i] && std::isfinite(value);
        least[i] = std::min(least[i], value);
        greatest[i] = std::max(greatest[i], value);
      }
  for (std::size_t i = 0; i < idle.size(); ++i) {
    const Limit& limit = mechanism.limits[i];
    const double lower = core::to_double(limit.lower_value), upper = core::to_double(limit.upper_value);
    const double from = limit.is_angle() ? std::cos(upper) : lower, to = limit.is_angle() ? std::cos(lower) : upper;
    const double hair = rounding * (limit.is_angle() ? 1 : to);
    idle[i] = idle[i] && least[i] <= greatest[i] && greatest[i] - least[i] <= hair && least[i] >= from - hair &&
              greatest[i] <= to + hair;
  }
  return idle;
}

Mechanism without_idle_limits(Mechanism mechanism) {
  const std::vector<bool> idle = idle_limits(mechanism);
  std::vector<Limit> kept;
  for (std::size_t i = 0; i < idle.size(); ++i)
    if (!idle[i]) kept.push_back(mechanism.limits[i]);
  mechanism.limits = std::move(kept);
  return mechanism;
}

}  // namespace clearloci::mechanism
