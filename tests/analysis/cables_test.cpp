// Tensions of cables (preload.md), held against the vertices of all feasible tensions: they are linear programs of
// few variables, and each vertex has as many cables at a bound as there are more than freedoms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "clearloci/errors.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/verify.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

/// Columns are the wrenches of unit tensions on the platform; balance: W t = -load, least <= t <= most.
struct CableStatics {
  Eigen::MatrixXd wrenches;
  Eigen::VectorXd load;
  double least = 0, most = 0;
};

/// The ranges of all tensions; none where there are no feasible ones.
std::vector<std::array<double, 2>> ranges_by_vertices(const CableStatics& statics) {
  const Eigen::Index n = statics.wrenches.rows(), m = statics.wrenches.cols();
  std::vector<std::array<double, 2>> ranges;
  for (unsigned set = 0; set < (1U << m); ++set) {  // the cables at a bound
    std::vector<Eigen::Index> free, bound;
    for (Eigen::Index k = 0; k < m; ++k) (((set >> k) & 1U) != 0U ? bound : free).push_back(k);
    if (static_cast<Eigen::Index>(free.size()) != n) continue;
    Eigen::MatrixXd basis(n, n);
    for (Eigen::Index k = 0; k < n; ++k) basis.col(k) = statics.wrenches.col(free[static_cast<std::size_t>(k)]);
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(basis);
    if (!lu.isInvertible()) continue;
    for (unsigned upper = 0; upper < (1U << bound.size()); ++upper) {
      Eigen::VectorXd t = Eigen::VectorXd::Zero(m);
      for (std::size_t b = 0; b < bound.size(); ++b)
        t(bound[b]) = ((upper >> b) & 1U) != 0U ? statics.most : statics.least;
      const Eigen::VectorXd solved = lu.solve(-statics.load - statics.wrenches * t);
      for (Eigen::Index k = 0; k < n; ++k) t(free[static_cast<std::size_t>(k)]) = solved(k);
      if (t.minCoeff() < statics.least - 1e-9 || t.maxCoeff() > statics.most + 1e-9) continue;
      if (ranges.empty()) ranges.assign(static_cast<std::size_t>(m), {statics.most, statics.least});
      for (Eigen::Index k = 0; k < m; ++k) {
        std::array<double, 2>& range = ranges[static_cast<std::size_t>(k)];
        range = {std::min(range[0], t(k)), std::max(range[1], t(k))};
      }
    }
  }
  return ranges;
}

/// With winches of 22 N, which leave parts of the workspace.
constexpr double weak = 22;

CableStatics point_statics(double x, double y) {
  CableStatics statics{Eigen::MatrixXd(2, 4), Eigen::Vector2d(0, -2 * 9.81), 5, weak};
  const std::array<Eigen::Vector2d, 4> anchors = {
      {Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, -1), Eigen::Vector2d(1, 1), Eigen::Vector2d(-1, 1)}};
  for (Eigen::Index k = 0; k < 4; ++k)
    statics.wrenches.col(k) = (anchors[static_cast<std::size_t>(k)] - Eigen::Vector2d(x, y)).normalized();
  return statics;
}

CableStatics platform_statics(double x, double y, double phi) {
  CableStatics statics{Eigen::MatrixXd(3, 4), Eigen::Vector3d(0, -20, 0), 5, 200};
  const std::array<Eigen::Vector2d, 4> anchors = {
      {Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, -1), Eigen::Vector2d(1, 1), Eigen::Vector2d(-1, 1)}};
  const std::array<Eigen::Vector2d, 4> places = {
      {Eigen::Vector2d(-0.2, 0.1), Eigen::Vector2d(0.2, 0.1), Eigen::Vector2d(0.2, -0.1), Eigen::Vector2d(-0.2, -0.1)}};
  const Eigen::Rotation2Dd turn(phi);
  for (Eigen::Index k = 0; k < 4; ++k) {
    const Eigen::Vector2d arm = turn * places[static_cast<std::size_t>(k)];
    const Eigen::Vector2d u = (anchors[static_cast<std::size_t>(k)] - Eigen::Vector2d(x, y) - arm).normalized();
    statics.wrenches.col(k) << u, arm.x() * u.y() - arm.y() * u.x();
  }
  return statics;
}

