// Task files: what they mean, and what is said of wrong ones.
#include <gtest/gtest.h>

#include <map>

#include "core/task.hpp"
#include "five_bar_text.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_task.hpp"
#include "mechanism/write_task.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::mechanism {
namespace {

const Mechanism& example(const std::string& name) {
  static std::map<std::string, Mechanism> models;
  const auto found = models.find(name);
  if (found != models.end()) return found->second;
  return models.emplace(name, read_mechanism(source_dir() + "/examples/" + name + ".yaml")).first->second;
}

core::Task parse(const std::string& text) { return parse_task("format: 1\n" + text, "task.yaml", example("five_bar")); }

std::string complaint(const std::string& text, const std::string& mechanism = "five_bar") {
  try {
    (void)parse_task("format: 1\n" + text, "task.yaml", example(mechanism));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Task, IsReadExactly) {
  const core::Task task =
      parse("box: {x: [L/5, 0.4], y: [-0.8, -0.6]}\nmargin: 0.01\nloads_from: [[1, -100], [2, -1]]");
  const auto& box = std::get<core::TaskBox>(task.shape);
  EXPECT_EQ(box.lower, (core::RationalPose{core::Rational(1, 10), core::Rational(-4, 5)}));
  EXPECT_EQ(box.upper, (core::RationalPose{core::Rational(2, 5), core::Rational(-3, 5)}));
  EXPECT_EQ(task.margin, core::Rational(1, 100));
  ASSERT_TRUE(task.loads);
  EXPECT_EQ(task.loads->second[0], 2);
  EXPECT_FALSE(task.min_force);
}

TEST(Task, WrongOnesAreToldWhereAndHowToMendThem) {
  EXPECT_EQ(complaint("margin: 1"), "task.yaml:1:1: the task has no shape; write one of box, circle, polygon, path");
  EXPECT_EQ(complaint("path: []"), "task.yaml:2:7: the path has 0 points; write 2 at least: [[x, y], [x, y], ...]");
  EXPECT_EQ(complaint("box: {x: [0.4, 0.1], y: [-0.5, 0.3]}"),
            "task.yaml:2:10: the x of the box is empty: from 0.4 m to 0.1 m; write [lower, upper]");
  EXPECT_EQ(
      complaint("box: {x: [-0.3182, -0.3181], y: 0.1453}"),
      "task.yaml:2:33: the y of the box is a single number, and a box over two lengths has an area; write [lower, "
      "upper], or for a line path: [[-0.3182, 0.1453], [-0.3181, 0.1453]]");
  EXPECT_TRUE(complaint("box: {x: 0.1, y: 0.1453}").ends_with("has an area; write [lower, upper]"));
  EXPECT_EQ(complaint("polygon: [[0, -0.7], [0.5, -0.7], [0, -0.6], [0.5, -0.6]]"),
            "task.yaml:2:22: the polygon crosses itself: side 2; write its corners in their order round it");
  EXPECT_NE(complaint("polygon: [[0, -0.7], [0.5, -0.7], [0.2, -0.7]]").find("crosses itself"), std::string::npos);
  EXPECT_NE(complaint("path: [[0, -0.7], [1.5, -0.9]]").find("leaves the mechanism's box"), std::string::npos);
  EXPECT_NE(complaint("circle: {centre: [0, 0], radius: -1}").find("task.yaml:2:"), std::string::npos);
  EXPECT_NE(complaint("circle: {centre: [0, 0], radius: 1/4}\nbox: {x: [0, 1], y: [0, 1]}").find("leave one"),
            std::string::npos);
  EXPECT_NE(complaint("path: [[0, 0], [0, 0]]").find("the one before it again"), std::string::npos);
  EXPECT_NE(complaint("path: [[0, 0], [0, 0.1]]\nloads_from: [[1, 0], [-2, 0]]").find("no load at all"),
            std::string::npos);
  EXPECT_NE(complaint("bocks: 1").find("unknown key 'bocks'"), std::string::npos);
}

TEST(Task, HasAValueForEveryFreeCoordinate) {
  EXPECT_NE(complaint("path: [[0, 0], [0, 0.1]]", "four_bar").find("has 2 values, and 1 coordinates are free"),
            std::string::npos);
  EXPECT_EQ(complaint("path: [0, 0.1]", "four_bar"), "");
}

TEST(Task, ABallOfTwoLengthsIsACircle) {
  const auto ball = parse("ball: {centre: [0, 0], radius: 1/4}"),
             circle = parse("circle: {centre: [0, 0], radius: 1/4}");
  EXPECT_EQ(core::bounds(ball.shape), core::bounds(circle.shape));
  EXPECT_EQ(core::kind_of(ball.shape), "circle");
}

TEST(Task, APolygonGoesWithTheRangesOfTheAngles) {
  const std::string triangle = "polygon: [[0, 0], [0.01, 0], [0, 0.01]]\n";
  EXPECT_NE(complaint(triangle, "three_rrr_orientation").find("write their ranges too, as a box"), std::string::npos);
  EXPECT_NE(complaint(triangle, "four_bar").find("lies in the plane of two lengths"), std::string::npos);
}

TEST(Task, ConvexAndConcavePolygonsAreFine) {
  EXPECT_EQ(complaint("polygon: [[0, -0.7], [0.5, -0.7], [0.25, -0.6]]"), "");
  EXPECT_EQ(complaint("polygon: [[0, -0.7], [0.5, -0.7], [0.25, -0.6], [0, -0.7]]"), "")
      << "closed by its first corner";
  EXPECT_NE(complaint("polygon: [[0, -0.7], [0.5, -0.7], [0, -0.7]]").find("has two corners"), std::string::npos);
  EXPECT_EQ(complaint("polygon: [[0, -0.8], [0.5, -0.8], [0.5, -0.6], [0.25, -0.75], [0, -0.6]]"), "");
}

TEST(Task, OfAnglesWrittenReadsBackAsItself) {
  const Mechanism& m = example("three_rrr_orientation");
  for (const std::string shape :
       {"box: {x: [0, 0.1], y: [-1/7, 0], phi: [-0.25, 1/3]}", "path: [[0, 0, 0], [0.1, 0, 10 deg]]",
        "ball: {centre: [0, 0, 0.125], radius: 0.01}\nangle_length: 0.2",
        "polygon: [[0, 0], [0.1, 0], [0, 0.1]]\nbox: {phi: [0, 0.25]}"}) {
    const core::Task task = parse_task("format: 1\n" + shape + "\nmargin: 0.001\n", "t.yaml", m);
    const std::string text = task_text(task, m);
    const core::Task again = parse_task(text, "again.yaml", m);
    EXPECT_EQ(task_text(again, m), text);
    EXPECT_EQ(core::bounds(again.shape), core::bounds(task.shape)) << text;
    EXPECT_EQ(again.shape.index(), task.shape.index());
    EXPECT_EQ(again.margin, task.margin);
    EXPECT_EQ(again.angle_length, task.angle_length);
  }
}

TEST(Task, OfManyDesignsAndLoadsWrittenReadsBackAsItself) {
  const Mechanism& m = example("five_bar");
  const core::Task task = parse(
      "box: {x: [0, 0.1], y: [0.4, 0.5]}\ntolerances: {L: 0.1e-3, d: [-1/3000, 0]}\n"
      "loads_within: [{load: 1, radius: 20}]\npose_error: 1e-5\n");
  const core::Task again = parse_task(task_text(task, m), "again.yaml", m);
  ASSERT_EQ(again.tolerances.size(), 2U);
  EXPECT_EQ(again.tolerances[1].parameter, "d");
  EXPECT_EQ(again.tolerances[1].below, Rational(-1, 3000));
  EXPECT_EQ(again.tolerances[0].above, Rational(1, 10000));
  ASSERT_EQ(again.loads_within.size(), 1U);
  EXPECT_EQ(again.loads_within[0].force, 20);
  EXPECT_EQ(again.pose_error, task.pose_error);
}

TEST(Task, WrittenReadsBackAsItself) {
  const std::string in_mm = with(five_bar_text, "parameters:", "units: {length: mm, force: kN}\nparameters:");
  const Mechanism m = parse_mechanism(with(with(in_mm, "[-0.5, 1.0]", "[-500, 1000]"), "L: 0.5", "L: 500"), "m.yaml");
  const std::vector<std::string> shapes = {"box: {x: [-12.345678, 80], y: [1/3, 0.5]}",
                                           "circle: {centre: [0, 0.25], radius: 0.125}",
                                           "polygon: [[0, 0], [100, 0], [50, 0.75]]", "path: [[0, 0], [100, 0.5]]"};
  for (const std::string& shape : shapes) {
    const core::Task task =
        parse_task("format: 1\n" + shape + "\nmargin: 0.2\nmin_force: 0.003\nmin_couple: 2\n", "t.yaml", m);
    const std::string text = task_text(task, m);
    EXPECT_NE(text.find(shape.substr(0, shape.find(':'))), std::string::npos) << text;
    EXPECT_EQ(task_text(parse_task(text, "again.yaml", m), m), text);
    EXPECT_EQ(parse_task(text, "again.yaml", m).margin, task.margin);
    EXPECT_EQ(parse_task(text, "again.yaml", m).min_force, task.min_force);
    EXPECT_EQ(core::bounds(parse_task(text, "again.yaml", m).shape), core::bounds(task.shape)) << text;
  }
}

}  // namespace
}  // namespace clearloci::mechanism
