// Preload, the cure for contact loss: proven to be one. And what springs, known efforts and limits mean to loci, zones
// and tasks, held against the witness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "analysis/loci.hpp"
#include "analysis/zones.hpp"
#include "mechanism/read_task.hpp"
#include "tests/laws/judged.hpp"
#include "tests/mechanism/five_bar_text.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using core::LocusKind;
using mechanism::with;

const std::string folder = source_dir() + "/examples/";

mechanism::Mechanism example(const std::string& name) { return mechanism::read_mechanism(folder + name + ".yaml"); }
mechanism::Mechanism parsed(const std::string& text) { return mechanism::parse_mechanism(text, "m.yaml"); }

void expect_witnessed(const mechanism::Mechanism& mechanism) {
  const Validation validation = validate_loci(mechanism, {}, {120, 120});
  EXPECT_EQ(validation.report.disputed, 0U);
  EXPECT_GT(validation.report.held, 1000U);
}

TEST(Preload, RemovesEveryLocusFromTheTask) {
  const auto decide = [](const std::string& name) {
    const mechanism::Mechanism mechanism = example(name);
    return test::decided(mechanism, mechanism::read_task(folder + "tasks/preload.yaml", mechanism), {});
  };
  const Verification bare = decide("five_bar");
  EXPECT_EQ(bare.verdict, core::Verdict::refuted);
  ASSERT_TRUE(bare.witness);
  EXPECT_EQ(bare.witness->kind, core::TaskWitness::Kind::vanishing);
  for (const char* name : {"five_bar_preloaded", "five_bar_antagonistic"}) {
    const Verification proven = decide(name);
    EXPECT_TRUE(proven.verified()) << name;
    EXPECT_GT(*proven.margin, 0.1) << name;
  }
}

TEST(Preload, LociHoldAgainstTheWitness) {
  for (const char* name : {"five_bar_preloaded", "five_bar_antagonistic", "excavator"}) {
    SCOPED_TRACE(name);
    const core::LocusMap map = trace_loci(example(name));
    EXPECT_TRUE(map.complete);
    for (const core::LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << curve.id;
    expect_witnessed(example(name));
  }
}

TEST(Preload, ALoadThatVariesWithThePoseHasItsLoci) {
  expect_witnessed(parsed(with(mechanism::five_bar_text, "force: [0, -100]", "force: [-40*(x - 1/4), -100]")));
}

TEST(Preload, InSpaceToo) {
  std::ifstream file(folder + "gough_stewart_slice.yaml");
  const std::string text = {std::istreambuf_iterator<char>(file), {}};
  LociRequest request;
  request.joints = {"S1", "S4"};
  const Validation validation = validate_loci(
      parsed(text + "springs: [{links: [ground, platform], at: [A1, P], stiffness: 300, free_length: 0.2}]\n"
                    "limits: [{distance: [A1, B1], within: [0.3, 0.7]}]\n"),
      request, {40, 40});
  EXPECT_EQ(validation.report.disputed, 0U);
  EXPECT_GT(validation.report.held, 1000U);
  EXPECT_GT(validation.report.outside, 100U) << "beyond the limit";
}

const std::string limits = R"(limits:
  - {distance: [A1, P], within: [0.31, 0.92]}
  - {angle: [A1, B1, P], within: [50 deg, 160 deg]}
)";

TEST(Limits, BoundTheWorkspace) {
  // |A1 P| = sin(angle / 2): from 50 deg on the angle asks for more than 0.31 m.
  const mechanism::Mechanism m = parsed(mechanism::five_bar_text + limits);
  const core::Zones map = find_zones(m);
  for (const core::LocusCurve& curve : map.loci.curves) {
    if (curve.kind != LocusKind::workspace_boundary || curve.cause.rfind("limit", 0) != 0) continue;
    const double radius = curve.cause == "limit: distance A1-P at 0.92 m" ? 0.92 : std::sin(25 * M_PI / 180);
    for (const core::Arc& arc : curve.arcs)
      for (const core::Point2& p : arc.points) EXPECT_NEAR(std::hypot(p[0], p[1]), radius, 1e-5) << curve.cause;
  }
  // The part of the ring about A1 that lies in the circle of radius 1 about A2, counted on a grid.
  double area = 0, counted = 0;
  for (const core::Zone& zone : map.zones) area += zone.size;
  constexpr int steps = 1500;
  const double hx = 1.5 / steps, hy = 2.0 / steps;
  for (int i = 0; i < steps; ++i)
    for (int k = 0; k < steps; ++k) {
      const double x = -0.5 + (i + 0.5) * hx, y = -1 + (k + 0.5) * hy, r = std::hypot(x, y);
      if (r >= std::sin(25 * M_PI / 180) && r <= 0.92 && std::hypot(x - 0.5, y) <= 1) counted += hx * hy;
    }
  EXPECT_NEAR(area, counted, 2e-3);
  expect_witnessed(m);
}

TEST(Limits, AreNamedByTheVerdictOnATask) {
  const mechanism::Mechanism m = parsed(mechanism::five_bar_text + limits);
  const auto verify = [&](const std::string& task) {
    return test::judged(m, mechanism::parse_task("format: 1\n" + task, "task.yaml", m), {});
  };
  const Verification beyond = verify("circle: {centre: [0.25, -0.75], radius: 0.2}");
  EXPECT_EQ(beyond.verdict, core::Verdict::refuted);
  ASSERT_TRUE(beyond.witness);
  EXPECT_EQ(beyond.witness->limit, "distance A1-P at 0.92 m");
  const Verification within = verify("circle: {centre: [0.25, -0.75], radius: 0.1}");
  EXPECT_TRUE(within.verified());
  EXPECT_NEAR(*within.margin, 0.92 - std::hypot(0.25, 0.75) - 0.1, 1e-4);
  ASSERT_TRUE(within.nearest);
  EXPECT_EQ(within.nearest->limit, "distance A1-P at 0.92 m");
}

TEST(Limits, BoundARangeOfOneCoordinate) {
  // A rod at the end of a crank: |H A|^2 = 1 + 0.25 - cos(t), within its ends where cos(t) is between 0.25 and 0.75.
  const mechanism::Mechanism m = parsed(R"(format: 1
workspace: {t: {angle: [-170 deg, 170 deg]}}
points: {O: [0, 0], H: [1, 0], A: [0.5*cos(t), 0.5*sin(t)]}
links: {crank: {points: [O, A]}}
joints: {O: {revolute: [ground, crank], at: O, actuated: true, clearance: {radial: 1e-5, angular: 1e-3}}}
end_effector: {link: crank, at: A}
loads: [{link: crank, at: A, force: [0, -10]}]
limits: [{distance: [H, A], within: [sqrt(1/2), 1]}]
)");
  const core::LocusMap map = trace_loci(m);
  ASSERT_EQ(map.reachable.size(), 2U);
  EXPECT_NEAR(map.reachable[1].from, std::acos(0.75), 1e-9);
  EXPECT_NEAR(map.reachable[1].to, std::acos(0.25), 1e-9);
}

}  // namespace
}  // namespace clearloci
