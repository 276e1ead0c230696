#include "report/task_drawing.hpp"

#include <numbers>

#include "report/mechanism_drawing.hpp"

namespace clearloci::report {
namespace {

using Context = Cairo::RefPtr<Cairo::Context>;

constexpr Colour good = light_theme.verified, bad = light_theme.failed;
constexpr double line_width = 1.8, ring = 5;

Colour colour_of(const TaskMark& task) { return task.verified ? good : bad; }

void outline_style(const Context& context, const TaskMark& task) {
  set_colour(context, colour_of(task));
  context->set_line_width(line_width);
  context->set_line_cap(Cairo::Context::LineCap::ROUND);
  context->set_line_join(Cairo::Context::LineJoin::ROUND);
  if (task.verified)
    context->unset_dash();
  else
    context->set_dash(std::vector<double>{5, 4}, 0);
}

void draw_ring(const Context& context, const TaskMark& task, const core::Point2& at) {
  context->unset_dash();
  for (const double width : {4.0, 1.8}) {  // white below, so that it shows on every colour
    set_colour(context, width > 2 ? Colour{1, 1, 1} : colour_of(task));
    context->set_line_width(width);
    context->begin_new_sub_path();
    context->arc(at[0], at[1], ring, 0, 2 * std::numbers::pi);
    context->stroke();
  }
}

}  // namespace

void draw_task(const Context& context, const TaskMark& task, const Layout& layout, LabelPlaces& labels) {
  const auto trace = [&] {
    context->begin_new_sub_path();
    for (const core::Point2& p : task.outline) {
      const core::Point2 at = layout.page(p);
      context->line_to(at[0], at[1]);
    }
    if (task.filled) context->close_path();
  };
  outline_style(context, task);
  context->unset_dash();
  constexpr double tint = 0.15;
  if (task.margin > 0) {
    // As one shape: the band beside the outline need not reach the middle of the task.
    context->push_group();
    set_colour(context, colour_of(task));
    trace();
    context->set_line_width(2 * task.margin * layout.scale[0]);
    if (task.filled) context->fill_preserve();
    context->stroke();
    context->pop_group_to_source();
    context->paint_with_alpha(tint);
  }
  set_colour(context, colour_of(task), tint);
  if (task.filled) {
    trace();
    context->fill();
  }
  outline_style(context, task);
  trace();
  context->stroke();
  const std::size_t corners = task.outline.size();
  for (std::size_t i = 0; i + (task.filled ? 0 : 1) < corners; ++i)  // numbers of zones keep off the task's line
    labels.occupy(layout.page(task.outline[i]), layout.page(task.outline[(i + 1) % corners]), 2 * line_width, 1);
  for (const core::Point2& p : task.points) {
    const core::Point2 at = layout.page(p);
    draw_ring(context, task, at);
    labels.occupy({at[0] - 2 * ring, at[1] - 2 * ring, 4 * ring, 4 * ring}, 1);
  }
  context->unset_dash();
}

void draw_task_sample(const Context& context, const TaskMark& task, double x, double y, double width) {
  if (task.margin > 0 || task.filled) {
    context->rectangle(x, y - 4.5, width, 9);
    set_colour(context, colour_of(task), 0.15);
    context->fill();
  }
  outline_style(context, task);
  context->move_to(x + 1, y);
  context->line_to(x + width - 1, y);
  context->stroke();
  context->unset_dash();
}

void draw_task_point_sample(const Context& context, const TaskMark& task, double x, double y) {
  draw_ring(context, task, {x, y});
}

}  // namespace clearloci::report
