// Gears and belts: reactions against statics by hand, wheel by wheel; the flank that bears, and where it changes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "clearloci/error.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/trajectory.hpp"
#include "clearloci/validate.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"
#include "tests/analysis/by_hand.hpp"
#include "tests/source_dir.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

using Eigen::Vector2d;

constexpr double degree = 0.017453292519943295;

/// The geared five-bar of examples/ by hand.
struct GearedFiveBar {
  Vector2d O2{0.06, 0}, T1, T2, P, rod1, rod2;
  double push1 = 0, push2 = 0;  ///< of the rods on P

  /// `load`: on P, N.
  explicit GearedFiveBar(double theta, double ratio = -2, const Vector2d& load = {20, -40}) {
    const double turned = 30 * degree + ratio * theta;
    T1 = 0.025 * Vector2d(std::cos(theta), std::sin(theta));
    T2 = O2 + 0.015 * Vector2d(std::cos(turned), std::sin(turned));
    const double d = (T2 - T1).norm(), along = (d * d + 0.09 * 0.09 - 0.08 * 0.08) / (2 * d);
    const Vector2d u = (T2 - T1) / d;
    P = T1 + along * u + std::sqrt(0.09 * 0.09 - along * along) * Vector2d(-u(1), u(0));
    rod1 = (P - T1).normalized();
    rod2 = (P - T2).normalized();
    Eigen::Matrix2d rods;
    rods << rod1, rod2;
    const Vector2d pushes = rods.inverse() * -load;
    push1 = pushes(0);
    push2 = pushes(1);
  }
  /// About its centre, of the rod on the second wheel: what its teeth have to hold.
  double on_second() const { return moment(T2 - O2, -push2 * rod2); }
  /// Of the teeth of the first wheel on those of the second, N, where the line of action turns the second wheel by
  /// `sense`, and its direction.
  Vector2d line(double sense, double alpha) const { return {std::sin(alpha), sense * std::cos(alpha)}; }
};

TEST(GearedFiveBar, ErrorsAreOfPosesInWhichTheTeethPush) {
  const Model model = shipped("geared_five_bar.yaml");
  ErrorRequest request;
  request.with_loci = false;
  const Errors errors = find_errors(model, request);
  const core::FieldMap& map = errors.modes.front().map;
  const auto field = std::find_if(map.fields.begin(), map.fields.end(), [](const auto& f) { return f.name == "dp"; });
  ASSERT_NE(field, map.fields.end());
  std::size_t pushed = 0, pulled = 0;
  for (std::size_t k = 0; k < map.size(); ++k) {
    const GearedFiveBar by_hand(map.axes[0][k]);
    const Vector2d W(0.04, 0);
    const double left = -by_hand.on_second() / moment(W - by_hand.O2, by_hand.line(-1, 20 * degree));
    EXPECT_EQ(std::isfinite(field->values[k]), left > 0) << map.axes[0][k];
    ++(left > 0 ? pushed : pulled);
  }
  EXPECT_GT(pushed, 100u);
  EXPECT_GT(pulled, 100u);
  EXPECT_EQ(errors.modes.front().reachable, pushed);
}

TEST(ScaraWithABelt, ErrorsAreOfPosesInWhichNoSpanIsSlack) {
  Model model = shipped("scara_belt.yaml");
  ErrorRequest request;
  request.with_loci = false;
  request.worst_case = false;
  request.grid = {40, 40};
  const std::size_t tight = find_errors(model, request).modes.front().reachable;
  model = model.with({{"T0", "20"}});
  const Errors loose = find_errors(model, request);
  EXPECT_LT(loose.modes.front().reachable, tight);
  const core::FieldMap& map = loose.modes.front().map;
  for (std::size_t k = 0; k < map.size(); k += 7) {
    if (!std::isfinite(map.fields.front().values[k])) continue;
    const Pose pose = solve_pose(model, {map.place(k)[0], map.place(k)[1]});
    EXPECT_LE(std::abs(part(pose, "T", Quantity::M)), 2 * 20 * 0.025) << k;
  }
}

