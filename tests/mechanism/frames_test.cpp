// Frames of platforms: points in them are those of p_origin + Rz(γ) Ry(β) Rx(α) p'.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "five_bar_text.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

std::string six_legs(const std::string& frame) {
  return R"(format: 1
space: spatial
parameters: {z: 0.5, a: 20 deg, b: -10 deg}
workspace:
  x: [-0.1, 0.1]
  g: {angle: [-30 deg, 30 deg]}
frames:
  plate: )" +
         frame + R"(
points:
  P: [x, 0.02, z]
links:
  plate: {points: [P, B1, B2, B3, B4, B5, B6]}
repeat:
  i: [1, 2, 3, 4, 5, 6]
  table:
    u: [10 deg, 110 deg, 130 deg, 230 deg, 250 deg, 350 deg]
    v: [50 deg, 70 deg, 170 deg, 190 deg, 290 deg, 310 deg]
  points:
    A{i}: ['0.4*cos(u{i})', '0.4*sin(u{i})', 0]
    B{i}: {in: plate, place: ['0.2*cos(v{i})', '0.2*sin(v{i})', '-{i}/100']}
  links: {'cyl{i}': {points: ['A{i}']}, 'rod{i}': {points: ['B{i}']}}
  joints:
    U{i}: {universal: [ground, 'cyl{i}'], at: 'A{i}', axes: [[1, 0, 0], 'cross([1, 0, 0], B{i} - A{i})']}
    S{i}: {prismatic: ['cyl{i}', 'rod{i}'], at: 'B{i}', axis: 'B{i} - A{i}', actuated: true}
    B{i}: {spherical: ['rod{i}', plate], at: 'B{i}'}
end_effector: {link: plate, at: P}
loads:
  - {link: plate, at: P, force: [0, 0, -100]}
)";
}

void expect_places(const Mechanism& m, const Eigen::Matrix3d& R, double x, double g) {
  const auto placed = sample_points(m, {x, g});
  const Eigen::Vector3d P(x, 0.02, 0.5);
  const double degree = std::acos(-1.0) / 180;
  const double v[] = {50, 70, 170, 190, 290, 310};
  for (int i = 1; i <= 6; ++i) {
    const Eigen::Vector3d p =
        P + R * Eigen::Vector3d(0.2 * std::cos(v[i - 1] * degree), 0.2 * std::sin(v[i - 1] * degree), -0.01 * i);
    std::size_t k = 0;
    while (m.points[k].name != "B" + std::to_string(i)) ++k;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(placed[k]->at(static_cast<std::size_t>(c)), p(c), 1e-14) << i;
  }
}

Eigen::Matrix3d about(int axis, double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}

TEST(Frames, PlacePointsByTheProductOfThreeRotations) {
  const double degree = std::acos(-1.0) / 180, a = 20 * degree, b = -10 * degree;
  for (const double g : {-0.4, 0.0, 0.3}) {
    expect_places(parse_mechanism(six_legs("{at: P, turned: [a, b, g], order: zyx}"), "m.yaml"),
                  about(2, g) * about(1, b) * about(0, a), 0.05, g);
    expect_places(parse_mechanism(six_legs("{at: P, turned: [a, b, g]}"), "m.yaml"),
                  about(2, g) * about(1, b) * about(0, a), -0.02, g);
    expect_places(parse_mechanism(six_legs("{at: P, turned: [a, b, g], order: xyz}"), "m.yaml"),
                  about(0, a) * about(1, b) * about(2, g), 0.05, g);
  }
}

TEST(Frames, InThePlaneTurnByOneAngle) {
  const std::string text =
      with(with(five_bar_text, "  y: [-1.0, 1.0]\n", "  y: [-1.0, 1.0]\nframes:\n  tool: {at: P, turned: [30 deg]}\n"),
           "  B1: {dyad", "  T: {in: tool, place: [0.2, 0.1]}\n  B1: {dyad");
  const Mechanism m = parse_mechanism(text, "m.yaml");
  const auto placed = sample_points(m, {0.25, -0.7});
  const double c = std::sqrt(3.0) / 2, s = 0.5;
  EXPECT_NEAR(placed[3]->at(0), 0.25 + c * 0.2 - s * 0.1, 1e-15);
  EXPECT_NEAR(placed[3]->at(1), -0.7 + s * 0.2 + c * 0.1, 1e-15);
}

