#include "report/mechanism_drawing.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "report/label_places.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::Point2;

constexpr Colour outline = light_theme.outline;
constexpr Colour link_fill = light_theme.link;
constexpr Colour load_colour = light_theme.load;
constexpr double bar_width = 8;
constexpr double pin_radius = 3.4;
constexpr double longest_arrow = 46;
constexpr Font name_font{9, true, false};
constexpr Font load_font{8.5, true, false};

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

/// Where a joint's name may stand: of sixteen directions those first that keep the largest angle to the links and
/// loads that meet there and to the bracket of a fixed joint. Unit vectors, y up.
std::vector<Point2> name_directions(const core::Sketch& sketch, const core::SketchJoint& joint) {
  std::vector<double> occupied;
  const auto occupy = [&](double dx, double dy) {
    if (std::hypot(dx, dy) > 1e-12) occupied.push_back(std::atan2(dy, dx));
  };
  for (const auto& link : sketch.links) {
    const bool here = std::find(link.points.begin(), link.points.end(), joint.at) != link.points.end();
    for (const auto& point : link.points) {
      if (here) occupy(point[0] - joint.at[0], point[1] - joint.at[1]);
    }
  }
  for (const auto& slide : sketch.slides) {
    const bool rail_here = slide.rail && std::abs(slide.from[0] + slide.to[0] - 2 * joint.at[0]) < 1e-9 &&
                           std::abs(slide.from[1] + slide.to[1] - 2 * joint.at[1]) < 1e-9;
    if (!rail_here && slide.from != joint.at && slide.to != joint.at) continue;
    for (const auto& end : {slide.from, slide.to}) occupy(end[0] - joint.at[0], end[1] - joint.at[1]);
  }
  for (const auto& load : sketch.loads) {
    // The arrow stands before or behind the point.
    if (load.at == joint.at) occupy(load.force[0], load.force[1]);
    if (load.at == joint.at) occupy(-load.force[0], -load.force[1]);
  }
  if (joint.on_ground) {
    for (const double dx : {-0.8, 0.0, 0.8}) occupy(dx, -1);
  }
  std::vector<std::pair<double, Point2>> by_room;
  for (const int k : {1, 0, 15, 2, 14, 7, 8, 9, 6, 10, 3, 5, 13, 11, 4, 12}) {  // readers look to the right first
    const double angle = full_turn * k / 16;
    double room = std::numbers::pi;
    for (const double other : occupied) room = std::min(room, std::abs(std::remainder(angle - other, full_turn)));
    constexpr double alike = 0.05;  // rad
    by_room.emplace_back(std::round(room / alike), Point2{std::cos(angle), std::sin(angle)});
  }
  std::stable_sort(by_room.begin(), by_room.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Point2> directions;
  for (const auto& [room, direction] : by_room) directions.push_back(direction);
  return directions;
}

/// The box of a text of this size is a little wider than its letters.
Point2 place_of(const std::string& text, const Font& font, const std::vector<Point2>& places, LabelPlaces& labels) {
  return labels.take(places, text_width(text, font) + 6, font.size + 2);
}

void write_label(const Canvas& canvas, const std::string& text, const Font& font, const Colour& colour,
                 const std::vector<Point2>& places, LabelPlaces& labels) {
  const Point2 middle = place_of(text, font, places, labels);
  write_over_lines(canvas, text, middle[0], middle[1] + 0.36 * font.size, font, colour, Align::centre);
}

/// From a place to a label that is not beside it.
void draw_leader(const Canvas& canvas, const Point2& at, const Point2& label, double half_width) {
  constexpr double beside = 17, clear = pin_radius + 3;  // pt
  const Point2 end = {std::clamp(at[0], label[0] - half_width, label[0] + half_width),
                      label[1] + (at[1] > label[1] ? 5 : -5)};
  const double length = std::hypot(end[0] - at[0], end[1] - at[1]);
  if (length < beside) return;
  canvas.set_dash({});
  canvas.move_to(at[0] + clear * (end[0] - at[0]) / length, at[1] + clear * (end[1] - at[1]) / length);
  canvas.line_to(end[0], end[1]);
  canvas.set_line_width(0.5);
  set_colour(canvas, outline, 0.6);
  canvas.stroke();
}

/// Joints at one place share a label, written for the first of them.
void write_joint_name(const Canvas& canvas, const Layout& layout, const core::Sketch& sketch,
                      const core::SketchJoint& joint, LabelPlaces& labels) {
  std::string name;
  for (const auto& other : sketch.joints) {
    if (other.at != joint.at) continue;
    if (name.empty() && &other != &joint) return;
    name += (name.empty() ? "" : ", ") + printable(other.name);
  }
  const Point2 at = layout.page(joint.at);
  const double width = text_width(name, name_font);
  std::vector<Point2> places;
  for (const double distance : {joint.actuated ? 11.0 : 9.0, 18.0, 28.0, 42.0})
    for (const Point2& direction : name_directions(sketch, joint))
      places.push_back({at[0] + direction[0] * (distance + width / 2 * std::abs(direction[0])),
                        at[1] - direction[1] * (distance + 2)});
  const Point2 middle = place_of(name, name_font, places, labels);
  draw_leader(canvas, at, middle, width / 2);
  write_over_lines(canvas, name, middle[0], middle[1] + 0.36 * name_font.size, name_font, outline, Align::centre);
}

/// A cross on a ring at the end effector's point, with its name where no joint there has written one.
void write_end_effector(const Canvas& canvas, const Layout& layout, const core::Sketch& sketch, LabelPlaces& labels) {
  if (!sketch.end_effector) return;
  const core::SketchPoint& end = *sketch.end_effector;
  const Point2 at = layout.page(end.at);
  const bool on_joint = std::any_of(sketch.joints.begin(), sketch.joints.end(),
                                    [&](const core::SketchJoint& joint) { return joint.at == end.at; });
  if (on_joint) return;
  constexpr double radius = 3, reach = 5.5;
  canvas.set_dash({});
  canvas.set_line_width(1.1);
  set_colour(canvas, outline);
  canvas.begin_new_sub_path();
  canvas.arc(at[0], at[1], radius, 0, full_turn);
  for (const Point2& way : {Point2{1, 0}, Point2{0, 1}}) {
    canvas.move_to(at[0] - reach * way[0], at[1] - reach * way[1]);
    canvas.line_to(at[0] + reach * way[0], at[1] + reach * way[1]);
  }
  canvas.stroke();
  labels.occupy({at[0] - reach, at[1] - reach, 2 * reach, 2 * reach}, 0.6);
  const std::string name = printable(end.name);
  if (name.empty()) return;
  const double width = text_width(name, name_font);
  std::vector<Point2> places;
  for (const double distance : {10.0, 18.0, 28.0})
    for (int k = 0; k < 16; ++k) {
      const Point2 way = {std::cos(full_turn * k / 16), std::sin(full_turn * k / 16)};
      places.push_back({at[0] + way[0] * (distance + width / 2 * std::abs(way[0])), at[1] - way[1] * (distance + 2)});
    }
  const Point2 middle = place_of(name, name_font, places, labels);
  draw_leader(canvas, at, middle, width / 2);
  write_over_lines(canvas, name, middle[0], middle[1] + 0.36 * name_font.size, name_font, outline, Align::centre);
}

constexpr double couple_radius = 15;

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

void write_couple(const Canvas& canvas, const Layout& layout, const core::SketchLoad& load, LabelPlaces& labels) {
  const std::string words = engineering(std::abs(load.couple), 4) + " N m";
  const Point2 at = layout.page(load.at);
  const double beside = couple_radius + 5 + text_width(words, load_font) / 2, above = couple_radius + 9;
  write_label(canvas, words, load_font, load_colour,
              {{at[0], at[1] + above}, {at[0], at[1] - above}, {at[0] + beside, at[1]}, {at[0] - beside, at[1]}},
              labels);
}

/// Of a force on the page.
struct Arrow {
  Point2 tail{}, tip{};
  bool ends_at_point = false;  ///< its tip is at the point of application
};

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
void write_force(const Canvas& canvas, const core::SketchLoad& load, const Arrow& arrow, LabelPlaces& labels) {
  const std::string words = force_words(std::hypot(load.force[0], load.force[1]));
  const double half_width = text_width(words, load_font) / 2 + 3, half_height = 6;
  const Point2 end = arrow.ends_at_point ? arrow.tail : arrow.tip, other = arrow.ends_at_point ? arrow.tip : arrow.tail;
  const double length = std::hypot(end[0] - other[0], end[1] - other[1]);
  const Point2 unit = {(end[0] - other[0]) / length, (end[1] - other[1]) / length};
  std::vector<Point2> places = {{end[0] + unit[0] * (half_width + 5), end[1] + unit[1] * (half_height + 4)}};
  for (const double part : {0.7, 0.4})
    for (const double side : {1.0, -1.0}) {
      const Point2 across = {-side * unit[1], side * unit[0]};
      places.push_back({other[0] + part * length * unit[0] + across[0] * (half_width + 5),
                        other[1] + part * length * unit[1] + across[1] * (half_height + 5)});
    }
  for (const double away : {1.0, 1.8})
    for (int k = 0; k < 12; ++k) {
      const Point2 way = {std::cos(full_turn * k / 12), std::sin(full_turn * k / 12)};
      places.push_back({end[0] + way[0] * away * (half_width + 8), end[1] + way[1] * away * (half_height + 8)});
    }
  write_label(canvas, words, load_font, load_colour, places, labels);
}

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

bool stands_in(const std::string& name, const std::string& words) {
  const auto is_letter = [&](std::size_t k) {
    return k < words.size() && (std::isalnum(static_cast<unsigned char>(words[k])) != 0 || words[k] == '_');
  };
  for (std::size_t at = words.find(name); at != std::string::npos; at = words.find(name, at + 1))
    if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + name.size())) return true;
  return false;
}

}  // namespace