TEST(GearedFiveBar, TeethHoldTheSecondCrank) {
  const Model model = shipped("geared_five_bar.yaml");
  int left = 0, right = 0;
  for (int k = 0; k < 24; ++k) {
    const double theta = (15 * k + 4) * degree, alpha = 20 * degree;
    const GearedFiveBar by_hand(theta);
    const Vector2d W(0.04, 0);
    // The one of the two lines along which teeth that push hold the moment.
    double force = 0;
    Vector2d u;
    for (const double sense : {1.0, -1.0}) {
      const Vector2d vector2d = by_hand.line(sense, alpha);
      const double needed = -by_hand.on_second() / moment(W - by_hand.O2, vector2d);
      if (needed >= 0) {
        force = needed;
        u = vector2d;
        ++(sense > 0 ? right : left);  // K is to the left of O1 -> W where the line goes down
      }
    }
    const Pose pose = solve_pose(model, {theta});
    EXPECT_NEAR(part(pose, "W", Quantity::F), force, 1e-8) << theta;
    const Vector2d held = by_hand.push2 * by_hand.rod2 - force * u;
    EXPECT_NEAR(part(pose, "O2", Quantity::fx), held(0), 1e-8) << theta;
    EXPECT_NEAR(part(pose, "O2", Quantity::fy), held(1), 1e-8) << theta;
    EXPECT_NEAR(part(pose, "O1", Quantity::M), moment(by_hand.T1, by_hand.push1 * by_hand.rod1) + force * moment(W, u),
                1e-9)
        << theta;
    for (const auto& [point, side] : pose.working_mode)
      if (point == "flank_W") {
        EXPECT_EQ(side, u(1) < 0 ? "left" : "right") << theta;
      }
  }
  EXPECT_GT(left, 3);
  EXPECT_GT(right, 3);
}

std::vector<double> zeros_of(const LocusMap& map, const std::string& joint, Quantity quantity) {
  std::vector<double> all;
  for (const IsolatedPoint& point : map.isolated_points)
    for (const Vanishing& vanishing : point.vanishing)
      if (vanishing.joint == joint && vanishing.quantity == quantity) all.push_back(point.at[0]);
  std::sort(all.begin(), all.end());
  return all;
}

/// Where the teeth bear nothing, whatever their pressure angle, and in either flank: by signs of the moment by hand.
TEST(GearedFiveBar, FlanksChangeWhereTheTeethBearNothing) {
  const std::string text = shipped("geared_five_bar.yaml").text();
  std::vector<double> by_hand;
  constexpr int steps = 7200;
  for (int k = 0; k < steps; ++k) {
    double a = 360 * degree * k / steps, b = 360 * degree * (k + 1) / steps;
    if (GearedFiveBar(a).on_second() * GearedFiveBar(b).on_second() >= 0) continue;
    for (int i = 0; i < 60; ++i) {
      const double middle = (a + b) / 2;
      (GearedFiveBar(a).on_second() * GearedFiveBar(middle).on_second() > 0 ? a : b) = middle;
    }
    by_hand.push_back(a);
  }
  ASSERT_GT(by_hand.size(), 1U);
  for (const char* angle : {"pressure_angle: 20", "pressure_angle: 25"})
    for (const char* flank : {"left", "right"}) {
      const LocusMap map =
          trace_loci(Model::parse(replaced(text, "pressure_angle: 20", std::string(angle) + ", flank: " + flank)));
      const std::vector<double> found = zeros_of(map, "W", Quantity::F);
      ASSERT_EQ(found.size(), by_hand.size()) << angle << " " << flank;
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], by_hand[i], 1e-9);
      // What else vanishes in this mode does so where its flank bears.
      for (const IsolatedPoint& point : map.isolated_points) {
        if (point.kind == LocusKind::workspace_boundary) continue;
        const double needed = -GearedFiveBar(point.at[0]).on_second() / 0.02;  // along the teeth of the left flank
        EXPECT_GE(needed * (std::string(flank) == "left" ? 1 : -1), -1e-6) << point.at[0];
      }
    }
}

