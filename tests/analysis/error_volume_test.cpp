// Error volumes of a 3-RPR against the geometry of its legs: each is longer or shorter by the clearances along it.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <numbers>

#include "clearloci/error.hpp"
#include "clearloci/errors.hpp"
#include "clearloci/mechanism.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

constexpr double degree = std::numbers::pi / 180;

Model example(const std::string& name) { return Model::read(source_dir() + "/examples/" + name + ".yaml"); }

const Field& field(const FieldVolume& volume, const std::string& name) {
  for (const Field& own : volume.fields)
    if (own.name == name) return own;
  throw std::out_of_range(name);
}

struct Platform {
  Eigen::Matrix3d jacobian;  ///< row: a leg's length by x, y, phi
  Eigen::Vector3d forces;    ///< along the legs, + from foot to tip: the leg is pressed and pushes the platform
};

Platform three_rpr(double x, double y, double phi) {
  const std::array<Eigen::Vector2d, 3> feet = {Eigen::Vector2d(-0.8, -0.5), {0.8, -0.5}, {0, 0.9}};
  constexpr std::array<double, 3> turned = {210, -30, 80};
  Platform own;
  for (int leg = 0; leg < 3; ++leg) {
    const double angle = phi + turned[static_cast<std::size_t>(leg)] * degree;
    const Eigen::Vector2d arm = 0.25 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d u = (Eigen::Vector2d(x, y) + arm - feet[static_cast<std::size_t>(leg)]).normalized();
    own.jacobian.row(leg) << u[0], u[1], arm[0] * u[1] - arm[1] * u[0];
  }
  own.forces = own.jacobian.transpose().partialPivLu().solve(-Eigen::Vector3d(30, -100, 5));
  return own;
}

TEST(ErrorVolume, OfA3RprIsThatOfItsLegsLengths) {
  const VolumeErrors errors = error_volume(example("three_rpr_orientation"), {.cells = {9, 8, 7}});
  ASSERT_EQ(errors.modes.size(), 1U);
  const FieldVolume& volume = errors.modes.front().volume;
  EXPECT_EQ(volume.coordinates, (std::array<std::string, 3>{"x", "y", "phi"}));
  EXPECT_EQ(volume.angles, (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(errors.modes.front().reachable, 9U * 8U * 7U);
  constexpr double play = 10e-6 + 5e-6 + 10e-6;  // both pins and the cylinder
  int compared = 0;
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 9; ++i) {
        const Platform own = three_rpr(volume.at(0, i), volume.at(1, j), volume.at(2, k));
        if (std::abs(own.jacobian.determinant()) < 1e-3) continue;
        ++compared;
        const auto inverse = own.jacobian.inverse().eval();
        Eigen::Vector3d longer;
        for (int leg = 0; leg < 3; ++leg) longer[leg] = own.forces[leg] > 0 ? -play : play;
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
  const VolumeErrors errors = error_volume(example("three_rpr_orientation"), {.cells = {5, 4, 3}, .worst_case = false});
  const FieldVolume& volume = errors.modes.front().volume;
  for (std::size_t across = 0; across < 3; ++across) {
    const FieldMap map = slice_of(volume, across, 2);
    const std::size_t u = across == 0 ? 1 : 0, v = across == 2 ? 1 : 2;
    ASSERT_EQ(map.nx, volume.cells[u]);
    ASSERT_EQ(map.ny, volume.cells[v]);
    for (int j = 0; j < map.ny; ++j)
      for (int i = 0; i < map.nx; ++i) {
        std::array<int, 3> cell{};
        cell[across] = 2;
        cell[u] = i;
        cell[v] = j;
        EXPECT_EQ(map.x(i), volume.at(u, i));
        for (std::size_t f = 0; f < map.fields.size(); ++f)
          EXPECT_EQ(map.fields[f].values[map.index(i, j)], volume.fields[f].values[volume.index(cell)]);
      }
  }
}

TEST(ErrorVolume, RefusesOtherNumbersOfCoordinatesAndEndsWithItsTime) {
  EXPECT_THROW(error_volume(example("five_bar")), InputError);
  ErrorRequest late{.cells = {9, 8, 7}};
  late.loci.deadline = std::chrono::steady_clock::now();
  EXPECT_THROW(error_volume(example("three_upu"), late), LimitReached);
}

}  // namespace
}  // namespace clearloci
