// Points and boxes side by side: each has the very numbers that it has alone.
#include "loci/surfaces/field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "loci/surfaces/measure.hpp"

namespace clearloci::loci::surface {
namespace {

using core::LocusProblem;
using core::Polynomial;
using core::Term;

bool same(double a, double b) { return a == b || (a != a && b != b); }

bool same(const Point& a, const Point& b) { return same(a[0], b[0]) && same(a[1], b[1]) && same(a[2], b[2]); }

bool same(const Proof& a, const Proof& b) {
  return a.outside == b.outside && a.zero_free == b.zero_free && a.one_sheet == b.one_sheet && a.rim == b.rim;
}

/// Over x, y and two half turns of an angle, in the t of each: s1^2 = 3 - x^2 - y^2 - t, s2^2 = 2 + x y + s1 - 2 t^2,
/// and a function of them all.
std::vector<LocusProblem> charts() {
  std::vector<LocusProblem> result;
  for (const int half_turns : {0, 1}) {
    LocusProblem& chart = result.emplace_back();
    chart.tower.coordinates = {"x", "y", "z"};
    chart.lower = {-2, -2, -1};
    chart.upper = {2, 2, 1};
    chart.charts = {std::nullopt, std::nullopt, core::AngleChart{half_turns}};
    core::Root one, two;
    one.square = {5, {{{2, 0, 0, 0, 0}, -1}, {{0, 2, 0, 0, 0}, -1}, {{0, 0, 1, 0, 0}, -1}, {{0, 0, 0, 0, 0}, 3}}};
    two.square = {5, {{{1, 1, 0, 0, 0}, 1}, {{0, 0, 2, 0, 0}, -2}, {{0, 0, 0, 1, 0}, 1}, {{0, 0, 0, 0, 0}, 2}}};
    chart.tower.roots = {one, two};
  }
  return result;
}

Polynomial function() {
  return {5,
          {{{2, 0, 1, 0, 0}, 1},
           {{1, 0, 0, 1, 0}, -2},
           {{0, 1, 0, 0, 1}, 1},
           {{0, 0, 1, 1, 1}, core::Rational(1, 3)},
           {{0, 0, 0, 0, 0}, core::Rational(-2, 7)}}};
}

class SideBySide : public testing::Test {
 protected:
  SideBySide()
      : problems_(charts()), field_({{&problems_[0], {function()}, 1}, {&problems_[1], {function()}, -1}}, {1, -1}) {}

  Point point() { return {unit_(random_), unit_(random_), unit_(random_)}; }

  Box box() {
    Box result;
    const double size = std::pow(0.5, std::uniform_int_distribution<int>(1, 8)(random_));
    const Point corner = point();
    for (std::size_t i = 0; i < 3; ++i) result[i] = {corner[i] * (1 - size), corner[i] * (1 - size) + size};
    return result;
  }

  std::vector<LocusProblem> problems_;
  Field field_;
  std::mt19937 random_{29};
  std::uniform_real_distribution<double> unit_{0, 1};
};

TEST_F(SideBySide, PointsHaveTheirOwnNumbers) {
  std::vector<Point> points;
  for (int k = 0; k < 203; ++k) points.push_back(point());
  const std::vector<double> values = field_.values(points);
  const std::vector<Field::Sight> sights = field_.look_at(points);
  int inside = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    Point slopes{};
    const double value = field_.gradient(points[k], slopes);
    EXPECT_TRUE(same(values[k], field_.value(points[k]))) << k;
    EXPECT_TRUE(same(sights[k].value, value)) << k;
    EXPECT_TRUE(same(sights[k].slopes, slopes)) << k;
    EXPECT_EQ(sights[k].inside, field_.inside(points[k])) << k;
    inside += sights[k].inside ? 1 : 0;
  }
  EXPECT_GT(inside, 40);
  EXPECT_LT(inside, 160);
}

TEST_F(SideBySide, BoxesHaveTheirOwnProofs) {
  std::vector<Box> boxes;
  for (int k = 0; k < 403; ++k) boxes.push_back(box());
  const std::vector<Proof> proofs = field_.examine(boxes);
  int outside = 0, free = 0, open = 0;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    EXPECT_TRUE(same(proofs[k], field_.examine(boxes[k]))) << k;
    (proofs[k].outside ? outside : proofs[k].zero_free ? free : open) += 1;
  }
  for (const int count : {outside, free, open}) EXPECT_GT(count, 25);
}

bool same(const core::Interval& a, const core::Interval& b) {
  return same(a.lower(), b.lower()) && same(a.upper(), b.upper());
}

bool same(const Vector& a, const Vector& b) { return same(a[0], b[0]) && same(a[1], b[1]) && same(a[2], b[2]); }

bool same(const Field::Clip& a, const Field::Clip& b) {
  return a.root == b.root && a.held == b.held && a.times == b.times && same(a.value, b.value) &&
         same(a.gradient, b.gradient);
}

