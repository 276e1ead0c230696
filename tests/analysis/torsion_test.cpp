// Torsion springs in loci, zones and proofs, held against statics and angles of the tests' own.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "analysis/loci.hpp"
#include "clearloci/error.hpp"
#include "clearloci/export.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A lever of 0.3 m under 100 N; 12 N m/rad pull it to 60 deg.
Model lever(const std::string& range) {
  return Model::parse("format: 1\nname: Lever\nworkspace: {q: {angle: " + range + R"(}}
points: {A: [0, 0], B: ['0.3*cos(q)', '0.3*sin(q)']}
links: {bar: {points: [A, B]}}
joints:
  A: {revolute: [ground, bar], at: A, actuated: true, clearance: {radial: 1e-5, angular: 1e-3}}
springs: [{name: T, joint: A, stiffness: 12, rest: 60 deg}]
loads: [{link: bar, at: B, force: [0, -100]}]
end_effector: {link: bar, at: B}
)");
}

double motor(double q) { return 12 * (q - 60 * degree) + 30 * std::cos(q); }

TEST(Torsion, HasItsZerosOverOneCoordinate) {
  const LocusMap map = trace_loci(lever("[-80 deg, 200 deg]"));
  std::vector<double> expected;
  constexpr int steps = 4000;
  for (int i = 0; i < steps; ++i) {
    double lower = (-80 + 280.0 * i / steps) * degree, upper = (-80 + 280.0 * (i + 1) / steps) * degree;
    if (motor(lower) * motor(upper) > 0) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = (lower + upper) / 2;
      (motor(lower) * motor(middle) > 0 ? lower : upper) = middle;
    }
    expected.push_back(lower);
  }
  ASSERT_EQ(expected.size(), 3U);
  ASSERT_EQ(map.isolated_points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(map.isolated_points[i].kind, LocusKind::backlash);
    EXPECT_TRUE(map.isolated_points[i].certified);
    EXPECT_NEAR(map.isolated_points[i].at[0], expected[i], 1e-12);
  }
  ASSERT_EQ(map.reachable.size(), 1U);
}

TEST(Torsion, EndsTheWorkspaceHalfATurnOffItsRest) {
  const LocusMap map = trace_loci(lever("[200 deg, 280 deg]"));
  ASSERT_EQ(map.reachable.size(), 2U);
  EXPECT_NEAR(map.reachable[0].to, 239.9 * degree, 0.001 * degree + 1e-5);
  EXPECT_NEAR(map.reachable[1].from, 240.1 * degree, 0.001 * degree + 1e-5);
  int ends = 0;
  for (const IsolatedPoint& point : map.isolated_points)
    if (point.kind == LocusKind::workspace_boundary) {
      ++ends;
      EXPECT_NE(point.cause.find("torsion spring T half a turn off its rest"), std::string::npos) << point.cause;
    }
  EXPECT_EQ(ends, 2);
}

/// The paper's 5R with a torsion spring in its first motor, over a part of its box.
Model five_bar(const std::string& x, const std::string& y, const std::string& spring) {
  return Model::parse("format: 1\nname: 5R\nworkspace: {x: " + x + ", y: " + y + R"(}
points:
  A1: [0, 0]
  A2: [1/2, 0]
  P: [x, y]
  B1: {dyad: [A1, P], lengths: [1/2, 1/2], side: right}
  B2: {dyad: [A2, P], lengths: [1/2, 1/2], side: left}
links: {A1B1: {points: [A1, B1]}, B1P: {points: [B1, P]}, PB2: {points: [P, B2]}, B2A2: {points: [B2, A2]}}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true, clearance: {radial: 1e-5, angular: 1e-3}}
  B1: {revolute: [A1B1, B1P], at: B1, clearance: {radial: 1e-5}}
  P: {revolute: [B1P, PB2], at: P, clearance: {radial: 1e-5}}
  B2: {revolute: [PB2, B2A2], at: B2, clearance: {radial: 1e-5}}
  A2: {revolute: [B2A2, ground], at: A2, actuated: true, clearance: {radial: 1e-5, angular: 1e-3}}
end_effector: {link: PB2, at: P}
loads: [{link: PB2, at: P, force: [0, -100]}]
springs: [)" + spring +
                      "]\n");
}

struct Elbows {
  std::array<double, 2> b1, b2;
};

