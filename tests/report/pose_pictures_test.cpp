// Pictures of tasks over poses and of zones by cells, of answers written by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "report/picture.hpp"
#include "report/task_panels.hpp"
#include "report/zones.hpp"

namespace clearloci::report {
namespace {

using core::Rational;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

core::Verification verified_box() {
  core::Verification verification;
  verification.mechanism = "a platform";
  verification.coordinates = {"x", "y", "phi"};
  verification.angles = {false, false, true};
  verification.verdict = core::Verdict::verified;
  verification.task.shape =
      core::TaskBox{{Rational(0), Rational(0), Rational(0)}, {Rational(1), Rational(2), Rational(1)}};
  verification.margin = 0.5;
  verification.angle_margin = 0.25;
  verification.nearest =
      core::NearestOfTask{"", core::LocusKind::backlash, {{"S1", core::Quantity::F, 1}}, {1.5, 1.0, 0.5}, 0.5};
  return verification;
}

TEST(PoseTaskPicture, SaysWhatItDraws) {
  const std::string svg = task_panels(verified_box(), PictureFormat::svg);
  EXPECT_TRUE(has(svg, "Task (box) with its margin, seen along the other coordinates"));
  EXPECT_TRUE(has(svg, "VERIFIED no locus, singularity or boundary in the task: proven\n"));
  EXPECT_TRUE(has(svg, "margin at least 0.5 m, proven, with the angles of the task\n"));
  EXPECT_TRUE(has(svg, "cross: nearest backlash F_S1 at x = 1.5 m"));
  EXPECT_FALSE(has(svg, "ring: "));
}

TEST(PoseTaskPicture, SaysWhatIsTooFarToBeDrawn) {
  core::Verification far = verified_box();
  far.nearest->at = {100, 1, 0.5};
  EXPECT_TRUE(has(task_panels(far, PictureFormat::svg), "beyond the picture: nearest"));
}

TEST(PoseTaskPicture, DrawsEveryShapeInEveryFormat) {
  core::Verification verification = verified_box();
  const auto expect_drawn = [&](const char* kind) {
    const std::string svg = task_panels(verification, PictureFormat::svg);
    EXPECT_TRUE(has(svg, std::string("Task (") + kind + ")"));
    EXPECT_FALSE(has(svg, "nan")) << kind;
    EXPECT_FALSE(has(svg, "inf")) << kind;
    EXPECT_EQ(svg, task_panels(verification, PictureFormat::svg));
    EXPECT_EQ(task_panels(verification, PictureFormat::pdf).substr(0, 5), "%PDF-");
    EXPECT_EQ(task_panels(verification, PictureFormat::png).substr(0, 8), "\x89PNG\r\n\x1A\n");
  };
  expect_drawn("box");
  verification.task.shape = core::TaskBall{{Rational(0), Rational(0), Rational(0)}, Rational(1)};
  expect_drawn("ball");
  verification.verdict = core::Verdict::refuted;
  verification.margin.reset(), verification.angle_margin.reset(), verification.nearest.reset();
  verification.witness.emplace().at = {0.5, 0, 0};
  verification.task.shape =
      core::TaskPath{{{Rational(0), Rational(0), Rational(0)}, {Rational(1), Rational(0), Rational(0)}}};
  expect_drawn("path");
  EXPECT_TRUE(has(task_panels(verification, PictureFormat::svg), "ring: witness x = 0.5 m"));
  verification.angles = {false, false, false};
  verification.task.shape = core::TaskMesh{
      "part.stl", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  expect_drawn("mesh");
  // One pose alone has no extent of its own.
  verification.coordinates = {"x"}, verification.angles = {false}, verification.witness->at = {0.5};
  verification.task.shape = core::TaskBox{{Rational(1, 2)}, {Rational(1, 2)}};
  expect_drawn("box");
}

core::Zones two_intervals() {
  core::Zones map;
  map.by_cells = true;
  map.loci.mechanism = "a crank";
  map.loci.tower.coordinates = {"theta"};
  map.loci.angles = {true};
  map.loci.lower = {0}, map.loci.upper = {Rational(std::numbers::pi)};
  map.grid = {8};
  map.modes.emplace_back().labels = {1, 1, 1, 1, 2, 2, 2, 2};
  core::ZoneEnd end{0.5 * std::numbers::pi, core::LocusKind::backlash, {{"O", core::Quantity::M, 1}}};
  end.jump = core::PoseError{{1e-5, 0}, {0}};
  core::Zone zone;
  zone.id = "z1", zone.assembly_mode = 1, zone.lower = {0}, zone.upper = {end.at - 1e-9}, zone.ends = {end};
  zone.ends.front().at = zone.upper.front();
  map.zones.push_back(zone);
  zone.id = "z2", zone.lower = {end.at + 1e-9}, zone.upper = {std::numbers::pi}, zone.ends = {end};
  zone.ends.front().at = zone.lower.front();
  map.zones.push_back(zone);
  return map;
}

TEST(CellZonePicture, OfAnIntervalTellsEachEndOnceWithItsJump) {
  const core::Zones map = two_intervals();
  const std::vector<std::string> lines = zone_end_lines(map, {});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines.front().substr(0, 6), "89.999");
  EXPECT_TRUE(has(lines.front(), "backlash M_O; the end effector jumps by (10, 0) µm and 0 deg"));
  const std::string svg = zone_picture(map, {}, PictureFormat::svg);
  EXPECT_TRUE(has(svg, "backlash M_O; the end effector jumps"));
}

TEST(CellZonePicture, NamesDoubtWhereThereIsAny) {
  core::Zones map = two_intervals();
  EXPECT_FALSE(has(zone_picture(map, {}, PictureFormat::svg), "in doubt"));
  map.modes.front().labels[3] = 0;
  map.modes.front().labels[7] = -1;
  const std::string svg = zone_picture(map, {}, PictureFormat::svg);
  EXPECT_TRUE(has(svg, "in doubt\n"));
  EXPECT_TRUE(has(svg, "white: out of reach\n"));
}

}  // namespace
}  // namespace clearloci::report
