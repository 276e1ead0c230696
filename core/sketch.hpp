// The mechanism in one posture, as report/ draws it.
#pragma once

#include <string>
#include <vector>

#include "core/locus_map.hpp"

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
};

struct Sketch {
  std::vector<SketchLink> links;
  std::vector<SketchSlide> slides;
  std::vector<SketchJoint> joints;
  std::vector<SketchLoad> loads;
  Point2 gravity{};  ///< m/s^2, zero where absent
  std::vector<SketchSpring> springs = {};
};

/// The posture in which the pictures of a mode show the mechanism.
struct ModeSketch {
  WorkingMode mode;
  Sketch sketch;
};

}  // namespace clearloci::inline core
