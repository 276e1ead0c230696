// Tasks that are solids over three lengths, and tasks that are moved or scaled until they verify: held against forces
// along the legs of a platform, by the tests' own statics.
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <tuple>

#include "clearloci/errors.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/verify.hpp"
#include "core/task.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;

/// The hexapod over x, y, z, its platform level.
Model level_hexapod() {
  std::ifstream file(source_dir() + "/examples/gough_stewart_poses.yaml");
  std::string text, line;
  while (std::getline(file, line))
    if (line.find(": {angle: ") == std::string::npos) text += line + "\n";
  const std::string turned = "turned: [alpha, beta, gamma]";
  text.replace(text.find(turned), turned.size(), "turned: [0, 0, 0]");
  return Model::parse(text, "level.yaml");
}

/// Forces on the platform along the legs, N.
Eigen::VectorXd forces(const Vector3d& p) {
  constexpr std::array<double, 6> base = {-10, 10, 110, 130, 230, 250}, plate = {-50, 50, 70, 170, 190, 290};
  Eigen::Matrix<double, 6, 6> A;
  for (std::size_t i = 0; i < 6; ++i) {
    const double a = base[i] * degree, b = plate[i] * degree;
    const Vector3d arm(0.3 * std::cos(b), 0.3 * std::sin(b), 0);
    const Vector3d u = (p + arm - Vector3d(0.5 * std::cos(a), 0.5 * std::sin(a), 0)).normalized();
    A.col(static_cast<Eigen::Index>(i)) << u, arm.cross(u);
  }
  Eigen::Matrix<double, 6, 1> right;
  right << 0, 0, 1000, 0, 0, 0;
  return A.partialPivLu().solve(right);
}

double least_force(const Vector3d& p) { return forces(p).minCoeff(); }

using Tetrahedron = std::array<Vector3d, 4>;

/// An STL file in mm, whichever way its triangles turn.
Task task_of(const Tetrahedron& corners, const Model& model, const std::string& more = "") {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) /
      ("clearloci_pose_solids_" + std::to_string(::getpid()));  // tests run side by side
  std::filesystem::create_directories(folder);
  std::ofstream file(folder / "part.stl");
  file.precision(12);
  file << "solid part\n";
  for (const auto& [a, b, c] : {std::array{0, 1, 2}, std::array{0, 2, 3}, std::array{0, 3, 1}, std::array{1, 3, 2}}) {
    file << "facet normal 0 0 0\nouter loop\n";
    for (const int k : {a, b, c}) {
      const Vector3d p = 1000 * corners[static_cast<std::size_t>(k)];
      file << "vertex " << p.x() << " " << p.y() << " " << p.z() << "\n";
    }
    file << "endloop\nendfacet\n";
  }
  file << "endsolid part\n";
  file.close();
  Task task =
      parse_task("format: 1\nmesh: {file: part.stl, unit: mm}\n" + more, model, (folder / "task.yaml").string());
  std::filesystem::remove_all(folder);
  return task;
}

Vector3d inside(const Tetrahedron& corners, std::mt19937& random) {
  std::exponential_distribution<double> part(1);
  Vector3d sum = Vector3d::Zero();
  double all = 0;
  for (const Vector3d& corner : corners) {
    const double pow = std::pow(part(random), 3);  // towards corners and edges
    sum += pow * corner;
    all += pow;
  }
  return sum / all;
}

/// The least of the parts that make up a point: negative outside.
double depth(const Tetrahedron& corners, const Vector3d& p) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = corners[static_cast<std::size_t>(k) + 1] - corners[0];
  const Vector3d parts = edges.partialPivLu().solve(p - corners[0]);
  return std::min(parts.minCoeff(), 1 - parts.sum());
}

TEST(PoseSolids, RandomSolidsAreJudgedRight) {
  const Model model = level_hexapod();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> side(-0.16, 0.16), height(0.35, 0.6);
  int verified = 0, refuted = 0, only_in_the_solid = 0;
  for (int i = 0; i < 10; ++i) {
    Tetrahedron corners;
    for (Vector3d& corner : corners) corner = {side(random), side(random), height(random)};
    const Task task = task_of(corners, model, i % 3 == 0 ? "margin: 0.005\n" : "");
    const Verification answer = verify(model, task, {.depth = VerifyDepth::verdict});
    if (answer.verified()) {
      ++verified;
      for (int k = 0; k < 3000; ++k) ASSERT_GT(least_force(inside(corners, random)), 0) << i;
      Vector3d low = corners[0], high = corners[0];
      for (const Vector3d& corner : corners) {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
      }
      for (int k = 0; k < 8; ++k)
        if (least_force({k & 1 ? low.x() : high.x(), k & 2 ? low.y() : high.y(), k & 4 ? low.z() : high.z()}) < 0) {
          ++only_in_the_solid;
          break;
        }
    }
    if (answer.verdict != Verdict::refuted) continue;
    ++refuted;
    const auto& at = answer.witness->at;
    EXPECT_LT(forces({at[0], at[1], at[2]}).cwiseAbs().minCoeff(), 1e-6) << i;
    if (task.margin == 0) {
      EXPECT_GT(depth(corners, {at[0], at[1], at[2]}), -1e-9) << i;
    }
  }
  EXPECT_GT(verified, 2);
  EXPECT_GT(refuted, 2);
  EXPECT_GE(verified + refuted, 9);
  EXPECT_GT(only_in_the_solid, 0) << "else its box would do";
}

