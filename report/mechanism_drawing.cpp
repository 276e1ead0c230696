#include "report/mechanism_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/mechanism_labels.hpp"

namespace clearloci::report {
namespace {

using core::Point2;

constexpr Colour outline = light_theme.outline;
constexpr Colour link_fill = light_theme.link;
constexpr Colour load_colour = light_theme.load;
constexpr double longest_arrow = 46;

constexpr double full_turn = 2 * std::numbers::pi;

/// A rounded bar: the stroke of `path` in the outline's colour, then a narrower one in the fill's.
void draw_bar(const Canvas& canvas, const std::vector<Point2>& path, double width_of_bar) {
  canvas.set_line_cap(LineCap::round);
  canvas.set_line_join(LineJoin::round);
  canvas.set_dash({});
  const auto stroke = [&](double width, const Colour& colour, double opacity) {
    for (const auto& point : path) canvas.line_to(point[0], point[1]);
    canvas.set_line_width(width);
    set_colour(canvas, colour, opacity);
    canvas.stroke();
  };
  stroke(width_of_bar, outline, 0.55);
  stroke(width_of_bar - 1.4, link_fill, 0.85);
}

/// The convex outline of some points, closed; of points in a line the way there and back.
std::vector<Point2> outline_of(std::vector<Point2> points) {
  std::sort(points.begin(), points.end());
  const auto turns_right = [](const std::vector<Point2>& way, const Point2& next) {
    const Point2 &a = way[way.size() - 2], &b = way.back();
    return (b[0] - a[0]) * (next[1] - a[1]) - (b[1] - a[1]) * (next[0] - a[0]) <= 0;
  };
  std::vector<Point2> all;
  for (int half = 0; half < 2; ++half) {
    std::vector<Point2> way;
    for (const Point2& point : points) {
      while (way.size() > 1 && turns_right(way, point)) way.pop_back();
      way.push_back(point);
    }
    all.insert(all.end(), way.begin(), way.end() - 1);
    std::reverse(points.begin(), points.end());
  }
  if (!all.empty()) all.push_back(all.front());
  return all;
}

/// A link of three points or more: the loci stay readable through it.
void draw_plate(const Canvas& canvas, const std::vector<Point2>& points) {
  for (const Point2& point : outline_of(points)) canvas.line_to(point[0], point[1]);
  canvas.close_path();
  set_colour(canvas, link_fill, 0.3);
  canvas.fill();
}

/// A rail is a line under the slider, a telescopic leg a bar that grows thinner half way.
void draw_slide(const Canvas& canvas, const Layout& layout, const core::SketchSlide& slide) {
  const Point2 from = layout.page(slide.from), to = layout.page(slide.to);
  if (slide.rail) {
    canvas.set_dash({});
    canvas.set_line_cap(LineCap::round);
    canvas.move_to(from[0], from[1]);
    canvas.line_to(to[0], to[1]);
    canvas.set_line_width(3);
    set_colour(canvas, outline, 0.45);
    canvas.stroke();
    return;
  }
  const Point2 middle = {(from[0] + to[0]) / 2, (from[1] + to[1]) / 2};
  draw_bar(canvas, {middle, to}, 0.55 * bar_width);
  draw_bar(canvas, {from, middle}, bar_width);
  if (!slide.actuated) return;
  // Filled, as the pins of motors are: the cylinder's own pin may lie below one that is not.
  const Point2 start = {from[0] + 0.15 * (to[0] - from[0]), from[1] + 0.15 * (to[1] - from[1])},
               end = {from[0] + 0.42 * (to[0] - from[0]), from[1] + 0.42 * (to[1] - from[1])};
  canvas.set_dash({});
  canvas.set_line_cap(LineCap::round);
  canvas.move_to(start[0], start[1]);
  canvas.line_to(end[0], end[1]);
  canvas.set_line_width(0.45 * bar_width);
  set_colour(canvas, outline);
  canvas.stroke();
}

void draw_pin(const Canvas& canvas, const Point2& at, bool actuated) {
  canvas.set_dash({});
  const auto disc = [&](double radius, const Colour& colour) {
    canvas.arc(at[0], at[1], radius, 0, full_turn);
    set_colour(canvas, colour);
    canvas.fill();
  };
  if (actuated) {
    disc(pin_radius + 2.6, outline);
    disc(pin_radius + 1.6, {1, 1, 1});
    disc(pin_radius, outline);
  } else {
    disc(pin_radius, outline);
    disc(pin_radius - 1.1, {1, 1, 1});
  }
}

/// The bracket of a fixed joint: a triangle on a hatched line.
void draw_ground(const Canvas& canvas, const Point2& at) {
  constexpr double half = 9, height = 13, hatch = 4.5;
  canvas.set_dash({});
  canvas.set_line_cap(LineCap::butt);
  canvas.set_line_width(0.9);
  canvas.move_to(at[0], at[1]);
  canvas.line_to(at[0] - 0.75 * half, at[1] + height);
  canvas.line_to(at[0] + 0.75 * half, at[1] + height);
  canvas.close_path();
  set_colour(canvas, {1, 1, 1}, 0.85);
  canvas.fill_preserve();
  set_colour(canvas, outline);
  canvas.stroke();
  canvas.move_to(at[0] - 1.25 * half, at[1] + height);
  canvas.line_to(at[0] + 1.25 * half, at[1] + height);
  for (double x = -1.25 * half + hatch; x <= 1.25 * half + 0.01; x += hatch) {
    canvas.move_to(at[0] + x, at[1] + height);
    canvas.line_to(at[0] + x - hatch, at[1] + height + hatch);
  }
  canvas.stroke();
}

void draw_couple(const Canvas& canvas, const Layout& layout, const core::SketchLoad& load) {
  constexpr double radius = couple_radius, start = 0.6, end = 5.2;  // rad on the page, where y points down
  const Point2 at = layout.page(load.at);
  const bool counter_clockwise = load.couple > 0;
  const double tip = counter_clockwise ? -end : end, side = counter_clockwise ? -1 : 1;
  set_colour(canvas, load_colour);
  canvas.set_dash({});
  canvas.set_line_width(1.6);
  if (counter_clockwise) {
    canvas.arc_negative(at[0], at[1], radius, -start, -end);
  } else {
    canvas.arc(at[0], at[1], radius, start, end);
  }
  canvas.stroke();
  const Point2 head = {at[0] + radius * std::cos(tip), at[1] + radius * std::sin(tip)};
  const Point2 along = {-side * std::sin(tip), side * std::cos(tip)};
  draw_load_arrow(canvas, {head[0] - 0.5 * along[0], head[1] - 0.5 * along[1]},
                  {head[0] + 7 * along[0], head[1] + 7 * along[1]});
}

/// The arrow starts at the point of application, or ends there where it would leave the plot.
Arrow arrow_of(const Layout& layout, const core::SketchLoad& load, double largest) {
  const double size = std::hypot(load.force[0], load.force[1]);
  const double length = std::max(0.45, size / largest) * longest_arrow;
  const Point2 unit = {load.force[0] / size, -load.force[1] / size}, at = layout.page(load.at);
  constexpr double clear_of_pin = pin_radius + 2.5, room = 14;
  Arrow arrow;
  arrow.tail = {at[0] + clear_of_pin * unit[0], at[1] + clear_of_pin * unit[1]};
  arrow.tip = {arrow.tail[0] + length * unit[0], arrow.tail[1] + length * unit[1]};
  const Box& plot = layout.plot;
  arrow.ends_at_point = arrow.tip[0] < plot.x + 4 || arrow.tip[0] > plot.right() - 4 || arrow.tip[1] < plot.y + room ||
                        arrow.tip[1] > plot.bottom() - room;
  if (arrow.ends_at_point) {
    arrow.tip = {at[0] - clear_of_pin * unit[0], at[1] - clear_of_pin * unit[1]};
    arrow.tail = {arrow.tip[0] - length * unit[0], arrow.tip[1] - length * unit[1]};
  }
  return arrow;
}

/// Beyond the arrow's free end, or beside the arrow.
}  // namespace

void set_colour(const Canvas& canvas, const Colour& colour, double opacity) {
  canvas.set_source_rgba(colour.red, colour.green, colour.blue, opacity);
}

void write_over_lines(const Canvas& canvas, const std::string& text, double x, double y, const Font& font,
                      const Colour& colour, Align align) {
  const double shift = align == Align::left ? 0 : text_width(text, font) * (align == Align::centre ? 0.5 : 1);
  choose_font(canvas, font);
  canvas.set_dash({});
  canvas.move_to(x - shift, y);
  canvas.text_path(text);
  set_colour(canvas, {1, 1, 1}, 0.8);
  canvas.set_line_width(3);
  canvas.set_line_join(LineJoin::round);
  canvas.stroke();
  set_colour(canvas, colour);
  write_text(canvas, text, x - shift, y, font);
}

void draw_load_arrow(const Canvas& canvas, const Point2& tail, const Point2& tip) {
  constexpr double head = 8, half = 3.1;
  const double length = std::hypot(tip[0] - tail[0], tip[1] - tail[1]);
  const Point2 unit = {(tip[0] - tail[0]) / length, (tip[1] - tail[1]) / length};
  const Point2 neck = {tip[0] - head * unit[0], tip[1] - head * unit[1]};
  set_colour(canvas, load_colour);
  canvas.set_dash({});
  canvas.set_line_cap(LineCap::butt);
  canvas.set_line_width(1.8);
  if (length > head) {
    canvas.move_to(tail[0], tail[1]);
    canvas.line_to(neck[0] + unit[0], neck[1] + unit[1]);
    canvas.stroke();
  }
  canvas.move_to(tip[0], tip[1]);
  canvas.line_to(neck[0] - half * unit[1], neck[1] + half * unit[0]);
  canvas.line_to(neck[0] + half * unit[1], neck[1] - half * unit[0]);
  canvas.close_path();
  canvas.fill();
}

/// A coil as seen from its side: leads at both ends, and between them a zigzag.
void draw_spring(const Canvas& canvas, const Point2& from, const Point2& to) {
  constexpr double lead = 0.18, half = 4.5;  // part of the length; points
  constexpr int turns = 7;
  const Point2 way = {to[0] - from[0], to[1] - from[1]};
  const double length = std::hypot(way[0], way[1]);
  if (!(length > 0)) return;
  const Point2 across = {-way[1] / length, way[0] / length};
  canvas.set_dash({});
  canvas.set_line_cap(LineCap::round);
  canvas.set_line_join(LineJoin::round);
  canvas.move_to(from[0], from[1]);
  canvas.line_to(from[0] + lead * way[0], from[1] + lead * way[1]);
  for (int i = 0; i < 2 * turns; ++i) {
    const double part = lead + (1 - 2 * lead) * (i + 0.5) / (2 * turns), side = i % 2 == 0 ? half : -half;
    canvas.line_to(from[0] + part * way[0] + side * across[0], from[1] + part * way[1] + side * across[1]);
  }
  canvas.line_to(to[0] - lead * way[0], to[1] - lead * way[1]);
  canvas.line_to(to[0], to[1]);
  set_colour(canvas, outline);
  canvas.set_line_width(1.1);
  canvas.stroke();
}

/// The coil of a torsion spring around its joint, a turn and a half.
void draw_torsion_spring(const Canvas& canvas, const Point2& at) {
  constexpr double inner = 7, outer = 12.5;
  constexpr int steps = 72;
  canvas.set_dash({});
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps, angle = 1.5 * full_turn * part;
    const double radius = inner + (outer - inner) * part;
    const double x = at[0] + radius * std::cos(angle), y = at[1] - radius * std::sin(angle);
    i == 0 ? canvas.move_to(x, y) : canvas.line_to(x, y);
  }
  set_colour(canvas, outline);
  canvas.set_line_width(1.1);
  canvas.stroke();
}

