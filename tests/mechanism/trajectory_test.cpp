// Trajectory files: what they mean, and what is said of wrong ones.
#include "mechanism/trajectory.hpp"

#include <gtest/gtest.h>

#include "mechanism/read.hpp"
#include "tests/source_dir.hpp"
#include "tests/texts.hpp"

namespace clearloci::mechanism {
namespace {

const std::string good = R"(format: 1
name: There and back
path:
  closed: true
  waypoints:
    - {name: pick, at: [0, -0.7], dwell: 1/20}
    - {at: [0, -L - 0.1], corner: 0.02}
    - {at: [d, -0.6], corner: L/25}
    - {name: place, at: [d, -0.7], stop: true, duration: 0.3}
motion: {law: s-curve, accelerating: 2/5, jerking: 1/3}
period: 0.76
payload:
  - {link: PB2, at: P, mass: 10, inertia: 0.05, picked: pick, placed: place}
)";

const Mechanism& five_bar() {
  static const Mechanism mechanism = read_mechanism(source_dir() + "/examples/five_bar.yaml");
  return mechanism;
}

Trajectory parse(const std::string& text) { return parse_trajectory(text, "path.yaml", five_bar()); }

TEST(Trajectory, IsReadExactly) {
  const Trajectory t = parse(good);
  EXPECT_EQ(t.name, "There and back");
  EXPECT_TRUE(t.closed);
  EXPECT_FALSE(t.smooth);
  ASSERT_EQ(t.waypoints.size(), 4u);
  EXPECT_TRUE(t.waypoints[0].stop);  // the first always is
  EXPECT_EQ(t.waypoints[0].dwell, Rational(1, 20));
  EXPECT_EQ(t.waypoints[1].at[1], Rational(-3, 5));  // parameters of the mechanism
  EXPECT_EQ(t.waypoints[2].corner, Rational(1, 50));
  EXPECT_EQ(t.waypoints[3].duration, Rational(3, 10));
  EXPECT_EQ(t.law.kind, LawKind::s_curve);
  EXPECT_EQ(t.law.accelerating, Rational(2, 5));
  EXPECT_EQ(t.period, Rational(19, 25));
  ASSERT_EQ(t.payloads.size(), 1u);
  EXPECT_EQ(t.payloads[0].mass, 10);
  EXPECT_EQ(t.payloads[0].picked, 0);
  EXPECT_EQ(t.payloads[0].placed, 3);
}

TEST(Trajectory, PointsMakeASmoothCurve) {
  const Trajectory t =
      parse("format: 1\npath: {points: [[0, -0.7], [0.2, -0.6], [0.4, -0.7]]}\nmotion: 3-4-5\nperiod: 2\n");
  EXPECT_TRUE(t.smooth);
  EXPECT_TRUE(t.waypoints.back().stop);
  EXPECT_EQ(t.name, "path");
}

struct Wrong {
  std::string what, by;     ///< in the good file
  std::string place, says;  ///< of the message
};

class WrongTrajectories : public testing::TestWithParam<Wrong> {};

TEST_P(WrongTrajectories, AreToldWhereAndHowToMendThem) {
  const Wrong& wrong = GetParam();
  try {
    parse(replaced(good, wrong.what, wrong.by));
    FAIL() << "accepted: " << wrong.by;
  } catch (const core::InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("path.yaml:" + wrong.place), std::string::npos) << message;
    EXPECT_NE(message.find(wrong.says), std::string::npos) << message;
    EXPECT_FALSE(error.mend().empty());
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongTrajectories,
    testing::Values(Wrong{"format: 1", "format: 2", "1:9", "reads format 1"},
                    Wrong{"period: 0.76", "period: 0", "11:9", "is zero"},
                    Wrong{"period: 0.76", "periode: 0.76", "11:1", "did you mean 'period'"},
                    Wrong{"period: 0.76\n", "", "1:1", "'period' is missing"},
                    Wrong{"law: s-curve", "law: s-curf", "10:15", "did you mean 's-curve'"},
                    Wrong{"law: s-curve", "law: cycloidal", "10:40", "no accelerating part"},
                    Wrong{"accelerating: 2/5", "accelerating: 3/5", "10:38", "more than half"},
                    Wrong{"accelerating: 2/5", "speed: 3", "10:31", "no speed to choose"},
                    Wrong{"law: s-curve, accelerating: 2/5, jerking: 1/3", "law: expression", "4:3", "needs no path"},
                    Wrong{"jerking: 1/3", "jerking: 0", "10:52", "is zero"},
                    Wrong{"at: [d, -0.6]", "at: [d]", "8:12", "the free coordinates are x, y"},
                    Wrong{"at: [d, -0.6]", "at: [d, -0.6, 0]", "8:12", "has 3 values"},
                    Wrong{"at: [d, -0.6]", "at: [d, east]", "8:16", "'east' is neither a number nor a parameter"},
                    Wrong{"at: [d, -0.6]", "at: [x, -0.6]", "8:13", "depends on the free coordinate"},
                    Wrong{"corner: 0.02", "corner: -0.02", "7:35", "is negative"},
                    Wrong{"corner: 0.02", "corner: 0.02, stop: true", "7:35", "rounded corner"},
                    Wrong{"corner: 0.02", "dwell: 0.02", "7:7", "neither dwell nor duration"},
                    Wrong{"at: [d, -0.6], corner: L/25", "at: [0, -0.6], corner: L/25", "8:7", "same place"},
                    Wrong{"name: place", "name: pick", "9:7", "two waypoints are called 'pick'"},
                    Wrong{"stop: true, duration: 0.3", "corner: 0.01", "13:71", "does not stop at place"},
                    Wrong{"placed: place", "placed: palce", "13:71", "did you mean 'place'"},
                    Wrong{"link: PB2", "link: ground", "13:12", "ground"},
                    Wrong{"link: PB2", "link: A1B1", "13:22", "point P is not on link A1B1"},
                    Wrong{"mass: 10", "mass: -1", "13:30", "is negative"},
                    Wrong{"placed: place", "placed: pick, at: B2", "13:77", "twice"},
                    Wrong{"picked: pick", "picked: place", "13:5", "placed where it is picked"},
                    Wrong{"closed: true", "closed: perhaps", "4:11", "neither true nor false"},
                    Wrong{"closed: true", "points: [[0, 0], [1, 1]]", "4:3", "either waypoints"},
                    Wrong{"dwell: 1/20", "dwell: 4/5", "6:7", "take up the whole period"}));

TEST(Trajectory, AnOpenPathHasNoWayBack) {
  const std::string open = replaced(good, "  closed: true\n", "");
  EXPECT_NO_THROW(parse(replaced(open, ", duration: 0.3", "")));
  EXPECT_THROW(parse(open), core::InputError);  // no stage begins at its end
  EXPECT_THROW(parse(replaced(replaced(open, ", duration: 0.3", ""), "picked: pick, placed: place",
                              "picked: place, placed: pick")),
               core::InputError);
}

TEST(Trajectory, AMissingFileIsNamed) {
  EXPECT_THROW(read_trajectory("/nowhere/path.yaml", five_bar()), core::InputError);
}

}  // namespace
}  // namespace clearloci::mechanism
