// Loci and zones of free efforts without a value (docs/background/method.md section 15), held against reactions that
// are solved with efforts that are given.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "clearloci/errors.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/validate.hpp"
#include "clearloci/zones.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

Model antagonistic() { return Model::parse(example_text("studies/antagonistic")); }

/// A 5R with a third leg, whose motor has a free effort.
Model three_legs() {
  return Model::parse(R"(format: 1
name: 5R with a third leg
space: planar
workspace: {x: [-0.3, 0.8], y: [0.05, 0.75]}
points:
  A1: [0, 0]
  A2: [0.5, 0]
  A3: [0.2, 0.9]
  P: [x, y]
  B1: {dyad: [A1, P], lengths: [0.45, 0.5], side: right}
  B2: {dyad: [A2, P], lengths: [0.45, 0.5], side: left}
  B3: {dyad: [A3, P], lengths: [0.4, 0.55], side: left}
links:
  C1: {points: [A1, B1]}
  R1: {points: [B1, P]}
  C2: {points: [A2, B2]}
  R2: {points: [B2, P]}
  C3: {points: [A3, B3]}
  R3: {points: [B3, P]}
joints:
  A1: {revolute: [ground, C1], at: A1, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}
  A2: {revolute: [ground, C2], at: A2, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}
  A3: {revolute: [ground, C3], at: A3, actuated: {effort: free}, clearance: {radial: 10e-6, angular: 0.5e-3}}
  B1: {revolute: [C1, R1], at: B1, clearance: {radial: 10e-6}}
  B2: {revolute: [C2, R2], at: B2, clearance: {radial: 10e-6}}
  B3: {revolute: [C3, R3], at: B3, clearance: {radial: 10e-6}}
  P:  {revolute: [R1, R2], at: P, clearance: {radial: 10e-6}}
  Q:  {revolute: [R3, R2], at: P, clearance: {radial: 10e-6}}
end_effector: {link: R2, at: P}
loads:
  - {link: R2, at: P, force: [30, -100]}
)");
}

/// Of every scalar reaction the two numbers a and b of w = a + b effort.
std::map<std::string, std::array<double, 2>> lines_at(const Model& model, const std::string& parameter,
                                                      const std::vector<double>& at) {
  std::map<std::string, std::array<double, 2>> lines;
  for (const int effort : {0, 1})
    for (const JointReaction& joint : solve_pose(model.with({{parameter, std::to_string(effort)}}), at).reactions)
      for (const ReactionComponent& part : joint.components) {
        std::array<double, 2>& line = lines[to_string(part.quantity) + "_" + joint.joint];
        line[static_cast<std::size_t>(effort)] = part.value;
      }
  for (auto& [name, range] : lines) range[1] -= range[0];
  lines.try_emplace("M_" + parameter.substr(parameter.find('_') + 1), std::array<double, 2>{0, 1});
  return lines;
}

/// The rows of a reaction: its components.
std::vector<std::array<double, 2>> rows_of(const std::map<std::string, std::array<double, 2>>& lines,
                                           const Vanishing& reaction) {
  if (reaction.quantity != Quantity::f) return {lines.at(to_string(reaction.quantity) + "_" + reaction.joint)};
  return {lines.at("fx_" + reaction.joint), lines.at("fy_" + reaction.joint)};
}

/// How far a set of rows is from vanishing at one effort: 0 where they do, below 1.
double apart(const std::vector<std::array<double, 2>>& rows) {
  double most = 0, largest = 0;
  for (const auto& r : rows) largest = std::max(largest, std::hypot(r[0], r[1]));
  for (const auto& r : rows)
    for (const auto& s : rows) {
      const double size = std::hypot(r[0], r[1]) * std::hypot(s[0], s[1]);
      const bool zero = std::min(std::hypot(r[0], r[1]), std::hypot(s[0], s[1])) < 1e-9 * largest;
      if (!zero) most = std::max(most, std::abs(r[0] * s[1] - r[1] * s[0]) / size);
    }
  return most;
}