TEST(GearedFiveBar, TasksKeepTheirFlank) {
  const Model model = shipped("geared_five_bar.yaml");
  const LocusMap map = trace_loci(model);
  const std::vector<double> changes = zeros_of(map, "W", Quantity::F);
  ASSERT_GT(changes.size(), 1U);
  const auto across = [&](double from, double to) {
    return parse_task("format: 1\nbox: {theta: [" + std::to_string(from) + ", " + std::to_string(to) + "]}\n", model);
  };
  const double change = changes.front() / degree;
  EXPECT_EQ(verify(model, across(change - 2, change + 2)).verdict, Verdict::refuted);
}

/// Where a task crosses a change of flanks it is moved beside it, on whichever flank bears there.
TEST(GearedFiveBar, TasksAreMovedAsideOfAChangeOfFlanks) {
  const Model model = shipped("geared_five_bar.yaml");
  const double change = zeros_of(trace_loci(model), "W", Quantity::F).front() / degree;
  for (const double off : {-1.0, 1.0}) {
    const Task task = parse_task("format: 1\nbox: {theta: [" + std::to_string(change + off - 2) + ", " +
                                     std::to_string(change + off + 2) + "]}\n",
                                 model);
    ASSERT_EQ(verify(model, task).verdict, Verdict::refuted);
    const Verification moved = verify(model, task, {.fit = TaskFit::nearest});
    ASSERT_TRUE(moved.verified());
    ASSERT_TRUE(moved.moved_by);
    const double by = to_double(moved.moved_by->front()) / degree;
    EXPECT_NEAR(by, off, 0.05);
    // The teeth's force and its bound vanish as one.
    if (moved.nearest) {
      EXPECT_EQ(moved.nearest->vanishing.size(), 1u);
    }
    // The teeth push all over it on the flank that is told.
    for (const double share : {0.0, 0.5, 1.0}) {
      const double theta = (change + off + by + (4 * share - 2) * (1 - 1e-6)) * degree;
      const double needed = -GearedFiveBar(theta).on_second();
      for (const auto& [point, side] : moved.working_mode)
        if (point == "flank_W") {
          EXPECT_EQ(side, needed > 0 ? "left" : "right") << theta;
        }
    }
  }
}

TEST(GearedFiveBar, HalfTheBacklashIsTakenUp) {
  std::string text = shipped("geared_five_bar.yaml").text();
  for (const char* other :
       {", clearance: {radial: 0.01, angular: 0.05}", ", clearance: {radial: 0.01}", ", clearance: {radial: 0.01}",
        ", clearance: {radial: 0.01}", ", clearance: {radial: 0.01}"})
    text = replaced(text, other, "");
  // The end effector is a point of the second wheel: it turns by half the backlash over its pitch radius.
  text = replaced(text, "end_effector: {link: rod1, at: P}", "end_effector: {link: wheel2, at: T2}");
  for (const double theta : {0.3, 2.0, 4.0}) {
    const Pose pose = solve_pose(Model::parse(text), {theta});
    ASSERT_TRUE(pose.error);
    // Against the moment that the rod exerts on the wheel the teeth hold it: it falls back with that moment.
    const double sense = GearedFiveBar(theta).on_second() > 0 ? 1 : -1;
    EXPECT_NEAR(pose.error->rotation.at(0), sense * 0.02e-3 / 0.02, 1e-12) << theta;
  }
}

