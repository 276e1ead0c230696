// Tasks of one to six coordinates, held against statics of the tests' own: forces along the legs of a platform, by
// lines through their joints.
#include "clearloci/verify.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>

#include "clearloci/errors.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "core/task.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

constexpr double degree = std::numbers::pi / 180;
using Pose = std::vector<double>;

Model hexapod() { return Model::read(source_dir() + "/examples/gough_stewart_poses.yaml"); }

Task hexapod_box(double length, double angle, const std::string& more = "", double z = 0.5) {
  std::string text = "format: 1\nbox:\n";
  for (const char* name : {"x", "y", "z"}) {
    const double middle = *name == 'z' ? z : 0.0;
    text += std::string("  ") + name + ": [" + std::to_string(middle - length) + ", " +
            std::to_string(middle + length) + "]\n";
  }
  for (const char* name : {"alpha", "beta", "gamma"})
    text += std::string("  ") + name + ": [" + std::to_string(-angle) + " deg, " + std::to_string(angle) + " deg]\n";
  return parse_task(text + more, hexapod());
}

/// Radii of the circles of joints, m.
struct Radii {
  double base = 0.5, plate = 0.3;
};

/// Forces on the platform along the legs, from base to platform, N: sum F u + load = 0, sum (B - P) x F u = 0.
Eigen::VectorXd leg_forces(const Pose& q, const Eigen::Vector3d& load = {0, 0, -1000}, const Radii& radii = {}) {
  const Eigen::Vector3d p(q[0], q[1], q[2]);
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(q[5], Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(q[4], Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(q[3], Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  constexpr std::array<double, 6> base = {-10, 10, 110, 130, 230, 250}, plate = {-50, 50, 70, 170, 190, 290};
  Eigen::Matrix<double, 6, 6> A;
  for (int i = 0; i < 6; ++i) {
    const double a = base[static_cast<std::size_t>(i)] * degree, b = plate[static_cast<std::size_t>(i)] * degree;
    const Eigen::Vector3d foot(radii.base * std::cos(a), radii.base * std::sin(a), 0);
    const Eigen::Vector3d arm = R * Eigen::Vector3d(radii.plate * std::cos(b), radii.plate * std::sin(b), 0);
    const Eigen::Vector3d u = (p + arm - foot).normalized();
    A.col(i) << u, arm.cross(u);
  }
  Eigen::Matrix<double, 6, 1> right;
  right << -load, 0, 0, 0;
  return A.partialPivLu().solve(right);
}

Pose pose_in(const Task& task, std::mt19937& random, double beyond = 0) {
  const auto& box = std::get<TaskBox>(task.shape);
  std::uniform_real_distribution<double> part(0, 1);
  Pose q;
  for (std::size_t c = 0; c < box.lower.size(); ++c) {
    // Half of the coordinates are at an end of their range: what is extreme is so there.
    const double t = part(random) < 0.5 ? std::round(part(random)) : part(random);
    const double low = to_double(box.lower[c]), high = to_double(box.upper[c]);
    q.push_back(low + t * (high - low) + beyond * (2 * part(random) - 1));
  }
  return q;
}

double least_over(const std::vector<LeastReaction>& all, const std::string& joint, bool proven) {
  for (const LeastReaction& reaction : all)
    if (reaction.reaction.joint == joint && reaction.reaction.quantity == Quantity::F)
      return proven ? reaction.proven : reaction.met;
  ADD_FAILURE() << "no least reaction of " << joint;
  return 0;
}

TEST(PoseTasks, SixCoordinatesOfAHexapodAreVerified) {
  const Task task = hexapod_box(0.05, 5, "angle_length: 0.2\n");
  const Verification answer = verify(hexapod(), task);
  ASSERT_TRUE(answer.verified());
  ASSERT_TRUE(answer.margin);
  EXPECT_GT(*answer.margin, 0.015);
  ASSERT_TRUE(answer.nearest);
  EXPECT_LE(*answer.margin, answer.nearest->distance);
  EXPECT_LT(leg_forces(answer.nearest->at).cwiseAbs().minCoeff(), 1e-3) << "what is nearest is a locus";
  std::mt19937 random(11);
  Eigen::VectorXd least = Eigen::VectorXd::Constant(6, 1e9);
  for (int i = 0; i < 20000; ++i) least = least.cwiseMin(leg_forces(pose_in(task, random)));
  for (int leg = 0; leg < 6; ++leg) {
    const std::string joint = "S" + std::to_string(leg + 1);
    EXPECT_GT(least_over(answer.least, joint, true), 0);
    EXPECT_LE(least_over(answer.least, joint, true), least[leg] * (1 + 1e-12)) << joint;
    EXPECT_GT(least_over(answer.least, joint, true), 0.8 * least[leg]) << joint;
  }
  // And around it: so far in lengths and angles together.
  const double part = *answer.margin / std::sqrt(6.0);
  for (int i = 0; i < 20000; ++i) {
    Pose q = pose_in(task, random);
    std::uniform_real_distribution<double> way(-1, 1);
    for (std::size_t c = 0; c < 6; ++c) q[c] += part * way(random) / (c < 3 ? 1 : 0.2);
    ASSERT_GT(leg_forces(q).minCoeff(), 0);
  }
}

TEST(PoseTasks, AWitnessIsReal) {
  const Task task = hexapod_box(0.15, 20);
  const Verification answer = verify(hexapod(), task);
  ASSERT_EQ(answer.verdict, Verdict::refuted);
  ASSERT_TRUE(answer.witness);
  const auto& box = std::get<TaskBox>(task.shape);
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_GE(answer.witness->at[c], to_double(box.lower[c]) - 1e-12);
    EXPECT_LE(answer.witness->at[c], to_double(box.upper[c]) + 1e-12);
  }
  EXPECT_LT(leg_forces(answer.witness->at).cwiseAbs().minCoeff(), 1e-6);
}

/// The first sample of the box is in its middle, where the load is zero but for rounding.
TEST(PoseTasks, ALoadThatTurnsRoundInTheMiddleFails) {
  const Model crank = Model::parse(R"(format: 1
workspace: {theta: {angle: [0, 360 deg], of: AB}}
drawn: {A: [0, 0], B: [0.3, 0.4]}
links: {AB: {points: [A, B]}}
joints: {A: {revolute: [ground, AB], at: A, actuated: true, clearance: {angular: 1e-3}}}
end_effector: {link: AB, at: B}
loads: [{link: AB, at: B, force: ['10*cos(theta)', '10*cos(theta)']}]
)",
                                   "crank.yaml");
  for (const char* box : {"[80 deg, 100 deg]", "[83 deg, 101 deg]"}) {
    const Task task = parse_task("format: 1\nbox: {theta: " + std::string(box) + "}\n", crank);
    EXPECT_EQ(verify(crank, task).verdict, Verdict::refuted) << box;
  }
}

TEST(PoseTasks, RandomBoxesOfAHexapodAreJudgedRight) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> length(0.01, 0.12), angle(1, 12), height(0.4, 0.6);
  int verified = 0, refuted = 0;
  for (int i = 0; i < 12; ++i) {
    const Task task = hexapod_box(length(random), angle(random), "min_force: 20\n", height(random));
    const Verification answer = verify(hexapod(), task, {.depth = VerifyDepth::verdict});
    if (answer.verified()) {
      ++verified;
      for (int k = 0; k < 2000; ++k) ASSERT_GE(leg_forces(pose_in(task, random)).minCoeff(), 0) << "task " << i;
    }
    if (answer.verdict != Verdict::refuted) continue;
    ++refuted;
    const double least = leg_forces(answer.witness->at).cwiseAbs().minCoeff();
    if (answer.witness->kind == TaskWitness::Kind::too_small)
      EXPECT_LT(least, 20) << "task " << i;
    else
      EXPECT_LT(least, 1e-6) << "task " << i;
  }
  EXPECT_GT(verified, 2);
  EXPECT_GT(refuted, 2);
  EXPECT_GE(verified + refuted, 11) << "hardly any stays open";
}