/// Along every arc of the preload loci all that is named vanishes at one effort, or does not change with it; the number
/// of curves.
int expect_named_at_one_effort(const Model& model, const std::string& parameter) {
  int curves = 0;
  for (const LocusCurve& curve : trace_loci(model).curves) {
    if (curve.kind != LocusKind::preload) continue;
    EXPECT_FALSE(curve.vanishing.empty()) << curve.id;
    ++curves;
    for (const Arc& arc : curve.arcs)
      for (const double part : {0.2, 0.5, 0.8}) {
        const Point2& at = arc.points[static_cast<std::size_t>(part * static_cast<double>(arc.points.size() - 1))];
        const auto lines = lines_at(model, parameter, {at[0], at[1]});
        std::vector<std::array<double, 2>> rows;
        for (const Vanishing& vanishing : curve.vanishing)
          for (const auto& row : rows_of(lines, vanishing)) rows.push_back(row);
        if (curve.cause.find("not depend on the effort") != std::string::npos) rows.push_back({1, 0});
        EXPECT_LT(apart(rows), 1e-3) << curve.cause << " at " << at[0] << ", " << at[1];
      }
  }
  return curves;
}

TEST(PreloadLoci, VanishTogetherAlongTheirArcs) {
  EXPECT_GT(expect_named_at_one_effort(antagonistic(), "preload_B2"), 0);
  EXPECT_GT(expect_named_at_one_effort(three_legs(), "preload_A3"), 0);
}

TEST(PreloadLoci, HoldOnAGrid) {
  for (const Model& model : {antagonistic(), three_legs()}) {
    const Validation validation = validate_loci(model, {.nodes = {100, 100}});
    EXPECT_TRUE(validation.validated()) << validation.report.disputed << " edges disputed";
    EXPECT_GT(validation.report.held, 1000U);
  }
}

/// Where reactions change at least as the sample of their zone says they do: as many ranges, ended by the same
/// reactions.
void expect_alike_all_over(const Model& model) {
  const Zones zones = find_zones(model);
  ASSERT_FALSE(zones.zones.empty());
  int poses = 0;
  for (const Zone& zone : zones.zones) {
    ASSERT_TRUE(zone.preload) << zone.id;
    ASSERT_EQ(zone.preload->efforts.size(), 1U);
    const auto& here = zone.preload->efforts.front().ranges;
    EXPECT_EQ(here.size(), zone.preload->patterns.size());
    // Around the middle of the largest circle, well inside.
    for (int k = 0; k < 5; ++k) {
      const double away = 0.7 * zone.ball.radius;
      const Pose pose = solve_pose(
          model, {zone.ball.centre[0] + away * std::cos(1.3 * k), zone.ball.centre[1] + away * std::sin(1.3 * k)});
      ASSERT_EQ(pose.efforts.size(), 1U);
      const auto& there = pose.efforts.front().ranges;
      ASSERT_EQ(there.size(), here.size()) << zone.id;
      for (std::size_t r = 0; r < here.size(); ++r) {
        const auto names = [](const std::vector<Vanishing>& all) {
          std::set<std::string> list;
          for (const Vanishing& vanishing : all)  // forces along a leg vanish with its couple, to rounding
            if (vanishing.joint.front() == 'A') list.insert(vanishing.joint);
          return list;
        };
        EXPECT_EQ(names(there[r].below), names(here[r].below)) << zone.id;
        EXPECT_EQ(names(there[r].above), names(here[r].above)) << zone.id;
      }
      ++poses;
    }
  }
  EXPECT_GT(poses, 20);
}

TEST(PreloadZones, HaveOneChoiceOfEffortsEach) {
  expect_alike_all_over(antagonistic());
  expect_alike_all_over(three_legs());
}

TEST(PreloadZones, WithoutRoomHaveNone) {
  const Model tight =
      Model::parse(replaced(example_text("studies/antagonistic"), "effort: free", "effort: free, within: [-0.5, 0.5]"));
  const Zones zones = find_zones(tight, {.loci = {.min_couple = Rational(40)}});
  EXPECT_TRUE(std::any_of(zones.zones.begin(), zones.zones.end(),
                          [](const Zone& zone) { return zone.preload && !zone.preload->feasible; }));
}

