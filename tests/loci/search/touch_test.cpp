// Curves that touch, or nearly do: double zeros that ZeroSearch settles by their tangency (touch_search.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "loci/curves/trace_sheet.hpp"
#include "loci/search/zero_search.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Polynomial;
using core::Rational;
using testing::Ring;

constexpr double size = 4, smallest = 1e-12 * size;

FoundZeros search(const core::RootTower& tower, const core::WorkingMode& mode, const Polynomial& f, const Polynomial& g,
                  double one_point = 1e-6) {
  const std::vector<SheetFunction> two = {{f}, {g}};
  const SheetProgram program(tower, two);
  TouchSearch touches(tower, two, mode, size, one_point);
  // Off the places that the tests ask about, so that none lies on an edge of a cell.
  const PlaneCell all = {{-2.0371, 2.0113}, {-2.0239, 2.0457}};
  return ZeroSearch(program, mode, {}).run({all}, {smallest, 8192, 1e-13 * size, {}, &touches});
}

// y = c + a x^2 - b x^3 over y = 0: apart, touching, crossing twice in what counts as one point, and crossing.
TEST(Touch, IsToldFromPassingAndFromCrossing) {
  const Ring r{2};
  const auto x = r.x(), y = r.y();
  for (const int bend : {1, -1, 3}) {
    const auto parabola = [&](const Rational& height) {
      return y - r(height) - r(Rational(bend)) * x * x + r(Rational(1, 7)) * x * x * x;
    };
    const Rational tiny("1/1000000000000000000000");
    for (const Rational& height : {Rational(0), Rational(-bend * tiny)}) {
      const FoundZeros found = search(testing::plane(), {}, parabola(height), y);
      EXPECT_TRUE(found.undecided.empty()) << bend;
      ASSERT_EQ(found.touches.size(), 1u) << bend;
      EXPECT_NEAR(found.touches[0].enclosure[0].middle(), 0, 1e-9);
      EXPECT_NEAR(found.touches[0].enclosure[1].middle(), 0, 1e-12);
    }
    const Rational some("1/1000000000");
    const FoundZeros passing = search(testing::plane(), {}, parabola(bend * some), y);
    EXPECT_TRUE(passing.undecided.empty() && passing.touches.empty()) << bend;
    const FoundZeros crossing = search(testing::plane(), {}, parabola(-bend * some), y);
    EXPECT_TRUE(crossing.undecided.empty() && crossing.touches.empty()) << bend;
    // The cubic has a third zero at 7 bend, which lies outside.
    EXPECT_EQ(passing.enclosures.size() + 2, crossing.enclosures.size()) << bend;
  }
}

// A strand that crosses beside the touch is not swallowed by its box.
TEST(Touch, LeavesOtherZerosToTheSearch) {
  const Ring r{2};
  const auto x = r.x(), y = r.y();
  for (const char* beside : {"1/4", "1/10", "1/30"}) {
    const FoundZeros found = search(testing::plane(), {}, (y - x * x) * (y + r(2) * (x - r(Rational(beside)))), y);
    EXPECT_TRUE(found.undecided.empty()) << beside;
    EXPECT_EQ(found.touches.size(), 1u) << beside;
    ASSERT_EQ(found.enclosures.size(), 1u) << beside;
    EXPECT_NEAR(found.enclosures[0][0].middle(), core::to_double(Rational(beside)), 1e-12);
  }
}

// s^2 = 1 - x^2 - y^2. s = y - 1/2 + 2 x^2 touches the line y = h where its lowest point is on the sheet; on the other
// sheet there is nothing.
TEST(Touch, OnASheetOfEitherSign) {
  const Ring r{3};
  const auto x = r.x(), y = r.y(), s = r.s(1);
  const core::RootTower tower = testing::one_root(r(1) - x * x - y * y);
  // At x = 0: s = 3/5, y = 4/5.
  const auto curve = s - r(Rational(3, 5)) - (y - r(Rational(4, 5))) - r(2) * x * x;
  for (const int sign : {1, -1}) {
    const FoundZeros found = search(tower, {sign}, curve, y - r(Rational(4, 5)));
    EXPECT_TRUE(found.undecided.empty());
    EXPECT_EQ(found.touches.size(), sign > 0 ? 1u : 0u);
  }
}

