#include "report/drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "report/label_places.hpp"
#include "report/mechanism_drawing.hpp"
#include "report/pixel_image.hpp"
#include "report/task_drawing.hpp"
#include "report/wording.hpp"
#include "report/zone_drawing.hpp"

namespace clearloci::report {
namespace {

using core::Point2;

constexpr Colour ink = light_theme.ink;
constexpr Colour faded_ink = light_theme.faded_ink;
constexpr Colour frame = light_theme.frame;
constexpr Colour workspace_fill = light_theme.workspace;
constexpr Colour grid = light_theme.grid;

void trace_path(const Canvas& canvas, const Layout& layout, const core::Polyline& points) {
  for (const auto& point : points) {
    const Point2 at = layout.page(point);
    canvas.line_to(at[0], at[1]);
  }
}

void apply(const Canvas& canvas, const Stroke& stroke) {
  set_colour(canvas, stroke.colour);
  canvas.set_line_width(stroke.width);
  canvas.set_line_cap(stroke.round ? LineCap::round : LineCap::butt);
  canvas.set_line_join(LineJoin::round);
  canvas.set_dash(stroke.dash);
}

void draw_workspace(const Canvas& canvas, const Subject& subject, const Layout& layout) {
  for (const auto& region : subject.map->workspace) {
    if (region.mode != subject.mode) continue;
    for (const auto& ring : region.rings) {
      canvas.begin_new_sub_path();
      trace_path(canvas, layout, ring);
      canvas.close_path();
    }
    canvas.set_fill_rule(FillRule::even_odd);
    set_colour(canvas, workspace_fill);
    canvas.fill();
    canvas.set_fill_rule(FillRule::winding);
  }
}

void draw_search_box(const Canvas& canvas, const Box& box) {
  canvas.rectangle(box.x, box.y, box.width, box.height);
  set_colour(canvas, frame, 0.6);
  canvas.set_line_width(0.5);
  canvas.set_dash({1.5, 2});
  canvas.stroke();
  canvas.set_dash({});
}

void draw_field(const Canvas& canvas, const FieldLayer& layer, const Layout& layout) {
  PixelImage image(layout.plot);
  const core::FieldMap& map = *layer.map;
  const std::size_t columns = map.axes[0].size();
  /// The cell along a coordinate, nothing outside the box.
  const auto cell = [&](double at, std::size_t c) -> std::optional<std::size_t> {
    const auto cells = static_cast<double>(map.axes[c].size());
    const double place = (at - map.lower[c]) / (map.upper[c] - map.lower[c]) * cells;
    return place < 0 || place >= cells ? std::nullopt : std::optional(static_cast<std::size_t>(place));
  };
  for (int row = 0; row < image.height(); ++row) {
    const double y = layout.high[1] - (row + 0.5) / PixelImage::pixels_per_point / layout.scale[1];
    const std::optional<std::size_t> j = cell(y, 1);
    for (int column = 0; j && column < image.width(); ++column) {
      const double x = layout.low[0] + (column + 0.5) / PixelImage::pixels_per_point / layout.scale[0];
      const std::optional<std::size_t> i = cell(x, 0);
      const double value = i ? layer.field->values[*j * columns + *i] : NAN;
      if (!std::isnan(value)) image.put(column, row, layer.scale.colour(value));
    }
  }
  image.paint(canvas);
}

/// `lines` at the ticks, and the searched box where the plot shows more than that.
void draw_grid(const Canvas& canvas, const Layout& layout, bool lines) {
  canvas.set_dash({});
  canvas.set_line_width(0.4);
  set_colour(canvas, grid, 0.8);
  for (std::size_t i = 0; lines && i < layout.x_ticks.size(); ++i) {
    canvas.move_to(layout.x_ticks[i].at, layout.plot.y);
    canvas.line_to(layout.x_ticks[i].at, layout.plot.bottom());
  }
  for (std::size_t i = 0; lines && i < layout.y_ticks.size(); ++i) {
    canvas.move_to(layout.plot.x, layout.y_ticks[i].at);
    canvas.line_to(layout.plot.right(), layout.y_ticks[i].at);
  }
  canvas.stroke();
  const Point2 low = layout.page(layout.search_low), high = layout.page(layout.search_high);
  draw_search_box(canvas, {low[0], high[1], high[0] - low[0], low[1] - high[1]});
}

void draw_curve(const Canvas& canvas, const Layout& layout, const core::LocusCurve& curve) {
  for (const auto& arc : curve.arcs) {
    canvas.begin_new_sub_path();
    trace_path(canvas, layout, arc.points);
    if (arc.closed) canvas.close_path();
  }
  canvas.stroke();
}

void trace_marker(const Canvas& canvas, const Point2& at, MarkerShape shape, double size) {
  const auto polygon = [&](const std::vector<Point2>& corners) {
    for (const auto& corner : corners) canvas.line_to(at[0] + size * corner[0], at[1] + size * corner[1]);
    canvas.close_path();
  };
  switch (shape) {
    case MarkerShape::circle:
      canvas.arc(at[0], at[1], size, 0, 2 * std::numbers::pi);
      break;
    case MarkerShape::square:
      polygon({{-0.88, -0.88}, {0.88, -0.88}, {0.88, 0.88}, {-0.88, 0.88}});
      break;
    case MarkerShape::diamond:
      polygon({{0, -1.25}, {1.25, 0}, {0, 1.25}, {-1.25, 0}});
      break;
    case MarkerShape::triangle:
      polygon({{0, -1.25}, {1.1, 0.75}, {-1.1, 0.75}});
      break;
  }
}

/// A ring of the marker's colour on white with a dot at the point itself.
void draw_marker(const Canvas& canvas, const Point2& at, const Marker& marker) {
  canvas.set_dash({});
  canvas.set_line_width(1.5);
  trace_marker(canvas, at, marker.shape, 4.6);
  set_colour(canvas, {1, 1, 1}, 0.9);
  canvas.fill_preserve();
  set_colour(canvas, marker.colour);
  canvas.stroke();
  canvas.arc(at[0], at[1], 1.4, 0, 2 * std::numbers::pi);
  set_colour(canvas, ink);
  canvas.fill();
}

/// Thinner, so that the field's own jumps stay in sight.
Stroke over_field(Stroke stroke) {
  constexpr double thinner = 0.55;
  stroke.width *= thinner;
  for (double& length : stroke.dash) length *= thinner;
  return stroke;
}

/// Thin lines first, what matters most last. Over a field every line has a white casing.
void draw_loci(const Canvas& canvas, const Subject& subject, const Layout& layout) {
  for (auto group = subject.groups.curves.rbegin(); group != subject.groups.curves.rend(); ++group) {
    const Stroke stroke = subject.layer != nullptr ? over_field(group->stroke) : group->stroke;
    if (subject.layer != nullptr) {
      apply(canvas, {{1, 1, 1}, stroke.width + 1.2, {}, true});
      for (const auto* curve : group->curves) draw_curve(canvas, layout, *curve);
    }
    apply(canvas, stroke);
    for (const auto* curve : group->curves) draw_curve(canvas, layout, *curve);
  }
}

/// Labels had better not lie on curves.
void occupy_curves(const Subject& subject, const Layout& layout, LabelPlaces& labels) {
  constexpr double width = 3, weight = 0.3;  // pt
  for (const CurveGroup& group : subject.groups.curves)
    for (const core::LocusCurve* const curve : group.curves)
      for (const auto& arc : curve->arcs) {
        if (arc.points.empty()) continue;
        Point2 last = layout.page(arc.points.front());
        for (const Point2& point : arc.points) {
          const Point2 at = layout.page(point);
          if (std::hypot(at[0] - last[0], at[1] - last[1]) < width) continue;
          labels.occupy(last, at, width, weight);
          last = at;
        }
      }
}

/// Beside the curves, as far as there is room: the names that tables and answers have for them.
void write_curve_ids(const Canvas& canvas, const Subject& subject, const Layout& layout, LabelPlaces& labels) {
  constexpr Font font{7.5, false, false};
  constexpr double aside = 7, most_covered = 0.15;  // pt; part of a label
  constexpr std::array parts = {0.5, 0.35, 0.65, 0.2, 0.8, 0.1, 0.9};
  for (const CurveGroup& group : subject.groups.curves)
    for (const core::LocusCurve* const curve : group.curves) {
      const auto longest = std::max_element(curve->arcs.begin(), curve->arcs.end(),
                                            [](const auto& a, const auto& b) { return a.length < b.length; });
      if (longest == curve->arcs.end() || longest->points.size() < 2) continue;
      const core::Polyline& points = longest->points;
      std::vector<Point2> places;
      for (const double part : parts) {
        const auto k =
            std::min(points.size() - 2, static_cast<std::size_t>(part * static_cast<double>(points.size() - 1)));
        const Point2 from = layout.page(points[k]), to = layout.page(points[k + 1]);
        const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
        if (!(length > 0) || from[0] < layout.plot.x || from[0] > layout.plot.right() || from[1] < layout.plot.y ||
            from[1] > layout.plot.bottom())
          continue;
        for (const double side : {aside, -aside})
          places.push_back({(from[0] + to[0]) / 2 - side * (to[1] - from[1]) / length,
                            (from[1] + to[1]) / 2 + side * (to[0] - from[0]) / length});
      }
      const std::string id = printable(curve->id);
      const auto at = labels.take_free(places, text_width(id, font) + 3, font.size + 1, most_covered);
      if (at)
        write_over_lines(canvas, id, (*at)[0], (*at)[1] + 0.36 * font.size, font, group.stroke.colour, Align::centre);
    }
}

void draw_isolated_points(const Canvas& canvas, const Subject& subject, const Layout& layout) {
  for (const auto& group : subject.groups.points) {
    for (const auto* point : group.points) {
      const Point2 at = {point->at[0], point->at.size() > 1 ? point->at[1] : 0};
      draw_marker(canvas, layout.page(at), group.marker);
    }
  }
}

void draw_open_box(const Canvas& canvas, const Box& box) {
  canvas.rectangle(box.x, box.y, box.width, box.height);
  set_colour(canvas, {1, 1, 1}, 0.6);
  canvas.fill_preserve();
  set_colour(canvas, ink);
  canvas.set_line_width(1);
  canvas.set_dash({2.5, 1.5});
  canvas.stroke();
  canvas.set_dash({});
}

/// What is open, large enough to be seen.
void draw_open_places(const Canvas& canvas, const Subject& subject, const Layout& layout) {
  constexpr double least = 7;
  for (const core::OpenRegion& region : subject.map->open) {
    if (region.mode != subject.mode || region.lower.size() != 2) continue;
    const Point2 a = layout.page({region.lower[0], region.upper[1]}),
                 b = layout.page({region.upper[0], region.lower[1]});
    const double width = std::max(b[0] - a[0], least), height = std::max(b[1] - a[1], least);
    draw_open_box(canvas, {(a[0] + b[0] - width) / 2, (a[1] + b[1] - height) / 2, width, height});
  }
}

void draw_axes(const Canvas& canvas, const Layout& layout) {
  constexpr double tick_length = 4;
  const Box& plot = layout.plot;
  canvas.set_dash({});
  canvas.set_line_cap(LineCap::butt);
  canvas.set_line_join(LineJoin::miter);
  canvas.set_line_width(0.8);
  set_colour(canvas, frame);
  canvas.rectangle(plot.x, plot.y, plot.width, plot.height);
  for (const auto& tick : layout.x_ticks) {
    canvas.move_to(tick.at, plot.bottom());
    canvas.line_to(tick.at, plot.bottom() + tick_length);
  }
  for (const auto& tick : layout.y_ticks) {
    canvas.move_to(plot.x, tick.at);
    canvas.line_to(plot.x - tick_length, tick.at);
  }
  canvas.stroke();

  set_colour(canvas, ink);
  for (const auto& tick : layout.x_ticks) {
    write_text(canvas, tick.label, tick.at, plot.bottom() + tick_length + 10, tick_font, Align::centre);
  }
  for (const auto& tick : layout.y_ticks) {
    write_text(canvas, tick.label, plot.x - tick_length - 3.5, tick.at + 3.1, tick_font, Align::right);
  }
  write_text(canvas, layout.x_label, plot.x + plot.width / 2, plot.bottom() + tick_length + 25, label_font,
             Align::centre);
  if (layout.y_label.empty()) return;
  canvas.save();
  canvas.translate(layout.y_label_x, plot.y + plot.height / 2);
  canvas.rotate(-std::numbers::pi / 2);
  write_text(canvas, layout.y_label, 0, 0, label_font, Align::centre);
  canvas.restore();
}

void draw_sample(const Canvas& canvas, const LegendEntry& entry, const Subject& subject) {
  const double x = entry.box.x, y = entry.box.y + legend_line_height / 2, end = x + legend_sample_width;
  switch (entry.sample) {
    case SampleKind::curve:
      apply(canvas, entry.stroke);
      canvas.move_to(x + entry.stroke.width / 2, y);
      canvas.line_to(end - entry.stroke.width / 2, y);
      canvas.stroke();
      break;
    case SampleKind::point:
      draw_marker(canvas, {(x + end) / 2, y}, entry.marker);
      break;
    case SampleKind::workspace:
      canvas.rectangle(x, y - 4.5, legend_sample_width, 9);
      set_colour(canvas, workspace_fill);
      canvas.fill();
      break;
    case SampleKind::zones:
      draw_zone_sample(canvas, x, y, legend_sample_width);
      break;
    case SampleKind::searched_box:
      draw_search_box(canvas, {x, y - 4.5, legend_sample_width, 9});
      break;
    case SampleKind::open_place:
      draw_open_box(canvas, {(x + end) / 2 - 4, y - 4, 8, 8});
      break;
    case SampleKind::mechanism:
      draw_mechanism_sample(canvas, x, y, legend_sample_width);
      break;
    case SampleKind::load:
      draw_load_arrow(canvas, {x + 2, y}, {end - 2, y});
      break;
    case SampleKind::colour_bar:
      draw_colour_bar(canvas, subject.layer->scale, entry.box);
      break;
    case SampleKind::task:
      draw_task_sample(canvas, *subject.task, x, y, legend_sample_width);
      break;
    case SampleKind::task_point:
      draw_task_point_sample(canvas, *subject.task, (x + end) / 2, y);
      break;
    case SampleKind::remark:
    case SampleKind::inset:  // drawn by itself
      break;
  }
}

/// What the legend says in grey: where reactions vanish.
std::string legend_reasons(const Layout& layout) {
  std::string words;
  for (const LegendEntry& entry : layout.legend)
    for (const LegendLine& line : entry.lines)
      if (line.secondary) words += line.text + " ";
  return words;
}

/// The mechanism below its label.
void draw_inset(const Canvas& canvas, const LegendEntry& entry, const core::Sketch& sketch,
                const std::string& reasons) {
  const double label = legend_line_height * static_cast<double>(entry.lines.size());
  draw_alone(canvas, {entry.box.x, entry.box.y + label, entry.box.width, entry.box.height - label}, sketch, reasons);
}

void draw_legend(const Canvas& canvas, const Layout& layout, const Subject& subject) {
  for (const auto& entry : layout.legend) {
    draw_sample(canvas, entry, subject);
    if (entry.sample == SampleKind::inset) draw_inset(canvas, entry, *subject.inset, legend_reasons(layout));
    const double indent = stands_below(entry.sample) ? 0 : legend_sample_width + legend_sample_gap;
    double baseline = entry.box.y + 0.5 * legend_line_height + 0.36 * legend_font.size;
    for (const auto& line : entry.lines) {
      set_colour(canvas, line.secondary ? faded_ink : ink);
      write_text(canvas, line.text, entry.box.x + indent, baseline, legend_font);
      baseline += legend_line_height;
    }
  }
}

}  // namespace

void draw(const Canvas& canvas, const Subject& subject, const Layout& layout) {
  draw_page_head(canvas, layout.head);
  canvas.save();
  canvas.rectangle(layout.plot.x, layout.plot.y, layout.plot.width, layout.plot.height);
  canvas.clip();
  if (subject.layer != nullptr)
    draw_field(canvas, *subject.layer, layout);
  else if (subject.zones != nullptr)
    draw_zones(canvas, subject, layout);
  else
    draw_workspace(canvas, subject, layout);
  draw_grid(canvas, layout, subject.layer == nullptr);
  if (subject.sketch != nullptr) draw_links(canvas, layout, *subject.sketch);
  draw_loci(canvas, subject, layout);
  draw_isolated_points(canvas, subject, layout);
  draw_open_places(canvas, subject, layout);
  LabelPlaces labels(layout.plot);
  occupy_curves(subject, layout, labels);
  if (subject.sketch != nullptr) draw_joints_and_loads(canvas, layout, *subject.sketch, legend_reasons(layout), labels);
  if (subject.task != nullptr) draw_task(canvas, *subject.task, layout, labels);
  if (subject.zones != nullptr) draw_zone_numbers(canvas, subject, layout, labels);
  write_curve_ids(canvas, subject, layout, labels);
  canvas.restore();

  draw_axes(canvas, layout);
  draw_legend(canvas, layout, subject);
}

}  // namespace clearloci::report
