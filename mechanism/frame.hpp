// A mechanism seen from nearby, in a size near 1: coordinates in which doubles keep their digits, and in which it is
// the same wherever its file puts it. The change is exact, and so is the way back.
//
//     place p = origin + scale p',   free length q = from + scale q',   scale = 2^k
//
// Forces stay as they are; couples, clearances and lengths are divided by the scale.
#pragma once

#include <optional>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// Of a mechanism moved by any vector it is the frame moved by that vector: what is analysed in it is the same to the
/// last bit. The origin is made of coordinates of points that the file fixes, or of the middle of the box, so chosen
/// that the fixed points have the fewest digits. The scale is 1 for sizes of 2^-6 to 2^7 m, what lengths in metres are
/// written for, else the power of two below the size.
/// The usual one where some coordinate is no polynomial in the free ones and their cosines and sines.
Frame frame_of(const Mechanism& mechanism);

/// The power of two below the largest of its lengths and of the distances of its fixed points from the frame's origin,
/// m; without lengths below half the width of the box. 1 where frame_of() is the usual one.
Rational size_of(const Mechanism& mechanism);

/// Whether doubles lose digits in the coordinates of the file: the origin is more than some four sizes away, or the
/// size is beyond what lengths in metres are written for.
bool is_far(const Mechanism& mechanism);

/// What becomes of the parameters.
enum class Parameters {
  valued,  ///< their values take their place
  kept,    ///< what depends on them, and what is irrational, stays as it is written
};

/// The mechanism in the frame. Nothing where some coordinate is no polynomial in the free ones and their cosines and
/// sines.
std::optional<Mechanism> in_frame(const Mechanism& mechanism, const Frame& frame,
                                  Parameters parameters = Parameters::valued);

}  // namespace clearloci::mechanism