TEST(PoseSolids, AMarginIsMeasuredAroundThem) {
  const Model model = level_hexapod();
  const Tetrahedron corners = {Vector3d{-0.03, -0.03, 0.47}, {0.05, -0.02, 0.48}, {-0.02, 0.05, 0.5}, {0, 0, 0.54}};
  const Verification answer = verify(model, task_of(corners, model));
  ASSERT_TRUE(answer.verified());
  ASSERT_TRUE(answer.margin && answer.nearest);
  EXPECT_GT(*answer.margin, 0.01);
  EXPECT_LE(*answer.margin, answer.nearest->distance);
  std::mt19937 random(5);
  std::normal_distribution<double> way;
  for (int i = 0; i < 5000; ++i) {
    const Vector3d off = Vector3d(way(random), way(random), way(random)).normalized();
    ASSERT_GT(least_force(inside(corners, random) + *answer.margin * off), 0);
  }
}

TEST(PoseSolids, AreRefusedWhereTheyHaveNoMeaning) {
  const Model hexapod = Model::read(source_dir() + "/examples/gough_stewart_poses.yaml");
  const Tetrahedron corners = {Vector3d{0, 0, 0.5}, {0.1, 0, 0.5}, {0, 0.1, 0.5}, {0, 0, 0.6}};
  EXPECT_THROW(task_of(corners, hexapod), InputError);
  const Tetrahedron beyond = {Vector3d{0, 0, 0.5}, {0.4, 0, 0.5}, {0, 0.1, 0.5}, {0, 0, 0.6}};
  EXPECT_THROW(task_of(beyond, level_hexapod()), InputError);
  EXPECT_THROW(parse_task("format: 1\nmesh: {file: none.stl, unit: mm}\n", level_hexapod()), InputError);
  EXPECT_THROW(parse_task("format: 1\nmesh: {file: none.stl, unit: kg}\n", level_hexapod()), InputError);
}

TEST(PoseFits, AnIntervalIsMovedAndGrowsToTheLociOfAFourBar) {
  const Model model = Model::read(source_dir() + "/examples/four_bar.yaml");
  const LocusMap loci = trace_loci(model);
  double below = 0, above = 10;
  for (const IsolatedPoint& point : loci.isolated_points) {
    const double at = point.at.front();
    if (at < 70 * degree) below = std::max(below, at);
    if (at > 70 * degree) above = std::min(above, at);
  }
  const double middle = 70 * degree, room = std::min(middle - below, above - middle);
  const Verification grown =
      verify(model, parse_task("format: 1\nbox: {theta: [69 deg, 71 deg]}\n", model), {.fit = TaskFit::largest});
  ASSERT_TRUE(grown.verified() && grown.scaled_by);
  EXPECT_LE(*grown.scaled_by, room / degree + 1e-9);
  EXPECT_GT(*grown.scaled_by, 0.98 * room / degree);

  // Half of it on the other side of the locus below.
  const double from = below - 1 * degree, to = below + 1 * degree;
  const auto box = [&](double low, double high) {
    return parse_task("format: 1\nbox: {theta: [" + std::to_string(low / degree) + " deg, " +
                          std::to_string(high / degree) + " deg]}\n",
                      model);
  };
  const Verification moved = verify(model, box(from, to), {.fit = TaskFit::nearest});
  ASSERT_TRUE(moved.verified() && moved.moved_by);
  EXPECT_GE(std::abs(to_double(moved.moved_by->front())), 1 * degree - 1e-6);
  EXPECT_LT(std::abs(to_double(moved.moved_by->front())), 1.2 * degree);

  const Verification lies = verify(model, box(70 * degree, 71 * degree), {.fit = TaskFit::nearest});
  ASSERT_TRUE(lies.verified() && lies.moved_by);
  EXPECT_EQ(lies.moved_by->front(), 0);

  // The widest interval between loci has the most room.
  std::vector<double> at;
  for (const IsolatedPoint& point : loci.isolated_points) at.push_back(point.at.front());
  std::sort(at.begin(), at.end());
  double widest = 0;
  for (std::size_t i = 1; i < at.size(); ++i) widest = std::max(widest, at[i] - at[i - 1]);
  const Verification best = verify(model, box(70 * degree, 71 * degree), {.fit = TaskFit::best});
  ASSERT_TRUE(best.verified() && best.angle_margin);
  EXPECT_GT(*best.angle_margin, 0.8 * (widest / 2 - 1 * degree));
}

