// Take-up, pose error and its worst case against the paper's screw equations and against brute force.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "numeric/pose_error.hpp"
#include "tests/numeric/designs.hpp"
#include "tests/numeric/random_five_bar.hpp"

namespace clearloci::numeric {
namespace {

using test::between;
using test::five_bar;
using test::FiveBar;
using test::random_five_bar;
using test::Side;

struct Clearances {
  double A1, B1, P, B2, A2;  // radial
  double angular1, angular2;
};

mechanism::Mechanism with(mechanism::Mechanism m, const Clearances& c) {
  const auto set = [&](std::size_t joint, double radial, double angular) {
    m.joints[joint].clearance = mechanism::Clearance{test::number(radial), test::number(angular)};
  };
  set(0, c.A1, c.angular1), set(1, c.B1, 0), set(2, c.P, 0), set(3, c.B2, 0), set(4, c.A2, c.angular2);
  return m;
}

Clearances random_clearances() {
  const auto radial = [] { return between(0, 1e-3); };
  return {radial(), radial(), radial(), radial(), radial(), between(0, 1e-2), between(0, 1e-2)};
}

/// A screw (ω, v): angular velocity and the velocity of the point at the end effector P.
using Screw = Eigen::Vector3d;

/// Of a revolute pair at r from P: (1, r × ... ) as in (2): k × is applied to the vector from the axis to P.
Screw revolute(const Point2& pair, const Point2& P) {
  const double rx = pair[0] - P[0], ry = pair[1] - P[1];
  return {1, ry, -rx};  // r × k
}

/// Equations (14), (15), (24)-(27) of the paper, written out for the 5R. Joints A1 [ground, A1B1], B1 [A1B1, B1P],
/// P [B1P, PB2], B2 [B2A2, PB2], A2 [ground, B2A2]; the mobile platform is PB2.
PoseError by_screws(const Posture& p, const Eigen::VectorXd& w, const Clearances& c) {
  const Point2 A1 = in_plane(p.points[0]), A2 = in_plane(p.points[1]), P = in_plane(p.points[2]);
  const Point2 B1 = in_plane(p.points[3]), B2 = in_plane(p.points[4]);
  const Screw x(0, 1, 0), y(0, 0, 1);
  const auto take_up = [&](int joint, double radial) {
    const Eigen::Vector2d f = w.segment<2>(2 * joint);
    return Eigen::Vector2d(-radial * f / f.norm());
  };
  const Eigen::Vector2d dA1 = take_up(0, c.A1), dB1 = take_up(1, c.B1), dP = take_up(2, c.P);
  const Eigen::Vector2d dB2 = take_up(3, c.B2), dA2 = take_up(4, c.A2);
  const double dtheta1 = w(10) > 0 ? -c.angular1 : c.angular1, dtheta2 = w(11) > 0 ? -c.angular2 : c.angular2;
  const Screw S_A1 = revolute(A1, P), S_B1 = revolute(B1, P), S_P(1, 0, 0), S_B2 = revolute(B2, P),
              S_A2 = revolute(A2, P);
  const auto shift = [&](const Eigen::Vector2d& d) { return Screw(d(0) * x + d(1) * y); };
  Eigen::Matrix3d passive;  // (26)
  passive << S_B1, S_P, -S_B2;
  const Screw screw =
      -(dtheta1 * S_A1 + shift(dA1) + shift(dB1) + shift(dP) - shift(dB2) - dtheta2 * S_A2 - shift(dA2));
  const Eigen::Vector3d angles = passive.fullPivLu().solve(screw);
  const Screw gamma = dtheta2 * S_A2 + angles(2) * S_B2 + shift(dA2) + shift(dB2);  // (27)
  return {{0, 0, gamma(0)}, {gamma(1), gamma(2), 0}};
}

RC_GTEST_PROP(PoseError, IsThatOfThePapersScrewEquations, ()) {
  const FiveBar d = random_five_bar();
  const Clearances c = random_clearances();
  const NumericModel model = compile(with(five_bar(d), c));
  const auto mode = mechanism::working_mode(model.mechanism);
  const auto p = posture(model, std::array{between(-0.5, 1), between(-1, 1)}, mode);
  RC_PRE(p.reachable());
  const Accuracy accuracy = pose_accuracy(model, p);
  RC_PRE(accuracy.reactions.condition < 1e3 && accuracy.undefined.empty());
  const PoseError screws = by_screws(p, accuracy.reactions.values, c);
  RC_ASSERT(std::abs(accuracy.error.dalpha[2] - screws.dalpha[2]) < 1e-12);
  RC_ASSERT(std::abs(accuracy.error.dp[0] - screws.dp[0]) < 1e-12);
  RC_ASSERT(std::abs(accuracy.error.dp[1] - screws.dp[1]) < 1e-12);
  // The other route of the same linear map.
  const PoseError influence = pose_error(model.mechanism.space, accuracy.influence,
                                         clearance_displacements(accuracy.columns, accuracy.take_up));
  RC_ASSERT(std::abs(influence.dp[0] - screws.dp[0]) < 1e-12 && std::abs(influence.dp[1] - screws.dp[1]) < 1e-12);
  RC_ASSERT(std::abs(influence.dalpha[2] - screws.dalpha[2]) < 1e-12);
}

TEST(TakeUp, OpposesTheReactionsOfTheExample) {
  const NumericModel model = compile(test::with_clearances(five_bar(), 1e-5, 5e-4));
  const auto p = posture(model, std::array{0.25, -0.7}, std::array{-1, 1});
  const Accuracy a = pose_accuracy(model, p);
  for (int j = 0; j < 5; ++j) {
    const auto& t = a.take_up[static_cast<std::size_t>(j)];
    const double fx = a.reactions.values(2 * j), fy = a.reactions.values(2 * j + 1);
    EXPECT_NEAR(std::hypot(t.displacement[0], t.displacement[1]), 1e-5, 1e-20);
    EXPECT_LT(t.displacement[0] * fx + t.displacement[1] * fy, 0);
    EXPECT_NEAR(t.displacement[0] * fy - t.displacement[1] * fx, 0, 1e-18);
    ASSERT_TRUE(t.beta.has_value());
    EXPECT_NEAR(std::tan(*t.beta), fx / fy, 1e-12);  // (16)
    EXPECT_GT(std::cos(*t.beta) * fy + std::sin(*t.beta) * fx, 0);
  }
  EXPECT_EQ(a.take_up[0].turn, 5e-4);  // M_A1 < 0
  EXPECT_EQ(a.take_up[4].turn, -5e-4);
  // The symmetric posture sinks: nothing moves it sideways but the gap at P, half of which each leg's side would take.
  EXPECT_LT(a.error.dp[1], 0);
}

TEST(TakeUp, JointsWithoutClearanceTakeNothing) {
  test::MechanismBuilder b;
  const NumericModel bare = compile(five_bar());
  const auto p = posture(bare, std::array{0.25, -0.7}, std::array{-1, 1});
  const Accuracy a = pose_accuracy(bare, p);
  EXPECT_FALSE(any_clearance(joint_clearances(bare.mechanism)));
  EXPECT_EQ(a.error.dp[0], 0);
  EXPECT_EQ(a.error.dp[1], 0);
  EXPECT_EQ(a.worst.distance, 0);
  EXPECT_TRUE(a.undefined.empty());
}

TEST(TakeUp, IsUndefinedOnALocus) {
  // PB2 is vertical at P = (4/5, -1/10), B2 = (4/5, 2/5): leg 1 is unloaded. -0.1 and 0.8 are no doubles.
  const NumericModel model = compile(test::with_clearances(five_bar(), 1e-5, 5e-4));
  const std::array mode = {-1, 1};
  const std::array<Bounded, 2> pose = {Bounded{0.8, unit_roundoff}, Bounded{-0.1, unit_roundoff}};
  const Accuracy a =
      pose_accuracy(model, posture(model, std::array{0.8, -0.1}, mode), lost_contacts(model, pose, mode));
  EXPECT_EQ(a.undefined, (std::vector<std::string>{"A1", "B1", "P"}));
  EXPECT_TRUE(std::isnan(a.error.dp[0]));
  EXPECT_FALSE(a.take_up[0].beta.has_value());
  EXPECT_TRUE(a.take_up[0].actuator_vanishes);
  EXPECT_TRUE(a.take_up[0].displacement.isZero(0));
  EXPECT_GT(a.worst.distance, 0);
  // A little aside everything is defined.
  const std::array<Bounded, 2> aside = {Bounded{0.8 + 1e-9}, Bounded{-0.1}};
  const auto vanishing = lost_contacts(model, aside, mode);
  EXPECT_TRUE(pose_accuracy(model, posture(model, std::array{0.8 + 1e-9, -0.1}, mode), vanishing).undefined.empty());
}

TEST(TakeUp, IsUndefinedAtADirectSingularity) {
  // P = (1, 0) between A1 = (0, 0) and A2 = (2, 0): with B1 below and B2 above, B1, P and B2 are in line.
  const NumericModel model =
      compile(test::with_clearances(five_bar({.base_x = 2, .a1 = 0.6, .b1 = 0.5, .a2 = 0.6, .b2 = 0.5}), 1e-5, 5e-4));
  const std::array<Bounded, 2> pose = {Bounded{1}, Bounded{0}};
  const auto accuracy = [&](const std::array<int, 2>& mode) {
    const auto p = posture(model, std::array{1.0, 0.0}, mode);
    return pose_accuracy(model, p, lost_contacts(model, pose, mode));
  };
  EXPECT_EQ(accuracy({-1, -1}).undefined.size(), 5);
  EXPECT_TRUE(std::isnan(accuracy({-1, -1}).error.dp[1]));
  EXPECT_TRUE(accuracy({-1, 1}).undefined.empty());  // both below: an ordinary posture
}

/// Every pin in a random direction of its circle, every actuator at a random end.
RC_GTEST_PROP(WorstCase, BoundsEveryTakeUpAndIsReached, ()) {
  const Clearances c = random_clearances();
  const bool platform = *rc::gen::arbitrary<bool>();
  const NumericModel model =
      compile(platform ? test::with_clearances(test::three_rrr(between(-1, 1), 1, 2, 0.3, true), 2e-4, 3e-3)
                       : with(five_bar(random_five_bar()), c));
  const auto mode = mechanism::working_mode(model.mechanism);
  const auto p = posture(model, std::array{between(-0.3, 0.6), between(-0.8, 0.8)}, mode);
  RC_PRE(p.reachable());
  const Accuracy a = pose_accuracy(model, p);
  RC_PRE(a.reactions.condition < 1e4);
  const auto columns = joint_columns(model);
  const auto clearances = joint_clearances(model.mechanism);
  const auto displacement = [&](const auto& direction_of, const auto& sign_of) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.unknowns.size()));
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const Point2 n = direction_of(j);
      d(columns[j].fx) = clearances[j].radial * n[0];
      d(columns[j].fy) = clearances[j].radial * n[1];
      if (columns[j].couple >= 0) d(columns[j].couple) = clearances[j].angular * sign_of(j);
    }
    return pose_error(model.mechanism.space, a.influence, d);
  };
  const double slack = 1;  // bounds are rounded up
  for (int i = 0; i < 20; ++i) {
    const PoseError e = displacement(
        [](std::size_t) {
          const double angle = between(0, 2 * std::numbers::pi);
          return Point2{std::cos(angle), std::sin(angle)};
        },
        [](std::size_t) { return *rc::gen::element(-1.0, 1.0); });
    RC_ASSERT(std::abs(e.dp[0]) <= a.worst.dp[0] * slack && std::abs(e.dp[1]) <= a.worst.dp[1] * slack);
    RC_ASSERT(std::abs(e.dalpha[2]) <= a.worst.dalpha[2] * slack && e.dp.norm() <= a.worst.distance * slack);
  }
  // The take-up that drives the point farthest in a given direction; the best of many directions comes close.
  double best = 0, best_x = 0, best_angle = 0;
  constexpr int directions = 2000;
  const auto farthest = [&](double angle) {
    const Eigen::RowVectorXd pull = std::cos(angle) * a.influence.row(0) + std::sin(angle) * a.influence.row(1);
    return displacement(
        [&](std::size_t j) {
          const double x = pull(columns[j].fx), y = pull(columns[j].fy), size = std::hypot(x, y);
          return size > 0 ? Point2{x / size, y / size} : Point2{1, 0};
        },
        [&](std::size_t j) { return pull(columns[j].couple) < 0 ? -1.0 : 1.0; });
  };
  for (int i = 0; i < directions; ++i) {
    const double angle = std::numbers::pi * i / directions;
    const PoseError e = farthest(angle);
    if (e.dp.norm() > best) best = e.dp.norm(), best_angle = angle;
    if (i == 0) best_x = e.dp[0];
  }
  RC_ASSERT(std::abs(best_x - a.worst.dp[0]) <= 1e-9 * a.worst.dp[0]);
  RC_ASSERT(best <= a.worst.distance * slack);
  RC_ASSERT(best >= a.worst.distance * (1 - 1e-5));
  // From the best of them up to where it leads: no further than the bound, and as far to 1e-8.
  for (int i = 0; i < 200; ++i) {
    const PoseError e = farthest(best_angle);
    best_angle = std::atan2(e.dp[1], e.dp[0]);
    best = std::max(best, e.dp.norm());
  }
  RC_ASSERT(best <= a.worst.distance);
  RC_ASSERT(best >= a.worst.distance * (1 - 1e-8));
}

