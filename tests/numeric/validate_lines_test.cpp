// The witness along lines over one coordinate and three: it holds maps of the tests' own that are right, and disputes
// wrong ones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "mechanism/read.hpp"
#include "numeric/validate.hpp"

namespace clearloci::numeric {
namespace {

using core::LocusKind;
using core::LocusMap;
using core::Quantity;

/// A slider on the x axis, pressed by (p, 1) N with p = x^2 - 1/4: its motor bears nothing at x = -1/2 and x = 1/2.
mechanism::Mechanism slider() {
  return mechanism::parse_mechanism(R"(
format: 1
name: Slider
space: planar
workspace: {x: [-1, 1]}
points: {P: [x, 0]}
links: {block: {points: [P]}}
joints:
  S: {prismatic: [ground, block], at: P, axis: [1, 0], actuated: true, clearance: {axial: 1e-5}}
end_effector: {link: block, at: P}
loads: [{link: block, at: P, force: [x^2 - 1/4, 1]}]
)",
                                    "test.yaml");
}

LocusMap map_of(const mechanism::Mechanism& mechanism) {
  LocusMap map;
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
    map.tower.coordinates.push_back(coordinate.name);
    map.lower.push_back(coordinate.lower);
    map.upper.push_back(coordinate.upper);
  }
  return map;
}

const std::vector<TracedReaction> drive = {{"S", Quantity::F}};

core::IsolatedPoint zero_at(double x) {
  core::IsolatedPoint point;
  point.kind = LocusKind::backlash;
  point.vanishing = {{"S", Quantity::F, 1}};
  point.at = {x};
  return point;
}

TEST(ValidateLines, HoldsPointsOverOneCoordinate) {
  LocusMap map = map_of(slider());
  map.isolated_points = {zero_at(-0.5), zero_at(0.5)};
  const ValidationReport report = validate(slider(), map, {.nx = 500}, drive);
  EXPECT_EQ(report.disputed, 0U);
  EXPECT_EQ(report.held, 499U);
  EXPECT_EQ(report.arcs_held, 2U);
}

TEST(ValidateLines, TakesNoBoundOfAnEffortForAZero) {
  LocusMap map = map_of(slider());
  map.isolated_points = {zero_at(-0.5), zero_at(0.5), zero_at(0.75), zero_at(0.5)};
  map.isolated_points[2].kind = map.isolated_points[3].kind = LocusKind::preload;
  const ValidationReport report = validate(slider(), map, {.nx = 500}, drive);
  EXPECT_EQ(report.disputed, 0U);
  EXPECT_EQ(report.held, 499U);
  EXPECT_EQ(report.arcs_held, 2U);
}

TEST(ValidateLines, DisputesMissingAddedAndShiftedPoints) {
  LocusMap map = map_of(slider());
  map.isolated_points = {zero_at(-0.5)};
  const ValidationReport missing = validate(slider(), map, {.nx = 500}, drive);
  ASSERT_EQ(missing.disputed_edges.size(), 1U);
  EXPECT_TRUE(missing.disputed_edges.front().sign_change);
  EXPECT_NEAR(missing.disputed_edges.front().from.at(0), 0.5, 0.005);

  map.isolated_points = {zero_at(-0.5), zero_at(0.1), zero_at(0.5)};
  const ValidationReport added = validate(slider(), map, {.nx = 500}, drive);
  EXPECT_EQ(added.disputed_edges.size(), 1U);
  ASSERT_EQ(added.disputed_arcs.size(), 1U) << "its motor bears 0.24 N there";
  EXPECT_TRUE(added.disputed_arcs.front().claimed);
  EXPECT_EQ(added.disputed_arcs.front().at, std::vector{0.1});

  map.isolated_points = {zero_at(-0.5), zero_at(0.5003)};
  EXPECT_EQ(validate(slider(), map, {.nx = 500}, drive).disputed_arcs.size(), 1U) << "within the same edge";

  map.isolated_points = {};
  EXPECT_EQ(validate(slider(), map, {.nx = 500}, drive).disputed, 2U) << "a map without points is a claim";
}