TEST(Gears, RefuseWhatDoesNotMesh) {
  const std::string text = shipped("geared_five_bar.yaml").text();
  const auto says = [&](const std::string& from, const std::string& to, const std::string& words) {
    const std::string told = refusal(replaced(text, from, to));
    EXPECT_NE(told.find(words), std::string::npos) << told;
    EXPECT_EQ(told.find('\n'), std::string::npos) << told;
  };
  says("teeth: [40, 20]", "teeth: [20, 40]", "by -1/2 of the angle of wheel1");
  says("teeth: [40, 20]", "teeth: [40, 20.5]", "no whole number");
  says("teeth: [40, 20]", "teeth: [-40, 20]", "pinion first");
  says("pressure_angle: 20", "pressure_angle: 60", "above 45 deg");
  says("T2: {in: wheel2, place: [crank2, 0]}", "T2: ['60 + crank2*cos(theta)', 'crank2*sin(theta)']",
       "do not move alike");
}

/// The same five-bar with a belt over pulleys of two sizes in place of the gear, open or crossed: span by span.
struct BeltedFiveBar : GearedFiveBar {
  double t = 0;                            ///< what one span pulls more than the other, N
  Vector2d on_second_ = Vector2d::Zero();  ///< the force of both on the second pulley
  double on_motor = 0;                     ///< the moment of both on the first pulley, about its centre

  BeltedFiveBar(double theta, double r2, double tension) : GearedFiveBar(theta, 0.03 / r2) {
    const double r1 = 0.03, along = (r1 - r2) / 0.06, across = std::sqrt(1 - along * along);
    std::array<Vector2d, 2> first, second, pull;
    for (const std::size_t s : {0, 1}) {
      const Vector2d n(along, s == 0 ? across : -across);
      first[s] = r1 * n;
      second[s] = r2 * n;
      pull[s] = (first[s] - O2 - second[s]).normalized();
    }
    t = -2 * on_second() / (moment(second[0], pull[0]) - moment(second[1], pull[1]));
    for (const std::size_t s : {0, 1}) {
      const Vector2d force = (tension + (s == 0 ? t : -t) / 2) * pull[s];
      on_second_ += force;
      on_motor -= moment(first[s], force);
    }
  }
};

std::string belted(const std::string& radii, int tension) {
  return replaced(shipped("geared_five_bar.yaml").text(),
                  "W: {gear: [wheel1, wheel2], centres: [O1, O2], teeth: [40, 20], pressure_angle: 20, phase: 30,",
                  "W: {belt: [wheel1, wheel2], centres: [O1, O2], radii: " + radii +
                      ", tension: " + std::to_string(tension) + ", phase: 30,");
}

/// The geared five-bar at constant speed with a mass at the tip, whose inertia is a load that differences of the path
/// by hand give: the teeth change flanks with the load and with the speed.
class TurningGears : public ::testing::TestWithParam<double> {
 protected:
  static constexpr double mass = 2;
  double period_ = GetParam();

  Vector2d tip(double t) const { return GearedFiveBar(2 * std::numbers::pi * t / period_).P; }
  GearedFiveBar at(double t) const {
    const double step = 1e-4 * period_;
    const Vector2d acceleration =
        (-tip(t - 2 * step) + 16 * tip(t - step) - 30 * tip(t) + 16 * tip(t + step) - tip(t + 2 * step)) /
        (12 * step * step);
    return GearedFiveBar(2 * std::numbers::pi * t / period_, -2, Vector2d(20, -40) - mass * acceleration);
  }
  /// Of the teeth, along the line on which they push; its direction.
  static std::pair<double, Vector2d> teeth(const GearedFiveBar& bar) {
    for (const double sense : {1.0, -1.0}) {
      const Vector2d u = bar.line(sense, 20 * degree);
      const double force = -bar.on_second() / moment(Vector2d(0.04, 0) - bar.O2, u);
      if (force >= 0) return {force, u};
    }
    throw std::logic_error("teeth that push on no flank");
  }
  TrajectoryResult followed() const {
    const Model model = Model::parse(replaced(shipped("geared_five_bar.yaml").text(), "rod1: {points: [T1, P]}",
                                              "rod1: {points: [T1, P], masses: [{mass: 2, at: P}]}"));
    return follow_trajectory_text(model,
                                  "format: 1\npath: {waypoints: [[0 deg], [360 deg]]}\n"
                                  "motion: {law: constant, speed: " +
                                      std::to_string(60 / period_) + " rpm}\n");
  }
};

