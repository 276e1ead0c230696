// Gears and belts with their clearances taken up, without linearisation: flanks as curves and belts as strings, on the
// wheels where the iteration leaves them.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <regex>

#include "clearloci/pose.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

using Eigen::Vector2d;

constexpr double degree = std::numbers::pi / 180;

Vector2d across(const Vector2d& v) { return {-v(1), v(0)}; }
double turn(const Vector2d& a, const Vector2d& b) { return a(0) * b(1) - a(1) * b(0); }
Vector2d turned(const Vector2d& v, double angle) { return std::cos(angle) * v + std::sin(angle) * across(v); }

Vector2d place(const std::vector<PosePoint>& points, const std::string& name) {
  for (const PosePoint& point : points)
    if (point.name == name) return {point.at[0], point.at[1]};
  throw std::out_of_range(name);
}

/// A wheel, as it was and as it is: its centre, and how far it has turned.
struct Wheel {
  Vector2d before, now;
  double by = 0;

  Wheel(const Pose& pose, const std::string& link, const std::string& centre, const std::string& mark)
      : before(place(pose.points, centre)) {
    for (const DisplacedLink& displaced_link : pose.actual->links) {
      if (displaced_link.link != link) continue;
      now = place(displaced_link.points, centre);
      const Vector2d way = place(pose.points, mark) - before, then = place(displaced_link.points, mark) - now;
      by = std::atan2(turn(way, then - way), way.dot(then));
    }
  }
};

/// The flank that a string draws which unwinds from a base circle: dP is across the string.
struct Flank {
  const Wheel& wheel;
  Vector2d touch, string;  ///< from the centre to where the string leaves, and from there to the pitch point

  Flank(const Wheel& of, const Vector2d& pitch, const Vector2d& line)
      : wheel(of), touch(pitch - of.before - line.dot(pitch - of.before) * line), string(pitch - of.before - touch) {}
  Vector2d direction(double v) const { return turned(string.normalized(), v + wheel.by); }
  Vector2d at(double v) const {
    const double length = string.norm() - touch.norm() * v * across(touch).normalized().dot(string.normalized());
    return wheel.now + turned(touch, v + wheel.by) + length * direction(v);
  }
};

/// How far flank `two` is from `one` along their common normal.
double gap(const Flank& one, const Flank& two) {
  const auto partner = [&](double v) {
    const Vector2d e = one.direction(v), f = two.direction(0);
    return std::atan2(turn(f, e), f.dot(e)) + (f.dot(e) < 0 ? (turn(f, e) > 0 ? -1 : 1) * std::numbers::pi : 0);
  };
  const auto beside = [&](double v) { return turn(one.direction(v), two.at(partner(v)) - one.at(v)); };
  double a = -1e-3, b = 1e-3;
  for (int i = 0; i < 60; ++i) {
    const double fa = beside(a), fb = beside(b);
    if (fa == fb) break;
    const double next = b - fb * (b - a) / (fb - fa);
    a = b;
    b = next;
  }
  return (two.at(partner(b)) - one.at(b)).dot(one.direction(b));
}

/// `text`: of a geared five-bar.
void expect_touching_teeth(const std::string& text, double pitch) {
  int compared = 0;
  for (int k = 0; k < 12; ++k) {
    const Pose pose = solve_pose(Model::parse(text), {(30 * k + 7) * degree}, {.iterate = true});
    ASSERT_TRUE(pose.actual) << k;
    if (!pose.actual->converged) continue;
    EXPECT_LT(pose.actual->residual, 1e-14);
    const Wheel first(pose, "wheel1", "O1", "T1"), second(pose, "wheel2", "O2", "T2");
    const Vector2d W(pitch, 0), line = (W - place(pose.points, "flank_W")).normalized();
    // Half of the backlash, along the line of action; teeth that push have come nearer by it.
    const Flank one(first, W, line), two(second, W, line);
    const double sense = one.direction(0).dot(line) > 0 ? 1 : -1;
    EXPECT_NEAR(sense * gap(one, two), -0.02e-3 * std::cos(20 * degree), 1e-13) << k;
    ++compared;
  }
  EXPECT_GT(compared, 8);
}

TEST(DisplacedWheels, TeethTouch) { expect_touching_teeth(example_text("geared_five_bar"), 0.04); }

