// Zones in a picture. Private to report/.
#pragma once

#include "report/canvas.hpp"

#include "report/label_places.hpp"
#include "report/layout.hpp"

namespace clearloci::report {

/// Every zone of the mode filled; neighbours in numbering differ in colour.
void draw_zones(const Canvas& canvas, const Subject& subject, const Layout& layout);

/// The zones' numbers over everything else, among `labels`, and without a task the largest circles. Zones too small for
/// a number have none.
void draw_zone_numbers(const Canvas& canvas, const Subject& subject, const Layout& layout, LabelPlaces& labels);

/// A sample for the legend, with its left end at (x, y).
void draw_zone_sample(const Canvas& canvas, double x, double y, double width);

}  // namespace clearloci::report
