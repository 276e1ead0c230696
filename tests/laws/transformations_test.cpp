// Moving, turning by a right angle, mirroring or scaling the whole mechanism moves its loci along; doubling every load
// moves nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "cli/pipeline.hpp"
#include "tests/laws/design_texts.hpp"

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

}  // namespace
}  // namespace clearloci
