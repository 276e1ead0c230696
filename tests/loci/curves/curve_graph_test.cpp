// From a subdivision to arcs: crossings and stretches, chains of them, vertices along the chains.
#include "loci/curves/curve_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "loci/curves/chains.hpp"
#include "loci/curves/vertices.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using testing::Ring;

const Ring r{2};

core::Polynomial circle(const core::Rational& x, const core::Rational& radius) {
  const auto dx = r.x() - r(x);
  return dx * dx + r.y() * r.y() - r(radius * radius);
}

CurveGraph graph_of(const core::Polynomial& curve) {
  const core::RootTower tower = testing::plane();
  return curve_graph(tower, {curve, {}}, {}, partition(tower, {-2, 2, -2, 2}), {});
}

std::vector<Chain> strung(const CurveGraph& graph) { return join_at_junctions(graph, chains(graph)); }

/// Every end of a stretch is at its crossing, and every stretch in one chain.
void expect_sound(const CurveGraph& graph, const std::vector<Chain>& strings) {
  std::size_t legs = 0;
  for (const Chain& chain : strings) {
    legs += chain.legs.size();
    for (std::size_t i = 0; i + 1 < chain.legs.size(); ++i) {
      const Leg &now = chain.legs[i], &next = chain.legs[i + 1];
      EXPECT_EQ(now.stretch->ends[now.forward ? 1 : 0].crossing, next.stretch->ends[next.forward ? 0 : 1].crossing);
    }
  }
  EXPECT_EQ(legs, graph.stretches.size());
  for (const Stretch& stretch : graph.stretches)
    for (const StretchEnd& end : stretch.ends) {
      ASSERT_GE(end.crossing, 0);
      const core::Point2& at = graph.crossings[static_cast<std::size_t>(end.crossing)].at;
      EXPECT_NEAR(end.enclosure[0].middle(), at[0], 1e-9);
      EXPECT_NEAR(end.enclosure[1].middle(), at[1], 1e-9);
    }
}

TEST(CurveGraph, ACircleIsOneClosedChain) {
  const CurveGraph graph = graph_of(circle(0, 1));
  EXPECT_TRUE(graph.undecided.empty());
  const std::vector<Chain> strings = strung(graph);
  expect_sound(graph, strings);
  ASSERT_EQ(strings.size(), 1u);
  EXPECT_TRUE(strings[0].closed);
  const PlacedArc arc = place_vertices(graph, {}, strings[0].legs, 1e-5, 4);
  EXPECT_TRUE(arc.open.empty());
  EXPECT_NEAR(arc.length, 2 * std::numbers::pi, 1e-5);
  double farthest = 0;
  for (std::size_t i = 0; i < arc.points.size(); ++i) {
    const core::Point2 &a = arc.points[i], &b = arc.points[(i + 1) % arc.points.size()];
    EXPECT_NEAR(std::hypot(a[0], a[1]), 1, 1e-12);
    farthest = std::max(farthest, 1 - std::hypot((a[0] + b[0]) / 2, (a[1] + b[1]) / 2));
  }
  EXPECT_LE(farthest, 1e-5);
  // Steps are as long as that allows: a chord of length h deviates h^2 / 8.
  EXPECT_LE(static_cast<double>(arc.points.size()), 1.6 * 2 * std::numbers::pi / std::sqrt(8e-5));
}

TEST(CurveGraph, ALineEndsAtTheBox) {
  const CurveGraph graph = graph_of(r.y() - r(core::Rational(1, 3)) * r.x());
  const std::vector<Chain> strings = strung(graph);
  expect_sound(graph, strings);
  ASSERT_EQ(strings.size(), 1u);
  EXPECT_FALSE(strings[0].closed);
  EXPECT_EQ(strings[0].ends[0], core::ArcEnd::box);
  EXPECT_EQ(strings[0].ends[1], core::ArcEnd::box);
  const PlacedArc arc = place_vertices(graph, {}, strings[0].legs, 1e-5, 4);
  EXPECT_NEAR(arc.length, 4 * std::sqrt(10.0) / 3, 1e-9);
  EXPECT_LE(arc.points.size(), 4 * graph.stretches.size());  // straight: as few vertices as the cells ask for
}

// Two circles 1e-7 apart at their nearest are two chains.
TEST(CurveGraph, NearlyTouchingCirclesStayApart) {
  const CurveGraph graph = graph_of(circle(-1, core::Rational(9, 10)) * circle(1, core::Rational("10999999/10000000")));
  EXPECT_TRUE(graph.undecided.empty());
  const std::vector<Chain> strings = strung(graph);
  expect_sound(graph, strings);
  EXPECT_EQ(strings.size(), 2u);
}

// Where two circles cross, the graph is open in two places of rounding's size, and four branches reach each.
TEST(CurveGraph, CrossingCirclesMeetInTwoNodes) {
  const CurveGraph graph =
      graph_of(circle(core::Rational(-1, 2), 1) * circle(core::Rational(1, 2), core::Rational(11, 10)));
  int nodes = 0;
  for (const Cluster& cluster : graph.clusters) {
    nodes += cluster.node >= 0 ? 1 : 0;
    EXPECT_LE(cluster.cell.x.width(), widest_place * 4);
  }
  EXPECT_EQ(nodes, 2);
}

/// Other cuts do not move a patch's border: where the curve runs along it one attempt says all there is to say.
TEST(CurveGraph, GivesUpOnceWhereTheCurveRunsAlongTheBorder) {
  const core::RootTower tower = testing::plane();
  const Partition parts = partition(tower, {-2, 2, -2, 2});
  const auto asked = [&](const core::Polynomial& curve) {
    int questions = 0;
    TreeOptions options;
    options.stop = [&] { return ++questions, false; };
    const CurveGraph graph = curve_graph(tower, {curve, {}}, {}, parts, options);
    EXPECT_FALSE(graph.undecided.empty());
    return questions;
  };
  const int along = asked(r.x() + r(2));
  EXPECT_GT(along, 10);
  EXPECT_LT(along, 50);  // a search asks some 30 times until it gives up
}

TEST(CurveGraph, CutsTheStretchThatHoldsAPlace) {
  CurveGraph graph = graph_of(circle(0, 1));
  const std::size_t before = graph.stretches.size();
  // A place of which only x is told to rounding, off every cell's side.
  const double x = 0.6123, y = std::sqrt(1 - x * x);
  ASSERT_TRUE(cut_stretch(graph, 0, {Interval(x - 1e-12, x + 1e-12), Interval(y - 1e-11, y + 1e-11)},
                          {.kind = Crossing::Kind::cut, .label = core::ArcEnd::direct_singularity}));
  EXPECT_EQ(graph.stretches.size(), before + 1);
  const core::Point2& at = graph.crossings.back().at;
  EXPECT_NEAR(at[0], x, 1e-11);
  EXPECT_NEAR(at[1], y, 1e-11);
  const std::vector<Chain> strings = chains(graph);
  ASSERT_EQ(strings.size(), 1u);
  EXPECT_EQ(strings[0].ends[0], core::ArcEnd::direct_singularity);
  EXPECT_EQ(strings[0].ends[1], core::ArcEnd::direct_singularity);
}

}  // namespace
}  // namespace clearloci::loci::sheet
