// Traced arcs against reactions beside them. What a reaction w does towards an arc shows in how |w| changes with the
// distance t from it: as t^(1/2) or faster where w tends to zero (on the workspace boundary as the root, elsewhere as
// t), not at all where its limit is another number, as t^(-1/2) or faster where it is unbounded. The arc is approached
// from both sides as far as the workspace is there, at a few of its points.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/locus_map.hpp"
#include "numeric/line_witness.hpp"

namespace clearloci::numeric {

enum class Tendency { zero, finite, unbounded };

/// One way towards an arc: poses in descending distance from it.
struct Approach {
  core::Point2 towards{};             ///< on the arc
  core::Point2 across{};              ///< unit vector off the arc
  double from = 0;                    ///< m: the largest distance, with its sign
  std::vector<BoundedNumerators> at;  ///< at distances that fall by `approach_step`
};

inline constexpr double approach_step = 1e-2;

/// The ways to a few points of an arc of the curve, from either side; none where the arc is too short, or a single
/// chord of which no point is known to be on the curve. `size`: of the box, m.
std::vector<Approach> approaches(const NumericModel& model, std::span<const int> mode, const core::LocusCurve& curve,
                                 const core::Arc& arc, double size);

/// The same way, `approach_step` nearer; nothing where the mechanism does not reach it.
std::optional<Approach> brought_nearer(const NumericModel& model, std::span<const int> mode, const Approach& way);

/// The reaction turns round between the two sides of the arc, `reach` away from it: the arc stands for a zero near by.
bool turns_round(const NumericModel& model, std::span<const int> mode, const Approach& way,
                 const WitnessColumns& columns, double reach);

/// What a reaction does along one way; nothing where rounding errors or a zero near by leave that open.
std::optional<Tendency> tendency(const Approach& approach, const WitnessColumns& columns);

}  // namespace clearloci::numeric
