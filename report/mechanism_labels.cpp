#include "report/mechanism_labels.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "report/mechanism_drawing.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::Point2;

constexpr Colour label_colour = light_theme.outline;
constexpr double label_turn = 2 * std::numbers::pi;
constexpr Font name_font{9, true, false};
constexpr Font load_font{8.5, true, false};

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
    const double angle = label_turn * k / 16;
    double room = std::numbers::pi;
    for (const double other : occupied) room = std::min(room, std::abs(std::remainder(angle - other, label_turn)));
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
  set_colour(canvas, label_colour, 0.6);
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
  write_over_lines(canvas, name, middle[0], middle[1] + 0.36 * name_font.size, name_font, label_colour, Align::centre);
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
  set_colour(canvas, label_colour);
  canvas.begin_new_sub_path();
  canvas.arc(at[0], at[1], radius, 0, label_turn);
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
      const Point2 way = {std::cos(label_turn * k / 16), std::sin(label_turn * k / 16)};
      places.push_back({at[0] + way[0] * (distance + width / 2 * std::abs(way[0])), at[1] - way[1] * (distance + 2)});
    }
  const Point2 middle = place_of(name, name_font, places, labels);
  draw_leader(canvas, at, middle, width / 2);
  write_over_lines(canvas, name, middle[0], middle[1] + 0.36 * name_font.size, name_font, label_colour, Align::centre);
}

void write_couple(const Canvas& canvas, const Layout& layout, const core::SketchLoad& load, LabelPlaces& labels) {
  const std::string words = engineering(std::abs(load.couple), 4) + " N m";
  const Point2 at = layout.page(load.at);
  const double beside = couple_radius + 5 + text_width(words, load_font) / 2, above = couple_radius + 9;
  write_label(canvas, words, load_font, light_theme.load,
              {{at[0], at[1] + above}, {at[0], at[1] - above}, {at[0] + beside, at[1]}, {at[0] - beside, at[1]}},
              labels);
}

/// Of a force on the page.
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
      const Point2 way = {std::cos(label_turn * k / 12), std::sin(label_turn * k / 12)};
      places.push_back({end[0] + way[0] * away * (half_width + 8), end[1] + way[1] * away * (half_height + 8)});
    }
  write_label(canvas, words, load_font, light_theme.load, places, labels);
}

bool stands_in(const std::string& name, const std::string& words) {
  const auto is_letter = [&](std::size_t k) {
    return k < words.size() && (std::isalnum(static_cast<unsigned char>(words[k])) != 0 || words[k] == '_');
  };
  for (std::size_t at = words.find(name); at != std::string::npos; at = words.find(name, at + 1))
    if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + name.size())) return true;
  return false;
}

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
    write_label(canvas, name, font, label_colour, places, labels);
  }
}

}  // namespace

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

void write_labels(const Canvas& canvas, const Layout& layout, const core::Sketch& sketch,
                  const std::vector<Arrow>& arrows, const std::string& words, LabelPlaces& labels) {
  for (const auto& joint : sketch.joints) write_joint_name(canvas, layout, sketch, joint, labels);
  write_end_effector(canvas, layout, sketch, labels);
  auto arrow = arrows.begin();
  for (const auto& load : sketch.loads) {
    if (load.force != Point2{0, 0}) write_force(canvas, load, *arrow++, labels);
    if (load.couple != 0) write_couple(canvas, layout, load, labels);
  }
  write_link_names(canvas, layout, sketch, words, labels);
}

}  // namespace clearloci::report
