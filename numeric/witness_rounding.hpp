// How near a witness tells poses, and what it takes for zero. Private to numeric/.
#pragma once

#include <cmath>

#include "numeric/bounded.hpp"

namespace clearloci::numeric {

/// A pose stands for those within so many spacings of doubles, at the task's largest coordinate: bisections end, and
/// decimals are rounded, that close.
inline constexpr double spacings = 4;
/// What cannot be told from zero counts as zero only where it is known so well, relative to what is usual.
inline constexpr double known_zero = 1e-10;
/// Around a pose to rounding on the boundary others are out of reach: so many spacings away.
inline constexpr double boundary_spacings = 64;

inline double spacing(double value) { return 2 * unit_roundoff * std::abs(value); }

inline bool is_zero(const Bounded& b) { return !(std::abs(b.value) > b.error); }

}  // namespace clearloci::numeric