void draw_links(const Canvas& canvas, const Layout& layout, const core::Sketch& sketch) {
  for (const auto& joint : sketch.joints) {
    if (joint.on_ground) draw_ground(canvas, layout.page(joint.at));
  }
  for (const auto& spring : sketch.springs) {
    if (spring.from_ground) draw_ground(canvas, layout.page(spring.from));
    if (spring.to_ground) draw_ground(canvas, layout.page(spring.to));
  }
  for (const auto& slide : sketch.slides) draw_slide(canvas, layout, slide);
  for (const auto& link : sketch.links) {
    std::vector<Point2> path;
    for (const auto& point : link.points) path.push_back(layout.page(point));
    if (path.size() > 2) draw_plate(canvas, path);
    draw_bar(canvas, path.size() > 2 ? outline_of(path) : path, bar_width);
  }
  for (const auto& spring : sketch.springs) {
    if (spring.torsion)
      draw_torsion_spring(canvas, layout.page(spring.from));
    else
      draw_spring(canvas, layout.page(spring.from), layout.page(spring.to));
  }
}

namespace {

void draw_pins(const Canvas& canvas, const Layout& layout, const core::Sketch& sketch) {
  // Of several at one place, that of the motor.
  for (const auto& joint : sketch.joints) {
    const bool actuated = std::any_of(sketch.joints.begin(), sketch.joints.end(),
                                      [&](const auto& other) { return other.actuated && other.at == joint.at; });
    draw_pin(canvas, layout.page(joint.at), actuated);
  }
}

/// In the plot's corner.
void draw_gravity(const Canvas& canvas, const Layout& layout, const core::Sketch& sketch, LabelPlaces& labels) {
  const double gravity = std::hypot(sketch.gravity[0], sketch.gravity[1]);
  if (gravity == 0) return;
  const Point2 centre = {layout.plot.right() - 22, layout.plot.y + 24};
  const Point2 half = {13 * sketch.gravity[0] / gravity, -13 * sketch.gravity[1] / gravity};
  draw_load_arrow(canvas, {centre[0] - half[0], centre[1] - half[1]}, {centre[0] + half[0], centre[1] + half[1]});
  labels.occupy({centre[0] - 16, centre[1] - 14, 32, 28}, 1);
  write_over_lines(canvas, "g", centre[0] - 8, centre[1] + 3, {9, false, true}, load_colour, Align::right);
}

}  // namespace

