#include "report/space_picture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "report/axis.hpp"
#include "report/mechanism_drawing.hpp"
#include "report/page_head.hpp"
#include "report/surface.hpp"
#include "report/surface_groups.hpp"
#include "report/view.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::Point2;
using core::Point3;

constexpr double view_side = 318, view_gap = 14;   // pt
constexpr double label_room = 62, side_room = 66;  // around the box of a view
constexpr double sample_width = 26, sample_gap = 8, line_height = 11.5, entry_gap = 5;
constexpr double sketch_height = 300;
constexpr double pixels_per_point = 2;
constexpr double elevation = 0.4;  // rad
constexpr std::array<double, 2> azimuths = {-1.05, 0.52};
constexpr Colour ink = light_theme.ink, grey{0.42, 0.42, 0.42};

void set_ink(const Canvas& canvas, const Colour& colour, double opacity = 1) {
  canvas.set_source_rgba(colour.red, colour.green, colour.blue, opacity);
}

/// Corner of the map's box; bit i of `which`: its upper end along coordinate i.
Point3 corner(const core::LocusMap& map, int which) {
  Point3 result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = core::to_double((which >> i & 1) != 0 ? map.upper[i] : map.lower[i]);
  return result;
}

/// Page extents of the box.
std::array<Point2, 2> outline(const core::LocusMap& map, const View& view) {
  std::array<Point2, 2> result = {{{1e300, 1e300}, {-1e300, -1e300}}};
  for (int which = 0; which < 8; ++which) {
    const Point2 at = view.page(corner(map, which));
    for (std::size_t i = 0; i < 2; ++i) {
      result[0][i] = std::min(result[0][i], at[i]);
      result[1][i] = std::max(result[1][i], at[i]);
    }
  }
  return result;
}

/// A view with its box in the middle of a part of the page that is `view_side` wide; its height is to be used.
struct PlacedView {
  View view;
  double left = 0, top = 0, height = 0;
};

std::vector<PlacedView> placed_views(const core::LocusMap& map, double top) {
  std::vector<PlacedView> views;
  double zoom = 1e300, height = 0;
  for (const double azimuth : azimuths) {
    views.push_back({view_of(map, azimuth, elevation), 0, top, 0});
    const auto [low, high] = outline(map, views.back().view);
    zoom =
        std::min({zoom, (view_side - side_room) / (high[0] - low[0]), (view_side - label_room) / (high[1] - low[1])});
    height = std::max(height, high[1] - low[1]);
  }
  for (std::size_t v = 0; v < views.size(); ++v) {
    PlacedView& view = views[v];
    view.left = page_margin + static_cast<double>(v) * (view_side + view_gap);
    view.height = std::ceil(zoom * height + label_room);
    view.view.zoom = zoom;
    const auto [low, high] = outline(map, view.view);
    view.view.origin = {view.left + view_side / 2 - (low[0] + high[0]) / 2,
                        view.top + (view.height - label_room / 2) / 2 - (low[1] + high[1]) / 2};
  }
  return views;
}

struct Edge {
  int from = 0, to = 0;  ///< corners
  bool hidden = false;   ///< behind the box: at its farthest corner
};

std::vector<Edge> edges_of(const core::LocusMap& map, const View& view) {
  int farthest = 0;
  for (int which = 1; which < 8; ++which)
    if (view.nearness(corner(map, which)) < view.nearness(corner(map, farthest))) farthest = which;
  std::vector<Edge> edges;
  for (int which = 0; which < 8; ++which)
    for (int i = 0; i < 3; ++i)
      if ((which >> i & 1) == 0)
        edges.push_back({which, which | 1 << i, which == farthest || (which | 1 << i) == farthest});
  return edges;
}

void draw_box(const Canvas& canvas, const core::LocusMap& map, const View& view, bool hidden) {
  set_ink(canvas, grey, hidden ? 0.55 : 0.9);
  canvas.set_line_width(hidden ? 0.5 : 0.7);
  for (const Edge& edge : edges_of(map, view)) {
    if (edge.hidden != hidden) continue;
    const Point2 from = view.page(corner(map, edge.from)), to = view.page(corner(map, edge.to));
    canvas.move_to(from[0], from[1]);
    canvas.line_to(to[0], to[1]);
  }
  canvas.stroke();
}

/// The edge along a coordinate that has its ticks: on the outline, lowest on the page; of the upright one, leftmost.
Edge axis_edge(const core::LocusMap& map, const View& view, int coordinate) {
  Edge best;
  double most = -1e300;
  for (const Edge& edge : edges_of(map, view)) {
    if ((edge.from ^ edge.to) != 1 << coordinate || edge.hidden) continue;
    const Point2 a = view.page(corner(map, edge.from)), b = view.page(corner(map, edge.to));
    const double merit = coordinate == 2 ? -a[0] - b[0] : a[1] + b[1];
    if (merit > most) {
      most = merit;
      best = edge;
    }
  }
  return best;
}

