// Cells and poses of a task whose condition is known: the force (x - t, y) under the loads 0 <= t <= 1, which vanishes
// on the segment from (0, 0) to (1, 0), and keeps a size at as great a distance from it; |A| = x + 2.
#include "loci/tasks/task_cell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace clearloci::loci {
namespace {

using core::Interval;
using core::Rational;

core::TaskConditions conditions(const Rational& least) {
  core::TaskConditions result;
  result.tower.coordinates = {"x", "y"};
  result.loads = 2;
  const auto line = [](const auto& make) {
    core::StraightLineBuilder build;
    return build.line(make(build));
  };
  using Builder = core::StraightLineBuilder;
  result.functions = {
      line([](Builder& b) { return b.add(b.variable(0), b.constant(2)); }),
      line([](Builder& b) { return b.variable(0); }),
      line([](Builder& b) { return b.add(b.variable(0), b.constant(-1)); }),
      line([](Builder& b) { return b.variable(1); }),
      line([](Builder& b) { return b.constant(1); }),
  };
  result.determinant = {0};
  core::TaskCondition force;
  force.reactions = {{"B", core::Quantity::f}};
  force.least = least;
  force.parts = {{1, 3}, {2, 3}};
  force.denominator = 4;
  result.conditions = {force};
  return result;
}

/// Of the nearest and the farthest place of a cell from the segment.
struct Reach {
  double least = 0, most = 0;
};

Reach reach_of(double x, double y, double side) {
  const auto gap = [](double low, double high, double from, double to) {
    return std::max({0.0, low - to, from - high});
  };
  const auto far = [](double low, double high, double from, double to) {
    return std::max({0.0, high - to, from - low});
  };
  return {std::hypot(gap(x, x + side, 0, 1), gap(y, y + side, 0, 0)),
          std::hypot(far(x, x + side, 0, 1), far(y, y + side, 0, 0))};
}

TEST(TaskCell, KeepsEveryLoadOfTheRange) {
  for (const double least : {0.0, 0.5}) {
    const core::TaskConditions asked = conditions(Rational(least));
    TaskCell cell(asked, {});
    constexpr int cells = 60;
    constexpr double side = 3.0 / cells;
    int proven = 0;
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < cells; ++k) {
        const double x = -1 + i * side, y = -1.5 + k * side;
        const Reach reach = reach_of(x, y, side);
        const auto [state, unmet] = cell.judge(Interval(x, x + side), Interval(y, y + side));
        if (state == TaskCell::State::proven) {
          ++proven;
          EXPECT_GT(reach.least, least) << x << " " << y;
        } else {
          EXPECT_EQ(state, TaskCell::State::unmet);
          EXPECT_EQ(unmet, 0);
          EXPECT_LT(reach.least, least + 3 * side) << x << " " << y;  // else it can be told
        }
      }
    EXPECT_GT(proven, cells * cells / 4);
  }
}

/// What is told of a cell does not depend on those that are looked at with it.
TEST(TaskCell, JudgesCellsTogetherAsAlone) {
  const core::TaskConditions asked = conditions(Rational(1, 2));
  TaskCell cell(asked, {});
  std::vector<std::array<Interval, 2>> all;
  for (int i = 0; i < 23; ++i)
    for (int k = 0; k < 23; ++k)
      all.push_back({Interval(-2.5 + 0.2 * i, -2.3 + 0.2 * i), Interval(-2 + 0.15 * k, -1.85 + 0.15 * k)});
  const std::vector<TaskCell::Judgement> together = cell.judge(all);
  ASSERT_EQ(together.size(), all.size());
  std::array<int, 5> seen{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const TaskCell::Judgement alone = cell.judge(all[i][0], all[i][1]);
    EXPECT_EQ(together[i].state, alone.state);
    EXPECT_EQ(together[i].unmet, alone.unmet);
    EXPECT_EQ(cell.enter(all[i]), alone.state);  // as a cell of poses and of no designs
    EXPECT_EQ(cell.unmet(), alone.unmet);
    ++seen[static_cast<std::size_t>(alone.state)];
  }
  EXPECT_GT(seen[static_cast<std::size_t>(TaskCell::State::proven)], 50);
  EXPECT_GT(seen[static_cast<std::size_t>(TaskCell::State::unmet)], 50);
  EXPECT_GT(seen[static_cast<std::size_t>(TaskCell::State::singular)], 10);
}

TEST(TaskCell, NamesTheSingularity) {
  const core::TaskConditions asked = conditions(0);
  TaskCell cell(asked, {});
  EXPECT_EQ(cell.judge(Interval(-2.1, -1.9), Interval(1, 1.1)).state, TaskCell::State::singular);
  EXPECT_EQ(cell.judge(Interval(-2.5, -2.4), Interval(1, 1.1)).state, TaskCell::State::proven);
}

TEST(TaskPoint, StepsLeadToAPoseAndALoadThatFail) {
  const core::TaskConditions asked = conditions(0);
  TaskPoint point(asked, {});
  core::Point2 at = {0.4, 0.3};
  double load = 0.9;
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(point.step(0, at, load));
  EXPECT_NEAR(at[1], 0, 1e-12);
  EXPECT_NEAR(at[0], load, 1e-12);
}

TEST(TaskPoint, SignsChangeAcrossWhatIsWatched) {
  const core::TaskConditions asked = conditions(0);
  TaskPoint point(asked, {});
  ASSERT_GE(point.watched(), 1U);
  const auto sign = [&](const core::Point2& at) {
    EXPECT_TRUE(point.enter(at));
    return point.sign(0);  // of |A|
  };
  EXPECT_EQ(sign({-2.5, 1}) * sign({-1.5, 1}), -1);
}

}  // namespace
}  // namespace clearloci::loci
