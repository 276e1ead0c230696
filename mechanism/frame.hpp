// A mechanism far from the origin, or in units in which it is very large or small, seen from nearby: coordinates in
// which doubles keep their digits. The change is exact, and so is the way back.
//
//     place p = origin + scale p',   free length q = from + scale q',   scale = 2^k
//
// Forces stay as they are; couples, clearances and lengths are divided by the scale.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// The usual one unless the points of a sample of postures are far from the origin for their distances, or of a size
/// far from 1: powers of two, and an origin of few digits.
Frame frame_of(const Mechanism& mechanism);

/// The mechanism in the frame; its parameters are put in. Nothing where some coordinate is no polynomial in the free
/// ones and their cosines and sines.
std::optional<Mechanism> in_frame(const Mechanism& mechanism, const Frame& frame);

}  // namespace clearloci::mechanism