/// A gantry of three sliders; the load on the first is x^2 + y^2 + z^2 - 1/4, which a sphere makes zero.
mechanism::Mechanism gantry() {
  return mechanism::parse_mechanism(R"(
format: 1
name: Gantry
space: spatial
workspace: {x: [-1, 1], y: [-1, 1], z: [-1, 1]}
points: {X: [x, 0, 0], Y: [x, y, 0], P: [x, y, z]}
links: {bridge: {points: [X]}, carriage: {points: [Y]}, quill: {points: [P]}}
joints:
  S: {prismatic: [ground, bridge], at: X, axis: [1, 0, 0], actuated: true, clearance: {axial: 1e-5}}
  T: {prismatic: [bridge, carriage], at: Y, axis: [0, 1, 0], actuated: true}
  U: {prismatic: [carriage, quill], at: P, axis: [0, 0, 1], actuated: true}
end_effector: {link: quill, at: P}
loads: [{link: quill, at: P, force: [x^2 + y^2 + z^2 - 1/4, 3, -5]}]
)",
                                    "test.yaml");
}

/// Triangles of a ball's surface between meridians and circles of latitude.
core::LocusSurface ball(double radius, double shift, int n) {
  core::LocusSurface surface;
  surface.id = "s1";
  surface.kind = LocusKind::backlash;
  surface.vanishing = {{"S", Quantity::F, 1}};
  const auto vertex = [&](int i, int j) {  // latitude, longitude
    return 1 + (i - 1) * 2 * n + (j % (2 * n));
  };
  surface.vertices.push_back({shift, 0, radius});
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double a = std::numbers::pi * i / n, b = std::numbers::pi * j / n;
      surface.vertices.push_back(
          {shift + radius * std::sin(a) * std::cos(b), radius * std::sin(a) * std::sin(b), radius * std::cos(a)});
    }
  const int last = static_cast<int>(surface.vertices.size());
  surface.vertices.push_back({shift, 0, -radius});
  for (int j = 0; j < 2 * n; ++j) {
    surface.triangles.push_back({0, vertex(1, j), vertex(1, j + 1)});
    for (int i = 1; i + 1 < n; ++i) {
      surface.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      surface.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
    surface.triangles.push_back({last, vertex(n - 1, j + 1), vertex(n - 1, j)});
  }
  surface.deviation = radius * (1 - std::cos(std::numbers::pi / n));
  return surface;
}

TEST(ValidateLines, HoldsASurfaceOverThreeCoordinates) {
  LocusMap map = map_of(gantry());
  map.surfaces = {ball(0.5, 0, 24)};
  const ValidationReport report = validate(gantry(), map, {.nx = 21, .ny = 20, .nz = 19}, drive);
  EXPECT_EQ(report.disputed, 0U);
  EXPECT_EQ(report.held + report.undecided, 20U * 20U * 19U + 21U * 19U * 19U + 21U * 20U * 18U);
  EXPECT_LT(report.undecided * 20, report.held);
  EXPECT_EQ(report.arcs_held, 1U);
}

TEST(ValidateLines, DisputesSurfacesThatAreMissingShiftedOrHaveHoles) {
  const GridSpec grid{.nx = 21, .ny = 20, .nz = 19};
  LocusMap map = map_of(gantry());
  // Lines through the ball's shadows, in and out: 3 * 2 * pi r^2 over an edge's square.
  EXPECT_NEAR(static_cast<double>(validate(gantry(), map, grid, drive).disputed), 6 * std::numbers::pi * 0.25 / 0.01,
              25)
      << "nothing is a claim, too";
  map.surfaces = {ball(0.5, 0.1, 24)};
  const ValidationReport shifted = validate(gantry(), map, grid, drive);
  EXPECT_GT(shifted.disputed_edges.size(), 200U);
  EXPECT_EQ(shifted.disputed_arcs.size(), 1U);
  map.surfaces = {ball(0.5, 0.002, 24)};
  EXPECT_EQ(validate(gantry(), map, grid, drive).disputed_arcs.size(), 1U) << "vertices are to lie on it";
  map.surfaces = {ball(0.5, 0, 24)};
  map.surfaces.front().triangles.resize(map.surfaces.front().triangles.size() / 2);
  const ValidationReport open = validate(gantry(), map, grid, drive);
  EXPECT_GT(open.disputed_edges.size(), 200U);
  for (const DisputedEdge& edge : open.disputed_edges) EXPECT_LT(edge.from.at(1), 0.1) << "where triangles are missing";
}

