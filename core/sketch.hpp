// The mechanism in one posture, as report/ draws it.
#pragma once

#include <string>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::core {

struct SketchLink {
  std::string name;
  std::vector<Point2> points;
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

struct Sketch {
  std::vector<SketchLink> links;
  std::vector<SketchJoint> joints;
  std::vector<SketchLoad> loads;
  Point2 gravity{};  ///< m/s^2, zero where absent
};

}  // namespace clearloci::core
