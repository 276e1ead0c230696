// Maps of the pose error through the public headers.
#include "clearloci/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

Model five_bar() { return Model::read(source_dir() + "/examples/five_bar.yaml"); }

std::size_t field(const FieldMap& map, const std::string& name) {
  const auto found = std::find_if(map.fields.begin(), map.fields.end(), [&](const Field& f) { return f.name == name; });
  EXPECT_NE(found, map.fields.end()) << name;
  return static_cast<std::size_t>(found - map.fields.begin());
}

TEST(ErrorMapOfAModel, HoldsWhatSinglePosesSay) {
  const Model model = five_bar();
  const Errors errors = find_errors(model, {.grid = {9, 7}});
  ASSERT_EQ(errors.modes.size(), 1U);
  const ModeErrors& mode_errors = errors.modes.front();
  EXPECT_FALSE(errors.loci.curves.empty());
  std::size_t reachable = 0;
  for (std::size_t j = 0; j < 7; ++j)
    for (std::size_t i = 0; i < 9; ++i) {
      const std::size_t cell = mode_errors.map.index({i, j});
      EXPECT_EQ(mode_errors.map.cell(cell), (std::array<std::size_t, 3>{i, j, 0}));
      const Pose pose = solve_pose(model, mode_errors.map.place(cell));
      const auto value = [&](const char* name) {
        return mode_errors.map.fields[field(mode_errors.map, name)].values[cell];
      };
      if (!pose.unreachable.empty()) {
        EXPECT_TRUE(std::isnan(value("worst_dp")));
        continue;
      }
      ++reachable;
      EXPECT_NEAR(value("worst_dp"), pose.worst.distance, 1e-8 * pose.worst.distance);
      if (!pose.error || !std::isfinite(value("dx"))) continue;
      EXPECT_NEAR(value("dx"), pose.error->displacement[0], 1e-8 * pose.worst.distance);
    }
  EXPECT_EQ(mode_errors.reachable, reachable);
}

TEST(ErrorMapOfAModel, HasSizesOfEveryField) {
  const Errors errors = find_errors(five_bar(), {.grid = {20, 20}, .with_loci = false});
  const ModeErrors& mode_errors = errors.modes.front();
  EXPECT_TRUE(errors.loci.curves.empty());
  ASSERT_EQ(mode_errors.sizes.size(), mode_errors.map.fields.size());
  for (std::size_t f = 0; f < mode_errors.sizes.size(); ++f) {
    ASSERT_TRUE(mode_errors.sizes[f]);
    const ErrorSizes& sizes = *mode_errors.sizes[f];
    EXPECT_LE(sizes.median, sizes.percentile_90);
    EXPECT_LE(sizes.percentile_90, sizes.percentile_99);
    EXPECT_LE(sizes.percentile_99, std::abs(sizes.largest));
    const std::vector<double>& values = mode_errors.map.fields[f].values;
    EXPECT_EQ(values[sizes.at], sizes.largest);
    EXPECT_TRUE(
        std::all_of(values.begin(), values.end(), [&](double v) { return !(std::abs(v) > std::abs(sizes.largest)); }));
  }
}

TEST(ErrorMapOfAModel, SharesItsCellsOutAmongTheZones) {
  const Errors errors = find_errors(five_bar(), {.grid = {30, 40}, .worst_case = false, .with_zones = true});
  const ModeErrors& mode_errors = errors.modes.front();
  ASSERT_GT(mode_errors.zones.size(), 1U);
  std::vector<std::size_t> cells;
  for (const ZoneErrors& zone : mode_errors.zones) {
    EXPECT_EQ(zone.sizes.size(), mode_errors.map.fields.size());
    cells.insert(cells.end(), zone.cells.begin(), zone.cells.end());
  }
  std::sort(cells.begin(), cells.end());
  EXPECT_EQ(std::adjacent_find(cells.begin(), cells.end()), cells.end()) << "a cell lies in one zone";
  for (const std::size_t cell : cells) EXPECT_LT(cell, 30U * 40U);
  // All but the cells whose middle is on a locus to rounding.
  EXPECT_LE(cells.size(), mode_errors.reachable);
  EXPECT_GE(cells.size() + 5, mode_errors.reachable);
}

TEST(ErrorMapOfAModel, IsMadeForEveryModeAskedFor) {
  const Errors errors =
      find_errors(five_bar(), {.grid = {8, 8}, .with_loci = false, .loci = {.all_working_modes = true}});
  ASSERT_EQ(errors.modes.size(), 4U);
  for (const ModeErrors& mode_errors : errors.modes)
    EXPECT_EQ(describe_mode(errors.loci.tower, mode_errors.mode).size(), 2U);
}

TEST(ErrorMapOfAModel, RefusesZonesWithoutLoci) {
  EXPECT_THROW(find_errors(five_bar(), {.with_loci = false, .with_zones = true}), InputError);
}

}  // namespace
}  // namespace clearloci