struct Scale {
  std::vector<Tick> ticks;
  double factor = 1;  ///< of a tick's value to the coordinate
  std::string label;
};

Scale scale_of(const core::LocusMap& map, std::size_t i, double points) {
  constexpr double degree = std::numbers::pi / 180;
  const double low = core::to_double(map.lower[i]), high = core::to_double(map.upper[i]);
  const double apart = 30 / points * (high - low);
  const std::string name = printable(map.tower.coordinates[i]);
  if (!map.angles.empty() && map.angles[i])
    return {angle_ticks(low / degree, high / degree, apart / degree), degree, name + " (deg)"};
  return {ticks(low, high, apart), 1, name + " (" + map.units.length.name + ")"};
}

/// Of the upright axis.
Scale heights_of(const core::LocusMap& map, const View& view) {
  const double upright = view.zoom * view.scale[2] * (core::to_double(map.upper[2]) - core::to_double(map.lower[2]));
  return scale_of(map, 2, upright * std::cos(elevation));
}

/// A unit vector across an edge of the box, away from its middle; on the page.
Point2 outwards(const View& view, const Point2& a, const Point2& b) {
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  const Point2 out = {(b[1] - a[1]) / length, -(b[0] - a[0]) / length};
  const Point2 middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
  const bool inwards = out[0] * (middle[0] - view.origin[0]) + out[1] * (middle[1] - view.origin[1]) < 0;
  return inwards ? Point2{-out[0], -out[1]} : out;
}

