#include "report/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/axis.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

constexpr double longest_side = 400;   // of the plot
constexpr double shortest_side = 130;  // a long thin box still gets a plot to look at
constexpr double legend_column = 200;
constexpr double legend_gap = 18;  // between plot and legend
constexpr double entry_gap = 5.5;  // between two entries

constexpr double inset_room = 170;

bool is_angle(const core::LocusMap& map, int coordinate) { return !map.angles.empty() && map.angles[coordinate]; }

/// The searched box and, where it does not get lost in it, the mechanism, with a margin around both.
void choose_view(const Subject& subject, Layout& layout) {
  const core::LocusMap& map = *subject.map;
  const bool planar = map.lower.size() > 1;
  for (int i = 0; i < 2; ++i) {
    layout.search_low[i] = i == 0 || planar ? core::to_double(map.lower[i]) : 0;
    layout.search_high[i] = i == 0 || planar ? core::to_double(map.upper[i]) : 0;
  }
  layout.low = layout.search_low;
  layout.high = layout.search_high;
  if (subject.sketch != nullptr && planar) {
    core::Point2 low = layout.low, high = layout.high;
    const auto cover_point = [&](const core::Point2& at, double room) {
      for (int i = 0; i < 2; ++i) {
        low[i] = std::min(low[i], at[i] - room);
        high[i] = std::max(high[i], at[i] + room);
      }
    };
    const auto cover = [&](double room) {
      for (const auto& joint : subject.sketch->joints) cover_point(joint.at, room);
      for (const auto& spring : subject.sketch->springs)
        if (!spring.torsion)
          for (const core::Point2& end : {spring.from, spring.to}) cover_point(end, room);
    };
    constexpr double room_for_names = 0.04;  // and for the brackets of fixed joints; beside the margin
    cover(0);
    cover(room_for_names * std::max(high[0] - low[0], high[1] - low[1]));
    const double searched = std::max(layout.high[0] - layout.low[0], layout.high[1] - layout.low[1]);
    constexpr double tolerable_growth = 3;
    if (std::max(high[0] - low[0], high[1] - low[1]) <= tolerable_growth * searched) {
      layout.low = low;
      layout.high = high;
    }
  }
  const core::Point2 extent = {layout.high[0] - layout.low[0], layout.high[1] - layout.low[1]};
  if (planar && (is_angle(map, 0) || is_angle(map, 1))) {
    // No length compares with an angle: the box is drawn as a square.
    for (int i = 0; i < 2; ++i) {
      layout.low[i] -= 0.03 * extent[i];
      layout.high[i] += 0.03 * extent[i];
      layout.scale[i] = longest_side / (layout.high[i] - layout.low[i]);
    }
  } else {
    const double margin = 0.03 * std::max(extent[0], extent[1]);
    const double side = std::max(extent[0], extent[1]) + 2 * margin;
    for (int i = 0; i < 2; ++i) {
      const double missing = side * shortest_side / longest_side - (extent[i] + 2 * margin);
      layout.low[i] -= margin + std::max(0.0, missing / 2);
      layout.high[i] += margin + std::max(0.0, missing / 2);
      layout.scale[i] = longest_side / side;
    }
  }
  layout.plot.width = (layout.high[0] - layout.low[0]) * layout.scale[0];
  layout.plot.height = (layout.high[1] - layout.low[1]) * layout.scale[1];
}

/// Ticks of one axis at least `apart` points from each other, `at` in the unit of the coordinate; of angles in degrees.
std::vector<Tick> ticks_of(const core::LocusMap& map, const Layout& layout, int i, double apart) {
  constexpr double degree = std::numbers::pi / 180;
  if (!is_angle(map, i)) return ticks(layout.low[i], layout.high[i], apart / layout.scale[i]);
  std::vector<Tick> result =
      angle_ticks(layout.low[i] / degree, layout.high[i] / degree, apart / layout.scale[i] / degree);
  for (Tick& tick : result) tick.at *= degree;
  return result;
}

