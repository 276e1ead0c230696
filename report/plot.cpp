#include "report/plot.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "report/axis.hpp"
#include "report/mechanism_drawing.hpp"
#include "report/page_head.hpp"
#include "report/pixel_image.hpp"
#include "report/surface.hpp"
#include "report/typesetting.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::Point2;

constexpr Colour ink = light_theme.ink;
constexpr Colour faded_ink = light_theme.faded_ink;
constexpr Colour frame = light_theme.frame;
constexpr Colour grid = light_theme.grid;

// The colours of the loci; then what Tol's muted colours (P. Tol, Colour schemes, 2021) add to them. A line more has a
// colour again, dashed.
constexpr std::array<Colour, 12> palette = {{light_theme.curves[0],
                                             light_theme.curves[1],
                                             light_theme.curves[2],
                                             light_theme.curves[3],
                                             light_theme.curves[4],
                                             light_theme.curves[5],
                                             {0.200, 0.133, 0.533},
                                             {0.533, 0.133, 0.333},
                                             {0.600, 0.600, 0.200},
                                             {0.067, 0.467, 0.200},
                                             {0.667, 0.267, 0.600},
                                             {0.467, 0.467, 0.467}}};
const std::vector<std::vector<double>> line_dashes = {{}, {6, 2}, {2, 2}, {8, 2, 2, 2}};
const std::vector<std::vector<double>> mark_dashes = {{4, 2}, {1, 2}, {7, 2, 1, 2}, {2, 4}};

constexpr double plot_width = 430, legend_width = 150, gap = 14;
constexpr double line_height = legend_line_height;

struct Frame {
  Box box;
  Point2 low{}, high{};

  Point2 page(const Point2& p) const {
    return {box.x + (p[0] - low[0]) / (high[0] - low[0]) * box.width,
            box.bottom() - (p[1] - low[1]) / (high[1] - low[1]) * box.height};
  }
};

void widen(std::array<double, 2>& range, double value) {
  if (!std::isfinite(value)) return;
  range[0] = std::min(range[0], value);
  range[1] = std::max(range[1], value);
}

/// What the series of some panels reach along one axis, with a margin; never empty.
std::array<double, 2> reach(const std::vector<PlotPanel>& panels, std::size_t axis, double part) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> range = {infinity, -infinity};
  for (const PlotPanel& panel : panels)
    for (const PlotSeries& series : panel.series)
      for (const core::Polyline& line : series.lines)
        for (const Point2& point : line)
          if (std::isfinite(point[1 - axis])) widen(range, point[axis]);
  if (!(range[0] <= range[1])) range = {0, 1};
  double size = range[1] - range[0];
  // What rounding leaves of a constant is no range to look at.
  constexpr double rounding = 1e-9;
  if (axis == 1 && size <= rounding * std::max(std::abs(range[0]), std::abs(range[1]))) size = 0;
  const double room = size > 0 ? part * size : std::max(1e-12, 0.5 * std::abs(range[0]));
  return {range[0] - room, range[1] + room};
}

class PlotDrawing {
 public:
  explicit PlotDrawing(const Plot& plot) : plot_(plot) {
    for (const PlotPanel& panel : plot.panels)
      scales_.push_back(
          panel.field ? scale_of(panel.field->values, panel.field->is_signed, panel.field->unit, panel.field->radians)
                      : FieldScale{});
    lay_out();
  }

  Page page() const {
    std::string description = plot_.subtitle;
    for (const PlotPanel& panel : plot_.panels)
      for (const PlotSeries& series : panel.series)
        if (!series.label.empty()) description += "\n" + printable(series.label);
    return {width_, height_, printable(plot_.title), printable(description)};
  }

  void draw(const Canvas& canvas) const {
    draw_page_head(canvas, head_);
    for (std::size_t i = 0; i < frames_.size(); ++i) draw_panel(canvas, i);
    const Box& last = frames_.back().box;
    write_text(canvas, plot_.x_label, last.x + last.width / 2, last.bottom() + 29, label_font, Align::centre);
  }

