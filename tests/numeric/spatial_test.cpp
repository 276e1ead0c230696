// Spatial mechanisms in floating point by two routes: one LU of the orthonormal form (reactions.hpp), and the compiled
// Cartesian form with the equations of what joints do not bear (equations.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mechanism/read.hpp"
#include "numeric/evaluator.hpp"
#include "numeric/reactions.hpp"
#include "tests/numeric/solved.hpp"
#include "tests/numeric/spatial_designs.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::numeric {
namespace {

using core::Quantity;
using mechanism::Mechanism;

constexpr unsigned seed = 20260501;

Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
}

std::vector<double> random_pose(const Mechanism& m, std::mt19937& random) {
  std::vector<double> pose;
  for (const auto& c : m.coordinates)
    pose.push_back(std::uniform_real_distribution<double>(core::to_double(c.lower), core::to_double(c.upper))(random));
  return pose;
}

/// Elbows and carriages to any side.
std::vector<int> any_mode(const Mechanism& m, std::mt19937& random) {
  std::vector<int> mode = mechanism::working_mode(m);
  for (int& side : mode)
    if (random() % 2 == 0) side = -side;
  return mode;
}

void expect_same_reactions(const Mechanism& m, std::mt19937& random) {
  SCOPED_TRACE(m.name);
  const NumericModel model = compile(m);
  const std::vector<int> mode = any_mode(m, random);
  int held = 0;
  for (int sample = 0; sample < (mode.empty() ? 8 : 40); ++sample) {
    const std::vector<double> pose = random_pose(m, random);
    const test::Solved plain = test::solved(m, pose, mode);
    EXPECT_EQ(plain.unreachable.has_value(), !reachable(model, pose, mode));
    if (plain.unreachable) continue;
    ++held;
    ASSERT_LT(plain.residual, 1e-12);
    if (plain.condition > 1e9) continue;
    const BoundedNumerators compiled = bounded_numerators(model, pose, mode);
    ASSERT_TRUE(compiled.reachable);
    const double det = compiled.determinant.value;
    EXPECT_NEAR(det, plain.determinant, 1e-9 * std::abs(plain.determinant));
    EXPECT_LE(compiled.determinant.error, 1e-6 * std::abs(det));
    double largest = 1;
    for (const auto& r : plain.reactions) largest = std::max({largest, r.force.norm(), std::abs(r.actuator)});
    const double tolerance = 1e-14 * plain.condition * largest;
    for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
      const auto& unknown = model.unknowns[k];
      const auto j = static_cast<std::size_t>(unknown.joint);
      const JointReaction& r = plain.reactions[j];
      const double value = compiled.values[k].value / det;
      const auto& axis = model.axes[j];
      Eigen::Vector3d force = r.force, couple = r.couple;
      if (m.joints[j].actuated) {
        Evaluator<double, 1> evaluator(model, mode, model.posture_size);
        for (std::size_t c = 0; c < pose.size(); ++c) evaluator.input(c, 0) = pose[c];
        evaluator.run_tape();
        Eigen::Vector3d u;
        for (int c = 0; c < 3; ++c) u(c) = evaluator.value((*axis)[static_cast<std::size_t>(c)], 0);
        (m.joints[j].type == mechanism::JointType::prismatic ? force : couple) += r.actuator * u;
      }
      const std::string name = mechanism::unknown_name(m, unknown);
      const int q = static_cast<int>(unknown.quantity);
      if (q >= static_cast<int>(Quantity::fx) && q <= static_cast<int>(Quantity::fz)) {
        EXPECT_NEAR(value, force(q - static_cast<int>(Quantity::fx)), tolerance) << name;
      } else if (q >= static_cast<int>(Quantity::mx) && q <= static_cast<int>(Quantity::mz)) {
        EXPECT_NEAR(value, couple(q - static_cast<int>(Quantity::mx)), tolerance) << name;
      } else if (unknown.quantity == Quantity::T) {
        EXPECT_NEAR(std::abs(value), couple.norm(), tolerance) << name;
      } else {
        EXPECT_NEAR(value, r.actuator, tolerance) << name;
      }
    }
  }
  EXPECT_GT(held, 0);
}

TEST(SpatialModel, AgreesWithOneLuOfTheOrthonormalForm) {
  std::mt19937 random(seed);
  for (const char* name : {"gough_stewart", "gough_stewart_slice", "three_upu", "three_ruu"})
    expect_same_reactions(example(name), random);
  for (int design = 0; design < 6; ++design) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", design " + std::to_string(design));
    const auto parsed = [](const std::string& text) { return mechanism::parse_mechanism(text, "random.yaml"); };
    expect_same_reactions(parsed(test::random_gough_stewart(random, design % 2 == 1)), random);
    expect_same_reactions(parsed(test::random_three_upu(random)), random);
    expect_same_reactions(parsed(test::random_three_leg(random)), random);
    expect_same_reactions(parsed(test::random_delta(random, design % 2 == 1, design > 3)), random);
  }
}

}  // namespace
}  // namespace clearloci::numeric