void choose_axes(const Subject& subject, Layout& layout) {
  const core::LocusMap& map = *subject.map;
  const auto label = [&](int i) {
    return printable(map.tower.coordinates[i]) + (is_angle(map, i) ? " (deg)" : " (" + map.units.length.name + ")");
  };
  layout.x_label = label(0);
  layout.x_ticks = ticks_of(map, layout, 0, 52);
  if (map.tower.coordinates.size() < 2) return;
  layout.y_label = label(1);
  layout.y_ticks = ticks_of(map, layout, 1, 42);
}

/// True where the plot had to grow for the mechanism, so that the searched box needs an explanation.
bool shows_more_than_searched(const Layout& layout) {
  bool more = false;
  for (int i = 0; i < 2; ++i) {
    const double margin = 0.1 * std::max(layout.plot.width, layout.plot.height) / layout.scale[i];
    more = more || layout.search_low[i] - layout.low[i] > margin || layout.high[i] - layout.search_high[i] > margin;
  }
  return more;
}

/// How zones are filled by the efforts that they need (report/zone_drawing.cpp).
std::string preload_words(const core::Zones& zones, const core::WorkingMode& mode) {
  bool none = false;
  double most = 0;
  for (const core::Zone& zone : zones.zones) {
    if (zone.mode != mode || !zone.preload) continue;
    none = none || !zone.preload->feasible;
    if (!zone.preload->efforts.empty() && !zone.preload->efforts.front().cable)
      most = std::max(most, zone.preload->smallest.value_or(0));
  }
  return std::string(none ? "; grey: no feasible efforts" : "") + (most > 0 ? "; darker: larger efforts" : "");
}

/// Entries with their labels not wrapped yet.
std::vector<LegendEntry> legend_entries(const Subject& subject, const Layout& layout) {
  std::vector<LegendEntry> entries;
  const auto add = [&](SampleKind sample, const std::string& label, const std::string& reason = "") -> LegendEntry& {
    LegendEntry entry;
    entry.sample = sample;
    if (!label.empty()) entry.lines.push_back({label, false});
    if (!reason.empty()) entry.lines.push_back({reason, true});
    return entries.emplace_back(std::move(entry));
  };
  if (subject.layer != nullptr) {
    const FieldLayer& layer = *subject.layer;
    add(SampleKind::colour_bar, layer.field->label + " (" + layer.scale.unit + ")", saturation_words(layer.scale));
  }
  const auto add_groups = [&](bool with_reason) {
    for (const auto& group : subject.groups.curves)
      if (group.vanishing.empty() != with_reason)
        add(SampleKind::curve, group.what + " (" + ids_of(group) + ")", group.why).stroke = group.stroke;
  };
  add_groups(true);
  for (const std::string& remark : subject.groups.remarks) add(SampleKind::remark, "", remark);
  add_groups(false);
  for (const auto& group : subject.groups.points) add(SampleKind::point, group.label).marker = group.marker;
  if (subject.task != nullptr) {
    const TaskMark& task = *subject.task;
    const std::string margin = task.margin > 0 ? " with its margin" : "";
    add(SampleKind::task, (task.verified ? "task, verified" : "task, not verified") + margin);
    if (!task.points.empty())
      add(SampleKind::task_point, task.verified ? "nearest point of a locus" : "where the task fails");
  }
  const core::LocusMap& map = *subject.map;
  const auto& regions = map.workspace;
  if (subject.layer == nullptr &&
      std::any_of(regions.begin(), regions.end(), [&](const auto& r) { return r.mode == subject.mode; })) {
    if (subject.zones != nullptr) {
      const bool has_margins = std::any_of(map.curves.begin(), map.curves.end(), [](const core::LocusCurve& curve) {
        return curve.kind == core::LocusKind::margin;
      });
      // With margins they are others than those of the same mechanism without.
      const std::string words = (subject.task == nullptr ? "dashed: the largest circle inside"
                                 : has_margins           ? "cut by margins, too"
                                                         : "") +
                                preload_words(*subject.zones, subject.mode);
      add(SampleKind::zones, "zones, the largest first", words.starts_with("; ") ? words.substr(2) : words);
    } else {
      add(SampleKind::workspace, "workspace");
    }
  }
  if (map.lower.size() > 1 && shows_more_than_searched(layout)) add(SampleKind::searched_box, "searched box");
  if (subject.sketch != nullptr) {
    const auto& joints = subject.sketch->joints;
    const bool actuated = std::any_of(joints.begin(), joints.end(), [](const auto& joint) { return joint.actuated; });
    add(SampleKind::mechanism, "mechanism in a sample posture", actuated ? "actuated joints filled" : "");
    if (!subject.sketch->loads.empty()) add(SampleKind::load, "load");
  }
  if (subject.inset != nullptr) add(SampleKind::inset, sample_posture_words);
  if (std::any_of(map.open.begin(), map.open.end(), [&](const auto& region) { return region.mode == subject.mode; }))
    add(SampleKind::open_place, "open: what is here is not settled");
  if (map.out_of_time) add(SampleKind::remark, "incomplete: stopped at the time limit");
  return entries;
}

