// Moving, turning by a right angle, mirroring or scaling the whole mechanism moves its loci along; doubling every load
// moves nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/loci.hpp"
#include "analysis/zones.hpp"
#include "tests/laws/design_texts.hpp"
#include "tests/laws/judged.hpp"

namespace clearloci {
namespace {

using core::Point2;

core::LocusMap loci_of(const test::FiveBarDesign& design) {
  return trace_loci(mechanism::parse_mechanism(design.text(), "design.yaml"));
}

test::FiveBarDesign base() {
  test::FiveBarDesign d;
  d.a1 = {"-1/10", "1/20"};
  d.a2 = {"2/5", "-1/10"};
  d.proximal1 = "9/20";
  d.distal1 = "3/5";
  d.proximal2 = "1/2";
  d.distal2 = "11/20";
  d.force = {"30", "-80"};
  d.box = {"-2", "2", "-2", "2"};
  return d;
}

struct Summary {
  core::LocusKind kind;
  std::size_t vanishing;
  std::size_t arcs;
  double length;
  Point2 centroid;  ///< of the curve's length
};

std::vector<Summary> summary(const core::LocusMap& map, const std::function<Point2(const Point2&)>& back) {
  std::vector<Summary> list;
  for (const core::LocusCurve& curve : map.curves) {
    Summary s{curve.kind, curve.vanishing.size(), curve.arcs.size(), 0, {0, 0}};
    for (const core::Arc& arc : curve.arcs) {
      for (std::size_t i = 1; i < arc.points.size(); ++i) {
        const Point2 a = back(arc.points[i - 1]), b = back(arc.points[i]);
        const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
        for (std::size_t k = 0; k < 2; ++k) s.centroid[k] += length * (a[k] + b[k]) / 2;
        s.length += length;
      }
    }
    for (double& c : s.centroid) c /= std::max(s.length, 1e-300);
    list.push_back(s);
  }
  return list;
}

void expect_same(const std::vector<Summary>& a, std::vector<Summary> b) {
  EXPECT_EQ(a.size(), b.size());
  for (const Summary& curve : a) {
    const auto twin = std::find_if(b.begin(), b.end(), [&](const Summary& other) {
      return curve.kind == other.kind && curve.vanishing == other.vanishing && curve.arcs == other.arcs &&
             std::abs(curve.length - other.length) < 1e-3 &&
             std::hypot(curve.centroid[0] - other.centroid[0], curve.centroid[1] - other.centroid[1]) < 1e-3;
    });
    if (twin == b.end()) {
      ADD_FAILURE() << "no twin for a curve of " << curve.arcs << " arcs, " << curve.length << " m";
    } else {
      b.erase(twin);
    }
  }
}

Point2 same(const Point2& p) { return p; }

TEST(Transformations, DoublingTheLoadMovesNothing) {
  test::FiveBarDesign doubled = base();
  doubled.force = {"60", "-160"};
  const core::LocusMap a = loci_of(base()), b = loci_of(doubled);
  ASSERT_EQ(a.curves.size(), b.curves.size());
  for (std::size_t i = 0; i < a.curves.size(); ++i) EXPECT_EQ(a.curves[i].implicit, b.curves[i].implicit);
  expect_same(summary(a, same), summary(b, same));
}

TEST(Transformations, ATranslationMovesTheLociAlong) {
  test::FiveBarDesign moved = base();
  moved.a1 = {"-1/10 + 3/7", "1/20 - 2/9"};
  moved.a2 = {"2/5 + 3/7", "-1/10 - 2/9"};
  moved.box = {"-2 + 3/7", "2 + 3/7", "-2 - 2/9", "2 - 2/9"};
  const auto back = [](const Point2& p) { return Point2{p[0] - 3.0 / 7, p[1] + 2.0 / 9}; };
  expect_same(summary(loci_of(base()), same), summary(loci_of(moved), back));
}

TEST(Transformations, ARightAngleTurnsTheLociAlong) {
  // (x, y) -> (-y, x)
  test::FiveBarDesign turned = base();
  turned.a1 = {"-1/20", "-1/10"};
  turned.a2 = {"1/10", "2/5"};
  turned.force = {"80", "30"};
  const auto back = [](const Point2& p) { return Point2{p[1], -p[0]}; };
  expect_same(summary(loci_of(base()), same), summary(loci_of(turned), back));
}

TEST(Transformations, AMirrorSwapsTheSides) {
  test::FiveBarDesign mirrored = base();
  mirrored.a1 = {"1/10", "1/20"};
  mirrored.a2 = {"-2/5", "-1/10"};
  mirrored.force = {"-30", "-80"};
  mirrored.side1 = "left";
  mirrored.side2 = "right";
  const auto back = [](const Point2& p) { return Point2{-p[0], p[1]}; };
  expect_same(summary(loci_of(base()), same), summary(loci_of(mirrored), back));
}

TEST(Transformations, AScaleScalesTheLoci) {
  test::FiveBarDesign scaled = base();
  scaled.a1 = {"-1/5", "1/10"};
  scaled.a2 = {"4/5", "-1/5"};
  scaled.proximal1 = "9/10";
  scaled.distal1 = "6/5";
  scaled.proximal2 = "1";
  scaled.distal2 = "11/10";
  scaled.box = {"-4", "4", "-4", "4"};
  const auto back = [](const Point2& p) { return Point2{p[0] / 2, p[1] / 2}; };
  expect_same(summary(loci_of(base()), same), summary(loci_of(scaled), back));
}

/// x -> scale R x + (dx, dy), R the turn with cos = 3/5, sin = 4/5 or none; lengths of text are rationals.
struct Change {
  std::string name;
  core::Rational scale = 1;
  std::array<core::Rational, 2> by{};
  bool turned = false, mirrored = false;