TEST_P(TurningGears, ReactionsAreThoseOfTheFlankThatBears) {
  const TrajectoryResult result = followed();
  const std::vector<double>& time = result.samples.at("time");
  double most = 0;
  for (const double force : result.samples.at("FW")) most = std::max(most, force);
  for (std::size_t i = 0; i < time.size(); i += 97) {
    const GearedFiveBar bar = at(time[i]);
    const auto [force, u] = teeth(bar);
    const Vector2d held = bar.push2 * bar.rod2 - force * u;
    EXPECT_NEAR(result.samples.at("FW")[i], force, 1e-6 * most) << time[i];
    EXPECT_NEAR(result.samples.at("fO2x")[i], held(0), 1e-6 * most) << time[i];
    EXPECT_NEAR(result.samples.at("fO2y")[i], held(1), 1e-6 * most) << time[i];
  }
}

TEST_P(TurningGears, LoseContactWhereTheTeethChangeFlanks) {
  std::vector<double> by_hand;
  constexpr int steps = 3600;
  for (int k = 0; k < steps; ++k) {
    double a = period_ * k / steps, b = period_ * (k + 1) / steps;
    if (at(a).on_second() * at(b).on_second() >= 0) continue;
    for (int i = 0; i < 40; ++i) (at(a).on_second() * at((a + b) / 2).on_second() > 0 ? a : b) = (a + b) / 2;
    by_hand.push_back(a);
  }
  ASSERT_GT(by_hand.size(), 1U);
  const TrajectoryResult result = followed();
  std::vector<double> found;
  for (const ContactLoss& loss : result.losses)
    if (loss.joint == "W") {
      found.push_back(loss.time);
      EXPECT_NEAR(loss.crossed, 0.04e-3 * std::cos(20 * degree), 1e-12);
    }
  ASSERT_EQ(found.size(), by_hand.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], by_hand[k], 1e-6 * period_);
}

INSTANTIATE_TEST_SUITE_P(SlowAndFast, TurningGears, ::testing::Values(10.0, 0.5));

class BeltOfTwoSizes : public ::testing::TestWithParam<int> {};

TEST_P(BeltOfTwoSizes, HoldsTheSecondCrankByItsSpans) {
  constexpr int tension = 200;
  const Model model = Model::parse(belted("[30, " + std::to_string(GetParam()) + "]", tension));
  for (int k = 0; k < 24; ++k) {
    const double theta = (15 * k + 4) * degree;
    const BeltedFiveBar by_hand(theta, GetParam() / 1000.0, tension);
    const Pose pose = solve_pose(model, {theta});
    EXPECT_NEAR(std::abs(part(pose, "W", Quantity::F)), std::abs(by_hand.t * (30 - GetParam()) / 60), 1e-8) << theta;
    const Vector2d held = by_hand.push2 * by_hand.rod2 - by_hand.on_second_;
    EXPECT_NEAR(part(pose, "O2", Quantity::fx), held(0), 1e-8) << theta;
    EXPECT_NEAR(part(pose, "O2", Quantity::fy), held(1), 1e-8) << theta;
    EXPECT_NEAR(part(pose, "O1", Quantity::M), moment(by_hand.T1, by_hand.push1 * by_hand.rod1) - by_hand.on_motor,
                1e-9)
        << theta;
  }
}