TEST(DisplacedWheels, TeethOfARingTouch) {
  const std::string text = replaced(
      replaced(example_text("geared_five_bar"), "wheel1: {at: O1, turned: theta}", "wheel2: {at: O2, turned: theta}"),
      "teeth: [40, 20]", "teeth: [20, -40]");
  expect_touching_teeth(text, -0.06);
}

std::string belted(const std::string& radii) {
  return replaced(example_text("geared_five_bar"),
                  "W: {gear: [wheel1, wheel2], centres: [O1, O2], teeth: [40, 20], pressure_angle: 20, phase: 30,",
                  "W: {belt: [wheel1, wheel2], centres: [O1, O2], radii: " + radii + ", tension: 200, phase: 30,");
}

/// A span with what is wound at its ends, up to marks that turn with the pulleys; by where its normal n has
/// n . w = r1 - r2.
double span(const Vector2d& first, const Vector2d& second, std::array<double, 2> radii, std::array<double, 2> by,
            double side) {
  const Vector2d w = second - first;
  const double psi = std::atan2(w(1), w(0));
  double low = 0, high = std::numbers::pi;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    const Vector2d n(std::cos(psi + side * middle), std::sin(psi + side * middle));
    (n.dot(w) > radii[0] - radii[1] ? low : high) = middle;
  }
  const double phi = psi + side * low;
  const Vector2d n(std::cos(phi), std::sin(phi));
  const double free = (second + radii[1] * n - first - radii[0] * n).norm();
  return free + side * (radii[0] * (by[0] - phi) - radii[1] * (by[1] - phi));
}

class DisplacedBelt : public ::testing::TestWithParam<int> {};

TEST_P(DisplacedBelt, HasSpansThatMoveByHalfItsPlay) {
  const Model model = Model::parse(belted("[30, " + std::to_string(GetParam()) + "]"));
  const std::array<double, 2> radii = {0.03, GetParam() / 1000.0};
  int compared = 0;
  for (int k = 0; k < 12; ++k) {
    const Pose pose = solve_pose(model, {(30 * k + 7) * degree}, {.iterate = true});
    ASSERT_TRUE(pose.actual);
    if (!pose.actual->converged) continue;
    EXPECT_LT(pose.actual->residual, 1e-14);
    const Wheel first(pose, "wheel1", "O1", "T1"), second(pose, "wheel2", "O2", "T2");
    double moved = 0;
    for (const double side : {1.0, -1.0})
      moved += side * (span(first.now, second.now, radii, {first.by, second.by}, side) -
                       span(first.before, second.before, radii, {0, 0}, side));
    EXPECT_NEAR(std::abs(moved / 2), 0.02e-3, 1e-13) << k;
    ++compared;
  }
  EXPECT_GT(compared, 8);
}

INSTANTIATE_TEST_SUITE_P(OpenAndCrossed, DisplacedBelt, ::testing::Values(15, -15, 10));

/// With clearances of a half, a quarter of what is beyond the linear step is left.
TEST(DisplacedWheels, GoBeyondTheLinearStepWithTheSquareOfTheirClearances) {
  for (const std::string& text : {example_text("geared_five_bar"), belted("[30, 15]"), belted("[30, -15]"),
                                  example_text("scara_belt"), example_text("scissor_lift")}) {
    const auto beyond = [&](const std::string& candidate, const std::vector<double>& at) {
      const Pose pose = solve_pose(Model::parse(candidate), at, {.iterate = true});
      EXPECT_TRUE(pose.actual && pose.actual->converged) << candidate;
      return Vector2d(pose.actual->beyond_linear.displacement[0], pose.actual->beyond_linear.displacement[1]);
    };
    const std::string half =
        std::regex_replace(text, std::regex("(radial|angular|backlash|gap|axial): ([0-9.]+)"), "$1: $2/2");
    ASSERT_NE(half, text);
    const std::vector<double> at = text.find("table") != std::string::npos    ? std::vector<double>{0.6, 0.25}
                                   : text.find("pulley") != std::string::npos ? std::vector<double>{0.2, 0.1}
                                                                              : std::vector<double>{100 * degree};
    const Vector2d whole = beyond(text, at), part = beyond(half, at);
    EXPECT_LT((part - whole / 4).norm(), 0.02 * whole.norm()) << text;
  }
}

}  // namespace
}  // namespace clearloci