/// A point of 2 kg on three cables.
constexpr const char* three_cables = R"(format: 1
name: Point mass on three cables
space: planar
workspace: {x: [-0.9, 0.9], y: [-0.8, 0.9]}
points:
  P: [x, y]
  A1: [-1, 1]
  A2: [1, 1.2]
  A3: [0.2, -1]
links:
  load: {points: [P], masses: [{at: P, mass: 2}]}
joints:
  K1: {cable: [ground, load], at: [A1, P], tension: [5, 60]}
  K2: {cable: [ground, load], at: [A2, P], tension: [5, 60]}
  K3: {cable: [ground, load], at: [A3, P], tension: [5, 40]}
end_effector: {link: load, at: P}
gravity: [0, -9.81]
)";

struct Cable {
  Point2 anchor;
  double least = 5, most = 60;
};
constexpr std::array<Cable, 3> cables = {{{{-1, 1}, 5, 60}, {{1, 1.2}, 5, 60}, {{0.2, -1}, 5, 40}}};
constexpr double weight = 2 * 9.81;

Point2 pull(const Cable& cable, const Point2& at) {
  const double x = cable.anchor[0] - at[0], y = cable.anchor[1] - at[1], length = std::hypot(x, y);
  return {x / length, y / length};
}
double cross(const Point2& a, const Point2& b) { return a[0] * b[1] - a[1] * b[0]; }

/// By hand: with the tension t of the third cable those of the others follow from two equations.
bool has_tensions(const Point2& at) {
  const Point2 u = pull(cables[0], at), v = pull(cables[1], at), w = pull(cables[2], at);
  double low = cables[2].least, high = cables[2].most;
  const auto hold = [&](double a, double b) {  // a + b t >= 0
    (b > 0 ? low : high) = b > 0 ? std::max(low, -a / b) : std::min(high, -a / b);
  };
  // t1 u + t2 v = (0, weight) - t w
  const Point2 up = {0, weight};
  const double d = cross(u, v);
  const std::array<Point2, 2> lines = {{{cross(up, v) / d, -cross(w, v) / d}, {cross(u, up) / d, -cross(u, w) / d}}};
  for (std::size_t i = 0; i < 2; ++i) {
    hold(lines[i][0] - cables[i].least, lines[i][1]);
    hold(cables[i].most - lines[i][0], -lines[i][1]);
  }
  return low < high;
}

bool is_within(const Polyline& ring, const Point2& at) {
  bool inside = false;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const Point2 &a = ring[i - 1], &b = ring[i];
    if ((a[1] > at[1]) != (b[1] > at[1]) && at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1]))
      inside = !inside;
  }
  return inside;
}

/// The force that is left, across the one cable that is at no bound.
TEST(TensionLoci, AreWhereTwoCablesAtTheirBoundsLeaveAForceAlongTheThird) {
  const LocusMap loci = trace_loci(Model::parse(three_cables));
  int curves = 0;
  for (const LocusCurve& curve : loci.curves) {
    ASSERT_NE(curve.kind, LocusKind::direct_singularity) << "of the choice of the free cable alone";
    if (curve.kind != LocusKind::preload) continue;
    ++curves;
    ASSERT_EQ(curve.vanishing.size(), 2U) << curve.cause;
    for (const Arc& arc : curve.arcs) {
      const Point2& at = arc.points[arc.points.size() / 2];
      Point2 left = {0, -weight};
      std::size_t other = 3;
      for (const Vanishing& vanishing : curve.vanishing) {
        const auto k = static_cast<std::size_t>(vanishing.joint.back() - '1');
        other -= k;
        const bool least = curve.cause.find(vanishing.joint + " at 5 N") != std::string::npos;
        const double tension = least ? cables[k].least : cables[k].most;
        const Point2 u = pull(cables[k], at);
        left = {left[0] + tension * u[0], left[1] + tension * u[1]};
      }
      EXPECT_NEAR(cross(left, pull(cables[other], at)), 0, 1e-3) << curve.cause << " at " << at[0] << ", " << at[1];
    }
  }
  EXPECT_GT(curves, 5);
}

