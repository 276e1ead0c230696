// The pose beyond the linear step: closed form of the displaced 5R, fixed points, and honest refusals.
#include "numeric/displaced.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/numeric/designs.hpp"

namespace clearloci::numeric {
namespace {

using test::five_bar;
using test::FiveBar;

double between(double low, double high) {
  return low + (high - low) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 100000)) / 100000;
}

Point2 plus(const Point2& a, const Point2& b) { return {a[0] + b[0], a[1] + b[1]}; }
double distance(const Point2& a, const Point2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// P at distance r1 from c1 and r2 from c2, on the side of c1 -> c2 where `near` is.
Point2 circles(const Point2& c1, double r1, const Point2& c2, double r2, const Point2& near) {
  const double dx = c2[0] - c1[0], dy = c2[1] - c1[1], D = dx * dx + dy * dy;
  const double a = (D + r1 * r1 - r2 * r2) / (2 * D), h = std::sqrt(r1 * r1 / D - a * a);
  const double side = dx * (near[1] - c1[1]) - dy * (near[0] - c1[0]) > 0 ? 1 : -1;
  return {c1[0] + a * dx - side * h * dy, c1[1] + a * dy + side * h * dx};
}

/// Where P of link PB2 stands when the cranks are held at their angles, each joint is offset by its take-up and the
/// actuators by theirs: built up from the ground, link by link.
Point2 displaced_five_bar(const FiveBar& d, const Posture& nominal, const std::vector<TakeUp>& t) {
  const auto point = [&](std::size_t i) { return in_plane(nominal.points[i]); };
  const auto moved = [&](std::size_t joint) { return in_plane(t[joint].displacement); };
  const Point2 A1 = point(0), A2 = point(1), P = point(2), B1 = point(3), B2 = point(4);
  const double theta1 = std::atan2(B1[1] - A1[1], B1[0] - A1[0]) + t[0].turn;
  const double theta2 = std::atan2(B2[1] - A2[1], B2[0] - A2[0]) + t[4].turn;
  const Point2 B1_crank = plus(plus(A1, moved(0)), {d.a1 * std::cos(theta1), d.a1 * std::sin(theta1)});
  const Point2 B2_crank = plus(plus(A2, moved(4)), {d.a2 * std::cos(theta2), d.a2 * std::sin(theta2)});
  const Point2 B1_rod = plus(B1_crank, moved(1)), B2_rod = plus(B2_crank, moved(3));
  return circles(plus(B1_rod, moved(2)), d.b1, B2_rod, d.b2, P);
}

RC_GTEST_PROP(ActualPose, IsTheDisplacedFiveBarsOwn, ()) {
  FiveBar d;
  d.base_x = between(0.3, 0.8);
  d.a1 = between(0.4, 0.7), d.b1 = between(0.4, 0.7), d.a2 = between(0.4, 0.7), d.b2 = between(0.4, 0.7);
  d.weighs = *rc::gen::arbitrary<bool>();
  d.fx = between(-50, 50), d.fy = between(-100, 100);
  const double radial = between(0, 1e-2), angular = between(0, 5e-3);
  const NumericModel model = compile(test::with_clearances(five_bar(d), radial, angular));
  const auto mode = mechanism::working_mode(model.mechanism);
  const auto p = posture(model, std::array{between(0, 0.6), between(-0.9, -0.2)}, mode);
  RC_PRE(p.reachable());
  const Accuracy linear = pose_accuracy(model, p);
  const ActualPose actual = actual_pose(model, p, linear);
  RC_PRE(actual.converged);
  RC_ASSERT(actual.residual < 1e-12);
  const Point2 P = displaced_five_bar(d, p, actual.take_up);
  RC_PRE(linear.reactions.condition < 1e3);
  const Point2 by_iteration = {p.points[2][0] + actual.error.dp[0], p.points[2][1] + actual.error.dp[1]};
  RC_ASSERT(distance(P, by_iteration) < 1e-12 * linear.reactions.condition);
  // Links stay rigid.
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& link = model.mechanism.links[i];
    const double length =
        (p.points[static_cast<std::size_t>(link.points[0])] - p.points[static_cast<std::size_t>(link.points[1])])
            .norm();
    RC_ASSERT(std::abs((actual.link_points[i][0] - actual.link_points[i][1]).norm() - length) < 1e-12);
  }
}