CableStatics robot_statics(const std::vector<double>& pose) {
  CableStatics statics{Eigen::MatrixXd(6, 8), Eigen::VectorXd::Zero(6), 5, 400};
  statics.load(2) = -50;
  const std::array<std::array<double, 6>, 8> sizes = {{{-2, -2, 0, 0.2, -0.2, 0.2},
                                                       {2, -2, 0, -0.2, -0.2, 0.2},
                                                       {2, 2, 0, -0.2, 0.2, 0.2},
                                                       {-2, 2, 0, 0.2, 0.2, 0.2},
                                                       {-2, -2, 3, -0.2, 0.2, -0.2},
                                                       {2, -2, 3, 0.2, 0.2, -0.2},
                                                       {2, 2, 3, 0.2, -0.2, -0.2},
                                                       {-2, 2, 3, -0.2, -0.2, -0.2}}};
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(pose[5], Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pose[4], Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(pose[3], Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  for (Eigen::Index k = 0; k < 8; ++k) {
    const auto& own_sizes = sizes[static_cast<std::size_t>(k)];
    const Eigen::Vector3d arm = turn * Eigen::Vector3d(own_sizes[3], own_sizes[4], own_sizes[5]);
    const Eigen::Vector3d u =
        (Eigen::Vector3d(own_sizes[0], own_sizes[1], own_sizes[2]) - Eigen::Vector3d(pose[0], pose[1], pose[2]) - arm)
            .normalized();
    statics.wrenches.col(k) << u, arm.cross(u);
  }
  return statics;
}

Model weak_point() {
  std::string text = example_text("cables/point");
  const std::string most = "[5, 100]";
  for (std::size_t at = text.find(most); at != std::string::npos; at = text.find(most, at))
    text.replace(at, most.size(), "[5, " + std::to_string(weak) + "]");
  return Model::parse(text, "m.yaml");
}

/// Both agree on feasibility and on every range; returns whether the pose is feasible.
bool expect_as_by_vertices(const Pose& pose, const CableStatics& statics) {
  const std::vector<std::array<double, 2>> expected = ranges_by_vertices(statics);
  EXPECT_EQ(static_cast<Eigen::Index>(pose.efforts.size()), statics.wrenches.cols());
  Eigen::VectorXd tensions(statics.wrenches.cols());
  for (std::size_t k = 0; k < pose.efforts.size(); ++k) {
    const FeasibleEfforts& efforts = pose.efforts[k];
    EXPECT_TRUE(efforts.cable);
    tensions(static_cast<Eigen::Index>(k)) = efforts.effort;
    EXPECT_EQ(efforts.ranges.empty(), expected.empty()) << efforts.joint;
    if (efforts.ranges.empty() || expected.empty()) continue;
    EXPECT_NEAR(efforts.ranges.front().from, expected[k][0], 1e-7 * statics.most) << efforts.joint;
    EXPECT_NEAR(efforts.ranges.front().to, expected[k][1], 1e-7 * statics.most) << efforts.joint;
    EXPECT_GE(efforts.effort, efforts.ranges.front().from - 1e-7 * statics.most);
    EXPECT_LE(efforts.effort, efforts.ranges.front().to + 1e-7 * statics.most);
  }
  // Whatever is chosen balances the load.
  EXPECT_LT((statics.wrenches * tensions + statics.load).norm(), 1e-8 * (statics.load.norm() + tensions.norm()));
  return !expected.empty();
}

TEST(Cables, OfAPointMassHaveTheTensionsOfLinearPrograms) {
  const Model model = weak_point();
  int feasible = 0, all = 0;
  for (double x = -0.87; x < 0.9; x += 0.21)
    for (double y = -0.88; y < 0.9; y += 0.21, ++all)
      feasible += expect_as_by_vertices(solve_pose(model, {x, y}), point_statics(x, y)) ? 1 : 0;
  EXPECT_GT(feasible, 20);
  EXPECT_GT(all - feasible, 20);
}

TEST(Cables, OfAPlatformHaveTheTensionsOfLinearPrograms) {
  const Model model = Model::parse(example_text("cables/platform"), "m.yaml");
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-0.8, 0.8), turn(-0.5, 0.5);
  int feasible = 0, all = 0;
  for (; all < 120; ++all) {
    const double scale = all % 2 == 0 ? 1 : 0.3;  // half of them near the middle
    const std::vector<double> at = {scale * place(random), scale * place(random), scale * turn(random)};
    feasible += expect_as_by_vertices(solve_pose(model, at), platform_statics(at[0], at[1], at[2])) ? 1 : 0;
  }
  EXPECT_GT(feasible, 20);
  EXPECT_GT(all - feasible, 3);
}

TEST(Cables, OfASpatialRobotHaveTheTensionsOfLinearPrograms) {
  const Model model = Model::parse(example_text("cables/robot"), "m.yaml");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1), turn(-0.26, 0.26);
  int feasible = 0, all = 0;
  for (; all < 30; ++all) {
    const double scale = all % 2 == 0 ? 1 : 0.4;
    const std::vector<double> at = {scale * place(random), scale * place(random), 1.5 + scale * place(random),
                                    scale * turn(random),  scale * turn(random),  scale * turn(random)};
    feasible += expect_as_by_vertices(solve_pose(model, at), robot_statics(at)) ? 1 : 0;
  }
  EXPECT_GT(feasible, 3);
  EXPECT_GT(all - feasible, 0);
}