/// With a hook on a pin along z, which bears 7 N along its axis everywhere and nothing across it on a tilted ellipse.
mechanism::Mechanism hook() {
  return mechanism::parse_mechanism(R"(
format: 1
name: Hook
space: spatial
workspace: {x: [-1, 1], y: [-1, 1], z: [-1, 1]}
points: {X: [x, 0, 0], Y: [x, y, 0], P: [x, y, z]}
links: {bridge: {points: [X]}, carriage: {points: [Y]}, quill: {points: [P]}, hook: {points: [P]}}
joints:
  S: {prismatic: [ground, bridge], at: X, axis: [1, 0, 0], actuated: true}
  T: {prismatic: [bridge, carriage], at: Y, axis: [0, 1, 0], actuated: true}
  U: {prismatic: [carriage, quill], at: P, axis: [0, 0, 1], actuated: true}
  R: {revolute: [quill, hook], at: P, axis: [0, 0, 1], actuated: true, clearance: {radial: 1e-5}}
end_effector: {link: hook, at: P}
loads: [{link: hook, at: P, force: [x^2 + y^2 - 1/4, z - x/2, 7]}]
)",
                                    "test.yaml");
}

core::SpaceCurve ellipse(double shift) {
  core::SpaceCurve curve;
  curve.id = "c1";
  curve.kind = LocusKind::contact_loss;
  curve.vanishing = {{"R", Quantity::f, 1}};
  core::SpaceArc arc;
  arc.closed = true;
  constexpr int n = 600;
  for (int i = 0; i <= n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    arc.points.push_back({0.5 * std::cos(a) + shift, 0.5 * std::sin(a), 0.25 * std::cos(a)});
  }
  curve.arcs = {arc};
  return curve;
}

TEST(ValidateLines, HoldsACurveOnWhichAPinIsNotPressed) {
  const GridSpec grid{.nx = 21, .ny = 20, .nz = 19};
  const std::vector<TracedReaction> pin = {{"R", Quantity::f}};
  LocusMap map = map_of(hook());
  map.space_curves = {ellipse(0)};
  const ValidationReport right = validate(hook(), map, grid, pin);
  EXPECT_EQ(right.disputed, 0U);
  EXPECT_EQ(right.held + right.undecided, 21U * 19U * 18U + 20U * 20U * 18U + 19U * 20U * 19U);
  EXPECT_LT(right.undecided, 5U);
  EXPECT_EQ(right.arcs_held, 1U);
  ASSERT_EQ(right.tallies.size(), 1U);

  map.space_curves = {};
  const ValidationReport missing = validate(hook(), map, grid, pin);
  // Planes of nodes across the ellipse, each met twice.
  EXPECT_NEAR(static_cast<double>(missing.disputed), 2 * (10.5 + 10 + 4.75), 6);
  for (const DisputedEdge& face : missing.disputed_edges) {
    EXPECT_TRUE(face.sign_change);
    EXPECT_NEAR(std::hypot(face.from[0], face.from[1]), 0.5, 0.15);
  }

  map.space_curves = {ellipse(0.07)};
  const ValidationReport shifted = validate(hook(), map, grid, pin);
  EXPECT_GT(shifted.disputed_edges.size(), 30U);
  EXPECT_EQ(shifted.disputed_arcs.size(), 1U);
}

TEST(ValidateLines, RefusesAGridWithoutCells) {
  EXPECT_THROW(validate(slider(), map_of(slider()), {.nx = 1}, drive), core::InputError);
  EXPECT_THROW(validate(gantry(), map_of(gantry()), {.nx = 9, .ny = 9, .nz = 1}, drive), core::InputError);
}

}  // namespace
}  // namespace clearloci::numeric