TEST(PoseTasks, ALoadMayTurnInSpace) {
  const std::string turning = "loads_from: [[100, 0, -1000], [0, 100, -1000]]\n";
  const Task task = hexapod_box(0.03, 3, turning);
  const Verification answer = verify(hexapod(), task, {.depth = VerifyDepth::verdict});
  ASSERT_TRUE(answer.verified());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 5000; ++i) {
    const double t = part(random);
    ASSERT_GT(leg_forces(pose_in(task, random), {100 * (1 - t), 100 * t, -1000}).minCoeff(), 0);
  }
  // From straight down to straight aside a leg loses its load on the way.
  const Verification other = verify(hexapod(), hexapod_box(0.001, 0.1, "loads_from: [[0, 0, -1000], [1000, 0, 0]]\n"));
  ASSERT_EQ(other.verdict, Verdict::refuted);
  ASSERT_EQ(other.witness->load.size(), 3U);
  const Eigen::Vector3d load(other.witness->load[0], other.witness->load[1], other.witness->load[2]);
  EXPECT_LT(leg_forces(other.witness->at, load).cwiseAbs().minCoeff(), 1e-6);
}

/// The hexapod over x and y alone, its platform level at a height.
Model slice_of_hexapod(const std::string& height) {
  std::ifstream file(source_dir() + "/examples/gough_stewart_poses.yaml");
  std::string text, line;
  while (std::getline(file, line))
    if (line.find(": {angle: ") == std::string::npos && line != "  z: [0.2, 0.8]") text += line + "\n";
  const std::string turned = "turned: [alpha, beta, gamma]", place = "P: [x, y, z]";
  text.replace(text.find(turned), turned.size(), "turned: [0, 0, 0]");
  text.replace(text.find(place), place.size(), "P: [x, y, " + height + "]");
  return Model::parse(text, "slice.yaml");
}