Verification verdict_of(const Model& model, const std::string& box, const std::string& more = "preload: controlled\n") {
  return verify(model, parse_task("format: 1\nbox: " + box + "\n" + more, model), {.depth = VerifyDepth::verdict});
}

std::string interval(double from, double to) { return "[" + std::to_string(from) + ", " + std::to_string(to) + "]"; }

TEST(Cables, VerdictsOfBoxesAgreeWithGridsOfLinearPrograms) {
  const Model model = weak_point();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-0.85, 0.85), size(0.02, 0.3);
  std::map<Verdict, int> seen;
  for (int i = 0; i < 40; ++i) {
    const double x = place(random), y = place(random),
                 half = std::min({size(random), 0.9 - std::abs(x), 0.9 - std::abs(y)});
    const Verification answer =
        verdict_of(model, "{x: " + interval(x - half, x + half) + ", y: " + interval(y - half, y + half) + "}");
    bool all = true;
    for (int a = 0; a <= 12; ++a)
      for (int b = 0; b <= 12; ++b)
        all = all && !ranges_by_vertices(point_statics(x + half * (a / 6.0 - 1), y + half * (b / 6.0 - 1))).empty();
    ++seen[answer.verdict];
    EXPECT_TRUE(all || answer.verdict != Verdict::verified) << x << " " << y << " " << half;
    if (answer.verdict != Verdict::refuted) continue;
    ASSERT_TRUE(answer.witness);
    const std::vector<double>& at = answer.witness->at;
    EXPECT_TRUE(ranges_by_vertices(point_statics(at[0], at[1])).empty());
    EXPECT_FALSE(answer.witness->beyond_bound.empty());
  }
  EXPECT_GT(seen[Verdict::verified], 5);
  EXPECT_GT(seen[Verdict::refuted], 5);
  EXPECT_LE(seen[Verdict::undecided], 2);
}

TEST(Cables, OfAPlatformAreProvenAcrossTheSingularitiesOfEachChoice) {
  const Model model = Model::parse(example_text("cables/platform"), "m.yaml");
  EXPECT_EQ(verdict_of(model, "{x: [-0.1, 0.1], y: [-0.1, 0.1], phi: [-3 deg, 3 deg]}").verdict, Verdict::verified);
  const Verification beyond = verdict_of(model, "{x: [-0.75, 0.75], y: [-0.75, 0.75], phi: [-25 deg, 25 deg]}");
  ASSERT_EQ(beyond.verdict, Verdict::refuted);
  EXPECT_TRUE(ranges_by_vertices(platform_statics(beyond.witness->at[0], beyond.witness->at[1], beyond.witness->at[2]))
                  .empty());
}

TEST(Cables, GivenTensionsAreHeldAgainstTheBoundsOfTheOthers) {
  const Model model = Model::parse(example_text("cables/point"), "m.yaml");
  // With K3 and K4 at 40 N each the weight leaves some tension in both lower cables near the middle.
  const Model given = model.with({{"preload_K3", "40"}, {"preload_K4", "40"}});
  const Pose pose = solve_pose(given, {0, 0});
  const double lower = 40 - 2 * 9.81 / std::sqrt(2);
  for (const JointReaction& joint : pose.reactions) {
    ASSERT_EQ(joint.components.size(), 1U) << joint.joint;
    const bool upper = joint.joint == "K3" || joint.joint == "K4";
    EXPECT_NEAR(joint.components[0].value, upper ? 40 : lower, 1e-9) << joint.joint;
  }
  EXPECT_EQ(verdict_of(given, "{x: [-0.1, 0.1], y: [-0.1, 0.1]}", "").verdict, Verdict::verified);
  const Verification slack =
      verdict_of(model.with({{"preload_K3", "15"}, {"preload_K4", "15"}}), "{x: [-0.1, 0.1], y: [-0.1, 0.1]}", "");
  EXPECT_EQ(slack.verdict, Verdict::refuted);
  ASSERT_TRUE(slack.witness);
  EXPECT_EQ(slack.witness->kind, TaskWitness::Kind::beyond_bound);
  EXPECT_LT(*slack.witness->size, 5);
}