 private:
  void lay_out() {
    const auto x = plot_.x_range ? *plot_.x_range : reach(plot_.panels, 0, plot_.equal_scales ? 0.04 : 0);
    double y = 0, labels = 0;
    for (const PlotPanel& panel : plot_.panels) {
      Frame f;
      const auto range = panel.y_range ? *panel.y_range : reach({panel}, 1, 0.06);
      f.low = {x[0], range[0]};
      f.high = {x[1], range[1]};
      const bool single = plot_.panels.size() == 1;
      f.box = {0, y, plot_width, plot_.panel_height > 0 ? plot_.panel_height : single ? 280.0 : 120.0};
      if (plot_.equal_scales) equalise(f);
      frames_.push_back(f);
      y = std::max(f.box.bottom(), legend(nullptr, frames_.size() - 1)) + gap;
      for (const Tick& tick : y_ticks(panel, f)) labels = std::max(labels, text_width(tick.label, tick_font));
    }
    for (Frame& f : frames_) f.box.x = page_margin + 18 + labels + 8;
    width_ = std::ceil(frames_.front().box.right() + gap + legend_width + page_margin);
    const double left = frames_.front().box.x;
    head_ = page_head(plot_.title, plot_.subtitle, left, width_ - left - page_margin);
    for (Frame& f : frames_) f.box.y += head_.bottom;
    const double below_axis = frames_.back().box.bottom() + 34;
    height_ = std::ceil(std::max(head_.bottom + y - gap, below_axis) + page_margin);
  }

  /// One scale for both axes: the height follows, but a flat plot still gets a height to look at.
  static void equalise(Frame& f) {
    constexpr double least = 150, most = 420;
    const double scale = f.box.width / (f.high[0] - f.low[0]);
    f.box.height = std::clamp(scale * (f.high[1] - f.low[1]), least, most);
    const double fit = std::min(scale, f.box.height / (f.high[1] - f.low[1]));
    const std::array<double, 2> size = {f.box.width, f.box.height};
    for (std::size_t i = 0; i < 2; ++i) {
      const double missing = size[i] / fit - (f.high[i] - f.low[i]);
      f.low[i] -= missing / 2;
      f.high[i] += missing / 2;
    }
  }

  void draw_panel(const Canvas& canvas, std::size_t i) const {
    const PlotPanel& panel = plot_.panels[i];
    const Frame& f = frames_[i];
    canvas.save();
    canvas.rectangle(f.box.x, f.box.y, f.box.width, f.box.height);
    canvas.clip();
    if (panel.field)
      draw_field(canvas, *panel.field, scales_[i], f);
    else
      draw_grid(canvas, panel, f);
    for (const PlotMark& mark : plot_.marks) draw_mark(canvas, f, mark);
    for (const PlotSeries& series : panel.series) {
      if (panel.field) stroke(canvas, f, series, {{1, 1, 1}, 2.4, {}, true});
      stroke(canvas, f, series, stroke_of(series));
      if (panel.field) continue;
      draw_jumps(canvas, f, series);
      draw_cuts(&canvas, f, series);
    }
    canvas.restore();
    draw_axes(canvas, panel, f, i + 1 == frames_.size());
    legend(&canvas, i);
  }

  static Stroke stroke_of(const PlotSeries& series) {
    if (series.faint) return {{0.55, 0.55, 0.55}, 0.9, {}, false};
    if (series.number < 0) return {{0, 0, 0}, 1.2, {}, false};
    const auto number = static_cast<std::size_t>(series.number);
    return {palette[number % palette.size()], 1.3, line_dashes[number / palette.size() % line_dashes.size()], false};
  }

