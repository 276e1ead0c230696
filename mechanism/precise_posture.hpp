// A mechanism's points at a pose to 256 bits, for what has to be told from rounding: whether a link keeps its lengths.
// Private to mechanism/.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

inline constexpr unsigned long precise_bits = 256;

using PrecisePoints = std::vector<std::array<mpf_class, 3>>;  ///< one a point, m

/// The complete posture at a pose (m and rad) in a working mode; nothing where it does not close. Mechanisms without
/// groups, whose points have no closed form.
std::optional<PrecisePoints> precise_posture(const Mechanism& mechanism, const std::vector<double>& pose,
                                             const std::vector<int>& sides);

}  // namespace clearloci::mechanism