TEST(PoseTasks, ALoadMayTurnInASliceOfSpace) {
  const Model slice = slice_of_hexapod("1/2");
  const Task task = parse_task(
      "format: 1\ncircle: {centre: [0, 0], radius: 0.03}\nmargin: 0.002\n"
      "loads_from: [[100, 0, -1000], [0, 100, -1000]]\n",
      slice);
  ASSERT_TRUE(verify(slice, task, {.depth = VerifyDepth::verdict}).verified());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 3000; ++i) {
    const double t = part(random), r = 0.032 * std::sqrt(part(random)), a = 360 * degree * part(random);
    ASSERT_GT(leg_forces({r * std::cos(a), r * std::sin(a), 0.5, 0, 0, 0}, {100 * (1 - t), 100 * t, -1000}).minCoeff(),
              0);
  }
  // From straight down to straight aside a leg loses its load on the way; so does one of 1000 N that is asked for 150.
  for (const char* more : {"loads_from: [[0, 0, -1000], [1000, 0, 0]]\n",
                           "min_force: 150\nloads_from: [[0, 0, -1000], [300, 0, -1000]]\n"}) {
    const Verification other =
        verify(slice, parse_task(std::string("format: 1\nbox: {x: [0, 0.001], y: [0, 0.001]}\n") + more, slice));
    ASSERT_EQ(other.verdict, Verdict::refuted) << more;
    ASSERT_EQ(other.witness->load.size(), 3U);
    const Eigen::Vector3d load(other.witness->load.data());
    const Eigen::VectorXd legs =
        leg_forces({other.witness->at[0], other.witness->at[1], 0.5, 0, 0, 0}, load).cwiseAbs();
    if (!other.witness->size) {
      EXPECT_LT(legs.minCoeff(), 1e-6);
      continue;
    }
    // Nothing but its axial force goes through a leg.
    const TaskWitness& told = *other.witness;
    const int leg = (told.vanishing.empty() ? told.too_small : told.vanishing).front().joint.back() - '1';
    EXPECT_NEAR(legs[leg], *other.witness->size, 1e-6);
    EXPECT_LT(*other.witness->size, 150);
  }
  for (const char* wrong : {"path: [[0, 0], [0.01, 0]]\nloads_from: [[1, 0], [0, 1]]\n",
                            "circle: {centre: [0, 0], radius: 0.3}\nbox: {x: 0, y: 0}\n"})
    EXPECT_THROW(parse_task(std::string("format: 1\n") + wrong, slice), InputError) << wrong;
  // A polygon in that circle.
  const Task triangle = parse_task(
      "format: 1\npolygon: [[0, 0], [0.02, 0], [0, 0.02]]\nloads_from: [[100, 0, -1000], [0, 100, -1000]]\n", slice);
  EXPECT_TRUE(verify(slice, triangle, {.depth = VerifyDepth::verdict}).verified());
}

