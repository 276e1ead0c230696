// Slices of spatial mechanisms: their loci hold against reactions solved numerically, their zones and tasks against the
// signs of the reactions. CLEARLOCI_DESIGNS=n in the environment tries n random designs of each family.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "analysis/zones.hpp"
#include "mechanism/read_task.hpp"
#include "tests/laws/distance_to.hpp"
#include "tests/laws/judged.hpp"
#include "tests/numeric/solved.hpp"
#include "tests/numeric/spatial_designs.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using test::distance_to;

constexpr unsigned seed = 20260502;

int designs(int usual) {
  const char* wanted = std::getenv("CLEARLOCI_DESIGNS");
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

/// `undecided`: the largest part of the edges that may be; edges that cross the boundary of the workspace are.
void hold(const std::string& text, int nodes, double undecided = 0.01) {
  SCOPED_TRACE(text);
  const mechanism::Mechanism mechanism = mechanism::parse_mechanism(text, "random.yaml");
  const Validation validation = validate_loci(mechanism, {}, {nodes, nodes});
  EXPECT_TRUE(validation.map.complete);
  EXPECT_FALSE(validation.map.curves.empty());
  EXPECT_EQ(validation.report.disputed, 0u);
  EXPECT_LT(static_cast<double>(validation.report.undecided), undecided * static_cast<double>(validation.report.held));
  for (const core::LocusCurve& curve : validation.map.curves) EXPECT_TRUE(curve.certified) << curve.id;
}

TEST(SpatialSlices, GoughStewartDesignsHoldAgainstTheWitness) {
  std::mt19937 random(seed);
  for (int i = 0; i < designs(12); ++i) hold(test::random_gough_stewart(random, false), 40);
}

TEST(SpatialSlices, GoughStewartDesignsWithWeightsHoldAgainstTheWitness) {
  std::mt19937 random(seed + 1);
  for (int i = 0; i < designs(12) / 6; ++i) hold(test::random_gough_stewart(random, true), 30);
}

TEST(SpatialSlices, ThreeUpuDesignsHoldAgainstTheWitness) {
  std::mt19937 random(seed + 2);
  for (int i = 0; i < designs(12); ++i) hold(test::random_three_upu(random), 40);
}

TEST(SpatialSlices, LegsWithRevoluteAndCylindricalJointsHoldAgainstTheWitness) {
  std::mt19937 random(seed + 3);
  for (int i = 0; i < designs(12); ++i) hold(test::random_three_leg(random), 40);
}

TEST(SpatialSlices, ElbowsAndCarriagesThatAreBuiltHoldAgainstTheWitness) {
  std::mt19937 random(seed + 4);
  for (int i = 0; i < designs(6); ++i) hold(test::random_delta(random, i % 2 == 1, i % 6 >= 4), 40, 0.05);
}

TEST(SpatialSlices, SixElbowsHoldAgainstTheWitness) {
  std::ifstream file(source_dir() + "/examples/six_rus.yaml");
  hold({std::istreambuf_iterator<char>(file), {}}, 40);
}

mechanism::Mechanism slice() { return mechanism::read_mechanism(source_dir() + "/examples/gough_stewart_slice.yaml"); }

std::size_t joint_index(const mechanism::Mechanism& m, const std::string& name) {
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (m.joints[j].name == name) return j;
  return m.joints.size();
}

TEST(SpatialSlices, ALocusThatIsLeftOutOrMovedIsDisputed) {
  const mechanism::Mechanism m = slice();
  const Validation good = validate_loci(m, {}, {60, 60});
  ASSERT_EQ(good.report.disputed, 0u);
  const auto wanted = selected_reactions(m, {});
  for (std::size_t c = 0; c < good.map.curves.size(); ++c) {
    if (good.map.curves[c].vanishing.empty()) continue;
    core::LocusMap without = good.map, moved = good.map;
    without.curves[c].arcs.clear();
    for (core::Arc& arc : moved.curves[c].arcs)
      for (core::Point2& p : arc.points) p[0] += 0.02, p[1] += 0.02;
    EXPECT_GT(numeric::validate(m, without, {60, 60}, wanted).disputed, 0u) << good.map.curves[c].id;
    EXPECT_GT(numeric::validate(m, moved, {60, 60}, wanted).disputed, 0u) << good.map.curves[c].id;
  }
}

bool inside(const core::Polyline& ring, const core::Point2& at) {
  bool result = false;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const core::Point2 &a = ring[i - 1], &b = ring[i];
    if ((a[1] > at[1]) != (b[1] > at[1]) && at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1]))
      result = !result;
  }
  return result;
}