// The circle about (0, 1/2) of radius 1/2 is s = 0 at (0, 1) only, where it goes over to the other sheet: there it
// touches y = 1 and the boundary. A line that reaches the boundary at its top touches y = 1 on the sheet too.
TEST(Touch, AtTheBoundary) {
  const Ring r{3};
  const auto x = r.x(), y = r.y(), s = r.s(1);
  // s^2 = 4 D - D^2 with D = x^2 + y^2 and dyad lengths 1: boundary of radius 2.
  const auto d = x * x + y * y;
  const core::RootTower tower = testing::one_root(r(4) * d - d * d);
  for (const int sign : {1, -1}) {
    // x D = y s: the crank end is above the base, B = (0, 1); P on the circle about it of radius 1.
    const FoundZeros circle = search(tower, {sign}, x * d - y * s, y - r(2));
    EXPECT_TRUE(circle.undecided.empty()) << sign;
    ASSERT_EQ(circle.touches.size(), 1u) << sign;
    EXPECT_NEAR(circle.touches[0].enclosure[0].middle(), 0, 1e-12);
    EXPECT_TRUE(circle.touches[0].enclosure[2].contains_zero());
    // Told to rounding, for the slopes of the bond are taken away from that of y.
    const FoundZeros near = search(tower, {sign}, x * d - y * s, y - r(2), 1e-10);
    EXPECT_EQ(near.touches.size(), 1u) << sign;
    const FoundZeros line = search(tower, {sign}, r(3) * x + (y - r(2)) * s, y - r(2));
    EXPECT_TRUE(line.undecided.empty()) << sign;
    EXPECT_EQ(line.touches.size() + line.enclosures.size(), 1u) << sign;
  }
}

// Curves of several degrees that touch sides of the box from inside and outside, traced without a second engine.
TEST(Touch, SidesOfTheBoxAreSettledOnTheSheet) {
  const Ring r{2};
  const auto x = r.x(), y = r.y();
  const auto power = [](const Polynomial& p, int n) {
    Polynomial result = p;
    for (int i = 1; i < n; ++i) result = result * p;
    return result;
  };
  const auto circle = [&](const Rational& a, const Rational& b, const Rational& radius) {
    return (x - r(a)) * (x - r(a)) + (y - r(b)) * (y - r(b)) - r(radius * radius);
  };
  struct Case {
    Polynomial curve;
    std::size_t arcs;
    double length;
  };
  const double pi = std::acos(-1.0);
  for (const Case& entry : {
           Case{circle(0, 0, 1), 1, 2 * pi},                                     // touches all four from inside
           Case{circle(Rational(3, 2), 0, Rational(1, 2)), 0, 0},                // one from outside
           Case{circle(Rational(1, 2), Rational(1, 2), Rational(1, 2)), 1, pi},  // two from inside
           Case{circle(1, 0, 1), 1, pi},                                         // two, and crosses at ends
           Case{y - r(1) + power(x, 2) * (x - r(2)) * (x - r(2)) * r(Rational(1, 2)), 1, 0},  // a quartic
       }) {
    SheetTraceOptions options;
    options.tolerance = 1e-6;
    const SheetTrace trace = trace_sheet(testing::plane(), {}, {-1, -1}, {1, 1}, {entry.curve}, {}, options);
    EXPECT_TRUE(trace.certified);
    ASSERT_EQ(trace.arcs.size(), entry.arcs);
    double length = 0;
    for (const TracedArc& arc : trace.arcs) length += arc.arc.length;
    if (entry.length > 0) {
      EXPECT_NEAR(length, entry.length, 1e-5);
    }
  }
}