/// A load of 1000 N down, off by so much in a random direction; half of them as far off as may be.
Eigen::Vector3d load_within(double radius, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> part(0, 1);
  const Eigen::Vector3d way = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
  return Eigen::Vector3d(0, 0, -1000) + (part(random) < 0.5 ? 1 : part(random)) * radius * way;
}

TEST(PoseTasks, HoldForEveryDesignAndLoadThatIsAskedFor) {
  const Model slice = slice_of_hexapod("1/2");
  const std::string circle = "format: 1\ncircle: {centre: [0, 0], radius: 0.02}\n";
  const Task task = parse_task(
      circle + "tolerances: {base: 0.002, plate: [-0.003, 0.001]}\nloads_within: [{load: 1, radius: 60}]\n", slice);
  const Verification answer = verify(slice, task, {.depth = VerifyDepth::margin});
  ASSERT_TRUE(answer.verified());
  ASSERT_TRUE(answer.margin);
  EXPECT_GT(*answer.margin, 0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 3000; ++i) {
    const double r = (0.02 + *answer.margin) * std::sqrt(part(random)), a = 360 * degree * part(random);
    const Radii radii{0.498 + 0.004 * part(random), 0.297 + 0.004 * part(random)};
    ASSERT_GT(leg_forces({r * std::cos(a), r * std::sin(a), 0.5, 0, 0, 0}, load_within(60, random), radii).minCoeff(),
              0);
  }
  const Verification alone = verify(slice, parse_task(circle, slice), {.depth = VerifyDepth::margin});
  EXPECT_LT(*answer.margin, *alone.margin) << "other designs and loads leave less room";
}

// At a corner of the cube leg 2 bears 7.3 N under the load of the file, and -1.1 N under one that is 5 N off it.
// Halving poses and loads together told neither, since the middles of cells are under loads in the middle.
TEST(PoseTasks, TriesTheLoadsThatTakeMost) {
  const Model legs = Model::read(source_dir() + "/tests/corpus/verify/four_legs_load_ball.yaml");
  const auto verdict = [&](const std::string& radius) {
    return verify(legs,
                  parse_task("format: 1\nbox: {x: [-0.149691, -0.069691], y: [0.064230, 0.144230], z: [0.600944, "
                             "0.680944]}\nloads_within: [{load: 1, radius: " +
                                 radius + "}]\n",
                             legs),
                  {.depth = VerifyDepth::verdict});
  };
  EXPECT_TRUE(verdict("0.01").verified());
  const Verification answer = verdict("5");
  ASSERT_EQ(answer.verdict, Verdict::refuted);
  const Eigen::Vector3d load(answer.witness->loads.at(0).force.data());
  EXPECT_LE((load - Eigen::Vector3d(-25, -60, -100)).norm(), 5 * (1 + 1e-12));
}