  static void set_stroke(const Canvas& canvas, const Stroke& s) {
    set_colour(canvas, s.colour);
    canvas.set_line_width(s.width);
    canvas.set_line_join(LineJoin::round);
    canvas.set_line_cap(LineCap::butt);
    canvas.set_dash(s.dash);
  }

  static void stroke(const Canvas& canvas, const Frame& f, const PlotSeries& series, const Stroke& s) {
    set_stroke(canvas, s);
    for (const core::Polyline& line : series.lines) {
      canvas.begin_new_sub_path();
      const Point2* before = nullptr;
      for (const Point2& point : line) {
        if (!std::isfinite(point[0]) || !std::isfinite(point[1])) {
          canvas.begin_new_sub_path();
          before = nullptr;
          continue;
        }
        const Point2 at = f.page(point);
        // Lines do not run along a jump, which is drawn by itself.
        if (before != nullptr && point[0] == (*before)[0] && point[1] != (*before)[1]) canvas.begin_new_sub_path();
        before = &point;
        // Cairo's own numbers are small; what leaves the panel is clipped anyway.
        constexpr double far = 1e4;
        canvas.line_to(std::clamp(at[0], -far, far), std::clamp(at[1], -far, far));
      }
      canvas.stroke();
    }
  }

  /// Where a line goes on at another height: a jump, as a thin dotted line.
  void draw_jumps(const Canvas& canvas, const Frame& f, const PlotSeries& series) const {
    constexpr double beside = 1e-6;  // of the range: what is nearer is at one place
    const double near = beside * (f.high[0] - f.low[0]);
    Stroke s = stroke_of(series);
    s.width *= 0.6;
    s.dash = {1.5, 2};
    set_stroke(canvas, s);
    for (const core::Polyline& line : series.lines) {
      const Point2* before = nullptr;
      for (const Point2& point : line) {
        if (!std::isfinite(point[0]) || !std::isfinite(point[1])) continue;
        if (before != nullptr && point[0] - (*before)[0] <= near && point[1] != (*before)[1]) {
          const Point2 from = f.page(*before), to = f.page(point);
          canvas.move_to(from[0], std::clamp(from[1], f.box.y, f.box.bottom()));
          canvas.line_to(to[0], std::clamp(to[1], f.box.y, f.box.bottom()));
          canvas.stroke();
        }
        before = &point;
      }
    }
  }

  /// Triangles at the panel's upper or lower side where a line goes beyond it. Whether there is one.
  static bool draw_cuts(const Canvas* canvas, const Frame& f, const PlotSeries& series) {
    constexpr double size = 3.6;  // pt
    bool any = false;
    for (const core::Polyline& line : series.lines) {
      bool beyond = false;
      for (const Point2& point : line) {
        const bool above = point[1] > f.high[1], below = point[1] < f.low[1];
        const bool now = std::isfinite(point[0]) && std::isfinite(point[1]) && (above || below) &&
                         point[0] >= f.low[0] && point[0] <= f.high[0];
        if (now && !beyond) {
          any = true;
          if (canvas != nullptr) {
            const double x = f.page(point)[0], side = above ? 1 : -1, y = above ? f.box.y : f.box.bottom();
            canvas->move_to(x, y + side);
            canvas->line_to(x - size, y + side * (1 + 1.7 * size));
            canvas->line_to(x + size, y + side * (1 + 1.7 * size));
            canvas->close_path();
            set_colour(*canvas, stroke_of(series).colour);
            canvas->fill();
          }
        }
        beyond = now;
      }
    }
    return any;
  }

  static void draw_field(const Canvas& canvas, const PlotField& field, const FieldScale& scale, const Frame& f) {
    PixelImage image(f.box);
    for (int row = 0; row < image.height(); ++row) {
      const double y = f.high[1] - (row + 0.5) / image.height() * (f.high[1] - f.low[1]);
      for (int column = 0; column < image.width(); ++column) {
        const double value = field.at(f.low[0] + (column + 0.5) / image.width() * (f.high[0] - f.low[0]), y);
        if (!std::isnan(value)) image.put(column, row, scale.colour(value));
      }
    }
    image.paint(canvas);
  }