Elbows elbows(double x, double y) {
  const auto elbow = [&](double from, int side) {
    const double u = x - from, v = y, d = u * u + v * v, h = std::sqrt(0.25 / d - 0.25) * side;
    return std::array{from + u / 2 - h * v, v / 2 + h * u};
  };
  return {elbow(0, -1), elbow(0.5, 1)};
}

/// The couple of the motor at A1: the rod B1P bears n, with n (P - B1) + m (P - B2) + (0, -100) = 0.
double first_motor(double x, double y, double rest) {
  const auto [b1, b2] = elbows(x, y);
  const double ax = x - b1[0], ay = y - b1[1], bx = x - b2[0], by = y - b2[1];
  const double n = -100 * bx / (ax * by - ay * bx);  // of the rod on P, along P - B1, per length
  const double turned = std::remainder(std::atan2(b1[1], b1[0]) - rest, 2 * std::numbers::pi);
  return (b1[0] * n * ay - b1[1] * n * ax) + 20 * turned;
}

TEST(Torsion, HasItsCurvesTracedAndCertified) {
  const LocusMap map =
      trace_loci(five_bar("[0.1, 0.6]", "[-0.9, -0.3]", "{name: T, joint: A1, stiffness: 20, rest: 150 deg}"));
  int curves = 0;
  for (const LocusCurve& curve : map.curves) {
    if (curve.kind != LocusKind::backlash || curve.vanishing[0].joint != "A1") continue;
    ++curves;
    EXPECT_TRUE(curve.certified);
    EXPECT_TRUE(curve.implicit.is_zero());
    for (const Arc& arc : curve.arcs)
      for (const Point2& p : arc.points) EXPECT_NEAR(first_motor(p[0], p[1], 150 * degree), 0, 1e-7);
  }
  EXPECT_EQ(curves, 1);
  // Nothing is missing: the signs of zones are those of the couple at their samples, and of neighbours in them.
  const Zones zones =
      find_zones(five_bar("[0.1, 0.6]", "[-0.9, -0.3]", "{name: T, joint: A1, stiffness: 20, rest: 150 deg}"));
  EXPECT_GE(zones.zones.size(), 3U);
  double area = 0;
  for (const Zone& zone : zones.zones) area += zone.size;
  int inside = 0;
  constexpr int n = 200;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double x = 0.1 + 0.5 * (i + 0.5) / n, y = -0.9 + 0.6 * (k + 0.5) / n;
      inside += std::hypot(x, y) < 1 && std::hypot(x - 0.5, y) < 1 ? 1 : 0;
    }
  EXPECT_NEAR(area, 0.3 * inside / (n * n), 1e-3);
}

TEST(Torsion, LeavesTheCurvesOfOthersAlone) {
  // Around A1, where the elbow takes all directions, and across the cut.
  const LocusMap map =
      trace_loci(five_bar("[-0.2, 0.2]", "[-0.2, 0.2]", "{name: T, joint: A1, stiffness: 20, rest: 150 deg}"));
  for (const LocusCurve& curve : map.curves) {
    if (curve.kind != LocusKind::backlash || curve.vanishing[0].joint != "A1") continue;
    for (const Arc& arc : curve.arcs)
      for (const Point2& p : arc.points)
        if (std::hypot(p[0], p[1]) > 1e-3) {
          EXPECT_NEAR(first_motor(p[0], p[1], 150 * degree), 0, 1e-6);
        }
  }
}

// Random designs of which chains of cells along the cut were left open: there the workspace ends within 1e-6 of an
// extreme of the cosine that tells it.
TEST(Torsion, CurvesBesideTheCutAreCertified) {
  for (const char* const name : {"torsion_at_an_elbow", "torsion_cut_meets_a_rim", "torsion_at_coaxial_bases"}) {
    SCOPED_TRACE(name);
    const auto file = source_dir() + "/tests/corpus/springs/" + name + ".yaml";
    const Validation validation = validate_loci(mechanism::read_mechanism(file), {}, {40, 40});
    EXPECT_EQ(validation.report.disputed, 0U);
    for (const LocusCurve& curve : validation.map.curves)
      EXPECT_TRUE(curve.certified) << curve.id << " " << curve.cause;
  }
}