TEST(PoseTasks, AWitnessIsAPoseADesignAndALoad) {
  const Model slice = slice_of_hexapod("1/2");
  const Verification answer =
      verify(slice, parse_task("format: 1\nbox: {x: [0, 0.01], y: [0, 0.01]}\ntolerances: {base: 0.002, plate: 0.001}\n"
                               "loads_within: [{load: 1, radius: 900}]\n",
                               slice));
  ASSERT_EQ(answer.verdict, Verdict::refuted);
  const TaskWitness& witness = *answer.witness;
  ASSERT_EQ(witness.design.size(), 2U);
  EXPECT_EQ(witness.design[0].first, "base");
  EXPECT_NEAR(witness.design[0].second, 0.5, 0.002 + 1e-12);
  EXPECT_NEAR(witness.design[1].second, 0.3, 0.001 + 1e-12);
  ASSERT_EQ(witness.loads.size(), 1U);
  ASSERT_EQ(witness.loads[0].force.size(), 3U);
  const Eigen::Vector3d load(witness.loads[0].force.data());
  EXPECT_LE((load - Eigen::Vector3d(0, 0, -1000)).norm(), 900 * (1 + 1e-12));
  ASSERT_EQ(witness.at.size(), 2U);
  const Radii radii{witness.design[0].second, witness.design[1].second};
  EXPECT_LT(leg_forces({witness.at[0], witness.at[1], 0.5, 0, 0, 0}, load, radii).cwiseAbs().minCoeff(), 1e-6);
}

TEST(PoseTasks, SixCoordinatesHaveRoomForOneTolerance) {
  const Task task = hexapod_box(0.02, 2, "tolerances: {plate: 0.001}\n");
  ASSERT_TRUE(verify(hexapod(), task, {.depth = VerifyDepth::verdict}).verified());
  std::mt19937 random(8);
  std::uniform_real_distribution<double> part(-1, 1);
  const Eigen::VectorXd middle = leg_forces({0, 0, 0.5, 0, 0, 0});
  for (int i = 0; i < 2000; ++i) {
    const Eigen::VectorXd legs = leg_forces(pose_in(task, random), {0, 0, -1000}, {0.5, 0.3 + 0.001 * part(random)});
    ASSERT_GT(legs.cwiseProduct(middle).minCoeff(), 0);
  }
  EXPECT_THROW(verify(hexapod(), hexapod_box(0.02, 2, "tolerances: {base: 0.001, plate: 0.001}\n")), InputError);
}

TEST(PoseTasks, APolygonIsTheBoxWhoseCornersItHas) {
  const Model model = Model::read(source_dir() + "/examples/three_rpr_orientation.yaml");
  int verified = 0;
  for (const char* const angles : {"box: {phi: [10 deg, 12 deg]", "box: {phi: [40 deg, 60 deg]"}) {
    const Task box = parse_task(std::string("format: 1\n") + angles + ", x: [0, 0.02], y: [0.01, 0.03]}\n", model);
    const Task polygon = parse_task(
        std::string("format: 1\npolygon: [[0, 0.01], [0.02, 0.01], [0.02, 0.03], [0, 0.03]]\n") + angles + "}\n",
        model);
    EXPECT_EQ(core::bounds(polygon.shape), core::bounds(box.shape));
    const Verification a = verify(model, polygon, {.depth = VerifyDepth::margin});
    const Verification b = verify(model, box, {.depth = VerifyDepth::margin});
    EXPECT_EQ(a.verdict, b.verdict) << angles;
    if (!a.verified() || !b.verified()) continue;
    ++verified;
    EXPECT_NEAR(*a.margin, *b.margin, 0.1 * *b.margin);
    EXPECT_NEAR(*a.angle_margin, *b.angle_margin, 0.1 * *b.angle_margin);
  }
  EXPECT_GT(verified, 0);
}