  std::vector<Tick> x_ticks(const Frame& f) const {
    const double least = (plot_.degrees ? 40 : 52) / f.box.width * (f.high[0] - f.low[0]);
    return plot_.degrees ? angle_ticks(f.low[0], f.high[0], least) : ticks(f.low[0], f.high[0], least);
  }
  static std::vector<Tick> y_ticks(const PlotPanel& panel, const Frame& f) {
    const double least = 19 / f.box.height * (f.high[1] - f.low[1]);
    return panel.degrees ? angle_ticks(f.low[1], f.high[1], least) : ticks(f.low[1], f.high[1], least);
  }

  void draw_grid(const Canvas& canvas, const PlotPanel& panel, const Frame& f) const {
    set_stroke(canvas, {grid, 0.4, {}, false});
    for (const Tick& tick : x_ticks(f)) {
      canvas.move_to(f.page({tick.at, 0})[0], f.box.y);
      canvas.line_to(f.page({tick.at, 0})[0], f.box.bottom());
    }
    for (const Tick& tick : y_ticks(panel, f)) {
      canvas.move_to(f.box.x, f.page({0, tick.at})[1]);
      canvas.line_to(f.box.right(), f.page({0, tick.at})[1]);
    }
    canvas.stroke();
  }

  static const std::vector<double>& dashes(int style) {
    return mark_dashes[static_cast<std::size_t>(style) % mark_dashes.size()];
  }

  static void draw_mark(const Canvas& canvas, const Frame& f, const PlotMark& mark) {
    set_stroke(canvas, {faded_ink, 0.7, dashes(mark.style), false});
    canvas.move_to(f.page({mark.at, 0})[0], f.box.y);
    canvas.line_to(f.page({mark.at, 0})[0], f.box.bottom());
    canvas.stroke();
  }

  void draw_axes(const Canvas& canvas, const PlotPanel& panel, const Frame& f, bool with_x) const {
    constexpr double tick_length = 4;
    set_stroke(canvas, {frame, 0.8, {}, false});
    canvas.rectangle(f.box.x, f.box.y, f.box.width, f.box.height);
    canvas.stroke();
    for (const Tick& tick : x_ticks(f)) {
      const double x = f.page({tick.at, 0})[0];
      set_colour(canvas, frame);
      canvas.move_to(x, f.box.bottom());
      canvas.line_to(x, f.box.bottom() + tick_length);
      canvas.stroke();
      set_colour(canvas, ink);
      if (with_x) write_text(canvas, tick.label, x, f.box.bottom() + tick_length + 10, tick_font, Align::centre);
    }
    for (const Tick& tick : y_ticks(panel, f)) {
      const double y = f.page({0, tick.at})[1];
      set_colour(canvas, frame);
      canvas.move_to(f.box.x, y);
      canvas.line_to(f.box.x - tick_length, y);
      canvas.stroke();
      set_colour(canvas, ink);
      write_text(canvas, tick.label, f.box.x - tick_length - 3.5, y + 3.1, tick_font, Align::right);
    }
    canvas.save();
    canvas.translate(page_margin + 10, f.box.y + f.box.height / 2);
    canvas.rotate(-std::numbers::pi / 2);
    write_text(canvas, panel.y_label, 0, 0, label_font, Align::centre);
    canvas.restore();
  }

