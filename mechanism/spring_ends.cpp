#include "mechanism/spring_ends.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/actions.hpp"
#include "mechanism/posture_sample.hpp"

namespace clearloci::mechanism {
namespace {

/// The workspace ends where the ends are this part of the spring's greatest length apart, or half of it.
constexpr double part_of_length = 1e-4;
/// What rounding leaves of no length, as a part of the greatest one.
constexpr double rounding = 1e-6;

/// How far the ends of a spring are apart at some poses; NaN where it cannot be placed.
class Ends {
 public:
  Ends(const Mechanism& mechanism, const Spring& spring) : m_(mechanism), spring_(spring) {}

  double apart(const std::vector<double>& pose) {
    const auto points = sample_points(m_, pose);
    const auto &a = points[static_cast<std::size_t>(spring_.from_point)],
               &b = points[static_cast<std::size_t>(spring_.to_point)];
    if (!a || !b) return NAN;
    const double distance = std::hypot((*b)[0] - (*a)[0], (*b)[1] - (*a)[1], (*b)[2] - (*a)[2]);
    return distance;
  }

  /// The least on the way between two poses, around every pose of some that is nearer than its neighbours.
  double least_between(const std::vector<double>& from, const std::vector<double>& to, int looks) {
    const auto at = [&](double t) {
      std::vector<double> pose = from;
      for (std::size_t c = 0; c < pose.size(); ++c) pose[c] += t * (to[c] - from[c]);
      return apart(pose);
    };
    std::vector<double> seen;
    for (int i = 0; i <= looks; ++i) seen.push_back(at(static_cast<double>(i) / looks));
    std::vector<double> known = seen;
    std::erase_if(known, [](double distance) { return std::isnan(distance); });
    if (known.empty()) return INFINITY;
    seen_.insert(seen_.end(), known.begin(), known.end());
    // Ends that keep their distance, as those of a belt do, are nearest nowhere.
    const auto [nearest, farthest] = std::minmax_element(known.begin(), known.end());
    if (*farthest - *nearest <= rounding * *farthest) return *nearest;
    double least = INFINITY;
    for (int i = 1; i < looks; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (!(seen[k] <= seen[k - 1] && seen[k] <= seen[k + 1])) continue;
      double low = (i - 1.0) / looks, high = (i + 1.0) / looks;
      constexpr int thirds = 50;
      for (int n = 0; n < thirds; ++n) {
        const double first = low + (high - low) / 3, second = high - (high - low) / 3;
        (at(first) < at(second) ? high : low) = at(first) < at(second) ? second : first;
      }
      least = std::min(least, at(0.5 * (low + high)));
    }
    return least;
  }

  /// The greatest length that was seen. A point where two lines cross goes to infinity where they become parallel: of
  /// lengths beside such poses nothing is a part.
  double greatest() {
    if (seen_.empty()) return 0;
    constexpr double most_of_usual = 8;
    const auto middle = seen_.begin() + static_cast<std::ptrdiff_t>(seen_.size() / 2);
    std::nth_element(seen_.begin(), middle, seen_.end());
    return std::min(*std::max_element(middle, seen_.end()), most_of_usual * *middle);
  }

 private:
  const Mechanism& m_;
  const Spring& spring_;
  std::vector<double> seen_;
};

bool meet(Ends& ends, const Mechanism& mechanism) {
  if (mechanism.coordinates.size() == 1) {
    constexpr int looks = 128;
    const Coordinate& coordinate = mechanism.coordinates.front();
    const double least =
        ends.least_between({core::to_double(coordinate.lower)}, {core::to_double(coordinate.upper)}, looks);
    return least <= rounding * ends.greatest();
  }
  // A curve that parts the box is crossed by one of some ways through it; a single pose is met by none.
  constexpr std::size_t ways = 8;
  constexpr int looks = 16;
  const std::vector<SampledPosture> postures = sample_poses(mechanism, working_mode(mechanism), ways + 1);
  double least = INFINITY;
  for (std::size_t i = 1; i < postures.size(); ++i)
    least = std::min(least, ends.least_between(postures[i - 1].pose, postures[i].pose, looks));
  return least <= rounding * ends.greatest();
}

const Spring* spring_of(const Mechanism& mechanism, const Limit& limit) {
  const auto found = std::find_if(mechanism.springs.begin(), mechanism.springs.end(), [&](const Spring& spring) {
    return spring.kind != Spring::Kind::torsion && spring.where.line == limit.where.line &&
           spring.where.column == limit.where.column && !limit.is_angle() &&
           limit.points == std::vector<PointIndex>{spring.from_point, spring.to_point};
  });
  return found == mechanism.springs.end() ? nullptr : &*found;
}

Rational power_of_two(int exponent) {
  Rational value = 1;
  if (exponent < 0)
    value >>= static_cast<unsigned>(-exponent);
  else
    value <<= static_cast<unsigned>(exponent);
  return value;
}

}  // namespace

void limit_spring_ends(Mechanism& mechanism) {
  std::vector<Limit> found;
  for (const Action& action : actions(mechanism)) {
    if (action.source != Action::Source::spring || action.law == Action::Law::torsion) continue;
    if (!action.needs_length(mechanism)) continue;
    const Spring& spring = mechanism.springs[action.index];
    Ends ends(mechanism, spring);
    if (!meet(ends, mechanism)) continue;
    Limit limit;
    limit.points = {spring.from_point, spring.to_point};
    limit.lower_value = power_of_two(std::ilogb(part_of_length * ends.greatest()));
    // Nothing ends where they are far apart.
    limit.upper_value = power_of_two(std::ilogb(ends.greatest()) + 6);
    limit.upper_out_of_reach = true;
    limit.lower = Expression::number(limit.lower_value);
    limit.upper = Expression::number(limit.upper_value);
    limit.where = spring.where;
    found.push_back(std::move(limit));
  }
  mechanism.limits.insert(mechanism.limits.end(), found.begin(), found.end());
}

std::optional<std::string> words_of_spring_ends(const Mechanism& mechanism, const Limit& limit) {
  const Spring* const spring = spring_of(mechanism, limit);
  if (spring == nullptr) return std::nullopt;
  const auto name = [&](PointIndex point) { return mechanism.points[static_cast<std::size_t>(point)].name; };
  return "spring " + spring->name + ", whose ends " + name(spring->from_point) + " and " + name(spring->to_point) +
         " meet";
}

std::vector<std::string> notes_of_spring_ends(const Mechanism& mechanism) {
  std::vector<std::string> notes;
  for (const Limit& limit : mechanism.limits)
    if (const auto words = words_of_spring_ends(mechanism, limit))
      notes.push_back(*words +
                      ": there its force reverses and reactions jump; so the workspace ends there, as at a limit");
  return notes;
}

}  // namespace clearloci::mechanism
