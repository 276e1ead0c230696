// Loci of a family of designs: new values of parameters give what the design gives from scratch, special values
// included.
#include <gtest/gtest.h>

#include <random>

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/zones.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

// Every length, the base and the load are parameters; the second leg's lengths are expressions in them.
constexpr const char* design = R"(format: 1
name: family
space: planar
parameters: {a: 1/2, b: 3/5, c: 11/20, d: 1/2, e: 0, fx: 20, fy: -90, w: 0}
workspace: {x: [-3/2, 2], y: [-3/2, 3/2]}
points:
  A1: [0, 0]
  A2: [d, e]
  P: [x, y]
  B1: {dyad: [A1, P], lengths: [a, b], side: left}
  B2: {dyad: [A2, P], lengths: [c, b + (c - a)/2], side: right}
links:
  A1B1: {points: [A1, B1], mass: w}
  B1P:  {points: [B1, P],  mass: w}
  PB2:  {points: [P, B2],  mass: 2*w}
  B2A2: {points: [B2, A2], mass: w}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true}
  B1: {revolute: [A1B1, B1P], at: B1}
  P:  {revolute: [B1P, PB2], at: P}
  B2: {revolute: [B2A2, PB2], at: B2}
  A2: {revolute: [ground, B2A2], at: A2, actuated: true}
end_effector: {link: PB2, at: P}
gravity: [0, -9.81]
loads:
  - {link: PB2, at: P, force: [fx, fy]}
)";

void expect_same(const core::LocusMap& a, const core::LocusMap& b) {
  EXPECT_EQ(a.parameters, b.parameters);
  EXPECT_EQ(a.notes, b.notes);
  ASSERT_EQ(a.curves.size(), b.curves.size());
  for (std::size_t i = 0; i < a.curves.size(); ++i) {
    EXPECT_EQ(a.curves[i].factor, b.curves[i].factor);
    EXPECT_EQ(a.curves[i].cause, b.curves[i].cause);
    EXPECT_EQ(a.curves[i].implicit, b.curves[i].implicit);
    EXPECT_EQ(a.curves[i].vanishing, b.curves[i].vanishing);
    EXPECT_EQ(a.curves[i].mode, b.curves[i].mode);
    ASSERT_EQ(a.curves[i].arcs.size(), b.curves[i].arcs.size());
    for (std::size_t k = 0; k < a.curves[i].arcs.size(); ++k) {
      EXPECT_EQ(a.curves[i].arcs[k].points, b.curves[i].arcs[k].points);
      EXPECT_EQ(a.curves[i].arcs[k].ends, b.curves[i].arcs[k].ends);
    }
  }
  ASSERT_EQ(a.isolated_points.size(), b.isolated_points.size());
  for (std::size_t i = 0; i < a.isolated_points.size(); ++i)
    EXPECT_EQ(a.isolated_points[i].at, b.isolated_points[i].at);
}

void expect_as_from_scratch(const Model& family, const std::vector<Model::Value>& values) {
  std::string trace;
  for (const auto& [name, value] : values) trace += name + " = " + value + " ";
  SCOPED_TRACE(trace);
  const Model member = family.with(values);
  const Model alone = Model::parse(member.text(), member.file(), member.values());
  expect_same(trace_loci(member), trace_loci(alone));
  const Zones zones = find_zones(member), fresh = find_zones(alone);
  expect_same(zones.loci, fresh.loci);
  ASSERT_EQ(zones.zones.size(), fresh.zones.size());
  for (std::size_t i = 0; i < zones.zones.size(); ++i) {
    EXPECT_EQ(zones.zones[i].outer, fresh.zones[i].outer);
    EXPECT_EQ(zones.zones[i].size, fresh.zones[i].size);
    EXPECT_EQ(zones.zones[i].signs, fresh.zones[i].signs);
    EXPECT_EQ(zones.zones[i].certified, fresh.zones[i].certified);
  }
}

