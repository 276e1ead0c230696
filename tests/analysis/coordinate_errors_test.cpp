// Errors over a single coordinate and their jumps, through the public headers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clearloci/error.hpp"
#include "clearloci/mechanism.hpp"

namespace clearloci {
namespace {

Model four_bar() { return Model::read(CLEARLOCI_SOURCE_DIR "/examples/four_bar.yaml"); }

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
    EXPECT_NEAR(dx[i + 1] - dx[i - 1], event.dx, 1e-9);
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

TEST(CoordinateErrorsOfAModel, WantOneCoordinate) {
  EXPECT_THROW(coordinate_errors(Model::read(CLEARLOCI_SOURCE_DIR "/examples/five_bar.yaml")), InputError);
}

}  // namespace
}  // namespace clearloci
