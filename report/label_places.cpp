#include "report/label_places.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::report {
namespace {

double common_area(const Box& a, const Box& b) {
  const double width = std::min(a.right(), b.right()) - std::max(a.x, b.x);
  const double height = std::min(a.bottom(), b.bottom()) - std::max(a.y, b.y);
  return width > 0 && height > 0 ? width * height : 0;
}

}  // namespace

void LabelPlaces::occupy(const Box& box, double weight) { occupied_.push_back({box, weight}); }

void LabelPlaces::occupy(const core::Point2& from, const core::Point2& to, double width, double weight) {
  // As squares along it.
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  const int steps = std::max(1, static_cast<int>(std::ceil(length / width)));
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    occupy(
        {from[0] + part * (to[0] - from[0]) - width / 2, from[1] + part * (to[1] - from[1]) - width / 2, width, width},
        weight);
  }
}

double LabelPlaces::cost(const Box& box) const {
  double covered = 0;
  for (const Occupied& occupied : occupied_) covered += occupied.weight * common_area(box, occupied.box);
  return covered;
}

std::pair<Box, double> LabelPlaces::cheapest(const std::vector<core::Point2>& places, double width,
                                             double height) const {
  constexpr double worth_moving = 1;  // pt²: less is not seen
  Box best{};
  double least = HUGE_VAL;
  for (const core::Point2& place : places) {
    Box box{place[0] - width / 2, place[1] - height / 2, width, height};
    box.x = std::clamp(box.x, room_.x, std::max(room_.x, room_.right() - width));
    box.y = std::clamp(box.y, room_.y, std::max(room_.y, room_.bottom() - height));
    const double box_cost = cost(box);
    if (box_cost < least - worth_moving) {
      best = box;
      least = box_cost;
    }
  }
  return {best, least};
}

core::Point2 LabelPlaces::take(const std::vector<core::Point2>& places, double width, double height) {
  const Box best = cheapest(places, width, height).first;
  occupy(best, 1);
  return {best.x + best.width / 2, best.y + best.height / 2};
}

std::optional<core::Point2> LabelPlaces::take_free(const std::vector<core::Point2>& places, double width, double height,
                                                   double part) {
  const auto [best, covered] = cheapest(places, width, height);
  if (!(covered <= part * width * height)) return std::nullopt;
  occupy(best, 1);
  return core::Point2{best.x + best.width / 2, best.y + best.height / 2};
}

}  // namespace clearloci::report