/// Wraps the labels to `columns` columns of `width` each and stacks the entries from (x, y); returns the lower end.
double place_legend(std::vector<LegendEntry>& entries, double x, double y, double width, int columns) {
  const Measure measure = measure_in(legend_font);
  double total = 0;
  for (auto& entry : entries) {
    std::vector<LegendLine> wrapped;
    for (const auto& line : entry.lines) {
      const bool has_sample = !stands_below(entry.sample);
      for (auto& piece :
           wrap(line.text, has_sample ? width - legend_sample_width - legend_sample_gap : width, measure)) {
        wrapped.push_back({std::move(piece), line.secondary});
      }
    }
    entry.lines = std::move(wrapped);
    entry.box.width = width;
    entry.box.height = legend_line_height * static_cast<double>(entry.lines.size());
    if (entry.sample == SampleKind::colour_bar) entry.box.height += colour_bar_room;
    if (entry.sample == SampleKind::inset) entry.box.height += inset_room;
    total += entry.box.height + entry_gap;
  }
  // Columns are filled one after the other; each takes entries until it has its share of the height.
  double top = y, lower_end = y, filled = 0;
  int column = 0;
  for (auto& entry : entries) {
    if (column + 1 < columns && filled >= total * (column + 1) / columns - entry_gap) {
      ++column;
      top = y;
    }
    entry.box.x = x + column * (width + legend_gap);
    entry.box.y = top;
    top += entry.box.height + entry_gap;
    filled += entry.box.height + entry_gap;
    lower_end = std::max(lower_end, entry.box.bottom());
  }
  return lower_end;
}

double widest_label(const std::vector<Tick>& axis) {
  const Measure measure = measure_in(tick_font);
  double width = 0;
  for (const auto& tick : axis) width = std::max(width, measure(tick.label));
  return width;
}

}  // namespace

