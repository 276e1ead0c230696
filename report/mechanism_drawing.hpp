// The mechanism over its workspace: links as bars, joints as pins, the ground hatched, loads as arrows.
// Private to report/.
#pragma once

#include "report/canvas.hpp"

#include "report/label_places.hpp"
#include "report/layout.hpp"

namespace clearloci::report {

/// Links and the ground, to be drawn below the loci, which stay readable over them.
void draw_links(const Canvas& canvas, const Layout& layout, const core::Sketch& sketch);

/// Joints with their names, the names of the links that occur in `words`, what the legend says, forces as arrows with
/// their size, couples as turning arrows with theirs, and gravity in the plot's corner. All of that is kept free of
/// `labels`.
void draw_joints_and_loads(const Canvas& canvas, const Layout& layout, const core::Sketch& sketch,
                           const std::string& words, LabelPlaces& labels);

/// All of it in a box of its own, with the names of the links that `words` speak of.
void draw_alone(const Canvas& canvas, const Box& box, const core::Sketch& sketch, const std::string& words);

/// A bar with a pin and an actuated pin, for the legend: from (x, y) over `width`.
void draw_mechanism_sample(const Canvas& canvas, double x, double y, double width);

/// An arrow from `tail` to `tip` in the colour of loads.
void draw_load_arrow(const Canvas& canvas, const core::Point2& tail, const core::Point2& tip);

/// Text on a white halo, so that it can be read over lines.
void write_over_lines(const Canvas& canvas, const std::string& text, double x, double y, const Font& font,
                      const Colour& colour, Align align);

void set_colour(const Canvas& canvas, const Colour& colour, double opacity = 1);

}  // namespace clearloci::report
