// What the pictures of a trajectory show: panels by size, errors magnified beside the path.
#include "report/trajectory_plots.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace clearloci::report {
namespace {

/// A metre to the right with an error of 10 um upwards; three pins under forces of 1000, 400 and 2 N, one with a motor.
core::TrajectoryResult along_a_metre() {
  core::TrajectoryResult result;
  result.mechanism = "Crane";
  result.trajectory = "across";
  result.law = "cycloidal";
  result.period = 1;
  result.length = 1;
  result.distance_unit = "m";
  result.joints = {"A", "B", "C"};
  result.stages = {{"1", "2", 0, 1, 0, 1, 1, 0, {}}};
  const std::vector<double> zero = {0, 0}, one = {1, 1};
  const auto add = [&](const char* name, const std::vector<double>& values) {
    result.samples.names.emplace_back(name);
    result.samples.units.emplace_back("");
    result.samples.columns.push_back(values);
  };
  add("time", {0, 1});
  add("distance", {0, 1});
  add("stage", one);
  add("px", {0, 1});
  add("py", zero);
  for (const char* name : {"px_rate", "py_rate", "px_acceleration", "py_acceleration", "dx", "dalpha"}) add(name, zero);
  add("dy", {1e-5, 1e-5});
  add("fAx", {600, 600});
  add("fAy", {-800, 800});
  add("fBx", {400, 400});
  add("fBy", zero);
  add("fCx", {2, 1});
  add("fCy", zero);
  add("MA", {3, 4});
  return result;
}

const Plot& named(const std::vector<NamedPlot>& plots, const std::string& name) {
  const auto found = std::find_if(plots.begin(), plots.end(), [&](const NamedPlot& one) { return one.name == name; });
  EXPECT_NE(found, plots.end()) << name;
  return found->plot;
}

TEST(TrajectoryPlots, EffortsOfOtherSizeHaveAPanelOfTheirOwn) {
  const auto plots = trajectory_plots(along_a_metre());
  const Plot& reactions = named(plots, "trajectory-reactions");
  ASSERT_EQ(reactions.panels.size(), 3U);
  ASSERT_EQ(reactions.panels[0].series.size(), 2U);
  EXPECT_EQ(reactions.panels[0].series[0].label, "f_A");
  EXPECT_EQ(reactions.panels[0].series[0].lines[0][1][1], 1000);
  EXPECT_EQ(reactions.panels[0].series[1].label, "f_B");
  ASSERT_EQ(reactions.panels[1].series.size(), 1U);
  EXPECT_EQ(reactions.panels[1].series[0].label, "f_C");
  EXPECT_EQ(reactions.panels[2].y_label, "M (N m)");
  // A colour a line, the same for the same joint.
  EXPECT_NE(reactions.panels[0].series[0].number, reactions.panels[0].series[1].number);
  EXPECT_EQ(reactions.panels[0].series[0].number, reactions.panels[2].series[0].number);
}

/// 10 um of 1 m are seen at a twentieth of the path: 5000 times, a step of 1, 2, 5.
TEST(TrajectoryPlots, TheActualPathIsMagnified) {
  const auto plots = trajectory_plots(along_a_metre());
  const PlotPanel& path = named(plots, "trajectory-path").panels.at(0);
  ASSERT_EQ(path.series.size(), 2U);
  EXPECT_EQ(path.series[0].label, "nominal");
  EXPECT_EQ(path.series[1].label, "actual, stage 1, errors × 5000");
  EXPECT_DOUBLE_EQ(path.series[1].lines[0][1][1], 0.05);
  EXPECT_DOUBLE_EQ(path.series[1].lines[0][1][0], 1);
}

TEST(TrajectoryPlots, ErrorsThatAreSeenAreNot) {
  core::TrajectoryResult result = along_a_metre();
  for (std::size_t i = 0; i < result.samples.names.size(); ++i)
    if (result.samples.names[i] == "dy") result.samples.columns[i] = {0.04, 0.04};
  const auto plots = trajectory_plots(result);
  EXPECT_EQ(named(plots, "trajectory-path").panels.at(0).series[1].label, "actual, stage 1");
}

}  // namespace
}  // namespace clearloci::report
