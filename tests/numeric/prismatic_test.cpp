// Prismatic joints: what a guide bears, how it takes up its gap, and what that does to the pose.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "mechanism/read.hpp"
#include "numeric/dynamics.hpp"
#include "numeric/pose_error.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::numeric {
namespace {

mechanism::Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
}

TEST(Prismatic, PoseErrorOfThePrrrpByHand) {
  // P = (0.3, 0.1), S1 = (0, 0.5), S2 = (0.6, 0.5); load (30, -100) N. Rod forces along (3, -4)/5 and (-3, -4)/5
  // balance it: 87.5 N and 37.5 N. Each rod keeps its length: (P - S)·(δP - δS) = 0 with every clearance taken up
  // against the force it carries. The guides are pressed along -x and +x, the actuators pushed downwards.
  const NumericModel model = compile(example("prrrp"));
  const Posture at = posture(model, std::array{0.3, 0.1}, std::array{1, 1});
  const Accuracy accuracy = pose_accuracy(model, at, {});
  const double rho = 10e-6, gap = 10e-6, axial = 5e-6;
  // S1 as a point of rod 1 and S2 as one of rod 2, of the guides' and the pins' clearances.
  const double x1 = gap + 0.6 * rho, y1 = -axial - 0.8 * rho, x2 = -gap - 0.6 * rho, y2 = -axial - 0.8 * rho;
  // P of rod 2 against P of rod 1: (0.6, -0.8) rho. Two equations for δP of rod 2.
  const double first = 0.3 * (x1 + 0.6 * rho) - 0.4 * (y1 - 0.8 * rho), second = -0.3 * x2 - 0.4 * y2;
  const double dy = -(first + second) / 0.8, dx = (first - second) / 0.6;
  EXPECT_NEAR(accuracy.error.dp[0], dx, 1e-16);
  EXPECT_NEAR(accuracy.error.dp[1], dy, 1e-16);
  EXPECT_LE(std::abs(accuracy.error.dp[0]), accuracy.worst.dp[0] * (1 + 1e-12));
  EXPECT_LE(std::hypot(dx, dy), accuracy.worst.distance * (1 + 1e-9));
}

TEST(Prismatic, AGuideTiltsWhereTheCoupleOutweighsTheForce) {
  // Ends at ±h bear (N ± T/h)/2: pressed to one side while |T| < h |N|, to both where it is greater.
  const NumericModel model = compile(example("prrrp"));
  const JointContact guide =
      joint_contacts(model.mechanism, posture(model, std::array{0.3, 0.1}, std::array{1, 1}).axes)[0];
  const double h = guide.clearance.half_length, g = guide.clearance.gap;
  const auto taken_up = [&](double force, double couple) {
    return take_up(guide, {force * guide.normal(), couple * Vector3d::UnitZ(), 1});
  };
  for (const auto& [force, couple, normal, tilt] : {std::array{10.0, 0.5 * h * 10, -g, 0.0},
                                                    {-10.0, 0.5 * h * 10, g, 0.0},
                                                    {10.0, 2 * h * 10, 0.0, -g / h},
                                                    {10.0, -2 * h * 10, 0.0, g / h}}) {
    const TakeUp t = taken_up(force, couple);
    EXPECT_FALSE(t.guide_vanishes());
    EXPECT_NEAR(t.normal, normal, 1e-20);
    EXPECT_NEAR(t.tilt, tilt, 1e-20);
  }
  EXPECT_TRUE(taken_up(10, h * 10).guide_vanishes());
}

// Inertia, against Jourdain's principle of virtual power with this file's own places and differences:
//     sum F_J ds_J/dq + F . dP/dq = sum m (a - g) . dr/dq + I dω/dt dφ/dq   for either coordinate q

constexpr double first_step = 1e-3;

double first(const std::function<double(double)>& f) {
  const double h = first_step;
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}
double second(const std::function<double(double)>& f) {
  const double h = first_step;
  return (16 * (f(h) + f(-h)) - 30 * f(0) - f(2 * h) - f(-2 * h)) / (12 * h * h);
}

/// A body: where its centre of mass is and how far it is turned, of a place of P.
struct Body {
  double mass, inertia;
  std::function<double(const Point2&)> x, y, angle;
};