/// The take-up is that of the reactions in the displaced geometry: parts touch where the force passes.
TEST(ActualPose, BalancesTheLoadsInTheDisplacedGeometry) {
  const NumericModel model = compile(test::with_clearances(five_bar({.weighs = true}), 5e-3, 5e-3));
  const auto p = posture(model, std::array{0.2, -0.7}, std::array{-1, 1});
  const ActualPose actual = actual_pose(model, p, pose_accuracy(model, p));
  ASSERT_TRUE(actual.converged) << actual.reason;
  const auto& w = actual.reactions;
  const auto at = [&](std::size_t link, std::size_t point) { return in_plane(actual.link_points[link][point]); };
  const auto torque = [](const Point2& about, const Point2& place, double fx, double fy) {
    return (place[0] - about[0]) * fy - (place[1] - about[1]) * fx;
  };
  // B1P: links are {A1B1, B1P, PB2, B2A2}; moments about its B1, with the weight at its middle.
  const Point2 B1 = at(1, 0), P_rod = at(1, 1);
  const Point2 middle = {(B1[0] + P_rod[0]) / 2, (B1[1] + P_rod[1]) / 2};
  EXPECT_NEAR(torque(B1, P_rod, -w(4), -w(5)) + torque(B1, middle, 0, -9.81), 0, 1e-11);
  EXPECT_NEAR(w(2) - w(4), 0, 1e-11);
  EXPECT_NEAR(w(3) - w(5) - 9.81, 0, 1e-11);
  // The pin at B1 has moved against the force upon it.
  const Point2 gap = {B1[0] - at(0, 1)[0], B1[1] - at(0, 1)[1]};
  const double size = std::hypot(w(2), w(3));
  EXPECT_NEAR(gap[0], -5e-3 * w(2) / size, 1e-15);
  EXPECT_NEAR(gap[1], -5e-3 * w(3) / size, 1e-15);
}

/// The linear step is first order: half the clearances leave a quarter of the difference.
RC_GTEST_PROP(ActualPose, DiffersFromTheLinearStepToSecondOrder, ()) {
  const bool platform = *rc::gen::arbitrary<bool>();
  const auto bare = platform ? test::three_rrr(between(-0.5, 0.5), between(2, 9), between(2, 9), 0.5, true)
                             : test::driven_five_bar(between(2, 9), between(-9, -2), true);
  const std::array pose = {platform ? between(-0.2, 0.2) : between(0.2, 0.6),
                           platform ? between(-0.2, 0.2) : between(-1.1, -0.6)};
  std::vector<double> beyond;
  for (const double scale : {1.0, 0.5}) {
    const NumericModel model = compile(test::with_clearances(bare, 2e-5 * scale, 2e-5 * scale));
    const auto p = posture(model, pose, mechanism::working_mode(model.mechanism));
    RC_PRE(p.reachable());
    const Accuracy linear = pose_accuracy(model, p);
    RC_PRE(linear.reactions.condition < 100);
    const ActualPose actual = actual_pose(model, p, linear);
    RC_PRE(actual.converged);
    RC_ASSERT(actual.residual < 1e-12);
    beyond.push_back(actual.beyond_linear.dp.norm() + std::abs(actual.beyond_linear.dalpha[2]));
  }
  RC_PRE(beyond[0] > 1e-11);  // else it is rounding
  RC_ASSERT(beyond[1] > 0.24 * beyond[0] && beyond[1] < 0.26 * beyond[0]);
}

TEST(ActualPose, RefusesWhereTheTakeUpIsUndefined) {
  const NumericModel model = compile(test::with_clearances(five_bar(), 1e-5, 5e-4));
  const std::array mode = {-1, 1};
  const std::array<Bounded, 2> pose = {Bounded{0.8, unit_roundoff}, Bounded{-0.1, unit_roundoff}};
  const auto p = posture(model, std::array{0.8, -0.1}, mode);
  const ActualPose actual = actual_pose(model, p, pose_accuracy(model, p, lost_contacts(model, pose, mode)));
  EXPECT_FALSE(actual.converged);
  EXPECT_NE(actual.reason.find("A1, B1, P"), std::string::npos);
}

TEST(ActualPose, RefusesThroughADirectSingularity) {
  // Along x = 1/4 the determinant of the symmetric 5R changes its sign once between these poses.
  const NumericModel model = compile(test::with_clearances(five_bar(), 1e-3, 1e-2));
  double low = -0.8, high = -0.1;
  const auto determinant = [&](double y) {
    return solve_reactions(model, posture(model, std::array{0.25, y}, std::array{-1, 1})).determinant;
  };
  while (high - low > 1e-5) {
    const double middle = (low + high) / 2;
    (determinant(low) * determinant(middle) <= 0 ? high : low) = middle;
  }
  for (const double y : {low, high}) {
    const auto p = posture(model, std::array{0.2501, y}, std::array{-1, 1});
    const ActualPose actual = actual_pose(model, p, pose_accuracy(model, p));
    EXPECT_FALSE(actual.converged);
    EXPECT_FALSE(actual.reason.empty());
  }
}

}  // namespace
}  // namespace clearloci::numeric
