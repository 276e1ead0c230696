// A LocusMap put together by hand from the closed forms of the five-bar with L = d = 1/2 under a vertical load: no
// other module takes part, so that what report/ writes is held against known curves.
#pragma once

#include "core/locus_map.hpp"
#include "core/sketch.hpp"

namespace clearloci::report::fixture {

/// B1 right, B2 left.
core::WorkingMode elbows_out();

/// One mode: contact loss on two circles of radius 1/2 a leg, backlash on leg 1's outer boundary, the sextic of direct
/// singularities, the boundary, two isolated points.
core::LocusMap five_bar_map();

/// The same in all four working modes.
core::LocusMap five_bar_map_in_all_modes();

/// The map with every name that a file format could trip over, and every kind of curve and closed form.
core::LocusMap hostile_map();

/// The five-bar at P = (x, y) in a mode.
core::Sketch five_bar_sketch(const core::WorkingMode& mode, double x = 0.3, double y = -0.72);

}  // namespace clearloci::report::fixture
