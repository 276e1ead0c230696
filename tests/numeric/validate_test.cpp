// The witness on maps written by hand: a right one holds, and one that is wrong anywhere is disputed there.
#include "numeric/validate.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "numeric/model.hpp"
#include "tests/numeric/designs.hpp"

namespace clearloci::numeric {
namespace {

using core::ArcEnd;
using core::LocusCurve;
using core::LocusKind;
using core::LocusMap;
using core::Point2;
using core::Polyline;
using core::Quantity;
using test::FiveBar;
using test::Side;

/// Poses of a circle that a condition admits, as arcs; ends bisected to rounding.
std::vector<core::Arc> arcs_of_circle(const Point2& centre, double radius, int steps, double turn,
                                      const std::function<bool(const Point2&)>& admitted) {
  const auto at = [&](double t) {
    const double angle = turn + 2 * std::numbers::pi * t;
    return Point2{centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)};
  };
  const auto edge_of = [&](double inside, double outside) {
    while (std::abs(outside - inside) > 1e-14) {
      const double middle = (inside + outside) / 2;
      (admitted(at(middle)) ? inside : outside) = middle;
    }
    return at(inside);
  };
  std::vector<core::Arc> arcs;
  for (int k = 0; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps, before = static_cast<double>(k - 1) / steps;
    const bool here = admitted(at(t)), was = k > 0 && admitted(at(before));
    if (here && !was) arcs.emplace_back().points = k > 0 ? Polyline{edge_of(t, before)} : Polyline{};
    if (here) arcs.back().points.push_back(at(t));
    if (!here && was) arcs.back().points.push_back(edge_of(before, t));
  }
  return arcs;
}

struct Unloading {
  Point2 pivot;  ///< of the leg whose last link is parallel to the force
  double crank = 0, rod = 0;
  int apex = 0;  ///< its dyad point
};

/// tests/reference/reference-cases.md: with massless links leg 1 is unloaded where PB2 is parallel to the force at P,
/// leg 2 where B1P is.
LocusMap unloading_map(const FiveBar& d, int steps = 4000) {
  const auto mechanism = test::five_bar(d);
  const NumericModel model = compile(mechanism);
  const auto mode = mechanism::working_mode(mechanism);
  LocusMap map;
  map.tower.coordinates = {"x", "y"};
  for (const auto& c : mechanism.coordinates) map.lower.push_back(c.lower), map.upper.push_back(c.upper);
  const double size = std::hypot(d.fx, d.fy);
  const Unloading legs[] = {{{d.base_x, d.base_y}, d.a2, d.b2, 4}, {{0, 0}, d.a1, d.b1, 3}};
  map.tolerance = 1e-9;
  for (const auto& leg : legs) {
    LocusCurve curve;
    curve.mode = mode;
    for (const char* joint : {"A1", "B1", "P"}) {
      if (leg.apex == 4) curve.vanishing.push_back({joint, Quantity::f, 1});
    }
    for (const char* joint : {"B2", "A2"}) {
      if (leg.apex == 3) curve.vanishing.push_back({joint, Quantity::f, 1});
    }
    curve.vanishing.push_back({leg.apex == 4 ? "A1" : "A2", Quantity::M, 1});
    for (const double sign : {1.0, -1.0}) {
      const Point2 rod = {sign * leg.rod * d.fx / size, sign * leg.rod * d.fy / size};
      const auto admitted = [&](const Point2& pose) {
        const auto p = posture(model, pose, mode);
        if (!p.reachable()) return false;
        const Vector3d& apex = p.points[static_cast<std::size_t>(leg.apex)];
        // The apex of the other assembly differs by more than rounding unless the leg is stretched.
        return std::hypot(pose[0] - apex[0] - rod[0], pose[1] - apex[1] - rod[1]) < 1e-6;
      };
      const double reach = leg.crank * std::pow(std::numbers::pi / steps, 2) / 2;  // sagitta of a chord
      map.tolerance = std::max(map.tolerance, 1.01 * reach + 1e-9);
      for (auto& arc :
           arcs_of_circle({leg.pivot[0] + rod[0], leg.pivot[1] + rod[1]}, leg.crank, steps, 0.3, admitted)) {
        curve.arcs.push_back(arc);
      }
    }
    map.curves.push_back(curve);
  }
  map.workspace.push_back({mode, {}});
  return map;
}

FiveBar unequal() {
  return {.base_x = 0.6,
          .base_y = 0.1,
          .a1 = 0.55,
          .b1 = 0.7,
          .a2 = 0.6,
          .b2 = 0.5,
          .fx = 40,
          .fy = -60,
          .box = {-0.9, 1.4, -1.3, 1.3}};
}

constexpr GridSpec grid{.nx = 90, .ny = 80};

ValidationReport report_on(const FiveBar& d, const LocusMap& map, const GridSpec& spec = grid,
                           const std::vector<TracedReaction>& traced = {}) {
  return validate(test::five_bar(d), map, spec, traced);
}

TEST(Validate, HoldsARightMap) {
  for (const FiveBar& d : {FiveBar{}, unequal()}) {
    const auto report = report_on(d, unloading_map(d));
    EXPECT_EQ(report.disputed, 0u);
    EXPECT_EQ(report.tallies.size(), 7u);
    EXPECT_GT(report.held, 7u * 4000u);
    EXPECT_LT(report.undecided * 15, report.held);  // the edges that leave the workspace
    EXPECT_TRUE(report.disputed_edges.empty());
    for (const auto& t : report.tallies) {
      EXPECT_EQ(t.held + t.disputed + t.undecided + t.outside, 89u * 80u + 90u * 79u);
      EXPECT_FALSE(t.identically_zero);
    }
  }
}

TEST(Validate, HoldsARightMapOfCoarseChords) {
  const auto map = unloading_map(unequal(), 40);  // chords off their circle by two thousandths
  ASSERT_GT(map.tolerance, 1e-3);
  EXPECT_EQ(report_on(unequal(), map).disputed, 0u);
}

TEST(Validate, IsTheSameWithAnyNumberOfThreads) {
  auto map = unloading_map(unequal());
  map.curves[0].arcs.pop_back();
  GridSpec one = grid, two = grid;
  one.threads = 1, two.threads = 2;
  const auto a = report_on(unequal(), map, one), b = report_on(unequal(), map, two);
  ASSERT_EQ(a.disputed_edges.size(), b.disputed_edges.size());
  for (std::size_t i = 0; i < a.disputed_edges.size(); ++i)
    EXPECT_EQ(a.disputed_edges[i].from, b.disputed_edges[i].from);
  EXPECT_EQ(a.held, b.held);
}

TEST(Validate, DisputesAMissingArc) {
  for (const std::size_t curve : {0u, 1u}) {
    auto map = unloading_map(unequal());
    const auto gone = map.curves[curve].arcs.back();
    map.curves[curve].arcs.pop_back();
    const auto report = report_on(unequal(), map);
    EXPECT_GT(report.disputed, 10u);
    std::set<std::string> joints;
    for (const auto& edge : report.disputed_edges) {
      joints.insert(edge.reaction.joint);
      EXPECT_TRUE(edge.sign_change);
      EXPECT_EQ(edge.crossings % 2, 0);
      double nearest = 1;
      for (const auto& p : gone.points)
        nearest = std::min(nearest, std::hypot(p[0] - edge.from[0], p[1] - edge.from[1]));
      EXPECT_LT(nearest, 0.06);
    }
    EXPECT_EQ(joints, curve == 0 ? (std::set<std::string>{"A1", "B1", "P"}) : (std::set<std::string>{"A2", "B2"}));
  }
}

TEST(Validate, DisputesAShiftedCurveButNotOneWithinTheTolerance) {
  auto map = unloading_map(unequal());
  for (auto& arc : map.curves[0].arcs) {
    for (auto& p : arc.points) p[0] += 0.004;
  }
  EXPECT_GT(report_on(unequal(), map).disputed, 5u);
  map.tolerance = 0.0041;
  EXPECT_EQ(report_on(unequal(), map).disputed, 0u);
}

TEST(Validate, DisputesAnAddedArcInsideAndOutsideTheWorkspace) {
  auto map = unloading_map(unequal());
  core::Arc inside;
  inside.points = {{0.3, -0.75}, {0.45, -0.6}};
  map.curves[0].arcs.push_back(inside);
  const auto report = report_on(unequal(), map);
  EXPECT_GT(report.disputed, 3u);
  for (const auto& edge : report.disputed_edges) EXPECT_FALSE(edge.sign_change);

  map.curves[0].arcs.back().points = {{1.31, -1.25}, {1.36, -1.0}};
  EXPECT_GT(report_on(unequal(), map).disputed, 3u);
}

TEST(Validate, DisputesAWrongMultiplicityModeOrReaction) {
  auto doubled = unloading_map(unequal());
  for (auto& v : doubled.curves[0].vanishing) v.multiplicity = 2;
  EXPECT_GT(report_on(unequal(), doubled).disputed, 10u);

  auto other_mode = unloading_map(unequal());
  other_mode.curves[0].mode = {1, -1};
  EXPECT_GT(report_on(unequal(), other_mode).disputed, 10u);

  auto swapped = unloading_map(unequal());
  std::swap(swapped.curves[0].vanishing, swapped.curves[1].vanishing);
  EXPECT_GT(report_on(unequal(), swapped).disputed, 10u);
}

TEST(Validate, TwoPassesOfOneArcAreEven) {
  auto map = unloading_map(unequal());
  core::Arc there_and_back;
  there_and_back.points = {{0.3, -0.75}, {0.45, -0.6}, {0.3, -0.75}};
  map.curves[0].arcs.push_back(there_and_back);
  EXPECT_EQ(report_on(unequal(), map).disputed, 0u);
}

TEST(Validate, AnEmptyMapIsDisputedOnceReactionsAreNamed) {
  auto map = unloading_map(unequal());
  for (auto& curve : map.curves) curve.arcs.clear();
  const auto report = report_on(unequal(), map, grid, {{"A1", Quantity::M}, {"B2", Quantity::f}});
  ASSERT_EQ(report.tallies.size(), 2u);
  EXPECT_GT(report.tallies[0].disputed, 10u);
  EXPECT_GT(report.tallies[1].disputed, 10u);
}

TEST(Validate, ReportsAReactionThatIsZeroEverywhere) {
  // No load at all on leg 2's crank and none elsewhere: every reaction is zero.
  FiveBar d = unequal();
  auto map = unloading_map(d);
  d.fx = d.fy = 0;
  for (const auto& t : report_on(d, map).tallies) {
    EXPECT_TRUE(t.identically_zero);
    EXPECT_EQ(t.held + t.disputed + t.undecided, 0u);
  }
}

TEST(Validate, NodesOnALocusAreRefined) {
  // A vertical force makes f_A2x and f_B1x... vanish with B1P's direction; here nodes are put on the circle itself: the
  // grid's first column passes through its leftmost point and a node through another of its points.
  FiveBar d;
  auto map = unloading_map(d);
  const double phi = std::numbers::phi - 1, root = std::numbers::sqrt2 - 1;
  // Node (0, 0) at lower + (root, phi) cells; choose the box so that it is (1/2 - 1/2 cos, -1/2 - 1/2 sin) of 1 rad.
  const int n = 40;
  const double step_x = 1.0 / n, step_y = 1.0 / n;
  const double x = 0.5 - 0.5 * std::cos(1.0), y = -0.5 - 0.5 * std::sin(1.0);
  map.lower = {core::Rational(x - root * step_x), core::Rational(y - phi * step_y)};
  map.upper = {map.lower[0] + 1, map.lower[1] + 1};
  const auto report = report_on(d, map, {.nx = n, .ny = n});
  EXPECT_EQ(report.disputed, 0u);
  EXPECT_GT(report.held, 100u);
}

TEST(Validate, AForceThatOnlyTurnsAroundIsolatedPointsHasThemAndNoCurve) {
  // With weights no curve of f is left, though directions turn fast round the points at which contact is lost.
  const FiveBar d{.fx = 60, .fy = -30, .weighs = true};
  LocusMap map;
  map.lower = {core::Rational(-1, 2), -1}, map.upper = {1, 1};
  map.workspace.push_back({{-1, 1}, {}});
  std::vector<TracedReaction> forces;
  for (const char* joint : {"A1", "B1", "P", "B2", "A2"}) forces.push_back({joint, Quantity::f});
  const auto without = report_on(d, map, grid, forces);
  EXPECT_GT(without.disputed, 0u);
  EXPECT_EQ(without.disputed, without.disputed_edges.size());
  for (const DisputedEdge& face : without.disputed_edges)  // where the map lacks a point, and nowhere else
    map.isolated_points.push_back({.kind = LocusKind::contact_loss,
                                   .vanishing = {{face.reaction.joint, Quantity::f, 1}},
                                   .at = {(face.from[0] + face.to[0]) / 2, (face.from[1] + face.to[1]) / 2},
                                   .mode = face.mode});
  const auto report = report_on(d, map, grid, forces);
  EXPECT_EQ(report.disputed, 0u);
  EXPECT_GT(report.held, 5u * 3000u);
  // The components do change sign along curves, and this map has none.
  EXPECT_GT(report_on(d, map, grid, {{"A1", Quantity::fx}}).disputed, 10u);
}

TEST(Validate, RefusesWrongCalls) {
  const auto map = unloading_map(unequal());
  EXPECT_THROW(report_on(unequal(), map, {.nx = 1, .ny = 10}), core::InputError);
  EXPECT_THROW(report_on(unequal(), map, grid, {{"nobody", Quantity::f}}), core::InputError);
  EXPECT_THROW(report_on(unequal(), map, grid, {{"B1", Quantity::M}}), core::InputError);
  auto other = map;
  other.tower.coordinates = {"u", "v"};
  EXPECT_THROW(report_on(unequal(), other), core::InputError);
}

RC_GTEST_PROP(Validate, HoldsTheClosedFormsOfRandomDesigns, ()) {
  const auto between = [](double low, double high) {
    return low + (high - low) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 1000)) / 1000;
  };
  const auto side = [] { return *rc::gen::arbitrary<bool>() ? Side::left : Side::right; };
  FiveBar d;
  d.base_x = between(0.2, 1.0), d.base_y = between(-0.4, 0.4);
  d.a1 = between(0.3, 0.9), d.b1 = between(0.3, 0.9), d.a2 = between(0.3, 0.9), d.b2 = between(0.3, 0.9);
  d.side1 = side(), d.side2 = side();
  d.fx = between(-50, 50), d.fy = between(1, 50);
  d.box = {-1.9, 2.9, -2.3, 2.3};
  const auto report = report_on(d, unloading_map(d, 1500), {.nx = 50, .ny = 50});
  RC_ASSERT(report.disputed == 0u);
}

}  // namespace
}  // namespace clearloci::numeric
