#include "report/task_drawing.hpp"

#include <numbers>

#include "report/mechanism_drawing.hpp"

namespace clearloci::report {
namespace {

constexpr Colour good = light_theme.verified, bad = light_theme.failed;
constexpr double line_width = 1.8, ring = 5;

Colour colour_of(const TaskMark& task) { return task.verified ? good : bad; }

void outline_style(const Canvas& canvas, const TaskMark& task) {
  set_colour(canvas, colour_of(task));
  canvas.set_line_width(line_width);
  canvas.set_line_cap(LineCap::round);
  canvas.set_line_join(LineJoin::round);
  if (task.verified)
    canvas.set_dash({});
  else
    canvas.set_dash({5, 4});
}

void draw_ring(const Canvas& canvas, const TaskMark& task, const core::Point2& at) {
  canvas.set_dash({});
  for (const double width : {4.0, 1.8}) {  // white below, so that it shows on every colour
    set_colour(canvas, width > 2 ? Colour{1, 1, 1} : colour_of(task));
    canvas.set_line_width(width);
    canvas.begin_new_sub_path();
    canvas.arc(at[0], at[1], ring, 0, 2 * std::numbers::pi);
    canvas.stroke();
  }
}

}  // namespace

void draw_task(const Canvas& canvas, const TaskMark& task, const Layout& layout, LabelPlaces& labels) {
  const auto trace = [&] {
    canvas.begin_new_sub_path();
    for (const core::Point2& p : task.outline) {
      const core::Point2 at = layout.page(p);
      canvas.line_to(at[0], at[1]);
    }
    if (task.filled) canvas.close_path();
  };
  outline_style(canvas, task);
  canvas.set_dash({});
  constexpr double tint = 0.15;
  if (task.margin > 0) {
    // As one shape: the band beside the outline need not reach the middle of the task.
    canvas.push_group();
    set_colour(canvas, colour_of(task));
    trace();
    canvas.set_line_width(2 * task.margin * layout.scale[0]);
    if (task.filled) canvas.fill_preserve();
    canvas.stroke();
    canvas.paint_group(tint);
  }
  set_colour(canvas, colour_of(task), tint);
  if (task.filled) {
    trace();
    canvas.fill();
  }
  outline_style(canvas, task);
  trace();
  canvas.stroke();
  const std::size_t corners = task.outline.size();
  for (std::size_t i = 0; i + (task.filled ? 0 : 1) < corners; ++i)  // numbers of zones keep off the task's line
    labels.occupy(layout.page(task.outline[i]), layout.page(task.outline[(i + 1) % corners]), 2 * line_width, 1);
  for (const core::Point2& p : task.points) {
    const core::Point2 at = layout.page(p);
    draw_ring(canvas, task, at);
    labels.occupy({at[0] - 2 * ring, at[1] - 2 * ring, 4 * ring, 4 * ring}, 1);
  }
  canvas.set_dash({});
}

void draw_task_sample(const Canvas& canvas, const TaskMark& task, double x, double y, double width) {
  if (task.margin > 0 || task.filled) {
    canvas.rectangle(x, y - 4.5, width, 9);
    set_colour(canvas, colour_of(task), 0.15);
    canvas.fill();
  }
  outline_style(canvas, task);
  canvas.move_to(x + 1, y);
  canvas.line_to(x + width - 1, y);
  canvas.stroke();
  canvas.set_dash({});
}

void draw_task_point_sample(const Canvas& canvas, const TaskMark& task, double x, double y) {
  draw_ring(canvas, task, {x, y});
}

}  // namespace clearloci::report
