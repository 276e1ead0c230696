#include "tests/laws/same_topology.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace clearloci::test {
namespace {

using core::Arc;
using core::LocusCurve;
using core::LocusMap;
using core::Point2;

double size_of(const LocusMap& map) {
  double size = 0;
  for (std::size_t i = 0; i < map.lower.size(); ++i)
    size = std::max(size, core::to_double(map.upper[i] - map.lower[i]));
  return size;
}

std::string name(const LocusMap& map, const LocusCurve& curve) {
  std::ostringstream text;
  text << to_string(curve.kind) << " " << curve.factor.substr(0, 50) << " [" << curve.cause << "] mode";
  for (const int sign : curve.mode) text << (sign > 0 ? '+' : '-');
  text << " on " << core::to_string(curve.implicit, map.tower.coordinates).substr(0, 60);
  return text.str();
}

std::string describe(const Arc& arc) {
  std::ostringstream text;
  text.precision(12);
  if (arc.closed)
    text << "closed";
  else
    text << to_string(arc.ends[0]) << " (" << arc.points.front()[0] << ", " << arc.points.front()[1] << ") to "
         << to_string(arc.ends[1]) << " (" << arc.points.back()[0] << ", " << arc.points.back()[1] << ")";
  text << " length " << arc.length;
  return text.str();
}

bool same_place(const Point2& a, const Point2& b, double size) {
  return std::hypot(a[0] - b[0], a[1] - b[1]) <= 1e-8 * size;
}

bool on_side(const LocusMap& map, const Point2& at) {
  for (std::size_t i = 0; i < map.lower.size(); ++i)
    for (const core::Rational& side : {map.lower[i], map.upper[i]})
      if (std::abs(at[i] - core::to_double(side)) <= 1e-12 * size_of(map)) return true;
  return false;
}

/// The arc with its ends on sides of the box named after the box.
Arc named_by_place(const LocusMap& map, Arc arc) {
  if (!arc.closed && on_side(map, arc.points.front())) arc.ends[0] = core::ArcEnd::box;
  if (!arc.closed && on_side(map, arc.points.back())) arc.ends[1] = core::ArcEnd::box;
  return arc;
}

bool same_arc(const Arc& a, const Arc& b, double size, double tolerance) {
  if (a.closed != b.closed) return false;
  if (std::abs(a.length - b.length) > 0.01 * a.length + 10 * tolerance) return false;
  if (a.closed) return true;
  const auto forward = a.ends == b.ends && same_place(a.points.front(), b.points.front(), size) &&
                       same_place(a.points.back(), b.points.back(), size);
  const auto backward = a.ends[0] == b.ends[1] && a.ends[1] == b.ends[0] &&
                        same_place(a.points.front(), b.points.back(), size) &&
                        same_place(a.points.back(), b.points.front(), size);
  return forward || backward;
}

bool same_curve(const LocusCurve& a, const LocusCurve& b) {
  return a.kind == b.kind && a.mode == b.mode && a.implicit == b.implicit && a.factor == b.factor &&
         a.cause == b.cause && a.vanishing == b.vanishing;
}

void compare_arcs(const LocusMap& map, LocusCurve a, LocusCurve b, EndsOnSides ends, std::vector<std::string>& found) {
  const double size = size_of(map);
  if (ends == EndsOnSides::by_place)
    for (LocusCurve* curve : {&a, &b})
      for (Arc& arc : curve->arcs) arc = named_by_place(map, arc);
  std::vector<bool> matched(b.arcs.size(), false);
  for (const Arc& arc : a.arcs) {
    std::size_t k = 0;
    while (k < b.arcs.size() && (matched[k] || !same_arc(arc, b.arcs[k], size, map.tolerance))) ++k;
    if (k < b.arcs.size())
      matched[k] = true;
    else
      found.push_back("only first: " + name(map, a) + ": " + describe(arc));
  }
  for (std::size_t k = 0; k < b.arcs.size(); ++k)
    if (!matched[k]) found.push_back("only second: " + name(map, b) + ": " + describe(b.arcs[k]));
}

}  // namespace

std::vector<std::string> differences(const LocusMap& a, const LocusMap& b, EndsOnSides ends) {
  std::vector<std::string> found;
  std::vector<bool> matched(b.curves.size(), false);
  for (const LocusCurve& curve : a.curves) {
    std::size_t k = 0;
    while (k < b.curves.size() && (matched[k] || !same_curve(curve, b.curves[k]))) ++k;
    if (k < b.curves.size()) {
      matched[k] = true;
      compare_arcs(a, curve, b.curves[k], ends, found);
    } else {
      found.push_back("only first: " + name(a, curve));
      for (const Arc& arc : curve.arcs) found.push_back("    " + describe(arc));
    }
  }
  for (std::size_t k = 0; k < b.curves.size(); ++k)
    if (!matched[k]) {
      found.push_back("only second: " + name(b, b.curves[k]));
      for (const Arc& arc : b.curves[k].arcs) found.push_back("    " + describe(arc));
    }
  // Maps over an angle alone have one value a point.
  const auto place = [](const core::IsolatedPoint& point) {
    return Point2{point.at[0], point.at.size() > 1 ? point.at[1] : 0};
  };
  const auto has = [&](const LocusMap& map, const core::IsolatedPoint& point) {
    return std::any_of(map.isolated_points.begin(), map.isolated_points.end(), [&](const core::IsolatedPoint& other) {
      return other.kind == point.kind && other.mode == point.mode && other.vanishing == point.vanishing &&
             same_place(place(other), place(point), size_of(a));
    });
  };
  for (const auto& [from, to, who] : {std::tuple{&a, &b, "first"}, std::tuple{&b, &a, "second"}})
    for (const core::IsolatedPoint& point : from->isolated_points)
      if (!has(*to, point))
        found.push_back(std::string("only ") + who + ": isolated " + to_string(point.kind) + " (" +
                        std::to_string(place(point)[0]) + ", " + std::to_string(place(point)[1]) + ")");
  return found;
}

}  // namespace clearloci::test
