// The same mechanism over two coordinates: a Stephenson six-bar (III) over its crank, where every point is placed by a
// dyad, and over the link at its far end, where B, C and E close together. Its loci are the same postures.
// CLEARLOCI_DESIGNS=n in the environment tries n designs, half of which can be assembled, from CLEARLOCI_FIRST on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <random>

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"

namespace clearloci {
namespace {

using Place = std::array<double, 2>;

/// Lengths and places are multiples of 1/4 in half of the designs.
struct SixBar {
  double crank, coupler, rocker, along, beside, rod, far;
  Place d, g;
  double fx, fy;
};

SixBar six_bar(std::mt19937& random, bool lattice) {
  const auto number = [&](double low, double high) {
    const double drawn = std::uniform_real_distribution<double>(low, high)(random);
    return lattice ? std::round(4 * drawn) / 4 : std::round(1000 * drawn) / 1000;
  };
  return {std::max(0.25, number(0.3, 1.2)),
          number(2, 4),
          number(1.5, 3.5),
          number(-1, 3),
          number(0.5, 2),
          number(1.5, 3.5),
          number(1.5, 3),
          {number(2, 4), number(-0.5, 0.5)},
          {number(3, 6), number(0, 2)},
          number(-50, 50),
          number(-100, -10)};
}

std::string rest_of(const SixBar& bar) {
  return fmt::format(R"(links:
  AB:  {{points: [A, B]}}
  BCE: {{points: [B, C, E]}}
  CD:  {{points: [C, D]}}
  EH:  {{points: [E, H]}}
  GH:  {{points: [G, H]}}
joints:
  A: {{revolute: [ground, AB], at: A, actuated: true, clearance: {{radial: 10e-6, angular: 0.5e-3}}}}
  B: {{revolute: [AB, BCE], at: B, clearance: {{radial: 10e-6}}}}
  C: {{revolute: [BCE, CD], at: C, clearance: {{radial: 10e-6}}}}
  D: {{revolute: [ground, CD], at: D, clearance: {{radial: 10e-6}}}}
  E: {{revolute: [BCE, EH], at: E, clearance: {{radial: 10e-6}}}}
  H: {{revolute: [EH, GH], at: H, clearance: {{radial: 10e-6}}}}
  G: {{revolute: [ground, GH], at: G, clearance: {{radial: 10e-6}}}}
end_effector: {{link: GH, at: H}}
loads:
  - {{link: GH, at: H, force: [{}, {}]}}
)",
                     bar.fx, bar.fy);
}

std::string by_dyads(const SixBar& bar, bool c_left, bool h_left) {
  return fmt::format(R"(format: 1
workspace:
  theta: {{angle: [0, 360 deg]}}
points:
  A: [0, 0]
  D: [{}, {}]
  G: [{}, {}]
  B: [{}*cos(theta), {}*sin(theta)]
  C: {{dyad: [B, D], lengths: [{}, {}], side: {}}}
  E: {{on: [B, C], offset: [{}, {}]}}
  H: {{dyad: [E, G], lengths: [{}, {}], side: {}}}
)",
                     bar.d[0], bar.d[1], bar.g[0], bar.g[1], bar.crank, bar.crank, bar.coupler, bar.rocker,
                     c_left ? "left" : "right", bar.along, bar.beside, bar.rod, bar.far, h_left ? "left" : "right") +
         rest_of(bar);
}

Place at(const Pose& pose, const std::string& name) {
  for (const PosePoint& point : pose.points)
    if (point.name == name) return {point.at[0], point.at[1]};
  ADD_FAILURE() << name;
  return {};
}

double turn(const Place& p, const Place& q, const Place& r) {
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/// Over the link GH, from a posture over the crank.
std::string by_group(const SixBar& bar, const Pose& posture, double reach) {
  const Place b = at(posture, "B"), c = at(posture, "C"), e = at(posture, "E"), h = at(posture, "H");
  const double phi = std::atan2(h[1] - bar.g[1], h[0] - bar.g[0]);
  return fmt::format(R"(format: 1
workspace:
  phi: {{angle: [{:.6f}, {:.6f}]}}
points:
  A: [0, 0]
  D: [{}, {}]
  G: [{}, {}]
  H: [{} + {}*cos(phi), {} + {}*sin(phi)]
  hip:
    group: [B, C, E]
    lengths: {{A-B: {}, B-C: {}, C-D: {}, B-E: 'sqrt(({})^2 + ({})^2)', C-E: 'sqrt((({}) - ({}))^2 + ({})^2)', E-H: {}}}
    near: {{at: {{phi: {:.12f}}}, B: [{:.9f}, {:.9f}], C: [{:.9f}, {:.9f}], E: [{:.9f}, {:.9f}]}}
)",
                     phi - reach, phi + reach, bar.d[0], bar.d[1], bar.g[0], bar.g[1], bar.g[0], bar.far, bar.g[1],
                     bar.far, bar.crank, bar.coupler, bar.rocker, bar.along, bar.beside, bar.along, bar.coupler,
                     bar.beside, bar.rod, phi, b[0], b[1], c[0], c[1], e[0], e[1]) +
         rest_of(bar);
}

/// What vanishes at a point, as words.
std::string told(const IsolatedPoint& point) {
  std::vector<std::string> names;
  for (const Vanishing& what : point.vanishing) names.push_back(what.joint + to_string(what.quantity));
  std::sort(names.begin(), names.end());
  std::string words = to_string(point.kind);
  for (const std::string& name : names) words += " " + name;
  return words;
}

