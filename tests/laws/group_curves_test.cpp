// The same mechanism twice over the angles of its two motors: a five-bar whose coupler point is placed by a dyad, so
// that its loci have formulas and are certified, and as a group of one point, so that they have none and are followed
// in floating point (loci/curves/pose_zeros.hpp). The curves and points of both are the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <random>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "tests/source_dir.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

struct FiveBar {
  double base, crank_a, crank_b, rod_a, rod_b, alpha, beta, fx, fy, couple;
  /// Of the other rod, N.
  double gx = 0, gy = 0;
};

FiveBar five_bar(std::mt19937& random) {
  const auto number = [&](double low, double high) {
    return std::round(1000 * std::uniform_real_distribution<double>(low, high)(random)) / 1000;
  };
  return {number(0.6, 1.2), number(0.3, 0.6), number(0.3, 0.6), number(0.5, 0.9),  number(0.5, 0.9),
          number(1, 2.2),   number(0.9, 2.1), number(-50, 50),  number(-100, -10), number(-4, 4)};
}

/// Boxes of angles so wide on either side of the posture.
constexpr double half_width = 0.6;

std::string text_of(const FiveBar& bar, const std::string& tip) {
  return fmt::format(R"(format: 1
space: planar
workspace:
  alpha: {{angle: [{}, {}]}}
  beta: {{angle: [{}, {}]}}
points:
  A1: [0, 0]
  A2: [{}, 0]
  B1: [{}*cos(alpha), {}*sin(alpha)]
  B2: [{} + {}*cos(beta), {}*sin(beta)]
  {}
links:
  crank1: {{points: [A1, B1]}}
  crank2: {{points: [A2, B2]}}
  rod1: {{points: [B1, P]}}
  rod2: {{points: [B2, P]}}
joints:
  A1: {{revolute: [ground, crank1], at: A1, actuated: true, clearance: {{radial: 10e-6, angular: 0.5e-3}}}}
  A2: {{revolute: [ground, crank2], at: A2, actuated: true, clearance: {{radial: 10e-6, angular: 0.5e-3}}}}
  B1: {{revolute: [crank1, rod1], at: B1, clearance: {{radial: 10e-6}}}}
  B2: {{revolute: [crank2, rod2], at: B2, clearance: {{radial: 10e-6}}}}
  P: {{revolute: [rod1, rod2], at: P, clearance: {{radial: 10e-6}}}}
end_effector: {{link: rod1, at: P}}
loads:
  - {{link: rod1, at: P, force: [{}, {}], couple: {}}}
  - {{link: rod2, at: {{mean: [B2, P]}}, force: [{:.9f}, {:.9f}]}}
)",
                     bar.alpha - half_width, bar.alpha + half_width, bar.beta - half_width, bar.beta + half_width,
                     bar.base, bar.crank_a, bar.crank_a, bar.base, bar.crank_b, bar.crank_b, tip, bar.fx, bar.fy,
                     bar.couple, bar.gx, bar.gy);
}