/// At random poses one LU of the orthonormal form finds the signs of the zone that the pose lies in.
void expect_one_sign_a_zone(const mechanism::Mechanism& m, std::mt19937& random) {
  const core::Zones map = find_zones(m);
  ASSERT_FALSE(map.zones.empty());
  double area = 0;
  for (const core::Zone& zone : map.zones) area += zone.size;
  EXPECT_NEAR(area, 0.64, 1e-6);
  int seen = 0;
  for (int i = 0; i < 100; ++i) {
    std::uniform_real_distribution<double> between(-0.4, 0.4);
    const core::Point2 at = {between(random), between(random)};
    for (const core::Zone& zone : map.zones) {
      const auto in = [&](const core::Polyline& ring) { return inside(ring, at); };
      if (!in(zone.outer) || std::any_of(zone.holes.begin(), zone.holes.end(), in)) continue;
      std::vector<core::Polyline> rings = zone.holes;
      rings.push_back(zone.outer);
      if (std::any_of(rings.begin(), rings.end(), [&](const auto& ring) { return distance_to(ring, at) < 1e-4; }))
        continue;
      ++seen;
      const test::Solved posture = test::solved(m, at);
      EXPECT_EQ(posture.determinant > 0 ? 1 : -1, zone.assembly_mode) << zone.id;
      EXPECT_FALSE(zone.signs.empty());
      for (const auto& [reaction, sign] : zone.signs) {
        EXPECT_TRUE(reaction.quantity == core::Quantity::F || reaction.quantity == core::Quantity::M);
        EXPECT_EQ(posture.reactions[joint_index(m, reaction.joint)].actuator > 0 ? 1 : -1, sign)
            << zone.id << " " << reaction.joint;
      }
    }
  }
  EXPECT_GT(seen, 80);
}

TEST(SpatialSlices, ZonesHaveOneSignEach) {
  std::mt19937 random(seed + 4);
  expect_one_sign_a_zone(slice(), random);
  for (int i = 0; i < designs(12) / 4; ++i) {
    for (const std::string& text :
         {test::random_gough_stewart(random, false), test::random_three_upu(random), test::random_three_leg(random)}) {
      SCOPED_TRACE(text);
      expect_one_sign_a_zone(mechanism::parse_mechanism(text, "random.yaml"), random);
    }
  }
}

TEST(SpatialSlices, TheLeastForceIsKeptUpToItsCurve) {
  const mechanism::Mechanism m = slice();
  LociRequest request;
  request.joints = {"B1"};
  request.min_force = 100;
  request.engine = loci::Engine::exact;  // two branches of degree 8 run closely side by side
  const core::LocusMap map = trace_loci(m, request);
  int places = 0;
  for (const core::LocusCurve& curve : map.curves) {
    if (curve.kind != core::LocusKind::margin) continue;
    for (const core::Arc& arc : curve.arcs) {
      const core::Point2& at = arc.points[arc.points.size() / 2];
      EXPECT_NEAR(test::solved(m, at).reactions[joint_index(m, "B1")].force.norm(), 100, 1);
      ++places;
    }
  }
  EXPECT_GT(places, 1);
}

Verification verified(const mechanism::Mechanism& m, const std::string& task, const LociRequest& request = {}) {
  return test::judged(m, mechanism::parse_task("format: 1\n" + task, "task.yaml", m), request);
}

TEST(SpatialSlices, TasksAreVerifiedInsideAZoneAndNotAcrossALocus) {
  const mechanism::Mechanism m = slice();
  const Verification good = verified(m, "box: {x: [0.3, 0.35], y: [0.2, 0.25]}\nmargin: 0.05");
  EXPECT_TRUE(good.verified());
  ASSERT_TRUE(good.nearest);
  EXPECT_GE(*good.margin, 0.05);
  EXPECT_LE(*good.margin, good.nearest->distance);
  // Some leg's force changes its sign between two corners of this one, and |A| between two of the next.
  const Verification across = verified(m, "box: {x: [0, 0.1], y: [0.2, 0.3]}");
  EXPECT_FALSE(across.verified());
  ASSERT_TRUE(across.witness);
  EXPECT_FALSE(across.witness->vanishing.empty());
  EXPECT_FALSE(verified(m, "box: {x: [0.1, 0.25], y: [-0.1, 0]}").verified());
  LociRequest one;
  one.joints = {"B1"};
  one.engine = loci::Engine::exact;
  const std::string box = "box: {x: [0.3, 0.31], y: [0.2, 0.21]}\n";
  EXPECT_TRUE(verified(m, box + "min_force: 10", one).verified());
  EXPECT_FALSE(verified(m, box + "min_force: 100000", one).verified());
}

}  // namespace
}  // namespace clearloci
