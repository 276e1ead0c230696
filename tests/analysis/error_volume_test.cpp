// Error volumes of a 3-RPR against the geometry of its legs: each is longer or shorter by the clearances along it.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include "clearloci/error.hpp"
#include "clearloci/errors.hpp"
#include "clearloci/mechanism.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

constexpr double degree = std::numbers::pi / 180;

Model example(const std::string& name) { return Model::read(source_dir() + "/examples/" + name + ".yaml"); }

const Field& field(const FieldMap& volume, const std::string& name) {
  for (const Field& field : volume.fields)
    if (field.name == name) return field;
  throw std::out_of_range(name);
}

struct Platform {
  Eigen::Matrix3d jacobian;  ///< row: a leg's length by x, y, phi
  Eigen::Vector3d forces;    ///< along the legs, + from foot to tip: the leg is pressed and pushes the platform
};

Platform three_rpr(double x, double y, double phi) {
  const std::array<Eigen::Vector2d, 3> feet = {Eigen::Vector2d(-0.8, -0.5), {0.8, -0.5}, {0, 0.9}};
  constexpr std::array<double, 3> turned = {210, -30, 80};
  Platform platform;
  for (int leg = 0; leg < 3; ++leg) {
    const double angle = phi + turned[static_cast<std::size_t>(leg)] * degree;
    const Eigen::Vector2d arm = 0.25 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d u = (Eigen::Vector2d(x, y) + arm - feet[static_cast<std::size_t>(leg)]).normalized();
    platform.jacobian.row(leg) << u[0], u[1], arm[0] * u[1] - arm[1] * u[0];
  }
  platform.forces = platform.jacobian.transpose().partialPivLu().solve(-Eigen::Vector3d(30, -100, 5));
  return platform;
}

TEST(ErrorVolume, OfA3RprIsThatOfItsLegsLengths) {
  const Errors errors = find_errors(example("three_rpr_orientation"), {.grid = {9, 8, 7}});
  ASSERT_EQ(errors.modes.size(), 1U);
  const FieldMap& volume = errors.modes.front().map;
  EXPECT_EQ(volume.coordinates, (std::vector<std::string>{"x", "y", "phi"}));
  EXPECT_EQ(volume.angles, (std::vector<bool>{false, false, true}));
  EXPECT_EQ(errors.modes.front().reachable, 9U * 8U * 7U);
  constexpr double play = 10e-6 + 5e-6 + 10e-6;  // both pins and the cylinder
  int compared = 0;
  for (std::size_t k = 0; k < 7; ++k)
    for (std::size_t j = 0; j < 8; ++j)
      for (std::size_t i = 0; i < 9; ++i) {
        const Platform platform = three_rpr(volume.axes[0][i], volume.axes[1][j], volume.axes[2][k]);
        if (std::abs(platform.jacobian.determinant()) < 1e-3) continue;
        ++compared;
        const auto inverse = platform.jacobian.inverse().eval();
        Eigen::Vector3d longer;
        for (int leg = 0; leg < 3; ++leg) longer[leg] = platform.forces[leg] > 0 ? -play : play;
        const Eigen::Vector3d moved = inverse * longer, most = inverse.cwiseAbs() * Eigen::Vector3d::Constant(play);
        const std::size_t cell = volume.index({i, j, k});
        const auto near = [&](const char* name, double expected) {
          EXPECT_NEAR(field(volume, name).values[cell], expected, 1e-10 * inverse.norm()) << name;
        };
        near("dx", moved[0]);
        near("dy", moved[1]);
        near("dalpha", moved[2]);
        near("worst_dx", most[0]);
        near("worst_dy", most[1]);
        near("worst_dalpha", most[2]);
      }
  EXPECT_GT(compared, 400);
}

TEST(ErrorVolume, HasSlicesAcrossEachCoordinate) {
  const Errors errors = find_errors(example("three_rpr_orientation"), {.grid = {5, 4, 3}, .worst_case = false});
  const FieldMap& volume = errors.modes.front().map;
  for (std::size_t across = 0; across < 3; ++across) {
    const FieldMap map = slice_of(volume, {across, 2});
    const std::size_t u = across == 0 ? 1 : 0, v = across == 2 ? 1 : 2;
    ASSERT_EQ(map.axes, (std::vector<std::vector<double>>{volume.axes[u], volume.axes[v]}));
    EXPECT_EQ(map.coordinates, (std::vector<std::string>{volume.coordinates[u], volume.coordinates[v]}));
    for (std::size_t j = 0; j < map.axes[1].size(); ++j)
      for (std::size_t i = 0; i < map.axes[0].size(); ++i) {
        std::array<std::size_t, 3> cell{};
        cell[across] = 2;
        cell[u] = i;
        cell[v] = j;
        for (std::size_t f = 0; f < map.fields.size(); ++f)
          EXPECT_EQ(map.fields[f].values[map.index({i, j})], volume.fields[f].values[volume.index(cell)]);
      }
  }
}

/// In a zone no leg's force changes its sign: by the closed form, which knows nothing of cells.
TEST(ErrorVolume, SharesItsCellsOutAmongZonesInWhichNoLegsForceTurns) {
  const Errors errors = find_errors(example("three_rpr_orientation"),
                                    {.grid = {9, 8, 7}, .worst_case = false, .with_zones = true, .zone_cells = 20'000});
  const ModeErrors& mode = errors.modes.front();
  ASSERT_GT(mode.zones.size(), 1U);
  std::vector<int> zones_of(mode.map.size(), 0);
  std::size_t cells = 0;
  for (const ZoneErrors& zone : mode.zones) {
    std::optional<Eigen::Array4d> signs;  // of the forces, and of the determinant of the legs' lines
    cells += zone.cells.size();
    for (const std::size_t cell : zone.cells) {
      EXPECT_EQ(++zones_of[cell], 1);
      const std::vector<double> at = mode.map.place(cell);
      const Platform platform = three_rpr(at[0], at[1], at[2]);
      Eigen::Array4d here;
      here << platform.forces.array(), platform.jacobian.determinant();
      here = here.sign();
      if (!signs) signs = here;
      EXPECT_TRUE((here == *signs).all()) << zone.zone << " at " << at[0] << ", " << at[1] << ", " << at[2];
    }
    if (!zone.cells.empty()) {
      EXPECT_LE(std::abs(zone.sizes.back()->largest), std::abs(mode.sizes.back()->largest));
    }
  }
  EXPECT_GT(cells, mode.map.size() / 3) << "most cells are not in doubt";
}

TEST(ErrorVolume, RefusesOtherNumbersOfCellsAndEndsWithItsTime) {
  EXPECT_THROW(find_errors(example("five_bar"), {.grid = {9, 8, 7}}), InputError);
  ErrorRequest late{.grid = {9, 8, 7}};
  late.loci.deadline = std::chrono::steady_clock::now();
  EXPECT_THROW(find_errors(example("three_upu"), late), LimitReached);
}

}  // namespace
}  // namespace clearloci
