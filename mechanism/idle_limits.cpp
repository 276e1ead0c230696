#include "mechanism/idle_limits.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>

#include "mechanism/evaluate.hpp"
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

/// The square of a distance that links keep, where it can be read from how one of the points is built.
std::optional<Rational> kept_square(const Mechanism& mechanism, PointIndex from, PointIndex to) {
  const auto value = [&](const Expression& e) -> std::optional<Rational> {
    try {
      const ExactValue found = evaluate(e, mechanism.parameters);
      return found.exact ? std::optional(found.value) : std::nullopt;
    } catch (const std::exception&) {
      return std::nullopt;  // it varies with the pose
    }
  };
  const auto sum_of_squares = [&](const std::vector<std::optional<Rational>>& parts) -> std::optional<Rational> {
    Rational sum = 0;
    for (const std::optional<Rational>& part : parts) {
      if (!part) return std::nullopt;
      sum += *part * *part;
    }
    return sum;
  };
  const auto form = [&](PointIndex p) -> const auto& { return mechanism.points[static_cast<std::size_t>(p)].form; };
  for (const auto& [built, other] : {std::pair{from, to}, std::pair{to, from}}) {
    if (const auto* dyad = std::get_if<DyadPoint>(&form(built))) {
      if (dyad->from == other) return sum_of_squares({value(dyad->from_length)});
      if (dyad->to == other && !dyad->right_angle) return sum_of_squares({value(dyad->to_length)});
    }
    if (const auto* offset = std::get_if<OffsetPoint>(&form(built)); offset != nullptr && offset->first == other)
      return sum_of_squares({value(offset->along), value(offset->left)});
  }
  const auto *a = std::get_if<ExplicitPoint>(&form(from)), *b = std::get_if<ExplicitPoint>(&form(to));
  if (a == nullptr || b == nullptr) return std::nullopt;
  std::vector<std::optional<Rational>> differences;
  for (std::size_t i = 0; i < a->coordinates.size(); ++i) {
    const std::optional<Rational> p = value(a->coordinates[i]), q = value(b->coordinates[i]);
    differences.push_back(p && q ? std::optional<Rational>(*p - *q) : std::nullopt);
  }
  return sum_of_squares(differences);
}

}  // namespace

void leave_out_ends_out_of_reach(Mechanism& mechanism) {
  for (Limit& limit : mechanism.limits) {
    if (limit.is_angle()) continue;
    for (PointIndex joint = 0; joint < static_cast<PointIndex>(mechanism.points.size()); ++joint) {
      if (joint == limit.points[0] || joint == limit.points[1]) continue;
      const std::optional<Rational> a = kept_square(mechanism, limit.points[0], joint);
      const std::optional<Rational> b = a ? kept_square(mechanism, joint, limit.points[1]) : std::nullopt;
      if (!b) continue;
      // d^2 - a^2 - b^2 against 2 a b and -2 a b, squared.
      const auto beyond = [&](const Rational& end) -> Rational { return end * end - *a - *b; };
      const Rational product = 4 * *a * *b, low = beyond(limit.lower_value), high = beyond(limit.upper_value);
      limit.lower_out_of_reach = limit.lower_out_of_reach || (low <= 0 && low * low >= product);
      limit.upper_out_of_reach = limit.upper_out_of_reach || (high >= 0 && high * high >= product);
    }
  }
}

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