TEST(TensionZones, AreTheWrenchFeasibleWorkspace) {
  const Zones zones = find_zones(Model::parse(three_cables));
  int feasible = 0, others = 0;
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j) {
      const Point2 at = {-0.9 + 1.8 * (i + 0.4142) / 60, -0.8 + 1.7 * (j + 0.618) / 60};
      bool near = false;  // the answer changes within the tolerance of borders
      for (const double step : {-1e-4, 1e-4})
        near = near || has_tensions({at[0] + step, at[1]}) != has_tensions({at[0], at[1] + step}) ||
               has_tensions({at[0] + step, at[1]}) != has_tensions(at);
      if (near) continue;
      const Zone* home = nullptr;
      for (const Zone& zone : zones.zones)
        if (is_within(zone.outer, at) &&
            std::none_of(zone.holes.begin(), zone.holes.end(), [&](const Polyline& h) { return is_within(h, at); }))
          home = &zone;
      ASSERT_NE(home, nullptr) << at[0] << ", " << at[1];
      ASSERT_TRUE(home->preload);
      EXPECT_EQ(home->preload->feasible, has_tensions(at)) << at[0] << ", " << at[1];
      ++(has_tensions(at) ? feasible : others);
    }
  EXPECT_GT(feasible, 100);
  EXPECT_GT(others, 100);
  // Loci between zones alike are no borders.
  for (const Zone& zone : zones.zones)
    for (const ZoneBorder& border : zone.borders)
      for (const std::string& beside : border.beside)
        for (const Zone& other : zones.zones)
          if (other.id == beside) {
            EXPECT_NE(other.preload->feasible, zone.preload->feasible) << zone.id << beside;
          }
}

/// Three sliders on one point, the third one of free effort.
const char* const three_sliders = R"(format: 1
space: planar
workspace: {x: [0.1, 0.5], y: [-0.3, 0.3]}
points:
  R1: [0, 0]
  R2: [0.6, 0]
  R3: [0, 0.5]
  P: [x, y]
  S1: {slider: [R1, [0, 1]], from: P, length: 0.52, side: ahead}
  S2: {slider: [R2, [0, 1]], from: P, length: 0.54, side: ahead}
  S3: {slider: [R3, [1, 0]], from: P, length: 0.9, side: ahead}
links:
  K1: {points: [S1]}
  L1: {points: [S1, P]}
  K2: {points: [S2]}
  L2: {points: [S2, P]}
  K3: {points: [S3]}
  L3: {points: [S3, P]}
joints:
  G1: {prismatic: [ground, K1], at: S1, axis: [0, 2], actuated: true, clearance: {axial: 5e-6}}
  S1: {revolute: [K1, L1], at: S1}
  P:  {revolute: [L1, L2], at: P}
  S2: {revolute: [K2, L2], at: S2}
  G2: {prismatic: [ground, K2], at: S2, axis: [0, 1], actuated: true, clearance: {axial: 5e-6}}
  Q:  {revolute: [L3, L2], at: P}
  S3: {revolute: [K3, L3], at: S3}
  G3: {prismatic: [ground, K3], at: S3, axis: [1, 0], actuated: {effort: free, within: [-200, 200]}, clearance: {axial: 5e-6}}
end_effector: {link: L2, at: P}
loads:
  - {link: L2, at: P, force: [30, -100]}
)";

/// Of the motors at a place, where the third one exerts `effort`, N: by the balance of P between three rods.
std::array<double, 3> motors_of_sliders(const Point2& p, double effort) {
  const std::array<Point2, 3> ends = {Point2{0, p[1] + std::sqrt(0.52 * 0.52 - p[0] * p[0])},
                                      Point2{0.6, p[1] + std::sqrt(0.54 * 0.54 - std::pow(p[0] - 0.6, 2))},
                                      Point2{p[0] + std::sqrt(0.81 - std::pow(p[1] - 0.5, 2)), 0.5}};
  const std::array<double, 3> lengths = {0.52, 0.54, 0.9};
  std::array<Point2, 3> e{};  // along which the rods push P
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t c = 0; c < 2; ++c) e[i][c] = (p[c] - ends[i][c]) / lengths[i];
  const double third = effort / e[2][0];
  const Point2 rest = {-30 - third * e[2][0], 100 - third * e[2][1]};
  const double turn = e[0][0] * e[1][1] - e[0][1] * e[1][0];
  const double first = (rest[0] * e[1][1] - rest[1] * e[1][0]) / turn,
               second = (e[0][0] * rest[1] - e[0][1] * rest[0]) / turn;
  return {first * e[0][1], second * e[1][1], effort};
}