void draw_joints_and_loads(const Canvas& canvas, const Layout& layout, const core::Sketch& sketch,
                           const std::string& words, LabelPlaces& labels) {
  draw_pins(canvas, layout, sketch);
  double largest = 0;
  for (const auto& load : sketch.loads) largest = std::max(largest, std::hypot(load.force[0], load.force[1]));
  std::vector<Arrow> arrows;
  for (const auto& load : sketch.loads) {
    if (load.force != Point2{0, 0}) {
      arrows.push_back(arrow_of(layout, load, largest));
      draw_load_arrow(canvas, arrows.back().tail, arrows.back().tip);
    }
    if (load.couple != 0) draw_couple(canvas, layout, load);
  }
  keep_free(layout, sketch, arrows, labels);
  draw_gravity(canvas, layout, sketch, labels);
  write_labels(canvas, layout, sketch, arrows, words, labels);
}

void draw_alone(const Canvas& canvas, const Box& box, const core::Sketch& sketch, const std::string& words) {
  const Layout alone = lay_out_alone(sketch, box);
  draw_links(canvas, alone, sketch);
  LabelPlaces labels(alone.plot);
  draw_joints_and_loads(canvas, alone, sketch, words, labels);
}

void draw_mechanism_sample(const Canvas& canvas, double x, double y, double width) {
  const Point2 left = {x + 7, y}, right = {x + width - 6, y};
  draw_bar(canvas, {left, right}, bar_width);
  draw_pin(canvas, left, true);
  draw_pin(canvas, right, false);
}

}  // namespace clearloci::report
