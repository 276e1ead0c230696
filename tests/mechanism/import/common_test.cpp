// What all formats have in common: decimals, rotations, ranks, merging.
#include <random>

#include "mechanism/import/common.hpp"
#include "tests/mechanism/import/imported.hpp"

namespace clearloci::mechanism::imports {
namespace {

/// Within the tolerance, and no decimal of fewer digits behind the point is.
TEST(ShortestDecimal, IsWithinTheToleranceAndShort) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-100, 100), digits(-12, -1);
  for (int i = 0; i < 2000; ++i) {
    const double v = value(random), tolerance = std::pow(10, digits(random));
    const std::string text = shortest_decimal(v, tolerance);
    EXPECT_LE(std::abs(std::stod(text) - v), tolerance) << text;
    const std::size_t point = text.find('.');
    if (point == std::string::npos) continue;
    const int behind = static_cast<int>(text.size() - point - 1);
    const double step = std::pow(10, behind - 1);
    EXPECT_GT(std::abs(std::round(v * step) / step - v), tolerance * (1 - 1e-9)) << text << " of " << v;
  }
}

TEST(ShortestDecimal, KeepsWhatPeopleWrite) {
  EXPECT_EQ(shortest_decimal(0.1 + 0.2, 1e-12), "0.3");
  EXPECT_EQ(shortest_decimal(-2, 1e-9), "-2");
  EXPECT_EQ(shortest_decimal(1e-13, 1e-12), "0");
  EXPECT_EQ(shortest_decimal(1200, 1e-6), "1200");
}

TEST(Rotation, KeepsLengthsAndTurnsAsItSays) {
  const Rotation r = roll_pitch_yaw(0.3, -0.7, 1.1);
  EXPECT_NEAR(dot(r.x, r.y), 0, 1e-15);
  EXPECT_NEAR(norm(cross(r.x, r.y) - r.z), 0, 1e-15);
  EXPECT_NEAR(norm(turn({0, 0, 1}, std::acos(-1.0) / 2) * Vec{1, 0, 0} - Vec{0, 1, 0}), 0, 1e-15);
  const Rotation q = quaternion(std::cos(0.2), 0, 0, std::sin(0.2));
  EXPECT_NEAR(norm(q.x - turn({0, 0, 1}, 0.4).x), 0, 1e-15);
}

TEST(RowSpace, CountsWhatIsIndependent) {
  RowSpace space;
  EXPECT_TRUE(space.add({1, 2, 3}));
  EXPECT_TRUE(space.add({0, 1, 1}));
  EXPECT_FALSE(space.add({2, 5, 7}));
  EXPECT_TRUE(space.add({0, 0, 1e-3}));
  EXPECT_EQ(space.rank(), 3U);
}

Source three_pins(const Vec& third) {
  Source source;
  source.planar = true;
  for (const char* name : {"a", "b", "c"}) source.links.push_back({name, 0, 1, Vec{}, Tensor{}, false, false});
  const std::vector<Vec> at = {{0, 0, 0}, {1, 0, 0}, third};
  for (int i = 0; i < 3; ++i) {
    SourceJoint joint;
    joint.name = "P" + std::to_string(i);
    joint.from = i;
    joint.to = (i + 1) % 3;
    place(joint, at[static_cast<std::size_t>(i)], {0, 0, 1});
    source.joints.push_back(joint);
  }
  return source;
}

TEST(MergeRigid, MakesOneLinkOfATriangle) {
  Source source = three_pins({0, 1, 0});
  merge_rigid(source);
  EXPECT_EQ(std::count_if(source.links.begin(), source.links.end(), [](const SourceLink& l) { return !l.dropped; }), 1);
  EXPECT_DOUBLE_EQ(source.links[0].mass, 3);
}

/// Three pins in a line brace nothing.
TEST(MergeRigid, LeavesAFlatTriangle) {
  Source source = three_pins({2, 0, 0});
  merge_rigid(source);
  EXPECT_EQ(std::count_if(source.links.begin(), source.links.end(), [](const SourceLink& l) { return !l.dropped; }), 3);
}

/// A motor for every freedom, on the ground where it can be.
TEST(ChooseMotors, HoldsEveryFreedom) {
  const Imported imported = import_text(
      "M[J[R, P[0, 0], L[ground, a]], J[R, P[3, 4], L[a, b]], J[R, P[8, 4], L[b, c]], J[R, P[12, 3], L[c, d]], J[R, "
      "P[10, 0], L[d, ground]]]",
      "five_bar");
  EXPECT_TRUE(has_note(imported, "the source names no motor: P0 and P4 drive"));
  EXPECT_EQ(mechanism_of(imported).coordinates.size(), 2U);
}

}  // namespace
}  // namespace clearloci::mechanism::imports