bool same(const Field::Over& a, const Field::Over& b) {
  if (a.known != b.known || !same(a.value, b.value)) return false;
  if (!a.known) return true;
  return same(a.gradient, b.gradient) && a.steep.has_value() == b.steep.has_value() &&
         (!a.steep || same(*a.steep, *b.steep)) && a.reach == b.reach &&
         std::equal(a.clips.begin(), a.clips.end(), b.clips.begin(), b.clips.end(),
                    [](const Field::Clip& one, const Field::Clip& other) { return same(one, other); });
}

TEST_F(SideBySide, BoxesHaveTheirOwnEnclosures) {
  std::vector<Box> boxes;
  for (int k = 0; k < 403; ++k) boxes.push_back(box());
  const auto overs = field_.over(boxes);
  int unknown = 0, steep = 0, plain = 0;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const auto alone = field_.over(boxes[k]);
    EXPECT_TRUE(std::equal(overs[k].begin(), overs[k].end(), alone.begin(), alone.end(),
                           [](const Field::Over& a, const Field::Over& b) { return same(a, b); }))
        << k;
    for (const Field::Over& over : overs[k]) (!over.known ? unknown : over.steep ? steep : plain) += 1;
  }
  for (const int count : {unknown, steep, plain}) EXPECT_GT(count, 25);
}

/// Where a sign is asked for, it is found wherever it is found without, and all that is known is the same elsewhere.
TEST_F(SideBySide, BoxesKeepSigns) {
  std::vector<Box> boxes;
  std::vector<int> signs;
  for (int k = 0; k < 400; ++k) {
    boxes.push_back(box());
    signs.push_back(k % 2 == 0 ? 1 : -1);
  }
  const auto overs = field_.over(boxes), asked = field_.over(boxes, signs);
  const std::vector<bool> kept = field_.keeps_signs(boxes, signs);
  int found = 0, more = 0, open = 0;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    bool all = true;
    for (std::size_t c = 0; c < overs[k].size(); ++c) {
      const bool settled = asked[k][c].value.sign() == signs[k];
      all = all && settled;
      EXPECT_TRUE(same(asked[k][c].value, overs[k][c].value)) << k;
      EXPECT_TRUE(settled || same(asked[k][c], overs[k][c])) << k;
    }
    EXPECT_TRUE(all || !kept[k]) << k;
    (kept[k] ? found : all ? more : open) += 1;
  }
  EXPECT_GT(more, 0);
  for (const int count : {found, open}) EXPECT_GT(count, 10);
}

/// (x - a)^2 + (y - b)^2 + (z - c)^2 + 3e-6 on the unit cube: a cell round (a, b, c) is proven to be free of zeros once
/// it was halved more than five times.
TEST(Unexplained, CellsAreCutFurtherBeforeTheyAreLeft) {
  LocusProblem problem;
  problem.tower.coordinates = {"x", "y", "z"};
  problem.lower = {0, 0, 0};
  problem.upper = {1, 1, 1};
  const core::Rational a(3, 7), b(4, 9), c(5, 11);
  const Polynomial function = {3,
                               {{{2, 0, 0}, 1},
                                {{0, 2, 0}, 1},
                                {{0, 0, 2}, 1},
                                {{1, 0, 0}, -2 * a},
                                {{0, 1, 0}, -2 * b},
                                {{0, 0, 1}, -2 * c},
                                {{0, 0, 0}, a * a + b * b + c * c + core::Rational(3, 1000000)}}};
  Field field({{&problem, {function}, 1}}, {});
  constexpr int level = 4, cuts = 5;
  const Cells cells(field, {.level = level, .finest = level});
  const auto active = [](const OctreeCell& cell) { return cell.active(); };
  EXPECT_GT(std::count_if(cells.cells().begin(), cells.cells().end(), active), 0);
  EXPECT_TRUE(unexplained(field, cells, level, {}, cuts, {}).empty());
}

/// What is proven of a box holds at the points in it.
TEST_F(SideBySide, BoxesHoldTheirPoints) {
  for (int k = 0; k < 400; ++k) {
    const Box whole = box();
    const auto over = field_.over(whole);
    const Proof proof = field_.examine(whole);
    int signs = 0;
    for (int s = 0; s < 20; ++s) {
      const Point share = point();
      Point at{};
      for (std::size_t i = 0; i < 3; ++i) at[i] = whole[i].lower() + share[i] * whole[i].width();
      if (!field_.inside(at)) continue;
      EXPECT_FALSE(proof.outside) << k;
      const double value = field_.value(at);
      const auto holds = [&](const Field::Over& one) { return one.value.contains(value); };
      EXPECT_TRUE(std::any_of(over.begin(), over.end(), holds)) << k;
      signs |= value > 0 ? 1 : 2;
    }
    EXPECT_FALSE(proof.zero_free && signs == 3) << k;
  }
}

}  // namespace
}  // namespace clearloci::loci::surface