/// "F_G1 at 20 N and G3 at -200 N at once".
std::map<int, double> motors_told(const std::string& words) {
  std::map<int, double> told;
  for (std::size_t at = words.find('G'); at != std::string::npos; at = words.find('G', at + 1))
    if (words.compare(at + 2, 4, " at ") == 0) told[words[at + 1] - '1'] = std::stod(words.substr(at + 6));
  return told;
}

TEST(PreloadLoci, AreWhereTwoMotorsHaveTheirLeastForcesTogether) {
  const LocusMap map = trace_loci(Model::parse(three_sliders, "sliders.yaml"), {.min_force = Rational(20)});
  EXPECT_TRUE(map.complete);
  int curves = 0, held = 0;
  for (const LocusCurve& curve : map.curves) {
    const std::map<int, double> told = motors_told(curve.cause);
    if (told.size() != 2) continue;
    ++curves;
    for (const Arc& arc : curve.arcs)
      for (const Point2& p : arc.points) {
        double effort = 0;
        if (told.count(2) > 0) {
          effort = told.at(2);
        } else {
          const double at_0 = motors_of_sliders(p, 0)[0], at_1 = motors_of_sliders(p, 1)[0];
          effort = (told.at(0) - at_0) / (at_1 - at_0);
        }
        const std::array<double, 3> motors = motors_of_sliders(p, effort);
        for (const auto& [motor, force] : told) {
          ++held;
          EXPECT_NEAR(motors[static_cast<std::size_t>(motor)], force, 2e-3)
              << curve.cause << " at " << p[0] << ", " << p[1];
        }
      }
  }
  EXPECT_GT(curves, 8);
  EXPECT_GT(held, 400);
}

TEST(TensionLoci, HoldOnAGrid) {
  const Validation validation = validate_loci(Model::parse(three_cables), {.nodes = {60, 60}});
  EXPECT_TRUE(validation.validated()) << validation.report.disputed << " edges disputed";
  EXPECT_GT(validation.report.held, 1000U);
}

/// With an effort that varies with the pose another effort may be free.
TEST(PreloadLoci, ControlledHaveFewerSingularities) {
  const auto singular = [](bool controlled) {
    const LocusMap loci = trace_loci(three_legs(), {.controlled = controlled});
    return std::count_if(loci.curves.begin(), loci.curves.end(),
                         [](const LocusCurve& curve) { return curve.kind == LocusKind::direct_singularity; });
  };
  EXPECT_GT(singular(false), 0);
  EXPECT_EQ(singular(true), 0);
}

/// An effort that follows, at its bound.
TEST(BoundLoci, AreWhereADeterminedEffortHasItsBound) {
  const Model model = Model::parse(
      replaced(example_text("five_bar"), "at: A1, actuated: true", "at: A1, actuated: {within: [-20, 30]}"));
  int curves = 0;
  for (const LocusCurve& curve : trace_loci(model).curves) {
    if (curve.kind != LocusKind::preload) continue;
    ++curves;
    const double bound = curve.cause.find("-20 N m") != std::string::npos ? -20 : 30;
    for (const Arc& arc : curve.arcs) {
      const Point2& at = arc.points[arc.points.size() / 2];
      for (const JointReaction& joint : solve_pose(model, {at[0], at[1]}).reactions)
        for (const ReactionComponent& part : joint.components)
          if (joint.joint == "A1" && part.quantity == Quantity::M) {
            EXPECT_NEAR(part.value, bound, 0.05) << curve.cause;
          }
    }
  }
  EXPECT_EQ(curves, 2);
}

}  // namespace
}  // namespace clearloci
