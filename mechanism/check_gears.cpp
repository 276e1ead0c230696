// What the points have to hold for two wheels to be a gear: nothing else does.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/shown_units.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using Flat = std::array<double, 2>;

constexpr std::size_t gear_postures = 12;
/// Of a coordinate's range: the step of differences.
constexpr double gear_step = 1e-4;
/// Of what the teeth move by: what differences leave of it.
constexpr double apart = 1e-5;

Flat place(const PosturePoints& posture, PointIndex point) {
  const auto& at = posture[static_cast<std::size_t>(point)];
  return {at[0], at[1]};
}

std::string words_of(const Joint& gear) { return to_string(gear.type) + " " + gear.name; }

bool is_pinned(const Mechanism& m, LinkIndex wheel, PointIndex centre) {
  const auto at = [&](PointIndex point) { return point == centre; };
  return wheel == ground || std::any_of(m.joints.begin(), m.joints.end(), [&](const Joint& joint) {
           return joint.type == JointType::revolute && at(joint.at) && (joint.from == wheel || joint.to == wheel);
         });
}

/// Whether a link, or the ground, holds both centres.
bool has_carrier(const Mechanism& m, PointIndex first, PointIndex second) {
  for (LinkIndex link = ground; link < static_cast<LinkIndex>(m.links.size()); ++link)
    if (is_on_link(m, first, link) && is_on_link(m, second, link)) return true;
  return false;
}

std::string link_words(const Mechanism& m, LinkIndex link) {
  return link == ground ? "the ground" : "link " + m.links[static_cast<std::size_t>(link)].name;
}

void check_carrier(const Mechanism& m, const Joint& gear) {
  const auto name = [&](PointIndex point) { return m.points[static_cast<std::size_t>(point)].name; };
  const auto check = [&](LinkIndex wheel, PointIndex centre) {
    if (!is_pinned(m, wheel, centre))
      throw core::InputError(
          gear.where,
          link_words(m, wheel) + " of " + words_of(gear) + " is pinned to nothing at its centre " + name(centre),
          "add a revolute joint there");
  };
  check(gear.from, gear.meshing->first);
  if (!gear.meshing->second) return;
  check(gear.to, *gear.meshing->second);
  if (!has_carrier(m, gear.meshing->first, *gear.meshing->second))
    throw core::InputError(gear.where,
                           "no link holds both centres of " + words_of(gear) + ", " + name(gear.meshing->first) +
                               " and " + name(*gear.meshing->second),
                           "pin both wheels to one carrier, a link or the ground");
}

/// How far the material of a link at a place moves between two postures; nothing where its turn is not known.
std::optional<Flat> way_of(const Mechanism& m, LinkIndex link, const Flat& at, const PosturePoints& before,
                           const PosturePoints& after, bool may_turn) {
  if (link == ground) return Flat{0, 0};
  const std::vector<PointIndex>& points = m.links[static_cast<std::size_t>(link)].points;
  const Flat p = place(before, points[0]), q = place(after, points[0]);
  double turn = 0;
  if (points.size() > 1) {
    const Flat r = place(before, points[1]), s = place(after, points[1]);
    const Flat a = {r[0] - p[0], r[1] - p[1]}, b = {s[0] - q[0], s[1] - q[1]};
    turn = std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
  } else if (may_turn) {
    return std::nullopt;
  }
  const Flat arm = {at[0] - (p[0] + q[0]) / 2, at[1] - (p[1] + q[1]) / 2};
  return Flat{q[0] - p[0] - turn * arm[1], q[1] - p[1] + turn * arm[0]};
}