void draw_axis(const Canvas& canvas, const core::LocusMap& map, const View& view, int coordinate) {
  const auto i = static_cast<std::size_t>(coordinate);
  const Edge edge = axis_edge(map, view, coordinate);
  const Point3 from = corner(map, edge.from), to = corner(map, edge.to);
  const Point2 a = view.page(from), b = view.page(to);
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  const Point2 out = outwards(view, a, b);
  const Point2 along = {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
  const Scale scale = scale_of(map, i, length);
  // The two lower axes meet in a corner, where their last labels make room for each other.
  const Edge other = axis_edge(map, view, coordinate == 0 ? 1 : 0);
  constexpr double close = 14, aside = 9;  // pt
  set_ink(canvas, ink);
  canvas.set_line_width(0.7);
  double widest = 0;
  for (const Tick& tick : scale.ticks) {
    Point3 place = from;
    place[i] = tick.at * scale.factor;
    Point2 at = view.page(place);
    canvas.move_to(at[0], at[1]);
    canvas.line_to(at[0] + 4 * out[0], at[1] + 4 * out[1]);
    canvas.stroke();
    const double width = text_width(tick.label, tick_font);
    widest = std::max(widest, width);
    for (const int end : {edge.from, edge.to}) {
      if (coordinate == 2 || (end != other.from && end != other.to)) continue;
      const Point2 shared = view.page(corner(map, end));
      if (std::hypot(at[0] - shared[0], at[1] - shared[1]) > close) continue;
      const double away = end == edge.from ? aside : -aside;
      at = {at[0] + away * along[0], at[1] + away * along[1]};
    }
    // The label's box touches the end of the tick with the side that faces it.
    write_text(canvas, tick.label, at[0] + 7 * out[0] + width / 2 * (out[0] - 1), at[1] + 7 * out[1] + 3 + 3 * out[1],
               tick_font);
  }
  const double away = 13 + widest * std::abs(out[0]) + 11 * std::abs(out[1]);
  canvas.save();
  canvas.translate((a[0] + b[0]) / 2 + away * out[0], (a[1] + b[1]) / 2 + away * out[1]);
  const double upright = std::remainder(std::atan2(along[1], along[0]), std::numbers::pi);  // never upside down
  canvas.rotate(coordinate == 2 ? -std::numbers::pi / 2 : upright);
  write_text(canvas, scale.label, 0, 3, label_font, Align::centre);
  canvas.restore();
}

void draw_surfaces(const Canvas& canvas, const core::LocusMap& map, const PlacedView& placed,
                   const std::vector<SurfaceGroup>& groups) {
  const View& view = placed.view;
  std::vector<ShadedSurface> shaded;
  // A part of the boundary on which a reaction vanishes is drawn once, as that.
  const auto drawn = [&](const core::LocusSurface& surface) {
    return surface.kind == core::LocusKind::workspace_boundary &&
           std::any_of(shaded.begin(), shaded.end(), [&](const ShadedSurface& other) {
             return other.surface->triangles.size() == surface.triangles.size() &&
                    other.surface->vertices == surface.vertices;
           });
  };
  for (const SurfaceGroup& group : groups)
    for (const core::LocusSurface* surface : group.surfaces)
      if (!drawn(*surface)) shaded.push_back({surface, group.colour, group.opacity});
  const Scale heights = heights_of(map, view);
  const double step = heights.ticks.size() > 1 ? (heights.ticks[1].at - heights.ticks[0].at) * heights.factor : 0;
  const int width = static_cast<int>(view_side * pixels_per_point);
  const int height = static_cast<int>(placed.height * pixels_per_point);
  const std::vector<std::uint32_t> pixels =
      shade(view, shaded, {step}, {placed.left, placed.top}, width, height, pixels_per_point);
  Raster image(width, height);
  std::memcpy(image.data(), pixels.data(), pixels.size() * sizeof pixels.front());
  canvas.save();
  canvas.translate(placed.left, placed.top);
  canvas.scale(1 / pixels_per_point, 1 / pixels_per_point);
  canvas.paint(image, Filter::smooth);
  canvas.restore();
}

std::vector<LineGroup> lines_of_mode(std::vector<LineGroup> groups, const core::WorkingMode& mode) {
  for (LineGroup& group : groups) {
    std::erase_if(group.curves, [&](const auto* curve) { return curve->mode != mode; });
    std::erase_if(group.points, [&](const auto* point) { return point->mode != mode; });
  }
  std::erase_if(groups, [](const LineGroup& group) { return group.curves.empty() && group.points.empty(); });
  return groups;
}

/// Over the surfaces, with a white seam: where they pass behind one, that shines through anyway.
void draw_lines(const Canvas& canvas, const View& view, const std::vector<LineGroup>& groups) {
  constexpr double seam = 3.4, line = 1.8, ring = 3.2;  // pt
  for (const bool below : {true, false})
    for (const LineGroup& group : groups) {
      set_ink(canvas, below ? Colour{1, 1, 1} : group.colour, below ? 0.85 : 1);
      canvas.set_line_width(below ? seam : line);
      for (const core::SpaceCurve* curve : group.curves)
        for (const core::SpaceArc& arc : curve->arcs) {
          for (const Point3& place : arc.points) {
            const Point2 at = view.page(place);
            if (&place == &arc.points.front())
              canvas.move_to(at[0], at[1]);
            else
              canvas.line_to(at[0], at[1]);
          }
          canvas.stroke();
        }
      for (const core::IsolatedPoint* point : group.points) {
        const Point2 at = view.page({point->at[0], point->at[1], point->at[2]});
        canvas.arc(at[0], at[1], ring, 0, 2 * std::numbers::pi);
        canvas.stroke();
      }
    }
}

struct Entry {
  const SurfaceGroup* group = nullptr;  ///< null: a remark, or lines
  std::vector<std::string> lines, reason;
  double x = 0, y = 0;
  const LineGroup* line = nullptr;

  double height() const { return line_height * static_cast<double>(lines.size() + reason.size()); }
};

/// In two columns below the views; returns the lower end.
double place_legend(std::vector<Entry>& entries, double top) {
  const double width = view_side + view_gap / 2 - page_margin;
  double total = 0;
  for (Entry& entry : entries) {
    const Measure measure = measure_in(legend_font);
    const double room = width - sample_width - sample_gap;
    std::vector<std::string> lines, reason;
    for (const std::string& text : entry.lines)
      for (auto& line : wrap(text, room, measure)) lines.push_back(std::move(line));
    for (const std::string& text : entry.reason)
      for (auto& line : wrap(text, room, measure)) reason.push_back(std::move(line));
    entry.lines = std::move(lines);
    entry.reason = std::move(reason);
    total += entry.height() + entry_gap;
  }
  double x = page_margin, y = top, lowest = top;
  bool second = false;
  for (Entry& entry : entries) {
    if (!second && y - top >= total / 2) {
      second = true;
      x += view_side + view_gap;
      y = top;
    }
    entry.x = x;
    entry.y = y;
    y += entry.height() + entry_gap;
    lowest = std::max(lowest, y);
  }
  return lowest;
}

void draw_entry(const Canvas& canvas, const Entry& entry) {
  if (entry.group != nullptr) {
    const SurfaceGroup& group = *entry.group;
    canvas.rectangle(entry.x, entry.y + 1.5, sample_width, line_height - 2.5);
    set_ink(canvas, group.colour, std::max(0.35, group.opacity));
    canvas.fill_preserve();
    set_ink(canvas, {0.55 * group.colour.red, 0.55 * group.colour.green, 0.55 * group.colour.blue});
    canvas.set_line_width(0.8);
    canvas.stroke();
  }
  if (entry.line != nullptr) {
    set_ink(canvas, entry.line->colour);
    canvas.set_line_width(1.8);
    const double middle = entry.y + line_height / 2;
    if (entry.line->curves.empty()) {
      canvas.arc(entry.x + sample_width / 2, middle, 3.2, 0, 2 * std::numbers::pi);
    } else {
      canvas.move_to(entry.x, middle);
      canvas.line_to(entry.x + sample_width, middle);
    }
    canvas.stroke();
  }
  double baseline = entry.y + 8.5;
  const auto write = [&](const std::vector<std::string>& lines, const Colour& colour) {
    set_ink(canvas, colour);
    for (const std::string& line : lines) {
      write_text(canvas, line, entry.x + sample_width + sample_gap, baseline, legend_font);
      baseline += line_height;
    }
  };
  write(entry.lines, ink);
  write(entry.reason, grey);
}

std::vector<Entry> legend_of(const core::LocusMap& map, const std::vector<SurfaceGroup>& groups,
                             const std::vector<std::string>& remarks, const std::vector<LineGroup>& lines) {
  std::vector<Entry> entries;
  for (const SurfaceGroup& group : groups) {
    Entry entry;
    entry.group = &group;
    entry.lines = {group.what + " (" + ids_of(group) + ")"};
    if (!group.why.empty()) entry.reason = {group.why};
    entries.push_back(std::move(entry));
  }
  for (const std::string& remark : remarks) entries.push_back({nullptr, {}, {remark}});
  for (const LineGroup& group : lines) {
    Entry entry;
    entry.lines = {group.what + (group.curves.empty() ? ", at points" : ", along curves")};
    entry.line = &group;
    entries.push_back(std::move(entry));
  }
  if (!groups.empty())
    entries.push_back(
        {nullptr, {"thin lines: equal " + printable(map.tower.coordinates[2]) + ", at the ticks of its axis"}, {}});
  if (groups.empty() && lines.empty()) entries.push_back({nullptr, {"no surfaces in the box"}, {}});
  if (map.out_of_time) entries.push_back({nullptr, {"incomplete: stopped at the time limit"}, {}});
  return entries;
}

}  // namespace

