#include "report/zone_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/mechanism_drawing.hpp"

namespace clearloci::report {
namespace {

constexpr const auto& fills = light_theme.zones;
constexpr double fill_strength = light_theme.zone_strength;
constexpr Colour circle_colour = light_theme.circle;
constexpr Colour no_preload_colour = {0.55, 0.55, 0.55};  ///< no choice of efforts is feasible
constexpr Colour little_preload_colour = {0.98, 0.85, 0.45}, much_preload_colour = {0.75, 0.2, 0.1};
constexpr double least_numbered = 5;  // pt, radius of the largest circle
constexpr Font number_font{9.5, true, false};

template <typename Action>
void for_each_zone(const Subject& subject, const Action& action) {
  std::size_t number = 0;
  for (const core::Zone& zone : subject.zones->zones) {
    if (zone.mode == subject.mode) action(zone, number++);
  }
}

/// The largest size of efforts that a zone needs; 0 where none needs any, and of cables.
double most_needed(const Subject& subject) {
  double most = 0;
  for_each_zone(subject, [&](const core::Zone& zone, std::size_t) {
    if (zone.preload && !zone.preload->efforts.empty() && !zone.preload->efforts.front().cable)
      most = std::max(most, zone.preload->smallest.value_or(0));
  });
  return most;
}

Colour fill_of(const core::Zone& zone, std::size_t number, double most) {
  if (zone.preload && !zone.preload->feasible) return no_preload_colour;
  if (!zone.preload || most <= 0) return zone_colour(number);
  const double part = zone.preload->smallest.value_or(0) / most;
  const auto between = [&](double a, double b) { return a + part * (b - a); };
  return {between(little_preload_colour.red, much_preload_colour.red),
          between(little_preload_colour.green, much_preload_colour.green),
          between(little_preload_colour.blue, much_preload_colour.blue)};
}

}  // namespace

void draw_zones(const Canvas& canvas, const Subject& subject, const Layout& layout) {
  const double most = most_needed(subject);
  for_each_zone(subject, [&](const core::Zone& zone, std::size_t number) {
    const auto add = [&](const core::Polyline& ring) {
      canvas.begin_new_sub_path();
      for (const core::Point2& p : ring) {
        const core::Point2 at = layout.page(p);
        canvas.line_to(at[0], at[1]);
      }
      canvas.close_path();
    };
    add(zone.outer);
    for (const core::Polyline& hole : zone.holes) add(hole);
    canvas.set_fill_rule(FillRule::even_odd);
    set_colour(canvas, fill_of(zone, number, most), fill_strength);
    canvas.fill();
    canvas.set_fill_rule(FillRule::winding);
  });
}

void draw_zone_numbers(const Canvas& canvas, const Subject& subject, const Layout& layout, LabelPlaces& labels) {
  const bool circles = subject.task == nullptr;  // a task's picture tells of the task
  for_each_zone(subject, [&](const core::Zone& zone, std::size_t) {
    const core::Point2 at = layout.page({zone.ball.centre[0], zone.ball.centre[1]});
    const double radius = zone.ball.radius * layout.scale[0];
    if (circles) {
      set_colour(canvas, circle_colour, 0.8);
      canvas.set_line_width(0.7);
      canvas.set_dash({3, 2});
      canvas.begin_new_sub_path();
      canvas.arc(at[0], at[1], radius, 0, 2 * std::numbers::pi);
      canvas.stroke();
      canvas.set_dash({});
    }
    if (radius < least_numbered) return;
    std::vector<core::Point2> places = {at};
    for (const double away : {0.45, 0.8})
      for (int k = 0; k < 8; ++k)
        places.push_back({at[0] + away * radius * std::cos(std::numbers::pi / 4 * k),
                          at[1] + away * radius * std::sin(std::numbers::pi / 4 * k)});
    const core::Point2 middle = labels.take(places, text_width(zone.id, number_font) + 4, number_font.size + 2);
    set_colour(canvas, {0.1, 0.1, 0.1});
    write_text(canvas, zone.id, middle[0], middle[1] + 0.36 * number_font.size, number_font, Align::centre);
  });
}

void draw_zone_sample(const Canvas& canvas, double x, double y, double width) {
  constexpr int shown = 3;
  for (int i = 0; i < shown; ++i) {
    canvas.rectangle(x + i * width / shown, y - 4.5, width / shown, 9);
    set_colour(canvas, fills[static_cast<std::size_t>(i)], fill_strength);
    canvas.fill();
  }
}

}  // namespace clearloci::report