TEST(Cables, TensionsThatFollowALawAreTold) {
  const Model law = Model::parse(example_text("cables/point"), "m.yaml")
                        .with({{"preload_K3", "30"}, {"preload_K4", "20 N + 40 N/m*x"}});
  const std::array<Eigen::Vector2d, 4> ends = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0.2, -0.1), Eigen::Vector2d(-0.3, 0.4)}) {
    const Pose pose = solve_pose(law, {at(0), at(1)});
    ASSERT_EQ(pose.reactions.size(), 4U);
    Eigen::Vector2d sum(0, -2 * 9.81);
    for (std::size_t k = 0; k < 4; ++k) {
      ASSERT_EQ(pose.reactions[k].components.size(), 1U) << pose.reactions[k].joint;
      sum += pose.reactions[k].components[0].value * (ends[k] - at).normalized();
    }
    EXPECT_NEAR(pose.reactions[3].components[0].value, 20 + 40 * at(0), 1e-12);
    EXPECT_LT(sum.norm(), 1e-9);
  }
}

TEST(Cables, LawsKeepTheBoundsOfTheirTensions) {
  const Model model = Model::parse(example_text("cables/point"), "m.yaml");
  // A cable never pushes: K3 would be at -2 N.
  const Model pushing = model.with({{"preload_K3", "-2 N + 0.001 N/m*x"}, {"preload_K4", "60"}});
  EXPECT_NE(verdict_of(pushing, "{x: [-0.87, -0.83], y: [-0.02, 0.02]}", "").verdict, Verdict::verified);
  // K3 is at its least tension of 5 N at x = -0.5.
  const Model law = model.with({{"preload_K3", "35 N + 60 N/m*x"}, {"preload_K4", "40"}});
  EXPECT_EQ(verdict_of(law, "{x: [0, 0.02], y: [0, 0.02]}", "").verdict, Verdict::verified);
  EXPECT_EQ(verdict_of(law, "{x: [-0.51, -0.49], y: [0, 0.02]}", "").verdict, Verdict::refuted);
  EXPECT_EQ(solve_pose(law, {-0.45, 0}).beyond_limit, "");
  EXPECT_EQ(solve_pose(law, {-0.55, 0}).beyond_limit, "tension of cable K3 at 5 N");
  LociRequest request;
  const core::LocusMap map = trace_loci(law, request);
  const auto ends = [](const core::LocusCurve& curve) {
    return curve.kind == core::LocusKind::workspace_boundary && curve.cause == "limit: tension of cable K3 at 5 N";
  };
  ASSERT_TRUE(std::any_of(map.curves.begin(), map.curves.end(), ends));
  for (const core::LocusCurve& curve : map.curves)
    for (const core::Arc& arc : curve.arcs)
      for (const auto& vertex : arc.points) {
        if (ends(curve)) {
          EXPECT_NEAR(vertex[0], -0.5, 1e-9);
        }
        EXPECT_GE(vertex[0], -0.5 - 1e-9) << curve.id;
      }
}

TEST(Cables, OneConstantChoiceIsFoundForATask) {
  const Model model = Model::parse(example_text("cables/point"), "m.yaml");
  const Verification answer = verdict_of(model, "{x: [-0.1, 0.1], y: [-0.1, 0.1]}", "preload: constant\n");
  EXPECT_EQ(answer.verdict, Verdict::verified);
  ASSERT_TRUE(answer.preload && answer.preload->value);
  EXPECT_EQ(answer.preload->joints, (std::vector<std::string>{"K3", "K4"}));
}

std::string complaint_of(const std::string& text) {
  try {
    (void)Model::parse(text, "m.yaml");
  } catch (const InputError& error) {
    return error.problem();
  }
  return "none";
}

std::string with_part(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Cables, AreRefusedInOneLineWhereTheyAreWrong) {
  const std::string point = example_text("cables/point");
  const std::string first = "K1: {cable: [ground, load], at: [A1, P], tension: [5, 100]}";
  const auto complaint = [&](const std::string& candidate) { return complaint_of(with_part(point, first, candidate)); };
  EXPECT_THAT(complaint("K1: {cable: [ground, load], at: [P, A1], tension: [5, 100]}"),
              testing::HasSubstr("moves with"));
  EXPECT_THAT(complaint("K1: {cable: [ground, load], at: [A1, A2], tension: [5, 100]}"),
              testing::HasSubstr("no point of link load"));
  EXPECT_THAT(complaint("K1: {cable: [ground, load], at: [A1, P], tension: [-5, 100]}"),
              testing::HasSubstr("a cable pulls"));
  EXPECT_THAT(complaint("K1: {cable: [ground, load], at: [A1, P], tension: [100, 5]}"),
              testing::HasSubstr("empty or reversed"));
  EXPECT_THAT(complaint("K1: {cable: [ground, load], at: [A1, P]}"), testing::HasSubstr("tension"));
  EXPECT_THAT(complaint_of(with_part(point, "gravity:", "loads: [{link: load, couple: 1}]\ngravity:")),
              testing::HasSubstr("turns link load"));
}

}  // namespace
}  // namespace clearloci
