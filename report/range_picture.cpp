#include "report/range_picture.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "report/axis.hpp"
#include "report/mechanism_drawing.hpp"
#include "report/page_head.hpp"
#include "report/surface.hpp"
#include "report/typesetting.hpp"
#include "report/wording.hpp"
#include "report/wrap.hpp"

namespace clearloci::report {
namespace {

constexpr double page_width = 640, label_width = 190, label_gap = 12;   // pt
constexpr double line_height = 11, row_padding = 10, axis_height = 44;  // pt
constexpr double sketch_height = 300;                                   // pt
constexpr int longest_factor = 40;                                      // columns

struct Row {
  core::LocusKind kind = core::LocusKind::contact_loss;
  std::vector<std::string> lines, reason;
  std::string words, ids;  ///< "p1, p3", as in the table
  std::vector<double> at;
  double y = 0, height = 0;
};

struct Range {
  double from = 0, to = 1, factor = 1;  ///< page unit a unit of the map
  std::string label;
};

Range range_of(const core::LocusMap& map) {
  const bool angle = !map.angles.empty() && map.angles.front();
  const double factor = angle ? 180 / std::numbers::pi : 1;
  return {core::to_double(map.lower.front()) * factor, core::to_double(map.upper.front()) * factor, factor,
          printable(map.tower.coordinates.front()) + (angle ? " (deg)" : " (" + map.units.length.name + ")")};
}

std::string words_of(const core::IsolatedPoint& point) {
  const std::string what = vanishing_words(point.kind, point.vanishing);
  return printable(what.empty() ? kind_words(point.kind) : what);
}

std::vector<Row> rows_of(const core::LocusMap& map, const core::WorkingMode& mode) {
  std::vector<std::pair<std::string, Row>> rows;
  for (std::size_t i = 0; i < map.isolated_points.size(); ++i) {
    const core::IsolatedPoint& point = map.isolated_points[i];
    if (point.mode != mode) continue;
    const std::string words = words_of(point), reason = reason_words(point.kind, point.vanishing, point.factor,
                                                                     point.cause, readable_factor(map, longest_factor));
    auto row = rows.begin();
    while (row != rows.end() && (row->first != words + reason || row->second.kind != point.kind)) ++row;
    if (row == rows.end()) {
      Row fresh;
      fresh.kind = point.kind;
      fresh.words = words;
      if (reason != words) fresh.reason = wrap(reason, label_width, measure_in(legend_font));
      row = rows.insert(rows.end(), {words + reason, std::move(fresh)});
    }
    row->second.ids += (row->second.ids.empty() ? "p" : ", p") + std::to_string(i + 1);
    row->second.at.push_back(point.at.front());
  }
  for (auto& [key, row] : rows)
    row.lines = wrap(row.words + " (" + row.ids + ")", label_width, measure_in(legend_font));
  std::vector<Row> sorted;
  for (int kind = 0; kind <= static_cast<int>(core::LocusKind::workspace_boundary); ++kind)
    for (auto& [words, row] : rows)
      if (static_cast<int>(row.kind) == kind) sorted.push_back(std::move(row));
  return sorted;
}

/// Colours apart for the colour-blind (Okabe and Ito 2008); the marks differ in shape too.
void set_colour(const Canvas& canvas, core::LocusKind kind) {
  switch (kind) {
    case core::LocusKind::contact_loss:
      return canvas.set_source_rgb(0.835, 0.369, 0);
    case core::LocusKind::backlash:
      return canvas.set_source_rgb(0, 0.447, 0.698);
    case core::LocusKind::component:
      return canvas.set_source_rgb(0, 0.62, 0.451);
    case core::LocusKind::margin:
      return canvas.set_source_rgb(0.8, 0.475, 0.655);
    case core::LocusKind::preload:
      return canvas.set_source_rgb(0.902, 0.624, 0);
    case core::LocusKind::direct_singularity:
      return canvas.set_source_rgb(0, 0, 0);
    default:
      return canvas.set_source_rgb(0.45, 0.45, 0.45);
  }
}

void draw_mark(const Canvas& canvas, core::LocusKind kind, double x, double y) {
  constexpr double r = 4;
  canvas.begin_new_path();
  if (kind == core::LocusKind::contact_loss) {
    canvas.arc(x, y, r, 0, 2 * std::numbers::pi);
    return canvas.fill();
  }
  if (kind == core::LocusKind::backlash) {
    canvas.move_to(x, y - r), canvas.line_to(x + r, y), canvas.line_to(x, y + r), canvas.line_to(x - r, y);
    return canvas.fill();
  }
  canvas.set_line_width(1.5);
  if (kind == core::LocusKind::direct_singularity) {
    canvas.move_to(x - r, y - r), canvas.line_to(x + r, y + r);
    canvas.move_to(x - r, y + r), canvas.line_to(x + r, y - r);
  } else if (kind == core::LocusKind::workspace_boundary) {
    canvas.move_to(x, y - r), canvas.line_to(x, y + r);
  } else {
    canvas.rectangle(x - r + 1, y - r + 1, 2 * r - 2, 2 * r - 2);
  }
  canvas.stroke();
}

constexpr double least_tick_gap = 30;  // pt

}  // namespace

std::string range_picture(const core::LocusMap& map, const core::WorkingMode& mode, const core::Sketch* sketch,
                          PictureFormat format) {
  const Range range = range_of(map);
  std::vector<Row> rows = rows_of(map, mode);
  const double left = page_margin + label_width + label_gap, right = page_width - page_margin - 8;
  const std::string words = mode_words(map.tower, mode);
  const PageHead head = page_head(
      map.mechanism,
      "Discontinuity loci over one coordinate" + (words.empty() ? "" : ": " + words) + "; shaded: within reach",
      page_margin, page_width - 2 * page_margin);
  const double top = head.bottom;
  double y = top;
  for (Row& row : rows) {
    row.y = y;
    row.height = line_height * static_cast<double>(row.lines.size() + row.reason.size()) + row_padding;
    y += row.height;
  }
  const double bottom = std::max(y, top + 40);
  const auto page = [&](double value) {
    return left + (value - range.from) / (range.to - range.from) * (right - left);
  };
  const std::string title = printable(map.mechanism);

  std::string reasons;
  for (const Row& row : rows)
    for (const std::string& text : row.reason) reasons += text + " ";
  const double height = bottom + axis_height + (sketch == nullptr ? 0 : sketch_height);

  const auto draw = [&](const Canvas& canvas) {
    draw_page_head(canvas, head);
    canvas.set_source_rgb(0.93, 0.95, 0.97);
    for (const auto& interval : map.reachable) {
      if (interval.mode != mode) continue;
      const double from = page(interval.from * range.factor), to = page(interval.to * range.factor);
      canvas.rectangle(from, top, to - from, bottom - top);
      canvas.fill();
    }
    canvas.set_line_width(0.5);
    canvas.set_source_rgb(0.8, 0.8, 0.8);
    for (const Row& row : rows) {
      canvas.move_to(page_margin, row.y + row.height);
      canvas.line_to(right, row.y + row.height);
    }
    canvas.stroke();
    canvas.set_dash({2, 3});
    canvas.set_source_rgb(0.6, 0.6, 0.6);
    for (const Row& row : rows)
      for (const double value : row.at) {
        canvas.move_to(page(value * range.factor), top);
        canvas.line_to(page(value * range.factor), bottom);
      }
    canvas.stroke();
    canvas.set_dash({});
    for (const Row& row : rows) {
      canvas.set_source_rgb(0, 0, 0);
      double line = row.y + row_padding / 2 + 8;
      for (const std::string& text : row.lines) {
        write_text(canvas, text, page_margin, line, legend_font);
        line += line_height;
      }
      canvas.set_source_rgb(0.42, 0.42, 0.42);
      for (const std::string& text : row.reason) {
        write_text(canvas, text, page_margin, line, legend_font);
        line += line_height;
      }
      set_colour(canvas, row.kind);
      for (const double value : row.at) draw_mark(canvas, row.kind, page(value * range.factor), row.y + row.height / 2);
    }
    canvas.set_source_rgb(0, 0, 0);
    canvas.set_line_width(0.8);
    canvas.rectangle(left, top, right - left, bottom - top);
    const double least = least_tick_gap / (right - left) * (range.to - range.from);
    const std::vector<Tick> marks =
        range.factor != 1 ? angle_ticks(range.from, range.to, least) : ticks(range.from, range.to, least);
    for (const Tick& tick : marks) {
      canvas.move_to(page(tick.at), bottom);
      canvas.line_to(page(tick.at), bottom + 4);
    }
    canvas.stroke();
    for (const Tick& tick : marks) write_text(canvas, tick.label, page(tick.at), bottom + 15, tick_font, Align::centre);
    write_text(canvas, range.label, (left + right) / 2, bottom + 30, label_font, Align::centre);
    if (sketch == nullptr) return;
    write_text(canvas, sample_posture_words, page_margin, bottom + axis_height + 12, legend_font);
    draw_alone(canvas, {page_margin, bottom + axis_height + 16, right - page_margin, sketch_height - 16}, *sketch,
               reasons);
  };
  std::string description;
  for (const Row& row : rows)
    for (const std::string& text : row.lines) description += text + "\n";
  return render({page_width, std::ceil(height), title, description}, format, draw);
}

}  // namespace clearloci::report
