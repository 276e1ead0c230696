// The batched error maps against the plain route, pose by pose.
#include "numeric/error_map.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "core/errors.hpp"
#include "mechanism/read.hpp"
#include "tests/numeric/designs.hpp"

namespace clearloci::numeric {
namespace {

const core::Field& field(const core::FieldMap& map, const std::string& name) {
  for (const core::Field& f : map.fields)
    if (f.name == name) return f;
  throw std::out_of_range(name);
}

class ErrorMaps : public testing::TestWithParam<int> {};

mechanism::Mechanism design(int number) {
  switch (number) {
    case 0:
      return test::with_clearances(test::five_bar({.weighs = true}), 1e-5, 5e-4);
    case 1:
      return test::with_clearances(test::five_bar({.base_x = 0.7, .a1 = 0.6, .b1 = 0.45, .fx = 40, .couple = 2}), 1e-4,
                                   0);
    case 2:
      return test::with_clearances(test::three_rrr(0.3, 5, -8, 0.4, true), 1e-4, 1e-3);
    default:
      return test::with_clearances(test::driven_five_bar(4, -7, true), 2e-4, 1e-3);
  }
}

TEST_P(ErrorMaps, AgreeWithThePlainRoute) {
  const NumericModel model = compile(design(GetParam()));
  const auto mode = mechanism::working_mode(model.mechanism);
  const ErrorMap errors = error_map(model, mode, {.cells = {41, 23}});
  const core::FieldMap& map = errors.map;
  ASSERT_EQ(map.fields.size(), 8u);
  std::size_t compared = 0, reached = 0;
  for (std::size_t j = 0; j < 23; ++j) {
    for (std::size_t i = 0; i < 41; ++i) {
      const auto p = posture(model, std::array{map.axes[0][i], map.axes[1][j]}, mode);
      const auto value = [&](const char* name) { return field(map, name).values[map.index({i, j})]; };
      if (!p.reachable()) {
        EXPECT_TRUE(std::isnan(value("dx")) && std::isnan(value("worst_dp")));
        continue;
      }
      ++reached;
      const Accuracy a = pose_accuracy(model, p);
      if (a.reactions.condition > 1e6) continue;
      ++compared;
      const double slack = 1e-13 * a.reactions.condition * a.worst.distance;
      EXPECT_NEAR(value("dx"), a.error.dp[0], slack);
      EXPECT_NEAR(value("dy"), a.error.dp[1], slack);
      EXPECT_NEAR(value("dalpha"), a.error.dalpha[2], 10 * slack);
      EXPECT_NEAR(value("dp"), a.error.dp.norm(), slack);
      EXPECT_NEAR(value("worst_dx"), a.worst.dp[0], slack);
      EXPECT_NEAR(value("worst_dy"), a.worst.dp[1], slack);
      EXPECT_NEAR(value("worst_dalpha"), a.worst.dalpha[2], 10 * slack);
      EXPECT_LE(value("worst_dp"), a.worst.distance * (1 + 1e-9));
      EXPECT_GE(value("worst_dp"), a.worst.distance * (1 - 1.1e-4));
    }
  }
  EXPECT_EQ(reached, errors.reachable);
  EXPECT_GT(compared, 50u);
}

INSTANTIATE_TEST_SUITE_P(Designs, ErrorMaps, testing::Values(0, 1, 2, 3));

TEST(ErrorMap, IsTheSameForAnyNumberOfThreads) {
  const NumericModel model = compile(design(2));
  const auto mode = mechanism::working_mode(model.mechanism);
  const ErrorMap one = error_map(model, mode, {.cells = {30, 30}, .threads = 1});
  const ErrorMap two = error_map(model, mode, {.cells = {30, 30}, .threads = 2});
  for (std::size_t f = 0; f < one.map.fields.size(); ++f)
    for (std::size_t k = 0; k < one.map.fields[f].values.size(); ++k) {
      const double a = one.map.fields[f].values[k], b = two.map.fields[f].values[k];
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
    }
}

TEST(ErrorMap, NamesJointsThatNeverBearAnything) {
  // No load and no weight: every reaction is zero. The bound over all take-ups stands.
  const NumericModel model = compile(test::with_clearances(test::five_bar({.fy = 0}), 1e-5, 5e-4));
  const ErrorMap errors = error_map(model, mechanism::working_mode(model.mechanism), {.cells = {10, 10}});
  EXPECT_EQ(errors.never_loaded, (std::vector<std::string>{"A1", "B1", "P", "B2", "A2"}));
  EXPECT_EQ(errors.map.fields.front().name, "worst_dx");
}

TEST(ErrorMap, LeavesCellsOnALocusOut) {
  // A crank that lies along the x axis at y = 0, loaded along itself: its couple is zero on the middle row exactly.
  test::MechanismBuilder b;
  b.box(0.5, 1.5, -1.5, 1.5).point("O", 0, 0).point("P", test::symbol("x"), test::symbol("y"));
  b.link("crank", {"O", "P"}).joint("O", "ground", "crank", "O", true).clearance("O", 0, 1e-3);
  const NumericModel model = compile(b.end_effector("crank", "P").load("crank", "P", 5, 0).finish());
  const ErrorMap errors = error_map(model, {}, {.cells = {4, 3}});
  EXPECT_EQ(errors.reachable, 12u);
  EXPECT_EQ(errors.undefined, 4u);
  EXPECT_TRUE(std::isnan(field(errors.map, "dy").values[errors.map.index({0, 1})]));
  EXPECT_EQ(field(errors.map, "dalpha").values[errors.map.index({0, 0})], 1e-3 * 1);
  EXPECT_EQ(field(errors.map, "dalpha").values[errors.map.index({0, 2})], -1e-3 * 1);
}

TEST(ErrorMap, LeavesSingularCellsOutToRounding) {
  // 3-RPR whose base and whose platform are in line: |A| = 0 wherever phi = 0, and rounding leaves a pivot of noise.
  const NumericModel model = compile(mechanism::parse_mechanism(
      R"(format: 1
workspace: {x: [-0.5, 0.5], y: [-0.5, 0.5], phi: {angle: [-0.5, 0.5]}}
points:
  P: [x, y]
  A1: [-0.75, -0.5]
  A2: [0.75, -0.5]
  A3: [0, -0.5]
  B1: [x - cos(phi)/4, y - sin(phi)/4]
  B2: [x + cos(phi)/4, y + sin(phi)/4]
links:
  plate: {points: [P, B1, B2]}
  c1: {points: [A1]}
  c2: {points: [A2]}
  c3: {points: [A3]}
  r1: {points: [B1]}
  r2: {points: [B2]}
  r3: {points: [P]}
joints:
  A1: {revolute: [ground, c1], at: A1, clearance: {radial: 1e-5}}
  A2: {revolute: [ground, c2], at: A2, clearance: {radial: 1e-5}}
  A3: {revolute: [ground, c3], at: A3, clearance: {radial: 1e-5}}
  S1: {prismatic: [c1, r1], at: B1, axis: [A1, B1], actuated: true}
  S2: {prismatic: [c2, r2], at: B2, axis: [A2, B2], actuated: true}
  S3: {prismatic: [c3, r3], at: P, axis: [A3, P], actuated: true}
  B1: {revolute: [r1, plate], at: B1, clearance: {radial: 1e-5}}
  B2: {revolute: [r2, plate], at: B2, clearance: {radial: 1e-5}}
  B3: {revolute: [r3, plate], at: P, clearance: {radial: 1e-5}}
end_effector: {link: plate, at: P}
loads: [{link: plate, at: P, force: [10, -50], couple: 5}]
)",
      "in_line.yaml"));
  for (const bool worst_case : {false, true}) {
    const ErrorMap errors =
        error_map(model, mechanism::working_mode(model.mechanism), {.cells = {7, 8, 7}, .worst_case = worst_case});
    EXPECT_EQ(errors.reachable, 392u);
    EXPECT_EQ(errors.undefined, 56u);
    for (const core::Field& f : errors.map.fields)
      for (std::size_t k = 0; k < f.values.size(); ++k)
        EXPECT_EQ(std::isnan(f.values[k]), errors.map.cell(k)[2] == 3) << f.name << " " << k;
  }
}

TEST(ErrorMap, RefusesWhatHasNoMap) {
  EXPECT_THROW(error_map(compile(test::five_bar()), std::array{-1, 1}, {.cells = {4, 4}}), core::InputError)
      << "no clearance";
  const NumericModel model = compile(design(0));
  const auto mode = mechanism::working_mode(model.mechanism);
  EXPECT_THROW(error_map(model, mode, {.cells = {4}}), core::InputError) << "two coordinates";
  EXPECT_THROW(error_map(model, mode, {.cells = {4, 0}}), core::InputError);
  EXPECT_THROW(error_map(model, mode, {.cells = {4, 4}, .deadline = std::chrono::steady_clock::now()}),
               core::LimitReached);
}

}  // namespace
}  // namespace clearloci::numeric
