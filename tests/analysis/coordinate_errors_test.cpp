// Errors over a single coordinate and their jumps, through the public headers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "clearloci/error.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

std::string example_text(const std::string& name) {
  std::ifstream file(source_dir() + "/examples/" + name + ".yaml");
  return {std::istreambuf_iterator<char>(file), {}};
}

Model four_bar() { return Model::read(source_dir() + "/examples/four_bar.yaml"); }

TEST(CoordinateErrorsOfAModel, JumpAtTheLociByWhatTheirRowsSay) {
  const CoordinateErrors errors = coordinate_errors(four_bar(), {.steps = 360});
  EXPECT_TRUE(errors.angle);
  EXPECT_EQ(errors.coordinate, "theta");
  ASSERT_EQ(errors.modes.size(), 1U);
  const CoordinateModeErrors& own = errors.modes.front();
  const std::vector<double>& at = own.samples.at("theta");
  EXPECT_TRUE(std::is_sorted(at.begin(), at.end()));
  int jumps = 0;
  for (const ErrorEvent& event : own.events) {
    if (!event.jumps) continue;
    ++jumps;
    const auto row = std::find(at.begin(), at.end(), event.point.at.front()) - at.begin();
    ASSERT_LT(static_cast<std::size_t>(row), at.size()) << "the event has a row";
    const auto i = static_cast<std::size_t>(row);
    const std::vector<double>& dx = own.samples.at("dx");
    EXPECT_TRUE(std::isnan(dx[i])) << "lines are broken there";
    ASSERT_TRUE(i > 0 && i + 1 < at.size());
    EXPECT_NEAR(dx[i + 1] - dx[i - 1], event.jump.displacement[0], 1e-9);
  }
  EXPECT_GT(jumps, 0);
}

TEST(CoordinateErrorsOfAModel, SayTheUnitOfEveryColumn) {
  const CoordinateErrors errors = coordinate_errors(four_bar(), {.steps = 30, .worst_case = false, .with_loci = false});
  const Table& samples = errors.modes.front().samples;
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
  EXPECT_EQ(errors.components.size(), 4U);
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
  const CoordinateErrors errors = coordinate_errors(model, {.steps = 40});
  ASSERT_EQ(errors.modes.size(), 1U);
  const CoordinateModeErrors& own = errors.modes.front();
  const std::vector<double>& at = own.samples.at("x");
  int compared = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double x = own.samples.at("dx")[i];
    if (!std::isfinite(x)) continue;
    const Pose pose = solve_pose(model, std::vector<double>{at[i]});
    ASSERT_TRUE(pose.error);
    const double scale = 1e-9 * pose.worst.distance;
    EXPECT_NEAR(x, pose.error->displacement[0], scale);
    EXPECT_NEAR(own.samples.at("dz")[i], pose.error->displacement[2], scale);
    EXPECT_NEAR(own.samples.at("dalpha_y")[i], pose.error->rotation[1], 1e-9 * pose.worst.angle);
    EXPECT_NEAR(own.samples.at("worst_dy")[i], pose.worst.displacement[1], scale);
    EXPECT_NEAR(own.samples.at("worst_dalpha_z")[i], pose.worst.rotation[2], 1e-9 * pose.worst.angle);
    const std::array axes = {"x", "y", "z"};
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(own.samples.at(std::string("d_V2_") + axes[c])[i], pose.take_up[5].displacement[c], 1e-12);
    ++compared;
  }
  EXPECT_GT(compared, 35);
}

TEST(CoordinateErrorsOfAModel, InSpaceJumpByWhatTheirRowsSay) {
  const CoordinateErrors errors = coordinate_errors(upu_along_x(), {.steps = 40});
  const CoordinateModeErrors& own = errors.modes.front();
  const std::vector<double>& at = own.samples.at("x");
  int jumps = 0;
  for (const ErrorEvent& event : own.events) {
    if (!event.jumps) continue;
    ++jumps;
    const auto i = static_cast<std::size_t>(std::find(at.begin(), at.end(), event.point.at.front()) - at.begin());
    ASSERT_TRUE(i > 0 && i + 1 < at.size());
    ASSERT_EQ(event.jump.displacement.size(), 3U);
    ASSERT_EQ(event.jump.rotation.size(), 3U);
    const std::array places = {"dx", "dy", "dz"};
    double size = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::vector<double>& column = own.samples.at(places[c]);
      EXPECT_NEAR(column[i + 1] - column[i - 1], event.jump.displacement[c], 1e-9);
      size = std::max(size, std::abs(event.jump.displacement[c]));
    }
    // A leg's force changes its sign: it is longer by twice the clearances along it, 25 um.
    EXPECT_GT(size, 1e-5);
  }
  EXPECT_GT(jumps, 0);
}

TEST(Errors, AreRefusedInTheirOwnWordsOverSixCoordinates) {
  const Model model = Model::read(source_dir() + "/examples/gough_stewart_poses.yaml");
  const auto words = [&](const auto& ask) -> std::string {
    try {
      ask(model, ErrorRequest{});
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  for (const std::string& own : {words([](const Model&m, const ErrorRequest&r) { error_map(m, r); }),
                                 words([](const Model&m, const ErrorRequest&r) { error_volume(m, r); }),
                                 words([](const Model&m, const ErrorRequest&r) { coordinate_errors(m, r); })}) {
    EXPECT_NE(own.find("errors"), std::string::npos) << own;
    EXPECT_EQ(own.find("loci are"), std::string::npos) << own;
  }
}

TEST(CoordinateErrorsOfAModel, WantOneCoordinate) {
  EXPECT_THROW(coordinate_errors(Model::read(source_dir() + "/examples/five_bar.yaml")), InputError);
}

}  // namespace
}  // namespace clearloci