  std::array<core::Rational, 2> vector(std::array<core::Rational, 2> v) const {
    if (mirrored) v[0] = -v[0];
    if (!turned) return v;
    const core::Rational c(3, 5), s(4, 5);
    return {c * v[0] - s * v[1], s * v[0] + c * v[1]};
  }
  std::array<core::Rational, 2> place(const std::array<core::Rational, 2>& p) const {
    const auto v = vector(p);
    return {scale * v[0] + by[0], scale * v[1] + by[1]};
  }
  Point2 back(const Point2& p) const {
    const double k = core::to_double(scale), x = (p[0] - core::to_double(by[0])) / k,
                 y = (p[1] - core::to_double(by[1])) / k;
    const Point2 v = turned ? Point2{0.6 * x + 0.8 * y, -0.8 * x + 0.6 * y} : Point2{x, y};
    return {mirrored ? -v[0] : v[0], v[1]};
  }
};

core::Rational rational(const std::string& text) {
  core::Rational value(text);
  value.canonicalize();
  return value;
}

using Place = std::array<core::Rational, 2>;

Place place_of(const std::array<std::string, 2>& text) { return {rational(text[0]), rational(text[1])}; }
std::array<std::string, 2> text_of(const Place& p) { return {core::to_string(p[0]), core::to_string(p[1])}; }

test::FiveBarDesign changed(const test::FiveBarDesign& design, const Change& change) {
  test::FiveBarDesign d = design;
  d.a1 = text_of(change.place(place_of(design.a1)));
  d.a2 = text_of(change.place(place_of(design.a2)));
  for (std::string* length : {&d.proximal1, &d.distal1, &d.proximal2, &d.distal2})
    *length = core::to_string(core::Rational(rational(*length) * change.scale));
  d.force = text_of(change.vector(place_of(design.force)));
  // A square box about the origin holds all of the workspace, turned or not.
  d.box = {core::to_string(core::Rational(change.by[0] - 2 * change.scale)),
           core::to_string(core::Rational(change.by[0] + 2 * change.scale)),
           core::to_string(core::Rational(change.by[1] - 2 * change.scale)),
           core::to_string(core::Rational(change.by[1] + 2 * change.scale))};
  if (change.mirrored)
    for (std::string* side : {&d.side1, &d.side2}) *side = *side == "left" ? "right" : "left";
  return d;
}

class Changes : public testing::TestWithParam<Change> {
 protected:
  static mechanism::Mechanism parsed(const test::FiveBarDesign& design) {
    return mechanism::parse_mechanism(design.text(), "design.yaml");
  }
  LociRequest request(bool moved) const {
    LociRequest result;
    result.tolerance = 1e-5 * (moved ? core::to_double(GetParam().scale) : 1);
    return result;
  }
};

TEST_P(Changes, MoveTheLociAlong) {
  const Change& change = GetParam();
  const core::LocusMap a = trace_loci(parsed(base()), request(false)),
                       b = trace_loci(parsed(changed(base(), change)), request(true));
  expect_same(summary(a, same), summary(b, [&](const Point2& p) { return change.back(p); }));
  EXPECT_TRUE(std::all_of(b.curves.begin(), b.curves.end(), [](const auto& curve) { return curve.certified; }));
  // On the curve to the spacing of doubles at the coordinates: the implicit polynomials are those of the user's own.
  for (const core::LocusCurve& curve : b.curves) {
    const double size = core::to_double(change.scale);
    const core::Polynomial dx = core::derivative(curve.implicit, 0), dy = core::derivative(curve.implicit, 1);
    for (const core::Arc& arc : curve.arcs)
      for (std::size_t i = 0; i < arc.points.size(); i += 16) {
        const std::vector<core::Rational> at = {arc.points[i][0], arc.points[i][1]};
        const double slope =
            std::hypot(core::to_double(core::evaluate(dx, at)), core::to_double(core::evaluate(dy, at)));
        if (slope == 0) continue;  // the vertex is a double point
        const double farthest = std::max(std::abs(arc.points[i][0]), std::abs(arc.points[i][1]));
        const double spacing = std::nextafter(farthest, INFINITY) - farthest;
        const double off = std::abs(core::to_double(core::evaluate(curve.implicit, at))) / slope;
        EXPECT_LE(off, std::max(1e-10 * size, 4 * spacing)) << curve.id << " at vertex " << i;
      }
  }
}

TEST_P(Changes, MoveTheZonesAlong) {
  const Change& change = GetParam();
  const core::Zones a = find_zones(parsed(base()), {request(false)}),
                    b = find_zones(parsed(changed(base(), change)), {request(true)});
  ASSERT_EQ(a.zones.size(), b.zones.size());
  const double k = core::to_double(change.scale);
  for (std::size_t i = 0; i < a.zones.size(); ++i) {
    EXPECT_NEAR(a.zones[i].size, b.zones[i].size / (k * k), 2e-5) << i;
    EXPECT_EQ(a.zones[i].certified, b.zones[i].certified);
    // Either search for the largest circle ends within 1e-3 of its radius (loci/zones/largest_circle.cpp).
    EXPECT_NEAR(a.zones[i].ball.radius, b.zones[i].ball.radius / k, 2e-3 * a.zones[i].ball.radius);
  }
}

TEST_P(Changes, MoveTheVerdictsAlong) {
  const Change& change = GetParam();
  const core::Zones zones = find_zones(parsed(base()), {request(false)});
  const core::Zone& zone = zones.zones.front();
  const Place centre = {core::Rational(zone.sample[0]), core::Rational(zone.sample[1])};
  for (const double part : {0.8, 1.2}) {
    const core::Rational radius(part * zone.ball.radius);
    core::Task task, moved;
    const Place moved_centre = change.place(centre);
    task.shape = core::TaskBall{{centre[0], centre[1]}, radius};
    moved.shape = core::TaskBall{{moved_centre[0], moved_centre[1]}, radius * change.scale};
    const Verification a = test::judged(parsed(base()), task, request(false)),
                       b = test::judged(parsed(changed(base(), change)), moved, request(true));
    EXPECT_EQ(a.verified(), part < 1);
    EXPECT_EQ(b.verdict, a.verdict);
    EXPECT_NEAR(a.margin.value_or(0), b.margin.value_or(0) / core::to_double(change.scale), 1e-3 * zone.ball.radius);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Transformations, Changes,
    testing::Values(
        Change{.name = "Far", .by = {1000000, -1000000}}, Change{.name = "Large", .scale = 1000000},
        Change{.name = "Small", .scale = core::Rational(1, 1000000)}, Change{.name = "Turned", .turned = true},
        Change{.name = "Mirrored", .mirrored = true},
        Change{.name = "All", .scale = core::Rational(1, 1000), .by = {1000, 500}, .turned = true, .mirrored = true}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace clearloci