  static bool is_drawn(const PlotSeries& series) {
    return std::any_of(series.lines.begin(), series.lines.end(), [](const core::Polyline& line) {
      return std::any_of(line.begin(), line.end(),
                         [](const Point2& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); });
    });
  }

  /// Where it ends, down the page. Without a canvas nothing is drawn.
  double legend(const Canvas* canvas, std::size_t i) const {
    constexpr double sample = 22, indent = sample + 6;
    const Frame& f = frames_[i];
    const double x = f.box.right() + gap;
    double y = f.box.y;
    const Measure measure = measure_in(legend_font);
    const auto write = [&](const std::string& label, double at, const Colour& colour) {
      for (const std::string& piece : wrap(label, legend_width - (at - x), measure)) {
        if (canvas != nullptr) {
          set_colour(*canvas, colour);
          write_text(*canvas, piece, at, y + 0.5 * line_height + 3.1, legend_font);
        }
        y += line_height;
      }
    };
    const auto draw_sample = [&](const Stroke& s) {
      if (canvas == nullptr) return;
      set_stroke(*canvas, s);
      canvas->move_to(x, y + line_height / 2);
      canvas->line_to(x + sample, y + line_height / 2);
      canvas->stroke();
    };
    if (const auto& field = plot_.panels[i].field) {
      write(field->label + " (" + scales_[i].unit + ")", x, ink);
      if (scales_[i].saturated) write(saturation_words(scales_[i]), x, faded_ink);
      if (canvas != nullptr) draw_colour_bar(*canvas, scales_[i], {x, y, legend_width, colour_bar_room});
      y += colour_bar_room + 6;
    }
    for (const PlotSeries& series : plot_.panels[i].series) {
      if (series.label.empty() || !is_drawn(series)) continue;
      draw_sample(stroke_of(series));
      write(printable(series.label), x + indent, ink);
    }
    const std::vector<PlotSeries>& lines = plot_.panels[i].series;
    const bool cut = !plot_.panels[i].field && std::any_of(lines.begin(), lines.end(), [&](const PlotSeries& series) {
      return draw_cuts(nullptr, f, series);
    });
    if (cut) write("▲ goes beyond the range shown", x, faded_ink);
    if (i != 0) return y;
    for (std::size_t style = 0; style < plot_.mark_labels.size(); ++style) {
      const bool used = std::any_of(plot_.marks.begin(), plot_.marks.end(),
                                    [&](const PlotMark& m) { return m.style == static_cast<int>(style); });
      if (!used) continue;
      draw_sample({faded_ink, 0.7, dashes(static_cast<int>(style)), false});
      write(plot_.mark_labels[style], x + indent, ink);
    }
    return y;
  }

  const Plot& plot_;
  std::vector<FieldScale> scales_;
  std::vector<Frame> frames_;
  PageHead head_;
  double width_ = 0, height_ = 0;
};

}  // namespace

void share_ranges(Plot& plot) {
  for (PlotPanel& panel : plot.panels)
    if (!panel.y_range) panel.y_range = reach({panel}, 1, 0.06);
  const std::vector<PlotPanel> panels = plot.panels;
  for (PlotPanel& panel : plot.panels)
    for (const PlotPanel& other : panels)
      if (other.y_label == panel.y_label && !other.series.empty()) {
        widen(*panel.y_range, (*other.y_range)[0]);
        widen(*panel.y_range, (*other.y_range)[1]);
      }
}

std::string plot(const Plot& plot, PictureFormat format) {
  const PlotDrawing drawing(plot);
  return render(drawing.page(), format, [&](const Canvas& canvas) { drawing.draw(canvas); });
}

std::string table_csv(const std::vector<std::string>& names, const std::vector<std::vector<double>>& columns) {
  std::string out;
  for (std::size_t c = 0; c < names.size(); ++c) out += (c == 0 ? "" : ",") + names[c];
  out += '\n';
  const std::size_t rows = columns.empty() ? 0 : columns.front().size();
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (c > 0) out += ',';
      const double value = columns[c][r];
      if (std::isnan(value)) continue;
      char text[32];
      const auto result = std::to_chars(text, text + sizeof text, value == 0 ? 0.0 : value);
      out.append(text, result.ptr);
    }
    out += '\n';
  }
  return out;
}

}  // namespace clearloci::report
