#include "report/mechanism_drawing.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::Point2;
using Context = Cairo::RefPtr<Cairo::Context>;

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
void draw_bar(const Context& context, const std::vector<Point2>& path, double width_of_bar) {
  context->set_line_cap(Cairo::Context::LineCap::ROUND);
  context->set_line_join(Cairo::Context::LineJoin::ROUND);
  context->unset_dash();
  const auto stroke = [&](double width, const Colour& colour, double opacity) {
    for (const auto& point : path) context->line_to(point[0], point[1]);
    context->set_line_width(width);
    set_colour(context, colour, opacity);
    context->stroke();
  };
  stroke(width_of_bar, outline, 0.55);
  stroke(width_of_bar - 1.4, link_fill, 0.85);
}

/// A rail is a line under the slider, a telescopic leg a bar that grows thinner half way.
void draw_slide(const Context& context, const Layout& layout, const core::SketchSlide& slide) {
  const Point2 from = layout.page(slide.from), to = layout.page(slide.to);
  if (slide.rail) {
    context->unset_dash();
    context->set_line_cap(Cairo::Context::LineCap::ROUND);
    context->move_to(from[0], from[1]);
    context->line_to(to[0], to[1]);
    context->set_line_width(3);
    set_colour(context, outline, 0.45);
    context->stroke();
    return;
  }
  const Point2 middle = {(from[0] + to[0]) / 2, (from[1] + to[1]) / 2};
  draw_bar(context, {middle, to}, 0.55 * bar_width);
  draw_bar(context, {from, middle}, bar_width);
  if (!slide.actuated) return;
  // Filled, as the pins of motors are: the cylinder's own pin may lie below one that is not.
  const Point2 start = {from[0] + 0.15 * (to[0] - from[0]), from[1] + 0.15 * (to[1] - from[1])},
               end = {from[0] + 0.42 * (to[0] - from[0]), from[1] + 0.42 * (to[1] - from[1])};
  context->unset_dash();
  context->set_line_cap(Cairo::Context::LineCap::ROUND);
  context->move_to(start[0], start[1]);
  context->line_to(end[0], end[1]);
  context->set_line_width(0.45 * bar_width);
  set_colour(context, outline);
  context->stroke();
}