TEST(Family, TakesNewValuesAsFromScratch) {
  const Model family = Model::parse(design, "family.yaml");
  constexpr unsigned seed = 4711;
  std::mt19937 random(seed);
  const auto quotient = [&](int low, int high, int denominator) {
    return std::to_string(std::uniform_int_distribution<int>(low, high)(random)) + "/" + std::to_string(denominator);
  };
  for (int i = 0; i < 6; ++i) {
    expect_as_from_scratch(family, {{"a", quotient(8, 14, 20)},
                                    {"b", quotient(12, 16, 20)},
                                    {"c", quotient(8, 14, 20)},
                                    {"d", quotient(8, 14, 20)},
                                    {"e", quotient(-3, 3, 20)},
                                    {"fx", quotient(-90, 90, 1)},
                                    {"fy", quotient(-90, 90, 1)},
                                    {"w", i % 3 == 0 ? "1" : "0"}});
  }
}

// What modes have in common is searched once: each gets what it gets alone, to the last bit.
TEST(Family, TracesEachModeAmongAllAsAlone) {
  const Model family = Model::parse(design, "family.yaml");
  const std::vector<std::vector<Model::Value>> designs = {{}, {{"w", "1"}}, {{"b", "1/2"}, {"c", "1/2"}}};
  for (const std::vector<Model::Value>& values : designs) {
    const Model member = family.with(values);
    const core::LocusMap all = trace_loci(member, {.all_working_modes = true});
    std::size_t curves = 0;
    for (const int first : {-1, 1})
      for (const int second : {-1, 1}) {
        const core::LocusMap alone = trace_loci(member, {.working_modes = {{first, second}}});
        core::LocusMap part = all;
        std::erase_if(part.curves, [&](const core::LocusCurve& curve) {
          return alone.curves.empty() || curve.mode != alone.curves.front().mode;
        });
        std::erase_if(part.isolated_points, [&](const core::IsolatedPoint& point) {
          return alone.curves.empty() || point.mode != alone.curves.front().mode;
        });
        part.notes = alone.notes;
        expect_same(part, alone);
        curves += alone.curves.size();
      }
    EXPECT_EQ(curves, all.curves.size());
    EXPECT_GT(curves, 4U);
  }
}

// Values at which factors split, vanish or coincide.
TEST(Family, SeesWhatSpecialValuesDo) {
  const Model family = Model::parse(design, "family.yaml");
  expect_as_from_scratch(family, {{"a", "1/2"}, {"b", "1/2"}, {"c", "1/2"}});              // both legs equal, stars
  expect_as_from_scratch(family, {{"fx", "0"}});                                           // along an axis
  expect_as_from_scratch(family, {{"fx", "0"}, {"fy", "0"}, {"w", "1"}});                  // weights alone
  expect_as_from_scratch(family, {{"a", "3/5"}, {"b", "3/5"}, {"c", "3/5"}, {"d", "1"}});  // symmetric
  expect_as_from_scratch(family, {{"fx", "-90"}, {"fy", "0"}, {"w", "0"}});
}

// A member may be simpler than the one that the family was derived from, and the other way round.
TEST(Family, DoesNotDependOnTheMemberItWasDerivedFrom) {
  std::string weighted = design;
  weighted.replace(weighted.find("w: 0}"), 5, "w: 1}");
  const Model family = Model::parse(weighted, "family.yaml");
  expect_as_from_scratch(family, {{"w", "0"}});
  expect_as_from_scratch(family, {{"w", "0"}, {"b", "1/2"}});
}

TEST(Family, LeavesIrrationalValuesToTheUsualWay) {
  const Model family = Model::parse(design, "family.yaml");
  expect_as_from_scratch(family, {{"d", "sqrt(2)/3"}});
}

// With symbols for all parameters the equations of these would have millions of terms: they are given up in time.
TEST(Family, LeavesWhatIsTooLongWithSymbolsToTheUsualWay) {
  for (const auto& [name, z] :
       {std::pair{"hexapod", "470"}, {"three_ruu_slice", "-11/20"}, {"gough_stewart_slice", "9/20"}}) {
    SCOPED_TRACE(name);
    const Model family = Model::read(source_dir() + "/examples/" + name + ".yaml");
    const Model member = family.with({{"z", z}});
    expect_same(trace_loci(member), trace_loci(Model::parse(member.text(), member.file(), member.values())));
  }
}

}  // namespace
}  // namespace clearloci