TEST(PoseFits, AWideIntervalIsMovedToTheGapThatHoldsIt) {
  const Model model = Model::read(source_dir() + "/examples/four_bar.yaml");
  std::vector<double> at;
  for (const IsolatedPoint& point : trace_loci(model).isolated_points) at.push_back(point.at.front());
  std::sort(at.begin(), at.end());
  double low = 0, high = 0;
  for (std::size_t i = 1; i < at.size(); ++i)
    if (at[i] - at[i - 1] > high - low) std::tie(low, high) = std::pair(at[i - 1], at[i]);
  // Nearly as wide as the widest gap, and off it by a quarter of its width: many places beside look good.
  const double width = high - low;
  const auto interval = [&](double from, double to) {
    return parse_task("format: 1\nbox: {theta: [" + std::to_string(from) + " rad, " + std::to_string(to) + " rad]}\n",
                      model);
  };
  const double off = low > width / 4 ? -width / 4 : width / 4;
  const Task task = interval(low + 0.05 * width + off, high - 0.05 * width + off);
  ASSERT_EQ(verify(model, task, {.depth = VerifyDepth::verdict}).verdict, Verdict::refuted);
  const Verification moved = verify(model, task, {.fit = TaskFit::nearest});
  ASSERT_TRUE(moved.verified() && moved.moved_by);
  EXPECT_NEAR(std::abs(to_double(moved.moved_by->front())), 0.2 * width, 0.002 * width);

  const Verification none = verify(model, interval(0.1, 6.1), {.fit = TaskFit::best});
  EXPECT_FALSE(none.verified());
  EXPECT_FALSE(none.moved_by);
  ASSERT_FALSE(none.notes.empty());
  EXPECT_NE(none.notes.back().find("no place was found"), std::string::npos);
}

TEST(PoseFits, ABoxOfAPlatformIsMovedOffALocus) {
  const Model model = Model::read(source_dir() + "/examples/three_rpr_orientation.yaml");
  std::mt19937 random(6);
  std::uniform_real_distribution<double> part(0, 1);
  const Task task = parse_task("format: 1\nbox: {x: [0.3, 0.33], y: [0.1, 0.13], phi: [-1 deg, 1 deg]}\n", model);
  ASSERT_EQ(verify(model, task, {.depth = VerifyDepth::verdict}).verdict, Verdict::refuted);
  const Verification answer = verify(model, task, {.fit = TaskFit::nearest});
  ASSERT_TRUE(answer.verified() && answer.moved_by);
  EXPECT_EQ((*answer.moved_by)[2], 0) << "it is moved, not turned";
  const auto& box = std::get<TaskBox>(answer.task.shape);
  std::vector<double> poses;
  for (int i = 0; i < 300; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double low = to_double(box.lower[c]), high = to_double(box.upper[c]);
      EXPECT_NEAR(low, to_double(std::get<TaskBox>(task.shape).lower[c] + (*answer.moved_by)[c]), 1e-12);
      poses.push_back(low + part(random) * (high - low));
    }
  const Reactions all = reactions(model, poses);
  for (std::size_t column = 0; column < all.quantities.size(); ++column)
    for (const double value : all.table.columns[column])
      ASSERT_TRUE(all.quantities[column] != Quantity::F || value * all.table.columns[column].front() > 0);
}

TEST(PoseFits, SolidsAreMovedAndScaled) {
  const TaskMesh mesh{"", {{1, 2, 3}, {2, 2, 3}, {1, 4, 3}, {1, 2, 7}}, {}};
  const auto moved = std::get<TaskMesh>(core::moved(mesh, {Rational(1), Rational(-2), Rational(1, 2)}));
  EXPECT_EQ(moved.corners[3], (std::array<double, 3>{2, 0, 7.5}));
  const auto bounds = core::bounds(mesh, {});
  EXPECT_EQ(bounds[1], (RationalPose{Rational(2), Rational(4), Rational(7)}));
  const auto scaled = std::get<TaskMesh>(core::placed(mesh, {Rational(1), Rational(3), Rational(5)}, Rational(2),
                                                      {Rational(1), Rational(3), Rational(5)}));
  EXPECT_EQ(scaled.corners[3], (std::array<double, 3>{1, 1, 9}));
}

}  // namespace
}  // namespace clearloci