/// From the frame's own point they are the places in the frame; from another one the way turns with the frame.
TEST(Frames, OffsetsAreInTheirDirections) {
  const double degree = std::acos(-1.0) / 180;
  const std::string places = "{in: plate, place: ['0.2*cos(v{i})', '0.2*sin(v{i})', '-{i}/100']}",
                    offsets = "{from: P, by: ['0.2*cos(v{i})', '0.2*sin(v{i})', '-{i}/100'], in: plate}";
  for (const double g : {-0.4, 0.3})
    expect_places(parse_mechanism(with(six_legs("{at: P, turned: [a, b, g]}"), places, offsets), "m.yaml"),
                  about(2, g) * about(1, -10 * degree) * about(0, 20 * degree), 0.05, g);
  const std::string text =
      with(with(five_bar_text, "  y: [-1.0, 1.0]\n", "  y: [-1.0, 1.0]\nframes:\n  tool: {at: P, turned: [30 deg]}\n"),
           "  B1: {dyad", "  T: {from: A2, by: [0.2, 0.1], in: tool}\n  B1: {dyad");
  const auto placed = sample_points(parse_mechanism(text, "m.yaml"), {0.25, -0.7});
  const double c = std::sqrt(3.0) / 2, s = 0.5;
  EXPECT_NEAR(placed[3]->at(0), 0.5 + c * 0.2 - s * 0.1, 1e-15);
  EXPECT_NEAR(placed[3]->at(1), s * 0.2 + c * 0.1, 1e-15);
}

TEST(Frames, WrongOnesAreRefused) {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      parse_mechanism(text, "m.yaml");
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto expect = [&](const std::string& frame, const std::string& says) {
    EXPECT_NE(complaint(six_legs(frame)).find(says), std::string::npos) << complaint(six_legs(frame));
  };
  expect("{at: Q, turned: [a, b, g]}", "there is no frame 'plate' above it (i = 1)");
  expect("{at: P, turned: [a, b]}", "a list of 3, not of 2");
  expect("{at: P, turned: [a, b, g], order: zyz}", "is 'zyz'");
  expect("{at: P, turned: [a, b, x]}", "'x' inside cos or sin is a length");
  expect("{at: P, turn: [a, b, g]}", "did you mean 'turned'?");
  const std::string on_a_dyad =
      with(with(five_bar_text, "  y: [-1.0, 1.0]\n", "  y: [-1.0, 1.0]\nframes:\n  tool: {at: B1}\n"), "links:\n",
           "  T: {in: tool, place: [0.2, 0.1]}\nlinks:\n");
  EXPECT_NE(complaint(on_a_dyad).find("which is no point with coordinates"), std::string::npos) << complaint(on_a_dyad);
  EXPECT_NE(complaint(with(on_a_dyad, "  T: {in: tool, place: [0.2, 0.1]}\n", "")).find("which is no point with"),
            std::string::npos);
  const std::string offset =
      with(with(on_a_dyad, "at: B1}", "at: P}"), "{in: tool, place: [0.2, 0.1]}", "{from: A1, by: A2 - A1, in: tool}");
  EXPECT_NE(complaint(offset).find("is made of points, whose directions are those of the ground"), std::string::npos)
      << complaint(offset);
  EXPECT_NE(complaint(with(with(on_a_dyad, "at: B1}", "at: P}"), "in: tool", "in: tol"))
                .find("there is no frame 'tol' above it; did you mean 'tool'?"),
            std::string::npos);
}

}  // namespace
}  // namespace clearloci::mechanism
