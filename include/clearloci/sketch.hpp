// How does the mechanism look in a posture? Its links, slides, joints and loads as they are drawn.
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     if (const auto pose = clearloci::sample_pose(model))
//       for (const clearloci::SketchLink& link : clearloci::sketch_pose(model, *pose).links)
//         std::cout << link.name << " has " << link.points.size() << " points\n";
//
// Lengths in m, forces in N, couples in N m.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clearloci/mechanism.hpp"

namespace clearloci::inline core {

struct SketchLink {
  std::string name;
  std::vector<Point2> points;
};

/// A telescopic leg, from a point of the cylinder to one of the rod; or a piece of a rail on the ground.
struct SketchSlide {
  Point2 from{}, to{};
  bool rail = false;
  bool actuated = false;
};

struct SketchJoint {
  std::string name;
  Point2 at{};
  bool on_ground = false;
  bool actuated = false;
};

struct SketchLoad {
  Point2 at{};
  Point2 force{};     ///< N
  double couple = 0;  ///< N m
};

struct SketchSpring {
  Point2 from{}, to{};
  bool torsion = false;  ///< in a joint at `from`
  bool from_ground = false, to_ground = false;
};

/// The end effector's point.
struct SketchPoint {
  std::string name;
  Point2 at{};
};

struct Sketch {
  std::vector<SketchLink> links;
  std::vector<SketchSlide> slides;
  std::vector<SketchJoint> joints;
  std::vector<SketchLoad> loads;
  Point2 gravity{};  ///< m/s^2, zero where absent
  std::vector<SketchSpring> springs = {};
  std::optional<SketchPoint> end_effector = {};
};

}  // namespace clearloci::inline core

namespace clearloci {

/// Of a planar mechanism; `at` as of solve_pose. Throws InputError where the mechanism is spatial, the pose cannot be
/// reached, or the number of values or sides is wrong.
Sketch sketch_pose(const Model& model, const std::vector<double>& at, const DyadSides& working_mode = {});

/// A pose in which the mechanism is well seen: open, far from singular, amid the box. Nothing where the working mode
/// reaches none of some thousand poses of the box. Throws InputError where the number of sides is wrong.
std::optional<std::vector<double>> sample_pose(const Model& model, const DyadSides& working_mode = {});

/// Whether the two free coordinates are x and y of the end effector's point, so that loci and mechanism lie in one
/// plane.
bool pose_is_place(const Model& model);

}  // namespace clearloci