Layout lay_out(const Subject& subject) {
  Layout layout;
  choose_view(subject, layout);
  choose_axes(subject, layout);
  layout.legend = legend_entries(subject, layout);

  const double left = page_margin + (layout.y_ticks.empty() ? 0 : 16 + widest_label(layout.y_ticks) + 8);
  constexpr double below_plot = 34;  // tick labels and axis label
  layout.plot.x = left;
  layout.y_label_x = page_margin + 10;

  // A legend beside the plot may be a little longer than it; a longer one reads better below, in two columns.
  std::vector<LegendEntry> trial = layout.legend;
  const bool beside = layout.plot.width <= 1.3 * layout.plot.height &&
                      place_legend(trial, 0, 0, legend_column, 1) <= 1.25 * layout.plot.height;
  const double least_width = left + std::max(layout.plot.width, 2 * legend_column + legend_gap);
  layout.width =
      (beside ? layout.plot.right() + legend_gap + legend_column : std::max(layout.plot.right(), least_width)) +
      page_margin;
  const std::string mode = mode_words(subject.map->tower, subject.mode);
  layout.head = page_head(subject.map->mechanism, mode.empty() ? "" : "Working mode: " + mode, left,
                          layout.width - left - page_margin);
  layout.plot.y = layout.head.bottom;
  const double plot_end = layout.plot.bottom() + below_plot;
  if (beside) {
    const double end = place_legend(layout.legend, layout.plot.right() + legend_gap, layout.plot.y, legend_column, 1);
    layout.height = std::max(plot_end, end + page_margin);
  } else {
    const double column = (layout.width - left - page_margin - legend_gap) / 2;
    const double end = place_legend(layout.legend, left, plot_end + 8, column, 2);
    layout.height = end + page_margin;
  }
  for (auto& tick : layout.x_ticks) tick.at = layout.page({tick.at, 0})[0];
  for (auto& tick : layout.y_ticks) tick.at = layout.page({0, tick.at})[1];
  layout.width = std::ceil(layout.width);
  layout.height = std::ceil(layout.height);
  return layout;
}

namespace {

/// A rectangle that grows.
struct Extent {
  core::Point2 low = {HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL};

  void cover(const core::Point2& at) {
    for (std::size_t i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], at[i]);
      high[i] = std::max(high[i], at[i]);
    }
  }
  /// Page units a unit of the rectangle, so that it fits.
  double scale_to(double width, double height) const {
    const core::Point2 size = {high[0] - low[0], high[1] - low[1]};
    const double widest = std::max({size[0], size[1], 1e-9});
    return std::min(width / std::max(size[0], 1e-3 * widest), height / std::max(size[1], 1e-3 * widest));
  }
};

Extent extent_of(const core::Sketch& sketch) {
  Extent all;
  for (const core::SketchLink& link : sketch.links)
    for (const core::Point2& at : link.points) all.cover(at);
  for (const core::SketchJoint& joint : sketch.joints) all.cover(joint.at);
  for (const core::SketchSlide& slide : sketch.slides) {
    all.cover(slide.from);
    all.cover(slide.to);
  }
  for (const core::SketchSpring& spring : sketch.springs) {
    all.cover(spring.from);
    if (!spring.torsion) all.cover(spring.to);
  }
  return all;
}

}  // namespace

Layout lay_out_alone(const core::Sketch& sketch, const Box& box) {
  constexpr double room = 34, arrow = 40;  // pt, for names and brackets; for an arrow with its size, beyond that
  const Extent mechanism = extent_of(sketch);
  Extent all = mechanism;
  double scale = all.scale_to(box.width - 2 * room, box.height - 2 * room);
  // Arrows are of one size on the page: the smaller the scale, the farther they reach. A few rounds settle it.
  for (int round = 0; round < 4; ++round) {
    all = mechanism;
    for (const core::SketchLoad& load : sketch.loads) {
      const double size = std::hypot(load.force[0], load.force[1]);
      if (size > 0)
        all.cover(
            {load.at[0] + arrow / scale * load.force[0] / size, load.at[1] + arrow / scale * load.force[1] / size});
    }
    scale = all.scale_to(box.width - 2 * room, box.height - 2 * room);
  }
  Layout layout;
  layout.plot = box;
  layout.scale = {scale, scale};
  layout.low = {(all.low[0] + all.high[0] - box.width / scale) / 2,
                (all.low[1] + all.high[1] - box.height / scale) / 2};
  layout.high = {layout.low[0] + box.width / scale, layout.low[1] + box.height / scale};
  return layout;
}

}  // namespace clearloci::report