double apart(const Point2& a, const Point2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

double distance(const Point2& p, const Point2& a, const Point2& b) {
  const Point2 way = {b[0] - a[0], b[1] - a[1]};
  const double square = way[0] * way[0] + way[1] * way[1];
  const double part = square > 0 ? std::clamp(((p[0] - a[0]) * way[0] + (p[1] - a[1]) * way[1]) / square, 0.0, 1.0) : 0;
  return apart(p, {a[0] + part * way[0], a[1] + part * way[1]});
}

std::set<std::string> names_of(const std::vector<Vanishing>& all) {
  std::set<std::string> names;
  for (const Vanishing& vanishing : all) names.insert(to_string(vanishing.quantity) + vanishing.joint);
  return names;
}

/// The least distance of a pose from the curves on which a reaction vanishes; without a name from the direct
/// singularities and the boundary, which are the same where a group comes to a dead centre.
double distance(const Point2& at, const std::string& name, const LocusMap& map) {
  double least = 1e9;
  for (const LocusCurve& curve : map.curves) {
    if (name.empty() ? !curve.vanishing.empty() : names_of(curve.vanishing).count(name) == 0) continue;
    for (const Arc& arc : curve.arcs)
      for (std::size_t i = 1; i < arc.points.size(); ++i)
        least = std::min(least, distance(at, arc.points[i - 1], arc.points[i]));
  }
  return least;
}

struct Held {
  int vertices = 0, away = 0, points = 0, missing = 0;
};

/// How many vertices of the one map's curves are farther than `within` from the other's of the same reactions, and how
/// many of its isolated points the other neither has nor leaves open.
void hold(const LocusMap& one, const LocusMap& other, double within, Held& held) {
  for (const LocusCurve& curve : one.curves) {
    std::set<std::string> names = names_of(curve.vanishing);
    if (names.empty()) names.insert("");
    for (const Arc& arc : curve.arcs)
      for (const Point2& at : arc.points)
        for (const std::string& name : names) {
          ++held.vertices;
          held.away += distance(at, name, other) < within ? 0 : 1;
        }
  }
  for (const IsolatedPoint& point : one.isolated_points) {
    ++held.points;
    const bool is_present =
        std::any_of(other.isolated_points.begin(), other.isolated_points.end(), [&](const auto& isolated_point) {
          return names_of(isolated_point.vanishing) == names_of(point.vanishing) &&
                 apart({isolated_point.at[0], isolated_point.at[1]}, {point.at[0], point.at[1]}) < 1e-6;
        });
    const bool open = std::any_of(other.open.begin(), other.open.end(), [&](const OpenRegion& region) {
      return point.at[0] >= region.lower[0] && point.at[0] <= region.upper[0] && point.at[1] >= region.lower[1] &&
             point.at[1] <= region.upper[1];
    });
    held.missing += is_present || open ? 0 : 1;
  }
}

Point2 place(const Pose& pose, const std::string& name) {
  for (const PosePoint& point : pose.points)
    if (point.name == name) return {point.at[0], point.at[1]};
  ADD_FAILURE() << name;
  return {};
}

TEST(GroupLaw, CurvesOverTwoMotorsAreThoseOfTheDyad) {
  const char* const wanted = std::getenv("CLEARLOCI_DESIGNS");
  const unsigned last = wanted != nullptr ? static_cast<unsigned>(std::atoi(wanted)) : 24;
  int designs = 0;
  Held followed, formulas;
  for (unsigned seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    FiveBar bar = five_bar(random);
    const auto dyad = [&] {
      return text_of(bar, fmt::format("P: {{dyad: [B1, B2], lengths: [{}, {}], side: right}}", bar.rod_a, bar.rod_b));
    };
    const Pose posture = solve_pose(Model::parse(dyad(), "dyad.yaml"), {bar.alpha, bar.beta});
    if (!posture.unreachable.empty()) continue;
    const Point2 tip = place(posture, "P"), b1 = place(posture, "B1"), b2 = place(posture, "B2");
    if (seed % 2 == 0) {
      // At the posture each rod is in balance without the pin between them.
      constexpr double force = 40;
      bar.gx = force * (tip[0] - b2[0]);
      bar.gy = force * (tip[1] - b2[1]);
      bar.couple = -((tip[0] - b1[0]) * bar.fy - (tip[1] - b1[1]) * bar.fx);
    }
    const std::string group = text_of(
        bar, fmt::format("tip: {{group: [P], lengths: {{B1-P: {}, B2-P: {}}}, near: {{at: {{alpha: {}, beta: {}}}, P: "
                         "[{:.9f}, {:.9f}]}}}}",
                         bar.rod_a, bar.rod_b, bar.alpha, bar.beta, tip[0], tip[1]));
    SCOPED_TRACE(group);
    const LocusMap one = trace_loci(Model::parse(dyad(), "dyad.yaml")),
                   other = trace_loci(Model::parse(group, "group.yaml"));
    ++designs;
    // What is followed is there: within the chords of the other.
    hold(other, one, 2e-4, followed);
    ASSERT_EQ(followed.away, 0);
    ASSERT_EQ(followed.missing, 0);
    // What is there is followed, but for strands that are nearer to each other than a cell.
    hold(one, other, 2 * 2 * half_width / 96, formulas);
  }
  fmt::print("{} designs; followed: {} vertices, {} points; by formulas: {} vertices, {} away, {} points, {} missing\n",
             designs, followed.vertices, followed.points, formulas.vertices, formulas.away, formulas.points,
             formulas.missing);
  EXPECT_GT(designs, 12);
  EXPECT_GT(followed.vertices, 2000);
  EXPECT_GT(followed.points, 4);
  EXPECT_LT(formulas.away, formulas.vertices / 50);
  EXPECT_LE(10 * formulas.missing, formulas.points);
}

// ---- A shipped five-bar over their motors' angles and over the place of their end effector

/// Over the motors' angles near a posture, with the end effector's point as a group.
std::string over_motors(std::string text, const Pose& posture, const std::array<double, 2>& angles, double half) {
  /// The parts of what is found, which is replaced.
  const auto cut = [&](const std::string& what, const std::string& by) {
    std::smatch found;
    if (!std::regex_search(text, found, std::regex(what))) throw std::logic_error("a five-bar of another form");
    const std::vector<std::string> parts(found.begin(), found.end());
    text = found.prefix().str() + by + found.suffix().str();
    return parts;
  };
  cut("  x: .*\n  y: .*\n", fmt::format("  alpha: {{angle: [{:.6f}, {:.6f}]}}\n  beta: {{angle: [{:.6f}, {:.6f}]}}\n",
                                        angles[0] - half, angles[0] + half, angles[1] - half, angles[1] + half));
  cut("  P:  \\[x, y\\].*\n", "");
  const std::string lengths = ", P\\], lengths: \\[([^,]*), ([^\\]]*)\\].*\n";
  const std::vector<std::string> first = cut("  B1: \\{dyad: \\[A1" + lengths, "");
  const std::vector<std::string> second = cut("  B2: \\{dyad: \\[A2" + lengths, "POINTS");
  const Point2 tip = place(posture, "P");
  const auto crank = [](int leg, const std::string& length, const char* angle) {
    return fmt::format("  B{0}: {{from: A{0}, by: ['({1})*cos({2})', '({1})*sin({2})']}}\n", leg, length, angle);
  };
  return replaced(text, "POINTS",
                  crank(1, first[1], "alpha") + crank(2, second[1], "beta") +
                      fmt::format("  tip: {{group: [P], lengths: {{B1-P: {}, B2-P: {}}}, near: {{at: {{alpha: {:.12f}, "
                                  "beta: {:.12f}}}, P: [{:.12f}, {:.12f}]}}}}\n",
                                  first[2], second[2], angles[0], angles[1], tip[0], tip[1]));
}

double angle_of(const Pose& pose, const char* from, const char* to) {
  const Point2 a = place(pose, from), b = place(pose, to);
  return std::atan2(b[1] - a[1], b[0] - a[0]);
}

double turn_of(const Pose& pose, const char* base, const char* elbow) {
  const Point2 a = place(pose, base), p = place(pose, "P"), b = place(pose, elbow);
  return (p[0] - a[0]) * (b[1] - a[1]) - (p[1] - a[1]) * (b[0] - a[0]);
}

struct Image {
  const char* example;
  Point2 posture;
};

class ImagesOfLoci : public ::testing::TestWithParam<Image> {};

TEST_P(ImagesOfLoci, AreTheSameOverTheMotorsAndOverTheEndEffector) {
  const std::string text = example_text(GetParam().example);
  const Model model = Model::parse(text, "place.yaml");
  const Pose posture = solve_pose(model, {GetParam().posture[0], GetParam().posture[1]});
  ASSERT_TRUE(posture.unreachable.empty());
  constexpr double half = 0.4;
  const std::array<double, 2> angles = {angle_of(posture, "A1", "B1"), angle_of(posture, "A2", "B2")};
  const std::string other = over_motors(text, posture, angles, half);
  SCOPED_TRACE(other);
  const Model motors = Model::parse(other, "motors.yaml");
  const LocusMap by_place = trace_loci(model), by_motors = trace_loci(motors);
  int followed = 0, images = 0, away = 0;
  // Every fourth vertex over the motors, as a place, in the working mode of the file.
  for (const LocusCurve& curve : by_motors.curves)
    for (const std::string& name : names_of(curve.vanishing))
      for (const Arc& arc : curve.arcs)
        for (std::size_t i = 0; i < arc.points.size(); i += 4) {
          const Pose pose = solve_pose(motors, {arc.points[i][0], arc.points[i][1]});
          if (!pose.unreachable.empty()) continue;
          if (turn_of(pose, "A1", "B1") * turn_of(posture, "A1", "B1") < 1e-4 ||
              turn_of(pose, "A2", "B2") * turn_of(posture, "A2", "B2") < 1e-4)
            continue;
          const Point2 at = place(pose, "P");
          if (!solve_pose(model, {at[0], at[1]}).unreachable.empty()) continue;
          ++followed;
          EXPECT_LT(distance(at, name, by_place), 2e-4) << name << " at " << at[0] << ", " << at[1];
        }
  // And the other way round, where the same assembly is reached; strands nearer than a cell are not followed.
  for (const LocusCurve& curve : by_place.curves)
    for (const std::string& name : names_of(curve.vanishing))
      for (const Arc& arc : curve.arcs)
        for (std::size_t i = 0; i < arc.points.size(); i += 4) {
          const Pose pose = solve_pose(model, {arc.points[i][0], arc.points[i][1]});
          if (!pose.unreachable.empty()) continue;
          const double alpha = angles[0] + std::remainder(angle_of(pose, "A1", "B1") - angles[0], 2 * std::numbers::pi),
                       beta = angles[1] + std::remainder(angle_of(pose, "A2", "B2") - angles[1], 2 * std::numbers::pi);
          if (std::abs(alpha - angles[0]) > half - 1e-3 || std::abs(beta - angles[1]) > half - 1e-3) continue;
          const Pose same = solve_pose(motors, {alpha, beta});
          if (!same.unreachable.empty() || apart(place(same, "P"), arc.points[i]) > 1e-6) continue;
          ++images;
          away += distance({alpha, beta}, name, by_motors) < 2 * 2 * half / 96 ? 0 : 1;
        }
  fmt::print("{}: {} vertices over the motors, {} images, {} away\n", GetParam().example, followed, images, away);
  EXPECT_GT(followed, 50);
  EXPECT_GT(images, 20);
  EXPECT_LE(50 * away, images);
}

INSTANTIATE_TEST_SUITE_P(Shipped, ImagesOfLoci, ::testing::Values(Image{"five_bar_generic", {0.3, -0.4}}),
                         [](const auto& candidate) { return std::string(candidate.param.example); });

/// The actuator's effort of a joint at a pose, N or N m; nothing out of reach.
std::optional<double> effort(const Model& model, const std::vector<double>& pose, const std::string& joint) {
  const Pose found = solve_pose(model, pose);
  if (!found.unreachable.empty()) return std::nullopt;
  for (const JointReaction& reaction : found.reactions)
    if (reaction.joint == joint) return reaction.components.back().value;
  return std::nullopt;
}

TEST(GroupLaw, EffortsVanishOnSurfacesOverThreeLegs) {
  const Model model = Model::read(source_dir() + "/examples/three_rpr_legs.yaml");
  const LocusMap map = trace_loci(model, {.mesh_size = 1.0 / 10});
  int seen = 0;
  for (const LocusSurface& surface : map.surfaces) {
    EXPECT_FALSE(surface.certified);
    EXPECT_GT(surface.components, 0);
    if (names_of(surface.vanishing).count("FS2") == 0) continue;
    for (const Point3& at : surface.vertices) {
      const auto value = effort(model, {at.begin(), at.end()}, "S2");
      if (!value) continue;  // by another means, beside a dead centre
      ++seen;
      // The legs bear some 100 N.
      ASSERT_LT(std::abs(*value), 1e-6) << at[0] << ", " << at[1] << ", " << at[2];
    }
  }
  EXPECT_GT(seen, 300);
  EXPECT_FALSE(map.complete);
}

}  // namespace
}  // namespace clearloci