void draw_pin(const Context& context, const Point2& at, bool actuated) {
  context->unset_dash();
  const auto disc = [&](double radius, const Colour& colour) {
    context->arc(at[0], at[1], radius, 0, full_turn);
    set_colour(context, colour);
    context->fill();
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
void draw_ground(const Context& context, const Point2& at) {
  constexpr double half = 9, height = 13, hatch = 4.5;
  context->unset_dash();
  context->set_line_cap(Cairo::Context::LineCap::BUTT);
  context->set_line_width(0.9);
  context->move_to(at[0], at[1]);
  context->line_to(at[0] - 0.75 * half, at[1] + height);
  context->line_to(at[0] + 0.75 * half, at[1] + height);
  context->close_path();
  set_colour(context, {1, 1, 1}, 0.85);
  context->fill_preserve();
  set_colour(context, outline);
  context->stroke();
  context->move_to(at[0] - 1.25 * half, at[1] + height);
  context->line_to(at[0] + 1.25 * half, at[1] + height);
  for (double x = -1.25 * half + hatch; x <= 1.25 * half + 0.01; x += hatch) {
    context->move_to(at[0] + x, at[1] + height);
    context->line_to(at[0] + x - hatch, at[1] + height + hatch);
  }
  context->stroke();
}

/// Where a joint's name stands: the direction, of sixteen, that keeps the largest angle to the links and loads that
/// meet there and to the bracket of a fixed joint. Unit vector, y up.
Point2 name_direction(const core::Sketch& sketch, const core::SketchJoint& joint) {
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
  double best = 0, best_room = -1;
  for (const int k : {1, 0, 15, 2, 14, 7, 8, 9, 6, 10, 3, 5, 13, 11, 4, 12}) {  // readers look to the right first
    const double angle = full_turn * k / 16;
    double room = std::numbers::pi;
    for (const double other : occupied) room = std::min(room, std::abs(std::remainder(angle - other, full_turn)));
    if (room > best_room + 0.05) {
      best = angle;
      best_room = room;
    }
  }
  return {std::cos(best), std::sin(best)};
}

/// Joints at one place share a label, written for the first of them.
void write_joint_name(const Context& context, const Layout& layout, const core::Sketch& sketch,
                      const core::SketchJoint& joint) {
  std::string name;
  for (const auto& other : sketch.joints) {
    if (other.at != joint.at) continue;
    if (name.empty() && &other != &joint) return;
    name += (name.empty() ? "" : ", ") + printable(other.name);
  }
  const Point2 at = layout.page(joint.at), direction = name_direction(sketch, joint);
  const double distance = joint.actuated ? 11 : 9, width = text_width(name, name_font);
  const double x = at[0] + direction[0] * (distance + width / 2 * std::abs(direction[0]));
  const double y = at[1] - direction[1] * (distance + 2) + 0.36 * name_font.size;
  const double room = width / 2 + 3;
  write_over_lines(context, name, std::clamp(x, layout.plot.x + room, layout.plot.right() - room), y, name_font,
                   outline, Align::centre);
}

void draw_couple(const Context& context, const Layout& layout, const core::SketchLoad& load) {
  constexpr double radius = 15, start = 0.6, end = 5.2;  // rad on the page, where y points down
  const Point2 at = layout.page(load.at);
  const bool counter_clockwise = load.couple > 0;
  const double tip = counter_clockwise ? -end : end, side = counter_clockwise ? -1 : 1;
  set_colour(context, load_colour);
  context->unset_dash();
  context->set_line_width(1.6);
  if (counter_clockwise) {
    context->arc_negative(at[0], at[1], radius, -start, -end);
  } else {
    context->arc(at[0], at[1], radius, start, end);
  }
  context->stroke();
  const Point2 head = {at[0] + radius * std::cos(tip), at[1] + radius * std::sin(tip)};
  const Point2 along = {-side * std::sin(tip), side * std::cos(tip)};
  draw_load_arrow(context, {head[0] - 0.5 * along[0], head[1] - 0.5 * along[1]},
                  {head[0] + 7 * along[0], head[1] + 7 * along[1]});
  write_over_lines(context, engineering(std::abs(load.couple), 4) + " N m", at[0], at[1] + radius + 12, load_font,
                   load_colour, Align::centre);
}

/// The arrow starts at the point of application, or ends there where it would leave the plot.
void draw_force(const Context& context, const Layout& layout, const core::SketchLoad& load, double largest) {
  const double size = std::hypot(load.force[0], load.force[1]);
  const double length = std::max(0.45, size / largest) * longest_arrow;
  const Point2 unit = {load.force[0] / size, -load.force[1] / size}, at = layout.page(load.at);
  constexpr double clear_of_pin = pin_radius + 2.5, room = 14;
  Point2 tail = {at[0] + clear_of_pin * unit[0], at[1] + clear_of_pin * unit[1]};
  Point2 tip = {tail[0] + length * unit[0], tail[1] + length * unit[1]};
  const Box& plot = layout.plot;
  const bool leaves =
      tip[0] < plot.x + 4 || tip[0] > plot.right() - 4 || tip[1] < plot.y + room || tip[1] > plot.bottom() - room;
  if (leaves) {
    tip = {at[0] - clear_of_pin * unit[0], at[1] - clear_of_pin * unit[1]};
    tail = {tip[0] - length * unit[0], tip[1] - length * unit[1]};
  }
  draw_load_arrow(context, tail, tip);
  // The size stands beyond the arrow's free end, inside the plot.
  const double away = leaves ? -1 : 1;
  const std::string words = force_words(size);
  const double half_width = text_width(words, load_font) / 2 + 3, half_height = 6;
  const Point2 end = leaves ? tail : tip;
  const double x = end[0] + away * unit[0] * (half_width + 5), y = end[1] + away * unit[1] * (half_height + 4);
  write_over_lines(context, words, std::clamp(x, plot.x + half_width, plot.right() - half_width),
                   std::clamp(y, plot.y + half_height, plot.bottom() - half_height) + 0.36 * load_font.size, load_font,
                   load_colour, Align::centre);
}

}  // namespace

void set_colour(const Context& context, const Colour& colour, double opacity) {
  context->set_source_rgba(colour.red, colour.green, colour.blue, opacity);
}

void write_over_lines(const Context& context, const std::string& text, double x, double y, const Font& font,
                      const Colour& colour, Align align) {
  const double shift = align == Align::left ? 0 : text_width(text, font) * (align == Align::centre ? 0.5 : 1);
  choose_font(context, font);
  context->unset_dash();
  context->move_to(x - shift, y);
  context->text_path(text);
  set_colour(context, {1, 1, 1}, 0.8);
  context->set_line_width(3);
  context->set_line_join(Cairo::Context::LineJoin::ROUND);
  context->stroke();
  set_colour(context, colour);
  write_text(context, text, x - shift, y, font);
}

void draw_load_arrow(const Context& context, const Point2& tail, const Point2& tip) {
  constexpr double head = 8, half = 3.1;
  const double length = std::hypot(tip[0] - tail[0], tip[1] - tail[1]);
  const Point2 unit = {(tip[0] - tail[0]) / length, (tip[1] - tail[1]) / length};
  const Point2 neck = {tip[0] - head * unit[0], tip[1] - head * unit[1]};
  set_colour(context, load_colour);
  context->unset_dash();
  context->set_line_cap(Cairo::Context::LineCap::BUTT);
  context->set_line_width(1.8);
  if (length > head) {
    context->move_to(tail[0], tail[1]);
    context->line_to(neck[0] + unit[0], neck[1] + unit[1]);
    context->stroke();
  }
  context->move_to(tip[0], tip[1]);
  context->line_to(neck[0] - half * unit[1], neck[1] + half * unit[0]);
  context->line_to(neck[0] + half * unit[1], neck[1] - half * unit[0]);
  context->close_path();
  context->fill();
}

/// A coil as seen from its side: leads at both ends, and between them a zigzag.
void draw_spring(const Context& context, const Point2& from, const Point2& to) {
  constexpr double lead = 0.18, half = 4.5;  // part of the length; points
  constexpr int turns = 7;
  const Point2 way = {to[0] - from[0], to[1] - from[1]};
  const double length = std::hypot(way[0], way[1]);
  if (!(length > 0)) return;
  const Point2 across = {-way[1] / length, way[0] / length};
  context->unset_dash();
  context->set_line_cap(Cairo::Context::LineCap::ROUND);
  context->set_line_join(Cairo::Context::LineJoin::ROUND);
  context->move_to(from[0], from[1]);
  context->line_to(from[0] + lead * way[0], from[1] + lead * way[1]);
  for (int i = 0; i < 2 * turns; ++i) {
    const double part = lead + (1 - 2 * lead) * (i + 0.5) / (2 * turns), side = i % 2 == 0 ? half : -half;
    context->line_to(from[0] + part * way[0] + side * across[0], from[1] + part * way[1] + side * across[1]);
  }
  context->line_to(to[0] - lead * way[0], to[1] - lead * way[1]);
  context->line_to(to[0], to[1]);
  set_colour(context, outline);
  context->set_line_width(1.1);
  context->stroke();
}

/// The coil of a torsion spring around its joint, a turn and a half.
void draw_torsion_spring(const Context& context, const Point2& at) {
  constexpr double inner = 7, outer = 12.5;
  constexpr int steps = 72;
  context->unset_dash();
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps, angle = 1.5 * full_turn * part;
    const double radius = inner + (outer - inner) * part;
    const double x = at[0] + radius * std::cos(angle), y = at[1] - radius * std::sin(angle);
    i == 0 ? context->move_to(x, y) : context->line_to(x, y);
  }
  set_colour(context, outline);
  context->set_line_width(1.1);
  context->stroke();
}