/// Where one span pulls with 0, and where both pull alike, by signs along the cycle.
TEST_P(BeltOfTwoSizes, EndsWhereASpanIsSlack) {
  constexpr int tension = 20, steps = 7200;
  const double r2 = GetParam() / 1000.0;
  const Model model = Model::parse(belted("[30, " + std::to_string(GetParam()) + "]", tension));
  const auto over = [&](double theta) { return std::abs(BeltedFiveBar(theta, r2, tension).t) - 2 * tension; };
  std::vector<double> ends;
  for (int k = 0; k < steps; ++k) {
    double a = 360 * degree * k / steps, b = 360 * degree * (k + 1) / steps;
    if (over(a) * over(b) >= 0) continue;
    for (int i = 0; i < 60; ++i) (over(a) * over((a + b) / 2) > 0 ? a : b) = (a + b) / 2;
    ends.push_back(a);
  }
  ASSERT_GT(ends.size(), 1U);
  const LocusMap map = trace_loci(model);
  std::vector<double> found;
  for (const IsolatedPoint& point : map.isolated_points)
    if (point.cause.find("span of belt W") != std::string::npos) found.push_back(point.at[0]);
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), ends.size());
  for (std::size_t k = 0; k < ends.size(); ++k) EXPECT_NEAR(found[k], ends[k], 1e-9);
  EXPECT_EQ(validate_loci(model, {.nodes = {400}}).report.disputed, 0U);
}

INSTANTIATE_TEST_SUITE_P(OpenAndCrossed, BeltOfTwoSizes, ::testing::Values(15, -15, 10));

/// Over the cycle in one working mode: no zone in which the teeth would have to pull.
TEST(GearedFiveBar, ZonesAreThoseInWhichTheTeethPush) {
  const Zones zones = find_zones(shipped("geared_five_bar.yaml"));
  ASSERT_GT(zones.zones.size(), 2U);
  double size = 0;
  for (const Zone& zone : zones.zones) {
    const GearedFiveBar by_hand(zone.sample[0]);
    // In the file's mode the line of action goes down on the second wheel.
    EXPECT_GE(-by_hand.on_second() / moment(Vector2d(0.04, 0) - by_hand.O2, by_hand.line(-1, 20 * degree)), 0)
        << zone.id;
    size += zone.size;
  }
  constexpr int steps = 20000;
  int push = 0;
  for (int k = 0; k < steps; ++k) {
    const GearedFiveBar by_hand(360 * degree * (k + 0.5) / steps);
    push += by_hand.on_second() / moment(Vector2d(0.04, 0) - by_hand.O2, by_hand.line(-1, 20 * degree)) <= 0;
  }
  EXPECT_NEAR(size, 360 * degree * push / steps, 1e-2);
}

// The flank that bears holds the angle of the spring, so that no polynomial tells where it changes. Against a separate
// closure and statics.
TEST(GearedFiveBar, FlankWithATorsionSpringEndsTheReach) {
  const Model model = Model::read(source_dir() + "/tests/corpus/loci/geared_five_bar_with_torsion_spring.yaml");
  const core::LocusMap map = trace_loci(model);
  EXPECT_TRUE(map.complete);
  std::vector<double> ends, losses;
  for (const core::ReachableInterval& interval : map.reachable) {
    ends.push_back(interval.from / degree);
    ends.push_back(interval.to / degree);
  }
  for (const core::IsolatedPoint& point : map.isolated_points) {
    EXPECT_TRUE(point.certified);
    if (point.kind == core::LocusKind::backlash && point.vanishing.front().joint == "O1")
      losses.push_back(point.at.front() / degree);
  }
  EXPECT_THAT(ends, testing::Pointwise(testing::DoubleNear(0.005), {70.42, 189.97, 197.71, 222.61}));
  EXPECT_THAT(losses, testing::Pointwise(testing::DoubleNear(0.005), {91.19, 157.77, 167.94, 184.91, 202.98}));
}