bool is_compared(const IsolatedPoint& point) {
  return point.kind == LocusKind::contact_loss || point.kind == LocusKind::backlash ||
         point.kind == LocusKind::direct_singularity;
}

struct Compared {
  int designs = 0, points = 0, singular = 0, dead_centres = 0, uncertified = 0;
};

void compare(const SixBar& bar, std::mt19937& random, Compared& count) {
  const bool c_left = random() % 2 == 0, h_left = random() % 2 == 0;
  std::optional<Model> built;
  try {
    built = Model::parse(by_dyads(bar, c_left, h_left), "dyads.yaml");
  } catch (const InputError& error) {
    ASSERT_NE(std::string(error.what()).find("unreachable in the whole box"), std::string::npos) << error.what();
    return;
  }
  const Model& dyads = *built;
  const double theta = std::uniform_real_distribution<double>(0, 2 * std::numbers::pi)(random);
  const Pose posture = solve_pose(dyads, {theta});
  if (!posture.unreachable.empty() || posture.singular) return;
  // Where the assembly is not near a dead centre of the group either.
  const std::string text = by_group(bar, posture, 0.4);
  std::optional<Model> found;
  try {
    found = Model::parse(text, "group.yaml");
  } catch (const InputError& error) {
    ASSERT_NE(std::string(error.what()).find("dead centre"), std::string::npos) << error.what() << "\n" << text;
    return;
  }
  const Model& group = *found;
  const LocusMap one = trace_loci(dyads, {.all_working_modes = true}), other = trace_loci(group, {});
  ++count.designs;
  ASSERT_TRUE(other.complete) << text;
  const double full = 2 * std::numbers::pi;
  const auto apart = [&](double a, double b) { return std::abs(std::remainder(a - b, full)); };
  constexpr double near = 1e-6;
  // Every point of the group is one of the dyads', in their working mode there.
  for (const IsolatedPoint& point : other.isolated_points) {
    count.dead_centres += point.kind == LocusKind::workspace_boundary && point.certified ? 1 : 0;
    if (!is_compared(point)) continue;
    ++count.points;
    count.uncertified += point.certified ? 0 : 1;
    count.singular += point.kind == LocusKind::direct_singularity ? 1 : 0;
    const Pose pose = solve_pose(group, {point.at[0]});
    ASSERT_TRUE(pose.unreachable.empty());
    const Place b = at(pose, "B");
    const double crank = std::atan2(b[1], b[0]);
    const bool c_side = turn(b, bar.d, at(pose, "C")) > 0, h_side = turn(at(pose, "E"), bar.g, at(pose, "H")) > 0;
    const bool is_there = std::any_of(one.isolated_points.begin(), one.isolated_points.end(), [&](const auto& p) {
      return told(p) == told(point) && apart(p.at[0], crank) < near && (p.mode[0] > 0) == c_side &&
             (p.mode[1] > 0) == h_side;
    });
    EXPECT_TRUE(is_there) << told(point) << " at phi " << point.at[0] << ", theta " << crank << "\n" << text;
  }
  // And the other way round, where the group reaches the posture.
  for (const IsolatedPoint& point : one.isolated_points) {
    if (!is_compared(point)) continue;
    const Model mode = Model::parse(by_dyads(bar, point.mode[0] > 0, point.mode[1] > 0), "dyads.yaml");
    const Pose pose = solve_pose(mode, {point.at[0]});
    if (!pose.unreachable.empty()) continue;
    const Place h = at(pose, "H"), b = at(pose, "B");
    const double phi = std::atan2(h[1] - bar.g[1], h[0] - bar.g[0]);
    for (const ReachableInterval& interval : other.reachable) {
      const double here = interval.from + std::fmod(std::fmod(phi - interval.from, full) + full, full);
      if (!(here > interval.from + 1e-4 && here < interval.to - 1e-4)) continue;
      const Pose same = solve_pose(group, {here});
      if (!same.unreachable.empty() || std::hypot(at(same, "B")[0] - b[0], at(same, "B")[1] - b[1]) > near) continue;
      const bool is_there = std::any_of(other.isolated_points.begin(), other.isolated_points.end(), [&](const auto& p) {
        return told(p) == told(point) && std::abs(p.at[0] - here) < near;
      });
      EXPECT_TRUE(is_there) << told(point) << " at theta " << point.at[0] << ", phi " << here << "\n" << text;
    }
  }
}

unsigned from_environment(const char* name, unsigned otherwise) {
  const char* const wanted = std::getenv(name);
  return wanted != nullptr ? static_cast<unsigned>(std::atoi(wanted)) : otherwise;
}

TEST(GroupLaw, LociAreThoseOfTheDyadsAsPostures) {
  const unsigned first = from_environment("CLEARLOCI_FIRST", 1), designs = from_environment("CLEARLOCI_DESIGNS", 60);
  Compared count;
  for (unsigned seed = first; seed < first + designs; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    compare(six_bar(random, seed % 2 == 0), random, count);
    if (HasFailure()) break;
  }
  RecordProperty("designs", count.designs);
  RecordProperty("points", count.points);
  EXPECT_GT(count.designs, 20);
  EXPECT_GT(count.points, 20);
  EXPECT_GT(count.dead_centres, 5);
  fmt::print("{} designs, {} points ({} of them singular, {} not certified), {} dead centres proven\n", count.designs,
             count.points, count.singular, count.uncertified, count.dead_centres);
}

}  // namespace
}  // namespace clearloci