/// The zone is the circle of radius 1/4 about (1/4, 1/2).
TEST(PoseTasks, ACircleOverTwoLengthsGrowsToTheLociOfAFiveBar) {
  const Model model = Model::read(source_dir() + "/examples/five_bar.yaml");
  const Task task = parse_task("format: 1\ncircle: {centre: [1/4, 1/2], radius: 0.1}\n", model);
  const Verification grown = verify(model, task, {.depth = VerifyDepth::verdict, .fit = TaskFit::largest});
  ASSERT_TRUE(grown.verified() && grown.scaled_by);
  EXPECT_LE(*grown.scaled_by, Rational(5, 2));
  EXPECT_GT(*grown.scaled_by, Rational(245, 100));
  EXPECT_TRUE(verify(model, grown.task, {.depth = VerifyDepth::verdict}).verified()) << "by the other kernel, too";
}

TEST(PoseTasks, MarginsOfLengthsAndAnglesAreApartWithoutAMetric) {
  const Verification answer = verify(hexapod(), hexapod_box(0.02, 2));
  ASSERT_TRUE(answer.verified());
  ASSERT_TRUE(answer.margin && answer.angle_margin);
  EXPECT_GT(*answer.margin, 0.05);
  EXPECT_GT(*answer.angle_margin, 5 * degree);
}

TEST(PoseTasks, AnIntervalEndsAtTheLociOfAFourBar) {
  const Model model = Model::read(source_dir() + "/examples/four_bar.yaml");
  const LocusMap loci = trace_loci(model);
  double below = 0, above = 10;
  for (const IsolatedPoint& point : loci.isolated_points) {
    const double at = point.at.front();
    if (at < 70 * degree) below = std::max(below, at);
    if (at > 70 * degree) above = std::min(above, at);
  }
  const Task task = parse_task("format: 1\nbox: {theta: [70 deg, 80 deg]}\n", model);
  const Verification answer = verify(model, task);
  ASSERT_TRUE(answer.verified());
  ASSERT_TRUE(answer.angle_margin);
  const double room = std::min(70 * degree - below, above - 80 * degree);
  EXPECT_LE(*answer.angle_margin, room + 1e-12);
  EXPECT_GT(*answer.angle_margin, 0.9 * room);
  const Verification across = verify(model, parse_task("format: 1\npath: [50 deg, 80 deg]\n", model));
  ASSERT_EQ(across.verdict, Verdict::refuted);
  EXPECT_NEAR(across.witness->at.front(), below, 1e-9);
}

/// Random boxes and balls of other mechanisms, against reactions solved pose by pose: dyads, working modes, angles.
TEST(PoseTasks, TheNearestLocusOfAFourBarIsTheNearest) {
  const Model model = Model::read(source_dir() + "/examples/four_bar.yaml");
  const std::vector<IsolatedPoint> loci = trace_loci(model).isolated_points;
  const auto nearest = [&](double low, double high) {
    double least = std::numeric_limits<double>::infinity();
    for (const IsolatedPoint& point : loci)
      least = std::min(least, std::max({0.0, low - point.at.front(), point.at.front() - high}));
    return least;
  };
  int verified = 0;
  for (int i = 0; i < 24; ++i) {
    const double low = (15 * i + 1) * degree, high = low + 4 * degree;
    const std::string from = std::to_string(low) + " rad", to = std::to_string(high) + " rad";
    for (const std::string& shape :
         {"box: {theta: [" + from + ", " + to + "]}", "path: [[" + from + "], [" + to + "]]"}) {
      const Verification answer = verify(model, parse_task("format: 1\n" + shape + "\n", model));
      if (!answer.verified()) continue;
      ++verified;
      // Loci beyond the range of the file count too.
      EXPECT_LE(answer.nearest->distance, nearest(low, high) + 1e-5) << shape;
    }
  }
  EXPECT_GT(verified, 20);
}

class Sampled : public testing::TestWithParam<const char*> {};

