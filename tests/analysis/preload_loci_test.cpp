// Loci and zones of free efforts without a value (docs/method.md section 15), held against reactions that are solved
// with efforts that are given.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "clearloci/errors.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/validate.hpp"
#include "clearloci/zones.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

std::string example(const std::string& name) {
  std::ifstream file(source_dir() + "/examples/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Model antagonistic() { return Model::parse(example("studies/antagonistic.yaml")); }

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
        std::array<double, 2>& own = lines[to_string(part.quantity) + "_" + joint.joint];
        own[static_cast<std::size_t>(effort)] = part.value;
      }
  for (auto& [name, own] : lines) own[1] -= own[0];
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
  double most = 0;
  for (const auto& r : rows)
    for (const auto& s : rows) {
      const double size = std::hypot(r[0], r[1]) * std::hypot(s[0], s[1]);
      if (size > 0) most = std::max(most, std::abs(r[0] * s[1] - r[1] * s[0]) / size);
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
        for (const Vanishing& own : curve.vanishing)
          for (const auto& row : rows_of(lines, own)) rows.push_back(row);
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
    const Validation own = validate_loci(model, {.nodes = {100, 100}});
    EXPECT_TRUE(own.validated()) << own.report.disputed << " edges disputed";
    EXPECT_GT(own.report.held, 1000U);
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
    const auto& here = zone.preload->efforts.ranges;
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
          for (const Vanishing& own : all) list.insert(to_string(own.quantity) + "_" + own.joint);
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
      Model::parse(with(example("studies/antagonistic.yaml"), "effort: free", "effort: free, within: [-0.5, 0.5]"));
  const Zones zones = find_zones(tight, {.loci = {.min_couple = Rational(40)}});
  EXPECT_TRUE(std::any_of(zones.zones.begin(), zones.zones.end(),
                          [](const Zone& zone) { return zone.preload && zone.preload->efforts.ranges.empty(); }));
}

}  // namespace
}  // namespace clearloci