void expect_virtual_power(const Motion& motion, const std::vector<Body>& bodies, const Point2& load,
                          const std::vector<std::pair<int, std::function<double(const Point2&)>>>& drives) {
  constexpr double g = 9.81;
  const std::array<double, 2> q = {0.25, 0.1}, v = {1.3, -0.7}, a = {-4, 9};
  std::vector<Series> coordinates;
  for (std::size_t c = 0; c < 2; ++c) {
    Series& series = coordinates.emplace_back(q[c]);
    series.c[1] = v[c];
    series.c[2] = a[c] / 2;
  }
  const Instant at = instant_of(motion, coordinates);
  ASSERT_TRUE(at.reachable);
  const Eigen::VectorXd w = at.reactions(1);
  const auto moved = [&](double t) {
    return Point2{q[0] + v[0] * t + a[0] * t * t / 2, q[1] + v[1] * t + a[1] * t * t / 2};
  };
  for (std::size_t c = 0; c < 2; ++c) {
    const auto by_q = [&](const std::function<double(const Point2&)>& f) {
      return first([&](double step) {
        Point2 there = {q[0], q[1]};
        there[c] += step;
        return f(there);
      });
    };
    const auto in_time = [&](const std::function<double(const Point2&)>& f) {
      return second([&](double t) { return f(moved(t)); });
    };
    double power = load[c], inertia = 0;
    for (const auto& [column, place] : drives) power += w(column) * by_q(place);
    for (const Body& body : bodies)
      inertia += body.mass * (in_time(body.x) * by_q(body.x) + (in_time(body.y) + g) * by_q(body.y)) +
                 body.inertia * in_time(body.angle) * by_q(body.angle);
    EXPECT_NEAR(power, inertia, 1e-5 * (1 + std::abs(inertia)));
  }
}

TEST(PrismaticMotion, SlidersBearTheInertiaOfTheLinks) {
  mechanism::Mechanism m = example("prrrp");
  const auto number = [](double value) { return core::Expression::number(core::Rational(value)); };
  for (std::size_t i = 0; i < 4; ++i) m.links[i].mass = number(0.5 + 0.25 * static_cast<double>(i));
  m.gravity = {number(0), core::Expression::number(core::Rational(-981, 100))};
  const Motion motion = compile_motion(m, {1, 1});
  const auto s1 = [](const Point2& p) { return p[1] + std::sqrt(0.25 - p[0] * p[0]); };
  const auto s2 = [](const Point2& p) { return p[1] + std::sqrt(0.25 - (p[0] - 0.6) * (p[0] - 0.6)); };
  const auto zero = [](const Point2&) { return 0.0; };
  const std::vector<Body> bodies = {
      {0.5, 0, zero, s1, zero},
      {0.75, 0.75 * 0.25 / 12, [](const Point2& p) { return p[0] / 2; },
       [=](const Point2& p) { return (s1(p) + p[1]) / 2; },
       [=](const Point2& p) { return std::atan2(p[1] - s1(p), p[0]); }},
      {1, 0.25 / 12, [](const Point2& p) { return (p[0] + 0.6) / 2; },
       [=](const Point2& p) { return (s2(p) + p[1]) / 2; },
       [=](const Point2& p) { return std::atan2(s2(p) - p[1], 0.6 - p[0]); }},
      {1.25, 0, zero, s2, zero},
  };
  expect_virtual_power(
      motion, bodies, {30, -100},
      {{column_of(motion.model, 0, core::Quantity::F), s1}, {column_of(motion.model, 4, core::Quantity::F), s2}});
}

TEST(PrismaticMotion, ABlockTurnsWithItsGuide) {
  // Two telescopic legs from (0, 0) and (0.6, 0); the cylinders have one point each and turn with the legs.
  const mechanism::Mechanism m = mechanism::parse_mechanism(R"(format: 1
workspace: {x: [0, 0.6], y: [0.05, 0.4]}
points: {A: [0, 0], B: [0.6, 0], P: [x, y]}
links:
  c1: {points: [A], mass: 2, com: A, inertia: 0.3}
  r1: {points: [P]}
  c2: {points: [B], mass: 2, com: B, inertia: 0.2}
  r2: {points: [P]}
joints:
  A: {revolute: [ground, c1], at: A}
  S1: {prismatic: [c1, r1], at: P, axis: [A, P], actuated: true}
  B: {revolute: [ground, c2], at: B}
  S2: {prismatic: [c2, r2], at: P, axis: [B, P], actuated: true}
  P: {revolute: [r1, r2], at: P}
end_effector: {link: r1, at: P}
loads: [{link: r1, at: P, force: [30, -100]}]
)",
                                                            "legs.yaml");
  const Motion motion = compile_motion(m, {});
  const auto zero = [](const Point2&) { return 0.0; };
  const std::vector<Body> bodies = {
      {0, 0.3, zero, zero, [](const Point2& p) { return std::atan2(p[1], p[0]); }},
      {0, 0.2, zero, zero, [](const Point2& p) { return std::atan2(p[1], p[0] - 0.6); }},
  };
  expect_virtual_power(
      motion, bodies, {30, -100},
      {{column_of(motion.model, 1, core::Quantity::F), [](const Point2& p) { return std::hypot(p[0], p[1]); }},
       {column_of(motion.model, 3, core::Quantity::F), [](const Point2& p) { return std::hypot(p[0] - 0.6, p[1]); }}});
}

}  // namespace
}  // namespace clearloci::numeric
