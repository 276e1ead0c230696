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
};

}  // namespace clearloci::inline core
