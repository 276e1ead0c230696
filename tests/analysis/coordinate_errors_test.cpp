// Errors over a single coordinate and their jumps, through the public headers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "clearloci/error.hpp"
#include "clearloci/errors.hpp"
#include "clearloci/export.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "tests/source_dir.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

Model four_bar() { return Model::read(source_dir() + "/examples/four_bar.yaml"); }

const std::vector<double>& values_of(const ModeErrors& errors, const std::string& name) {
  for (const Field& field : errors.map.fields)
    if (field.name == name) return field.values;
  throw std::out_of_range(name);
}

TEST(CoordinateErrorsOfAModel, JumpAtTheLociByWhatTheirRowsSay) {
  const Errors errors = find_errors(four_bar(), {.grid = {360}});
  EXPECT_EQ(errors.loci.angles, (std::vector<bool>{true}));
  EXPECT_EQ(errors.loci.tower.coordinates, (std::vector<std::string>{"theta"}));
  ASSERT_EQ(errors.modes.size(), 1U);
  const ModeErrors& mode_errors = errors.modes.front();
  const std::vector<double>& at = mode_errors.map.axes.front();
  EXPECT_TRUE(std::is_sorted(at.begin(), at.end()));
  int jumps = 0;
  for (const ErrorEvent& event : mode_errors.events) {
    if (!event.jumps) continue;
    ++jumps;
    const auto row = std::find(at.begin(), at.end(), event.point.at.front()) - at.begin();
    ASSERT_LT(static_cast<std::size_t>(row), at.size()) << "the event has a row";
    const auto i = static_cast<std::size_t>(row);
    const std::vector<double>& dx = values_of(mode_errors, "dx");
    EXPECT_TRUE(std::isnan(dx[i])) << "lines are broken there";
    ASSERT_TRUE(i > 0 && i + 1 < at.size());
    EXPECT_NEAR(dx[i + 1] - dx[i - 1], event.jump.displacement[0], 1e-9);
  }
  EXPECT_GT(jumps, 0);
}

TEST(CoordinateErrorsOfAModel, SayTheUnitOfEveryColumn) {
  const Errors errors = find_errors(four_bar(), {.grid = {30}, .worst_case = false, .with_loci = false});
  const Table samples = samples_of(errors.modes.front());
  ASSERT_EQ(samples.units.size(), samples.names.size());
  const auto unit = [&](const std::string& name) {
    return samples.units[static_cast<std::size_t>(std::find(samples.names.begin(), samples.names.end(), name) -
                                                  samples.names.begin())];
  };
  EXPECT_EQ(unit("theta"), "rad");
  EXPECT_EQ(unit("fAx"), "N");
  EXPECT_EQ(unit("MA"), "N m");
  EXPECT_EQ(unit("beta_B"), "rad");
  EXPECT_EQ(unit("dx"), "m");
  EXPECT_EQ(unit("dalpha"), "rad");
  EXPECT_FALSE(samples.has("worst_dx"));
  EXPECT_EQ(errors.modes.front().map.fields.size(), 4U);
  EXPECT_EQ(samples.columns.front().size(), 31U) << "no events without loci";
}

/// The 3-UPU of the examples along x, at a slant to its legs.
Model upu_along_x() {
  std::string text = example_text("three_upu");
  const auto put = [&](const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
  };
  put("  y: [-0.4, 0.4]\n", "");
  put("  z: [0.3, 0.9]\n", "");
  put("workspace:", "parameters:\n  y: 0.13\n  z: 0.5\nworkspace:");
  return Model::parse(text);
}

TEST(CoordinateErrorsOfAModel, InSpaceAreThoseOfItsPoses) {
  const Model model = upu_along_x();
  const Errors errors = find_errors(model, {.grid = {40}});
  ASSERT_EQ(errors.modes.size(), 1U);
  const ModeErrors& mode_errors = errors.modes.front();
  const std::vector<double>& at = mode_errors.map.axes.front();
  const Table samples = samples_of(mode_errors);
  int compared = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double x = samples.at("dx")[i];
    if (!std::isfinite(x)) continue;
    const Pose pose = solve_pose(model, std::vector<double>{at[i]});
    ASSERT_TRUE(pose.error);
    const double scale = 1e-9 * pose.worst.distance;
    EXPECT_NEAR(x, pose.error->displacement[0], scale);
    EXPECT_NEAR(samples.at("dz")[i], pose.error->displacement[2], scale);
    EXPECT_NEAR(samples.at("dalpha_y")[i], pose.error->rotation[1], 1e-9 * pose.worst.angle);
    EXPECT_NEAR(samples.at("worst_dy")[i], pose.worst.displacement[1], scale);
    EXPECT_NEAR(samples.at("worst_dalpha_z")[i], pose.worst.rotation[2], 1e-9 * pose.worst.angle);
    const std::array axes = {"x", "y", "z"};
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(samples.at(std::string("d_V2_") + axes[c])[i], pose.take_up[5].displacement[c], 1e-12);
    ++compared;
  }
  EXPECT_GT(compared, 35);
}