namespace {

/// Beside the middles of links, or elsewhere along them, on either side.
void write_link_names(const Canvas& canvas, const Layout& layout, const core::Sketch& sketch, const std::string& words,
                      LabelPlaces& labels) {
  constexpr Font font{8.5, false, true};
  constexpr double aside = bar_width + 4;
  for (const core::SketchLink& link : sketch.links) {
    const std::string name = printable(link.name);
    if (link.points.size() < 2 || !stands_in(name, words)) continue;
    const Point2 p = layout.page(link.points[0]), q = layout.page(link.points[1]);
    const double dx = q[0] - p[0], dy = q[1] - p[1], length = std::hypot(dx, dy);
    if (!(length > 0)) continue;
    // Off the link to the side on which the text needs the least room: above it, or right of an upright one.
    double u = dy / length, v = -dx / length;
    if (v > 0.3 || (std::abs(v) <= 0.3 && u < 0)) {
      u = -u;
      v = -v;
    }
    const double half = text_width(name, font) / 2;
    std::vector<Point2> places;
    for (const double part : {0.5, 0.3, 0.7})
      for (const double side : {1.0, -1.0})
        places.push_back(
            {p[0] + part * dx + side * u * (aside + half * std::abs(u)), p[1] + part * dy + side * v * aside});
    write_label(canvas, name, font, outline, places, labels);
  }
}

/// What labels had better leave in sight: pins and brackets, arrows, and less so bars.
void keep_free(const Layout& layout, const core::Sketch& sketch, const std::vector<Arrow>& arrows,
               LabelPlaces& labels) {
  constexpr double of_pins = 0.6, of_bars = 0.15, of_arrows = 0.6, of_springs = 0.3;
  for (const core::SketchLink& link : sketch.links)
    for (std::size_t i = 0; i + 1 < link.points.size() + (link.points.size() > 2 ? 1 : 0); ++i)
      labels.occupy(layout.page(link.points[i]), layout.page(link.points[(i + 1) % link.points.size()]), bar_width,
                    of_bars);
  for (const core::SketchSlide& slide : sketch.slides)
    labels.occupy(layout.page(slide.from), layout.page(slide.to), bar_width, of_bars);
  for (const core::SketchSpring& spring : sketch.springs)
    if (!spring.torsion) labels.occupy(layout.page(spring.from), layout.page(spring.to), bar_width, of_springs);
  for (const core::SketchJoint& joint : sketch.joints) {
    const Point2 at = layout.page(joint.at);
    constexpr double r = pin_radius + 2;
    labels.occupy({at[0] - r, at[1] - r, 2 * r, 2 * r}, of_pins);
    if (joint.on_ground) labels.occupy({at[0] - 12, at[1] + r, 24, 14}, of_pins);
  }
  for (const Arrow& arrow : arrows) labels.occupy(arrow.tail, arrow.tip, 4, of_arrows);
  for (const core::SketchLoad& load : sketch.loads) {
    const Point2 at = layout.page(load.at);
    if (load.couple != 0)
      labels.occupy({at[0] - couple_radius, at[1] - couple_radius, 2 * couple_radius, 2 * couple_radius}, of_bars);
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
  for (const auto& joint : sketch.joints) write_joint_name(canvas, layout, sketch, joint, labels);
  write_end_effector(canvas, layout, sketch, labels);
  auto arrow = arrows.begin();
  for (const auto& load : sketch.loads) {
    if (load.force != Point2{0, 0}) write_force(canvas, load, *arrow++, labels);
    if (load.couple != 0) write_couple(canvas, layout, load, labels);
  }
  write_link_names(canvas, layout, sketch, words, labels);
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
