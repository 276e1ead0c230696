// Springs, motors of known effort, loads that vary with the pose: against the principle of virtual work. Its arithmetic
// is this file's own: places by the intersection of two circles, energies by their definitions, derivatives by central
// differences of the fourth order.
//
//     sum M_J dθ_J + F . dP - dV = 0   for every displacement that the joints allow
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "mechanism/read.hpp"
#include "numeric/displaced.hpp"
#include "numeric/reactions.hpp"
#include "tests/mechanism/five_bar_text.hpp"
#include "tests/numeric/solved.hpp"

namespace clearloci::numeric {
namespace {

using mechanism::five_bar_text;
using mechanism::with;

mechanism::Mechanism parsed(const std::string& text) { return mechanism::parse_mechanism(text, "m.yaml"); }

constexpr double L = 0.5;

/// Of two bars of length L from `a` to `p`: the joint between them, to the left (1) or the right (-1) of a -> p.
Point2 elbow(const Point2& a, const Point2& p, int side) {
  const double u = p[0] - a[0], v = p[1] - a[1], d = std::hypot(u, v), height = std::sqrt(L * L - d * d / 4);
  return {(a[0] + p[0]) / 2 - side * height * v / d, (a[1] + p[1]) / 2 + side * height * u / d};
}

double angle(const Point2& from, const Point2& to) { return std::atan2(to[1] - from[1], to[0] - from[0]); }
double distance(const Point2& a, const Point2& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

/// The shipped five-bar: B1 right, B2 left.
struct FiveBar {
  Point2 A1{0, 0}, A2{L, 0}, H{0.1, 0.8}, P, B1, B2;

  explicit FiveBar(const Point2& p) : P(p), B1(elbow(A1, p, -1)), B2(elbow(A2, p, 1)) {}
  double crank1() const { return angle(A1, B1); }
  double crank2() const { return angle(A2, B2); }
};

using Of = std::function<double(const FiveBar&)>;

double derivative(const Of& of, Point2 at, std::size_t c) {
  constexpr double h = 1e-3;
  const auto value = [&](double step) {
    Point2 there = at;
    there[c] += step;
    return of(FiveBar(there));
  };
  return (8 * (value(h) - value(-h)) - (value(2 * h) - value(-2 * h))) / (12 * h);
}

/// M_A1 and M_A2 that balance a generalised force (what does work on a displacement of P in x and in y).
std::array<double, 2> couples(const Point2& at, const std::array<double, 2>& force) {
  std::array<std::array<double, 2>, 2> J{};
  for (std::size_t c = 0; c < 2; ++c)
    J[c] = {derivative([](const FiveBar& m) { return m.crank1(); }, at, c),
            derivative([](const FiveBar& m) { return m.crank2(); }, at, c)};
  const double det = J[0][0] * J[1][1] - J[0][1] * J[1][0];
  return {(-force[0] * J[1][1] + force[1] * J[0][1]) / det, (-force[1] * J[0][0] + force[0] * J[1][0]) / det};
}

constexpr std::array<Point2, 4> places = {{{0.25, -0.7}, {0.1, 0.55}, {0.4, -0.45}, {0.6, 0.3}}};

/// The file's couples against those of the generalised force -dV + F . dP.
void expect_couples(const std::string& text, const Of& energy, const std::function<Point2(const Point2&)>& load) {
  const NumericModel model = compile(parsed(text));
  for (const Point2& p : places) {
    const Reactions found = solve_reactions(model, posture(model, p, std::array{-1, 1}));
    const Point2 f = load(p);
    const auto expected = couples(p, {f[0] - derivative(energy, p, 0), f[1] - derivative(energy, p, 1)});
    const double size = 1 + std::abs(expected[0]) + std::abs(expected[1]);
    EXPECT_NEAR(found.values(column_of(model, 0, core::Quantity::M)), expected[0], 1e-7 * size) << p[0] << ", " << p[1];
    EXPECT_NEAR(found.values(column_of(model, 4, core::Quantity::M)), expected[1], 1e-7 * size) << p[0] << ", " << p[1];
  }
}

const std::string text = with(five_bar_text, "  A2: [d, 0]\n", "  A2: [d, 0]\n  H: [0.1, 0.8]\n");
constexpr double no_energy_at_all = 0;
double nothing(const FiveBar&) { return no_energy_at_all; }
Point2 usual_load(const Point2&) { return {0, -100}; }

TEST(Springs, LinearOnesByTheirEnergy) {
  expect_couples(
      text + "springs: [{links: [ground, A1B1], at: [H, B1], stiffness: 800, free_length: 0.12}]\n",
      [](const FiveBar& m) { return 400 * std::pow(distance(m.H, m.B1) - 0.12, 2); }, usual_load);
  expect_couples(
      text + "springs: [{links: [A1B1, B2A2], at: [B1, B2], stiffness: 300, free_length: 0}]\n",
      [](const FiveBar& m) { return 150 * std::pow(distance(m.B1, m.B2), 2); }, usual_load);
}

TEST(Springs, ConstantForcesByTheirEnergy) {
  expect_couples(
      text + "springs: [{links: [PB2, ground], at: [P, H], force: 40}]\n",
      [](const FiveBar& m) { return 40 * distance(m.P, m.H); }, usual_load);
}

TEST(Springs, TorsionSpringsByTheirEnergy) {
  // Of the crank against the ground, its angle taken within half a turn of rest; and of the elbow.
  const auto turned = [](double angle, double rest) { return std::remainder(angle - rest, 2 * std::numbers::pi); };
  expect_couples(
      text + "springs: [{joint: A1, stiffness: 2.5, rest: 30 deg}]\n",
      [&](const FiveBar& m) { return 1.25 * std::pow(turned(m.crank1(), std::numbers::pi / 6), 2); }, usual_load);
  expect_couples(
      text + "springs: [{joint: B1, stiffness: 4, rest: -20 deg}]\n",
      [&](const FiveBar& m) { return 2 * std::pow(turned(angle(m.B1, m.P) - m.crank1(), -std::numbers::pi / 9), 2); },
      usual_load);
}

TEST(Springs, AMotorOfKnownEffortDoesItsWork) {
  const std::string pin = "B1: {revolute: [A1B1, B1P], at: B1";
  expect_couples(
      with(text, pin, pin + ", actuated: {effort: 3.5}"),
      [](const FiveBar& m) { return -3.5 * std::remainder(angle(m.B1, m.P) - m.crank1(), 6.283185307179586); },
      usual_load);
}

TEST(Springs, LoadsThatVaryWithThePose) {
  expect_couples(with(text, "force: [0, -100]", "force: '30*(H - P)'"), nothing, [](const Point2& p) {
    return Point2{30 * (0.1 - p[0]), 30 * (0.8 - p[1])};
  });
  expect_couples(with(text, "force: [0, -100]", "force: [-20*(x - 1/3), 3*x*y]"), nothing, [](const Point2& p) {
    return Point2{-20 * (p[0] - 1.0 / 3), 3 * p[0] * p[1]};
  });
}

TEST(Springs, DisplacedOnesPullWithTheLengthThatTheyHave) {
  // A constant-force spring that is stiffer than anything keeps its force; a linear one changes it by k times the way.
  const NumericModel model =
      compile(parsed(text + "springs: [{links: [ground, PB2], at: [H, P], stiffness: 80000, free_length: 1.5}]\n"));
  const Posture at = posture(model, places[0], std::array{-1, 1});
  const Accuracy linear = pose_accuracy(model, at, {});
  const ActualPose actual = actual_pose(model, at, linear);
  ASSERT_TRUE(actual.converged) << actual.reason;
  // Force on PB2: that of the nominal place, and what the displacement of P along the spring adds.
  const Point2 P = {places[0][0] + actual.error.dp[0], places[0][1] + actual.error.dp[1]};
  const double now = 80000 * (distance(P, {0.1, 0.8}) - 1.5), before = 80000 * (distance(places[0], {0.1, 0.8}) - 1.5);
  EXPECT_GT(std::abs(now - before), 0.1) << "the displacement counts";
  // Balance of the two links that meet in P, with the reactions of the displaced mechanism.
  const auto f = [&](int joint, core::Quantity q) { return actual.reactions(column_of(model, joint, q)); };
  const Point2 pull = {now * (0.1 - P[0]) / distance(P, {0.1, 0.8}), now * (0.8 - P[1]) / distance(P, {0.1, 0.8})};
  EXPECT_NEAR(f(2, core::Quantity::fx) + f(3, core::Quantity::fx) + pull[0], 0, 1e-6);
  EXPECT_NEAR(f(2, core::Quantity::fy) + f(3, core::Quantity::fy) + pull[1] - 100, 0, 1e-6);
}

TEST(Limits, PutPosesOutOfReachAndSayWhich) {
  const NumericModel model = compile(parsed(text + "limits:\n  - {distance: [A1, P], within: [0.31, 0.75]}\n"
                                                   "  - {angle: [A1, B1, P], within: [20 deg, 160 deg]}\n"));
  const auto at = [&](const Point2& p) { return posture(model, p, std::array{-1, 1}); };
  EXPECT_TRUE(at({0.25, -0.7}).reachable());
  EXPECT_TRUE(reachable(model, std::array{0.25, -0.7}, std::array{-1, 1}));
  const Posture far = at({0.25, -0.8});
  EXPECT_FALSE(far.unreachable);
  ASSERT_TRUE(far.broken);
  EXPECT_EQ(far.broken->limit, 0U);
  EXPECT_TRUE(far.broken->upper);
  EXPECT_FALSE(reachable(model, std::array{0.25, -0.8}, std::array{-1, 1}));
  const auto near = tightest_limit(model, std::array{0.2, -0.1}, std::array{-1, 1});
  ASSERT_TRUE(near);
  EXPECT_EQ(near->limit, 0U);
  EXPECT_FALSE(near->upper);
  EXPECT_LT(near->slack, 0);
}

TEST(Limits, ThatNoPoseKeepsLeaveNoneInReach) {
  const NumericModel model = compile(parsed(text + "limits:\n  - {distance: [A1, A2], within: [0, 0.1]}\n"));
  EXPECT_FALSE(reachable(model, std::array{0.25, -0.7}, std::array{-1, 1}));
}

TEST(Springs, InSpaceAsInThePlane) {
  // A pendulum on a hinge about y: gravity, a spring to the ground, a torsion spring, against energies by hand.
  const mechanism::Mechanism m = parsed(R"(format: 1
space: spatial
workspace: {t: {angle: [-80 deg, 80 deg]}}
points:
  O: [0, 0, 0]
  H: [0.2, 0.3, 0.4]
  T: [0.6*cos(t), 0.1, 0.6*sin(t)]
links: {arm: {points: [O, T]}}
joints: {O: {revolute: [ground, arm], at: O, axis: [0, -2, 0], actuated: true}}
end_effector: {link: arm, at: T}
loads: [{link: arm, at: T, force: 'cross([0, 3, 0], T - H)'}]
springs:
  - {links: [ground, arm], at: [H, T], stiffness: 90, free_length: 0.25}
  - {joint: O, stiffness: 1.5, rest: 20 deg}
)");
  const double t = 0.7;
  const auto energy = [](double a) {
    const double l = std::hypot(0.6 * std::cos(a) - 0.2, 0.1 - 0.3, 0.6 * std::sin(a) - 0.4);
    // About -y the arm turns from x towards z; its direction leans by the constant 0.1 along the axis.
    return 45 * std::pow(l - 0.25, 2) + 0.75 * std::pow(a - 20 * std::numbers::pi / 180, 2);
  };
  constexpr double h = 1e-3;
  const double dV = (8 * (energy(t + h) - energy(t - h)) - (energy(t + 2 * h) - energy(t - 2 * h))) / (12 * h);
  // cross((0, 3, 0), v) = (3 vz, 0, -3 vx), v = T - H; dT = 0.6 (-sin t, 0, cos t).
  const double work =
      3 * (0.6 * std::sin(t) - 0.4) * -0.6 * std::sin(t) - 3 * (0.6 * std::cos(t) - 0.2) * 0.6 * std::cos(t);
  const test::Solved solved = test::solved(m, std::array{t});
  EXPECT_NEAR(solved.reactions[0].actuator, dV - work, 1e-8);
  const NumericModel model = compile(m);
  const BoundedNumerators n = bounded_numerators(model, std::array{t}, {});
  EXPECT_NEAR(n.values[static_cast<std::size_t>(column_of(model, 0, core::Quantity::M))].value / n.determinant.value,
              dV - work, 1e-8);
}

}  // namespace
}  // namespace clearloci::numeric