TEST(WorstCase, OfARoundReachIsItsRadius) {
  // One crank with a radial clearance at its pivot alone: its tip may be anywhere in a circle of that radius.
  using core::Expression;
  test::MechanismBuilder b;
  b.point("O", 0, 0);
  mechanism::Coordinate theta{"theta", true, test::number(0.0), test::number(6.0), 0, 6};
  b.coordinates({theta});
  b.point("P", Expression::apply(Expression::Kind::cos, {test::symbol("theta")}),
          Expression::apply(Expression::Kind::sin, {test::symbol("theta")}));
  b.link("crank", {"O", "P"}).joint("O", "ground", "crank", "O", true).clearance("O", 0.25, 0);
  const NumericModel model = compile(b.end_effector("crank", "P").load("crank", "P", 1, 1).finish());
  const Accuracy a = pose_accuracy(model, posture(model, std::array{0.4}, {}));
  EXPECT_NEAR(a.worst.distance, 0.25, 1e-9);
  EXPECT_GE(a.worst.distance, 0.25);  // a bound, rounded up
  EXPECT_GE(a.worst.dp[0], 0.25);
  EXPECT_NEAR(a.worst.dp[0], 0.25, 1e-14);
  EXPECT_EQ(a.worst.dalpha[2], 0);
}

/// d|Δp| of all links is virtual work: the reactions' work on the take-up equals the loads' work on the displacements.
RC_GTEST_PROP(LinkDisplacements, SatisfyVirtualWork, ()) {
  const NumericModel model =
      compile(test::with_clearances(test::driven_five_bar(between(-9, 9), between(-9, 9), true), 3e-4, 2e-3));
  const auto mode = mechanism::working_mode(model.mechanism);
  const auto p = posture(model, std::array{between(-0.2, 0.9), between(-1.2, 0.2)}, mode);
  RC_PRE(p.reachable());
  const Accuracy a = pose_accuracy(model, p);
  RC_PRE(a.reactions.condition < 1e4);
  const double of_joints = a.reactions.values.dot(clearance_displacements(a.columns, a.take_up));
  const double of_loads = load_column(model, p).dot(a.link_displacements);
  RC_ASSERT(std::abs(of_joints - of_loads) <= 1e-10 * (1 + std::abs(of_joints)));
  RC_ASSERT(of_joints < 0);  // every reaction pushes the parts apart: the clearances open under the load
}

}  // namespace
}  // namespace clearloci::numeric