TEST(BeltOverACycle, IsVerifiedWithinTheSlackOfItsSpans) {
  const Model model = Model::parse(belted("[30, 15]", 40));
  const auto slack = [](double theta) { return std::abs(BeltedFiveBar(theta, 0.015, 40).t) > 80; };
  ASSERT_TRUE(slack(60 * degree));
  ASSERT_FALSE(slack(100 * degree));
  const std::string task = "format: 1\npath: [[FROM deg], [TO deg]]\nloads_within: [{load: 1, radius: 5}]\n";
  const auto answer = [&](const std::string& from, const std::string& to) {
    return verify(model, parse_task(replaced(replaced(task, "FROM", from), "TO", to), model));
  };
  EXPECT_EQ(answer("100", "110").verdict, Verdict::verified);
  const Verification refuted = answer("50", "60");
  EXPECT_EQ(refuted.verdict, Verdict::refuted);
  ASSERT_TRUE(refuted.witness);
  EXPECT_EQ(refuted.witness->limit, "span of belt W");
}

TEST(ScaraBelt, BeltHoldsTheForearm) {
  const Model model = shipped("scara_belt.yaml");
  const Vector2d f(10, -25);
  for (const Vector2d& P : {Vector2d(0.25, 0.1), Vector2d(-0.1, 0.25), Vector2d(0.1, -0.2)}) {
    const double d = P.norm(), along = (d * d + 0.2 * 0.2 - 0.16 * 0.16) / (2 * d);
    const Vector2d u = P / d, E = along * u + std::sqrt(0.2 * 0.2 - along * along) * Vector2d(u(1), -u(0));
    const double belt = -moment(P - E, f);
    const Pose pose = solve_pose(model, {P(0), P(1)});
    EXPECT_NEAR(part(pose, "T", Quantity::M), belt, 1e-10);
    EXPECT_NEAR(part(pose, "M", Quantity::M), belt, 1e-10);
    EXPECT_NEAR(part(pose, "O", Quantity::M), -moment(P, f) - belt, 1e-10);
    // The belt draws the elbow to the shoulder with twice its tension.
    const Vector2d bearing = -f + 160 * E / 0.2;
    EXPECT_NEAR(part(pose, "E", Quantity::fx), bearing(0), 1e-8);
    EXPECT_NEAR(part(pose, "E", Quantity::fy), bearing(1), 1e-8);
  }
}

/// A span is slack where the belt carries more than 2 T0 r = 4 N m; the backlash is crossed where the forearm is along
/// the load.
TEST(ScaraBelt, SpansEndTheWorkspace) {
  const Model model = shipped("scara_belt.yaml");
  const LocusMap map = trace_loci(model, {.joints = {"T"}});
  const Vector2d f(10, -25);
  const auto couple_at = [&](const Vector2d& P) {
    const double d = P.norm(), along = (d * d + 0.2 * 0.2 - 0.16 * 0.16) / (2 * d);
    const Vector2d u = P / d,
                   E = along * u + std::sqrt(std::max(0.0, 0.2 * 0.2 - along * along)) * Vector2d(u(1), -u(0));
    return moment(P - E, f);
  };
  bool slack = false, crossed = false;
  for (const LocusCurve& curve : map.curves)
    for (const Arc& arc : curve.arcs)
      for (const auto& at : arc.points) {
        const double couple = std::abs(couple_at({at[0], at[1]}));
        if (curve.cause.find("span of belt T") != std::string::npos) {
          EXPECT_NEAR(couple, 4, 0.01);
          slack = true;
        }
        if (curve.kind == LocusKind::backlash) {
          EXPECT_NEAR(couple, 0, 0.01);
          crossed = true;
        }
      }
  EXPECT_TRUE(slack);
  EXPECT_TRUE(crossed);
  EXPECT_EQ(validate_loci(model, {.nodes = {80, 80}, .loci = {.joints = {"T"}}}).report.disputed, 0U);
}

}  // namespace
}  // namespace clearloci
