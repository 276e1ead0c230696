// The mechanism in one posture, as report/ draws it.
#pragma once

#include <vector>

#include "clearloci/sketch.hpp"
#include "core/locus_map.hpp"

namespace clearloci::inline core {

/// The posture in which the pictures of a mode show the mechanism.
struct ModeSketch {
  WorkingMode mode;
  Sketch sketch;
  /// The coordinates are not the end effector's place in the plane, so that it stands beside the loci.
  bool beside = false;
};

}  // namespace clearloci::inline core
