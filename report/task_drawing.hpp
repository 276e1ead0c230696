// A task in a picture. Private to report/.
#pragma once

#include "report/canvas.hpp"

#include "report/label_places.hpp"
#include "report/layout.hpp"

namespace clearloci::report {

/// The task and its margin: green and solid where it is verified, red and dashed where it is not. What it takes is kept
/// free of `labels`.
void draw_task(const Canvas& canvas, const TaskMark& task, const Layout& layout, LabelPlaces& labels);

/// Samples for the legend, with their left ends at (x, y).
void draw_task_sample(const Canvas& canvas, const TaskMark& task, double x, double y, double width);
void draw_task_point_sample(const Canvas& canvas, const TaskMark& task, double x, double y);

}  // namespace clearloci::report