std::string space_picture(const core::LocusMap& map, const core::WorkingMode& mode, const core::Sketch* sketch,
                          PictureFormat format) {
  const std::vector<SurfaceGroup> all = group_surfaces(map);
  std::vector<SurfaceGroup> groups = groups_of_mode(all, mode);
  std::string reasons;
  for (const SurfaceGroup& group : groups) reasons += group.why + " ";
  const std::vector<std::string> remarks = tell_shared_reasons(groups);
  const std::vector<LineGroup> lines = lines_of_mode(group_lines(map, all), mode);
  const std::string words = mode_words(map.tower, mode), parameters = parameter_words(map.parameters);
  const std::string title = printable(map.mechanism);
  const std::string subtitle = "Discontinuity loci seen from two sides" + (words.empty() ? "" : "; " + words) +
                               (parameters.empty() ? "" : "; " + parameters);
  const double width = 2 * page_margin + 2 * view_side + view_gap;
  const PageHead head = page_head(map.mechanism, subtitle, page_margin, width - 2 * page_margin);
  const double top = head.bottom;
  std::vector<Entry> entries = legend_of(map, groups, remarks, lines);
  const std::vector<PlacedView> views = placed_views(map, top);
  const double bottom = place_legend(entries, top + views.front().height + 8);

  const double height = bottom + (sketch == nullptr ? 0 : sketch_height) + page_margin;

  const auto draw = [&](const Canvas& canvas) {
    draw_page_head(canvas, head);
    for (const PlacedView& placed : views) {
      draw_box(canvas, map, placed.view, true);
      draw_surfaces(canvas, map, placed, groups);
      draw_lines(canvas, placed.view, lines);
      draw_box(canvas, map, placed.view, false);
      for (int i = 0; i < 3; ++i) draw_axis(canvas, map, placed.view, i);
    }
    for (const Entry& entry : entries) draw_entry(canvas, entry);
    if (sketch == nullptr) return;
    set_ink(canvas, ink);
    write_text(canvas, sample_posture_words, page_margin, bottom + 14, legend_font);
    draw_alone(canvas, {page_margin, bottom + 14, width - 2 * page_margin, sketch_height - 14}, *sketch, reasons);
  };
  std::string description;
  for (const SurfaceGroup& group : groups)
    description += group.what + (group.why.empty() ? "" : " — " + group.why) + "\n";
  for (const LineGroup& group : lines) description += group.what + "\n";
  return render({width, std::ceil(height), title, description}, format, draw);
}

}  // namespace clearloci::report