void draw_links(const Context& context, const Layout& layout, const core::Sketch& sketch) {
  for (const auto& joint : sketch.joints) {
    if (joint.on_ground) draw_ground(context, layout.page(joint.at));
  }
  for (const auto& slide : sketch.slides) draw_slide(context, layout, slide);
  for (const auto& link : sketch.links) {
    std::vector<Point2> path;
    for (const auto& point : link.points) path.push_back(layout.page(point));
    // A link of three points or more is a plate: its outline closes.
    if (path.size() > 2) path.push_back(path.front());
    draw_bar(context, path, bar_width);
  }
  for (const auto& spring : sketch.springs) {
    if (spring.torsion)
      draw_torsion_spring(context, layout.page(spring.from));
    else
      draw_spring(context, layout.page(spring.from), layout.page(spring.to));
  }
}

void draw_joints(const Context& context, const Layout& layout, const core::Sketch& sketch) {
  for (const auto& joint : sketch.joints) draw_pin(context, layout.page(joint.at), joint.actuated);
  for (const auto& joint : sketch.joints) write_joint_name(context, layout, sketch, joint);
}

namespace {

bool stands_in(const std::string& name, const std::string& words) {
  const auto is_letter = [&](std::size_t k) {
    return k < words.size() && (std::isalnum(static_cast<unsigned char>(words[k])) != 0 || words[k] == '_');
  };
  for (std::size_t at = words.find(name); at != std::string::npos; at = words.find(name, at + 1))
    if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + name.size())) return true;
  return false;
}

}  // namespace