// A spring between ground and crank: at both ends of its range the crank stands still, 0.2 deg apart, and P runs along
// a circle about its tip, half of it in either mode. Told by the cosine of the angle, the circles were one double curve
// to cells larger than the slit between them.
TEST(Torsion, TheCutOfACrankIsTwoHalfCircles) {
  const auto file = source_dir() + "/tests/corpus/springs/torsion_at_the_crank.yaml";
  LociRequest request;
  request.working_modes = {{-1}};  // right
  const core::LocusMap map = trace_loci(mechanism::read_mechanism(file), request);
  EXPECT_TRUE(map.complete);
  const Point2 base = {-3148.0 / 805, 953.0 / 342};
  const double crank = 39.0 / 97, rod = 136.0 / 129, rest = -59 * degree;
  std::array<double, 2> lengths = {0, 0};
  for (const LocusCurve& curve : map.curves) {
    if (curve.cause.find("half a turn off its rest") == std::string::npos) continue;
    EXPECT_TRUE(curve.certified);
    for (const Arc& arc : curve.arcs) {
      const auto off = [&](const Point2& p, int side) {
        const double angle = rest + (side == 0 ? 1 : -1) * std::acos(-1313315.0 / 1313317);
        return std::hypot(p[0] - base[0] - crank * std::cos(angle), p[1] - base[1] - crank * std::sin(angle)) - rod;
      };
      const Point2& middle = arc.points[arc.points.size() / 2];
      const int side = std::abs(off(middle, 0)) < std::abs(off(middle, 1)) ? 0 : 1;
      lengths[static_cast<std::size_t>(side)] += arc.length;
      for (const Point2& p : arc.points) EXPECT_NEAR(off(p, side), 0, 1e-11);
      for (const Point2& end : {arc.points.front(), arc.points.back()}) {
        const double reach = std::hypot(end[0] - base[0], end[1] - base[1]);
        EXPECT_LT(std::min(std::abs(reach - (rod + crank)), std::abs(reach - (rod - crank))), 1e-9);
      }
    }
  }
  for (const double length : lengths) EXPECT_NEAR(length, std::numbers::pi * rod, 1e-4);
}

// Over the angles of two motors the ends of the range have no closed form.
TEST(Torsion, TheCutOverAnglesAndOnACouplerIsCertified) {
  for (const char* const name : {"torsion_at_an_elbow_over_motors", "torsion_at_the_crank_of_a_coupler"}) {
    SCOPED_TRACE(name);
    const auto file = source_dir() + "/tests/corpus/springs/" + name + ".yaml";
    const Validation validation = validate_loci(mechanism::read_mechanism(file), {}, {40, 40});
    EXPECT_EQ(validation.report.disputed, 0U);
    EXPECT_TRUE(validation.map.complete);
    for (const LocusCurve& curve : validation.map.curves) {
      EXPECT_TRUE(curve.certified) << curve.id << " " << curve.cause;
      EXPECT_LT(curve.arcs.size(), 20U) << curve.cause;
    }
  }
}

// The fingers of a gripper mirror each other: the angles of their springs are opposite, what they exert on the guide
// cancels out, and the guide bears nothing in any pose. Its ends had zeros of rounding, and no zone was found.
TEST(Torsion, OfFingersThatMirrorEachOtherCancelsOut) {
  const auto file = source_dir() + "/tests/corpus/springs/gripper_torsion_and_ends_meet.yaml";
  const mechanism::Mechanism mechanism = mechanism::read_mechanism(file);
  const LocusMap map = trace_loci(mechanism, {});
  std::size_t losses = 0;
  for (const IsolatedPoint& point : map.isolated_points) {
    if (point.kind == LocusKind::workspace_boundary) continue;
    ++losses;
    EXPECT_NEAR(point.at.front(), -10.1063875e-3, 1e-9);
    for (const Vanishing& one : point.vanishing) EXPECT_NE(core::to_string(one.quantity).substr(0, 3), "end");
  }
  EXPECT_EQ(losses, 3U) << "R1 and K1, R2 and K2, and the motor, at one pose";
  const Model model = Model::read(file);
  EXPECT_EQ(find_zones(model).zones.size(), 3U);
  const std::string errors = to_text(find_errors(model));
  EXPECT_EQ(errors.find("nan"), std::string::npos);
  EXPECT_NE(errors.find("undefined"), std::string::npos);
}

TEST(Torsion, RestDoesNotVary) {
  const Model model = Model::read(source_dir() + "/tests/corpus/springs/five_bar_rest_of_a_parameter.yaml");
  const std::string box = "format: 1\nbox: {x: [0.2, 0.25], y: [-0.7, -0.65]}\n";
  EXPECT_THROW(verify(model, parse_task(box + "tolerances: {a: 0.01}\n", model)), InputError);
  EXPECT_NO_THROW(verify(model, parse_task(box + "tolerances: {k: 0.01}\n", model)));
}

}  // namespace
}  // namespace clearloci
