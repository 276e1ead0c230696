#include "loci/zones/circle_crossings.hpp"

#include <cmath>

#include "core/rational.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {
namespace {

using core::Point2;

std::optional<sheet::BoundaryCurve> curve_of(const core::ClosedForm& form) {
  sheet::BoundaryCurve curve;
  if (const auto* line = std::get_if<core::LineForm>(&form)) {
    curve.is_line = true;
    curve.normal = {line->a, line->b};
    curve.level = -line->c;
  } else if (const auto* circle = std::get_if<core::CircleForm>(&form)) {
    curve.x = circle->centre[0];
    curve.y = circle->centre[1];
    curve.radius_squared = circle->radius_squared;
  } else {
    return std::nullopt;
  }
  return curve;
}

}  // namespace

std::optional<std::vector<Point2>> circle_crossings(const core::ClosedForm& a, const core::ClosedForm& b) {
  const std::optional<sheet::BoundaryCurve> first = curve_of(a), second = curve_of(b);
  if (!first || !second) return std::nullopt;
  const std::optional<sheet::BoundaryMeeting> meeting = sheet::meeting_of(*first, *second);
  if (!meeting) return std::vector<Point2>{};
  const Point2 foot = {core::to_double(meeting->foot[0]), core::to_double(meeting->foot[1])};
  if (meeting->rise == 0) return std::vector<Point2>{foot};
  const double root = std::sqrt(core::to_double(meeting->rise));
  const double x = root * core::to_double(meeting->way[0]), y = root * core::to_double(meeting->way[1]);
  return std::vector<Point2>{{foot[0] + x, foot[1] + y}, {foot[0] - x, foot[1] - y}};
}

std::vector<Point2> own_crossings(const core::ClosedForm& form) {
  const auto* pair = std::get_if<core::CirclePairForm>(&form);
  if (pair == nullptr) return {};
  // Centres a + b sqrt(n) and a - b sqrt(n): sqrt(n) cancels in the foot of the common chord and in its squared half.
  const core::Rational n(pair->n), bx = pair->centre[0].multiple, by = pair->centre[1].multiple;
  const core::Rational b2 = bx * bx + by * by;
  if (b2 == 0) return {};
  const core::Rational along = pair->radius_squared.multiple / (2 * b2);
  const core::Rational half2 = pair->radius_squared.rational - n * b2 - along * along * b2;
  if (half2 < 0) return {};
  const Point2 foot = {core::to_double(pair->centre[0].rational - along * bx),
                       core::to_double(pair->centre[1].rational - along * by)};
  if (half2 == 0) return {foot};
  const double part = std::sqrt(core::to_double(half2 / b2));
  const double x = -part * core::to_double(by), y = part * core::to_double(bx);
  return {{foot[0] + x, foot[1] + y}, {foot[0] - x, foot[1] - y}};
}

}  // namespace clearloci::loci