void draw_link_names(const Context& context, const Layout& layout, const core::Sketch& sketch,
                     const std::string& words) {
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
    write_over_lines(context, name, (p[0] + q[0]) / 2 + u * (aside + half * std::abs(u)),
                     (p[1] + q[1]) / 2 + v * aside + 0.36 * font.size, font, outline, Align::centre);
  }
}

void draw_loads(const Context& context, const Layout& layout, const core::Sketch& sketch) {
  double largest = 0;
  for (const auto& load : sketch.loads) largest = std::max(largest, std::hypot(load.force[0], load.force[1]));
  for (const auto& load : sketch.loads) {
    if (load.force != Point2{0, 0}) draw_force(context, layout, load, largest);
    if (load.couple != 0) draw_couple(context, layout, load);
  }
  const double gravity = std::hypot(sketch.gravity[0], sketch.gravity[1]);
  if (gravity == 0) return;
  const Point2 centre = {layout.plot.right() - 22, layout.plot.y + 24};
  const Point2 half = {13 * sketch.gravity[0] / gravity, -13 * sketch.gravity[1] / gravity};
  draw_load_arrow(context, {centre[0] - half[0], centre[1] - half[1]}, {centre[0] + half[0], centre[1] + half[1]});
  write_over_lines(context, "g", centre[0] - 8, centre[1] + 3, {9, false, true}, load_colour, Align::right);
}

void draw_alone(const Context& context, const Box& box, const core::Sketch& sketch, const std::string& words) {
  const Layout alone = lay_out_alone(sketch, box);
  draw_links(context, alone, sketch);
  draw_link_names(context, alone, sketch, words);
  draw_joints(context, alone, sketch);
  draw_loads(context, alone, sketch);
}

void draw_mechanism_sample(const Context& context, double x, double y, double width) {
  const Point2 left = {x + 7, y}, right = {x + width - 6, y};
  draw_bar(context, {left, right}, bar_width);
  draw_pin(context, left, true);
  draw_pin(context, right, false);
}

}  // namespace clearloci::report
