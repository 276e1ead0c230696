// Points placed in closed form: what they are constructed by holds.
#include "mechanism/placement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanism/evaluate.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/read.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::mechanism {
namespace {

using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Of every dyad: |AB| and |BP| are its lengths, B is square to the axis beside A, and on the side that is asked for.
void expect_dyads_close(const std::string& file) {
  const Mechanism m = read_mechanism(source_dir() + "/examples/" + file);
  constexpr double rounding = 1e-9;  // of a few roots of differences, on lengths of a metre
  std::size_t checked = 0;
  const std::vector<PosturePoints> postures = sample_postures(m, 20);
  EXPECT_EQ(postures.size(), 20U);
  for (const PosturePoints& p : postures)
    for (std::size_t i = 0; i < m.points.size(); ++i) {
      const auto* const dyad = std::get_if<DyadPoint>(&m.points[i].form);
      if (dyad == nullptr || (dyad->axis && dyad->axis->kind != VectorExpression::Kind::components)) continue;
      const Vector A = p[static_cast<std::size_t>(dyad->from)], P = p[static_cast<std::size_t>(dyad->to)], B = p[i];
      Vector n = {0, 0, 1};
      for (std::size_t c = 0; dyad->axis && c < 3; ++c) n[c] = core::to_double(value_of(dyad->axis->numbers[c], m));
      const Vector AB = minus(B, A), BP = minus(P, B);
      EXPECT_NEAR(std::sqrt(dot(AB, AB)), core::to_double(value_of(dyad->from_length, m)), rounding);
      EXPECT_NEAR(std::sqrt(dot(BP, BP)), core::to_double(value_of(dyad->to_length, m)), rounding);
      EXPECT_NEAR(dot(AB, n), 0, rounding);
      EXPECT_EQ(dot(cross(minus(P, A), AB), n) > 0, dyad->side == Side::left);
      ++checked;
    }
  EXPECT_GT(checked, 20U);
}

TEST(Placement, DyadsOfThePlaneClose) { expect_dyads_close("five_bar.yaml"); }
TEST(Placement, DyadsOfSpaceClose) { expect_dyads_close("three_ruu.yaml"); }

TEST(Placement, HasNoPlaceBeyondTheReach) {
  const Mechanism m = read_mechanism(source_dir() + "/examples/five_bar.yaml");
  const auto placed = sample_points(m, {0.25, -5});
  for (std::size_t i = 0; i < m.points.size(); ++i)  // nor has what is placed between them
    EXPECT_EQ(placed[i].has_value(), std::holds_alternative<ExplicitPoint>(m.points[i].form)) << m.points[i].name;
}

}  // namespace
}  // namespace clearloci::mechanism