/// Of a belt over pulleys of one size: they turn alike.
void check_turns(const Mechanism& m, const Joint& belt, const PosturePoints& before, const PosturePoints& after,
                 const std::string& coordinate) {
  const auto turn = [&](LinkIndex link) -> std::optional<double> {
    const auto near = way_of(m, link, {0, 0}, before, after, true), off = way_of(m, link, {1, 0}, before, after, true);
    if (!near || !off) return std::nullopt;
    return (*off)[1] - (*near)[1];
  };
  const auto a = turn(belt.from), b = turn(belt.to);
  if (!a || !b || std::abs(*b - *a) <= apart * (std::abs(*a) + std::abs(*b)) + 1e-12) return;
  throw core::InputError(belt.where,
                         "the pulleys of belt " + belt.name + " do not turn alike as " + coordinate + " changes",
                         "write the points of both by one angle");
}

/// The distance that the file gives, in every posture.
void check_distance(const Mechanism& m, const Joint& gear) {
  if (!gear.meshing->distance || !gear.meshing->second) return;
  constexpr double rounding = 1e-9;
  const double given = core::to_double(value_of(*gear.meshing->distance, m));
  for (const SampledPosture& posture : sample_poses(m, working_mode(m), gear_postures)) {
    const Flat p = place(posture.points, gear.meshing->first), q = place(posture.points, *gear.meshing->second);
    const double far = std::hypot(q[0] - p[0], q[1] - p[1]);
    if (std::abs(far - given) > rounding * (far + given))
      throw core::InputError(gear.where,
                             "the centres of " + words_of(gear) + " are " + core::told(far, "m", m.units) +
                                 " apart, but its distance is " + core::told(given, "m", m.units),
                             "correct the distance, or leave it out where the centres stand still");
  }
}

void check_mesh(const Mechanism& m, const Joint& gear) {
  const std::vector<int> mode = working_mode(m);
  for (const SampledPosture& posture : sample_poses(m, mode, gear_postures))
    for (std::size_t c = 0; c < m.coordinates.size(); ++c) {
      const double step = gear_step * core::to_double(m.coordinates[c].upper - m.coordinates[c].lower);
      std::vector<double> less = posture.pose, more = posture.pose;
      less[c] -= step;
      more[c] += step;
      const auto before = sample_posture(m, less, mode), after = sample_posture(m, more, mode);
      if (!before || !after) continue;
      if (gear.axes.empty()) {
        check_turns(m, gear, *before, *after, m.coordinates[c].name);
        continue;
      }
      const auto axis = sample_vector(m, gear.axes.front(), posture.pose);
      if (!axis) continue;
      const Flat at = place(posture.points, gear.at);
      const auto a = way_of(m, gear.from, at, *before, *after, true),
                 b = way_of(m, gear.to, at, *before, *after, gear.meshing->second.has_value());
      if (!a || !b) return;
      const Flat u = {(*axis)[0], (*axis)[1]};
      const double length = std::hypot(u[0], u[1]);
      const double differ = ((*b)[0] - (*a)[0]) * u[0] / length + ((*b)[1] - (*a)[1]) * u[1] / length;
      const auto step_of = [&](PointIndex centre) {
        const Flat p = place(*before, centre), q = place(*after, centre);
        return std::hypot(q[0] - p[0], q[1] - p[1]);
      };
      // Where a wheel rolls on one that stands the teeth stand still, and the centre does not.
      const double size = std::hypot((*a)[0], (*a)[1]) + std::hypot((*b)[0], (*b)[1]) + step_of(gear.meshing->first) +
                          (gear.meshing->second ? step_of(*gear.meshing->second) : 0);
      if (std::abs(differ) > apart * size + 1e-12 * length)
        throw core::InputError(
            gear.where,
            "the teeth of " + words_of(gear) + " do not move alike as " + m.coordinates[c].name +
                " changes: the points of its wheels turn by other angles",
            "check its teeth or radii, and write points of the wheels in frames with the names of their links");
    }
}

}  // namespace

void check_gears(const Mechanism& mechanism) {
  for (const Joint& joint : mechanism.joints) {
    if (!joint.meshing) continue;
    check_carrier(mechanism, joint);
    check_distance(mechanism, joint);
    check_mesh(mechanism, joint);
  }
}

}  // namespace clearloci::mechanism