// With s^2 = 1 - D the curve s = 2 (x^2 - 1/2)^2 touches the rim s = 0 at four irrational points: it passes there on
// one sheet, and on the other one it has these points alone. Another curve may cut it in them.
TEST(Touch, TheRimOfItsOwnSheet) {
  const Ring r{3};
  const auto x = r.x(), y = r.y(), s = r.s(1);
  const core::RootTower tower = testing::one_root(r(1) - x * x - y * y);
  const auto off = x * x - r(Rational(1, 2));
  const auto curve = s - r(2) * off * off;
  const Cutter cutter = {{off + r(Rational(1, 3)) * s}, core::ArcEnd::direct_singularity, false};
  for (const bool is_cut : {false, true})
    for (const int sign : {1, -1}) {
      SheetTraceOptions options;
      options.tolerance = 1e-6;
      std::vector<Cutter> cutters;
      if (is_cut) cutters.push_back(cutter);
      const SheetTrace trace = trace_sheet(tower, {sign}, {Rational(-7, 6), Rational(-8, 7)},
                                           {Rational(9, 8), Rational(10, 9)}, {curve}, cutters, options);
      EXPECT_TRUE(trace.certified) << sign << is_cut;
      double length = 0;
      for (const TracedArc& arc : trace.arcs) length += arc.arc.length;
      if (sign > 0) {
        EXPECT_GT(length, 5);
        EXPECT_TRUE(std::all_of(trace.arcs.begin(), trace.arcs.end(),
                                [&](const TracedArc& arc) { return arc.arc.closed != is_cut; }));
        EXPECT_TRUE(trace.isolated_points.empty());
      } else {
        EXPECT_TRUE(trace.arcs.empty());
        EXPECT_EQ(trace.isolated_points.size(), is_cut ? 0u : 4u);
      }
      for (const TracedArc& arc : trace.arcs)
        for (std::size_t end = 0; is_cut && end < 2; ++end)
          EXPECT_EQ(arc.arc.ends[end], core::ArcEnd::direct_singularity);
    }
}

// Where two functions vanish whatever an angle is they are known to.
TEST(Touch, IsExactWhereAnAngleDoesNotCount) {
  const Ring r{3};
  const auto x = r.x(), y = r.y(), phi = r.s(1);
  core::Root angle;
  angle.name = angle.point = "phi";
  angle.square = x * x + r(1);
  angle.cosine_and_sine = {r(1), x};
  core::RootTower tower = testing::plane();
  tower.roots.push_back(angle);
  const auto off = x - r(Rational(1, 2));
  const PlaneCell place = {{0.5 - 1e-14, 0.5 + 1e-14}, {-1e-14, 1e-14}};
  EXPECT_TRUE(vanish_exactly(tower, {1}, {phi * off + y, phi * y + r(2) * off}, place));
  EXPECT_FALSE(vanish_exactly(tower, {1}, {phi * off + y, phi - r(4)}, place));
  EXPECT_FALSE(vanish_exactly(tower, {1}, {phi * off + y, phi * x}, place));
  // At x = y = 0 it would be undefined.
  tower.roots[0].square = off * off + y * y;
  tower.roots[0].cosine_and_sine = {off, y};
  EXPECT_FALSE(vanish_exactly(tower, {1}, {phi * off, y}, place));
}

/// s1 s2 = 2 at the origin for s1^2 = x + 2 and s2^2 = y + 2: each is irrational there.
TEST(Touch, VanishesExactlyWhereRootsAreIrrational) {
  const testing::Ring r{4};
  core::RootTower tower = testing::one_root(r.x() + r(2));
  tower.roots.push_back({"s2", "B2", core::RootRole::working_mode, r.y() + r(2)});
  const PlaneCell place = {{-1e-12, 1e-12}, {-1e-12, 1e-12}};
  EXPECT_TRUE(vanish_exactly(tower, {1, 1}, {r.s(1) * r.s(2) - r(2)}, place));
  EXPECT_TRUE(vanish_exactly(tower, {1, -1}, {r.s(1) + r.s(2)}, place));
  EXPECT_FALSE(vanish_exactly(tower, {1, -1}, {r.s(1) * r.s(2) - r(2)}, place));
  EXPECT_FALSE(vanish_exactly(tower, {1, 1}, {r.s(1) - r(Rational(1414213562373, 1000000000000))}, place));
}

}  // namespace
}  // namespace clearloci::loci::sheet