TEST_P(Sampled, VerifiedTasksHaveNoChangeOfSign) {
  const Model model = Model::read(source_dir() + "/examples/" + GetParam() + ".yaml");
  const std::vector<Model::Coordinate> coordinates = model.coordinates();
  std::mt19937 random(17);
  std::uniform_real_distribution<double> part(0, 1);
  int verified = 0;
  for (int i = 0; i < 16; ++i) {
    std::string box;
    std::vector<std::array<double, 2>> ranges;
    for (const Model::Coordinate& c : coordinates) {
      const double width = c.upper - c.lower, size = 0.12 * part(random) * width;
      const double low = c.lower + part(random) * (width - size);
      ranges.push_back({low, low + size});
      box += (box.empty() ? "" : ", ") + c.name + ": [" + std::to_string(low) + ", " + std::to_string(low + size) + "]";
    }
    const Verification answer =
        verify(model, parse_task("format: 1\nbox: {" + box + "}\n", model), {.depth = VerifyDepth::verdict});
    if (answer.verdict == Verdict::refuted) {
      ASSERT_TRUE(answer.witness) << box;
      continue;
    }
    if (!answer.verified()) continue;
    ++verified;
    std::vector<double> poses;
    constexpr std::size_t samples = 60;
    for (std::size_t k = 0; k < samples; ++k)
      for (const auto& [low, high] : ranges) {
        const double t = part(random);
        poses.push_back(low + (t < 0.2 ? 0 : t > 0.8 ? 1 : t) * (high - low));
      }
    const Reactions all = reactions(model, poses);
    for (std::size_t column = 0; column < all.quantities.size(); ++column) {
      const bool effort = all.quantities[column] == Quantity::M || all.quantities[column] == Quantity::F;
      const std::vector<double>& values = all.table.columns[column];
      for (const double value : values) {
        ASSERT_TRUE(std::isfinite(value)) << box << " " << all.table.names[column];
        ASSERT_TRUE(!effort || value * values.front() > 0) << box << " " << all.table.names[column];
      }
    }
  }
  EXPECT_GT(verified, 2);
}

INSTANTIATE_TEST_SUITE_P(PoseTasks, Sampled,
                         testing::Values("three_ruu", "delta", "three_upu", "three_rpr_orientation", "four_bar",
                                         "stephenson_six_bar"),
                         [](const auto& test) { return test.param; });

TEST(PoseTasks, RefuseWhatHasNoMeaningInOneLine) {
  const Model model = hexapod();
  const auto complaint = [&](const std::string& text) {
    try {
      verify(model, parse_task("format: 1\n" + text, model));
    } catch (const InputError& error) {
      const std::string words = error.what();
      EXPECT_EQ(words.find('\n'), std::string::npos);
      return words;
    }
    return std::string("none");
  };
  const auto says = [&](const std::string& text, const std::string& words) {
    EXPECT_NE(complaint(text).find(words), std::string::npos) << complaint(text);
  };
  says("circle: {centre: [0, 0], radius: 0.1}\n", "circle lies in the plane");
  says("ball: {centre: [0, 0, 0.5, 0, 0, 0], radius: 0.1}\n", "has lengths and angles, but no angle_length");
  says("path: [[0, 0, 0.5], [0.1, 0, 0.5]]\n", "has 3 values, and 6 coordinates are free");
  says("box: {x: [0, 0.1]}\n", "y");
  says("box: {x: [0.1, 0], y: 0, z: 0.5, alpha: 0, beta: 0, gamma: 0}\n", "is empty");
  says("box: {x: [0, 3], y: 0, z: 0.5, alpha: 0, beta: 0, gamma: 0}\n", "leaves the mechanism's box");
  says("path: [[0, 0, 0.5, 0, 0, 0], [0.1, 0, 0.5, 0, 0, 0]]\ntolerances: {base: 0.001}\n", "cells have room for 7");
}

}  // namespace
}  // namespace clearloci