TEST(CoordinateErrorsOfAModel, InSpaceJumpByWhatTheirRowsSay) {
  const Errors errors = find_errors(upu_along_x(), {.grid = {40}});
  const ModeErrors& mode_errors = errors.modes.front();
  const std::vector<double>& at = mode_errors.map.axes.front();
  int jumps = 0;
  for (const ErrorEvent& event : mode_errors.events) {
    if (!event.jumps) continue;
    ++jumps;
    const auto i = static_cast<std::size_t>(std::find(at.begin(), at.end(), event.point.at.front()) - at.begin());
    ASSERT_TRUE(i > 0 && i + 1 < at.size());
    ASSERT_EQ(event.jump.displacement.size(), 3U);
    ASSERT_EQ(event.jump.rotation.size(), 3U);
    const std::array places = {"dx", "dy", "dz"};
    double size = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::vector<double>& column = values_of(mode_errors, places[c]);
      EXPECT_NEAR(column[i + 1] - column[i - 1], event.jump.displacement[c], 1e-9);
      size = std::max(size, std::abs(event.jump.displacement[c]));
    }
    // A leg's force changes its sign: it is longer by twice the clearances along it, 25 um.
    EXPECT_GT(size, 1e-5);
  }
  EXPECT_GT(jumps, 0);
}

TEST(CoordinateErrorsOfAModel, LieInTheZonesBetweenTheirJumps) {
  const Errors errors = find_errors(four_bar(), {.grid = {200}, .with_zones = true});
  const ModeErrors& mode_errors = errors.modes.front();
  const std::vector<double>& at = mode_errors.map.axes.front();
  ASSERT_GT(mode_errors.zones.size(), 1U);
  std::vector<int> zones_of(at.size(), 0);
  for (const ZoneErrors& zone : mode_errors.zones) {
    ASSERT_FALSE(zone.cells.empty());
    for (const std::size_t cell : zone.cells) ++zones_of[cell];
    for (const ErrorEvent& event : mode_errors.events) {
      if (!event.jumps) continue;
      const double place = event.point.at.front();
      EXPECT_FALSE(at[zone.cells.front()] < place && place < at[zone.cells.back()]) << zone.zone << " at " << place;
    }
  }
  const auto alone = [](int count) { return count == 1; };
  EXPECT_GT(std::count_if(zones_of.begin(), zones_of.end(), alone), 190);
  EXPECT_EQ(*std::max_element(zones_of.begin(), zones_of.end()), 1);
}

TEST(CoordinateErrorsOfAModel, AreBoundsAloneWithoutALoad) {
  std::string text = example_text("four_bar");
  text.erase(text.find("\nloads:") + 1);
  const Errors errors = find_errors(Model::parse(text), {.grid = {40}});
  const ModeErrors& mode_errors = errors.modes.front();
  EXPECT_FALSE(mode_errors.never_loaded.empty());
  EXPECT_EQ(mode_errors.map.fields.size(), 4U);
  EXPECT_EQ(mode_errors.map.fields.front().name, "worst_dx");
  EXPECT_EQ(mode_errors.undefined, 0U);
  EXPECT_EQ(files_of(errors, {"svg"}).front().name, "error.svg");
  const Errors nothing = find_errors(Model::parse(text), {.grid = {40}, .worst_case = false});
  EXPECT_TRUE(nothing.modes.front().map.fields.empty());
  for (const ExportedFile& file : files_of(nothing, {"svg"})) EXPECT_NE(file.name, "error.svg");
}

TEST(CoordinateErrorsOfAModel, AreWholeWhereTheLociAreNotAndEndWithTheirTime) {
  ErrorRequest late{.grid = {20}, .with_loci = false};
  late.loci.deadline = std::chrono::steady_clock::now();
  EXPECT_THROW(find_errors(four_bar(), late), LimitReached);
}

TEST(Errors, AreRefusedInTheirOwnWordsOverSixCoordinates) {
  const Model model = Model::read(source_dir() + "/examples/gough_stewart_poses.yaml");
  try {
    find_errors(model);
    FAIL();
  } catch (const InputError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("errors"), std::string::npos) << words;
    EXPECT_EQ(words.find("loci are"), std::string::npos) << words;
  }
}

}  // namespace
}  // namespace clearloci
