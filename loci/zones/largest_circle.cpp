#include "loci/zones/largest_circle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace clearloci::loci {
namespace {

using core::Circle;
using core::Point2;
using core::Polyline;

constexpr int rounds = 6;
constexpr double same_contact = 0.02;  // relative to the radius
constexpr double settled_at = 1e-9;
constexpr double rounding = 1e-13;  // relative to the radius and the distance from the origin

double distance(const Point2& a, const Point2& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

/// The nearest point of a polyline between two of its vertices, and whether it is one of the line's own ends.
struct Nearest {
  Point2 at{};
  double distance = std::numeric_limits<double>::infinity();
  bool end = false;
};

Nearest nearest_on(const Polyline& line, std::size_t i, const Point2& from) {
  const Point2 &a = line[i], &b = line[i + 1];
  const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((from[0] - a[0]) * dx + (from[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0.0;
  const Point2 at = {a[0] + t * dx, a[1] + t * dy};
  return {at, distance(at, from), (i == 0 && t == 0) || (i + 2 == line.size() && t == 1)};
}

/// The point of the curve nearest to `centre`, from one near it: slide along the curve towards the foot, by the secant
/// method on what is left of the way along the tangent.
CurvePoint slid(const CurveProjection& curve, CurvePoint now, const Point2& centre) {
  constexpr double least_slope = 0.1, most_slope = 10;  // of what is left over the way; 1 on a straight line
  const auto left_at = [&](const CurvePoint& p) {
    return (centre[0] - p.at[0]) * p.tangent[0] + (centre[1] - p.at[1]) * p.tangent[1];
  };
  double slope = 1, left = left_at(now), far = distance(now.at, centre);
  for (int i = 0; i < 8; ++i) {
    const double way = left / slope;
    if (std::abs(left) < rounding * (1 + std::abs(now.at[0]) + std::abs(now.at[1]))) break;
    CurvePoint next = curve({now.at[0] + way * now.tangent[0], now.at[1] + way * now.tangent[1]});
    if (next.tangent[0] * now.tangent[0] + next.tangent[1] * now.tangent[1] < 0)
      next.tangent = {-next.tangent[0], -next.tangent[1]};
    // Near the foot all distances are the same to rounding, but what is left still tells half of the digits.
    const double distant = distance(next.at, centre), still_left = left_at(next);
    if (distant > far * (1 + rounding) || (distant >= far && std::abs(still_left) >= std::abs(left))) break;
    slope = std::clamp((left - still_left) / way, least_slope, most_slope);
    now = next;
    left = still_left;
    far = distant;
  }
  return now;
}

/// What the circle touches: a point of an obstacle; a corner stays where it is, a foot slides as the centre moves.
struct Contact {
  CurvePoint on;
  const CurveProjection* slides = nullptr;

  const Point2& at() const { return on.at; }
};

void follow(Contact& contact, const Point2& centre) {
  if (contact.slides != nullptr) contact.on = slid(*contact.slides, contact.on, centre);
}

/// Where the circle, grown by `slack`, reaches obstacles: one point a pass.
std::vector<Contact> contacts(const Circle& circle, const std::vector<Obstacle>& obstacles, const Polyline& points,
                              double slack) {
  std::vector<Contact> list;
  const auto add = [&](const Contact& contact) {
    const bool is_present = std::any_of(list.begin(), list.end(), [&](const Contact& other) {
      return other.slides == contact.slides && distance(other.at(), contact.at()) < same_contact * circle.radius;
    });
    if (!is_present) list.push_back(contact);
  };
  const double reach = circle.radius + slack;
  for (const Obstacle& obstacle : obstacles) {
    const Polyline& line = *obstacle.line;
    std::optional<Nearest> best;
    const auto finish = [&] {
      if (best && (best->end || obstacle.curve == nullptr)) add({{best->at, {}}, nullptr});
      if (best && !best->end && obstacle.curve != nullptr)
        add({slid(*obstacle.curve, (*obstacle.curve)(best->at), circle.centre), obstacle.curve});
      best.reset();
    };
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Nearest near = nearest_on(line, i, circle.centre);
      if (near.distance > reach)
        finish();
      else if (!best || near.distance < best->distance)
        best = near;
    }
    finish();
  }
  for (const Point2& p : points) {
    if (distance(p, circle.centre) <= reach) add({{p, {}}, nullptr});
  }
  return list;
}

double least_distance(const std::vector<Contact>& from, const Point2& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const Contact& contact : from) least = std::min(least, distance(contact.at(), at));
  return least;
}

/// The largest circle away from the tangents at the contacts: three of them bound it.
std::optional<Circle> largest_between(const std::vector<Contact>& contacts, const Point2& centre) {
  struct Line {
    double nx, ny, offset;
  };
  std::vector<Line> lines;
  for (const Contact& contact : contacts) {
    const Point2& p = contact.at();
    const double d = distance(p, centre);
    if (d == 0) return std::nullopt;
    const double nx = (centre[0] - p[0]) / d, ny = (centre[1] - p[1]) / d;
    lines.push_back({nx, ny, nx * p[0] + ny * p[1]});
  }
  std::optional<Circle> best;
  const auto determinant = [](double a, double b, double c, double d) { return a * d - b * c; };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      for (std::size_t k = j + 1; k < lines.size(); ++k) {
        const Line &l = lines[i], &m = lines[j], &n = lines[k];
        // n . z - r = offset, three times: differences leave two equations in z.
        const double a = l.nx - m.nx, b = l.ny - m.ny, c = l.nx - n.nx, d = l.ny - n.ny;
        const double e = l.offset - m.offset, f = l.offset - n.offset, all = determinant(a, b, c, d);
        if (std::abs(all) < 1e-9) continue;
        const Point2 z = {determinant(e, b, f, d) / all, determinant(a, e, c, f) / all};
        const double r = l.nx * z[0] + l.ny * z[1] - l.offset;
        // The normals hold the circle from all sides, and no other line cuts it.
        const double u = determinant(m.nx, m.ny, n.nx, n.ny), v = determinant(n.nx, n.ny, l.nx, l.ny),
                     w = determinant(l.nx, l.ny, m.nx, m.ny);
        if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) continue;
        const bool free = std::all_of(lines.begin(), lines.end(), [&](const Line& o) {
          return o.nx * z[0] + o.ny * z[1] - o.offset >= r * (1 - 1e-9);
        });
        if (free && r > 0 && (!best || r > best->radius)) best = Circle{z, r};
      }
    }
  }
  return best;
}

/// Between two opposite contacts the circle is widest where it can roll neither way: where they face each other.
std::optional<Circle> widest_between(Contact first, Contact second, const Circle& start) {
  const double gap = distance(first.at(), second.at());
  if (gap < 1.8 * start.radius) return std::nullopt;
  const Point2 across = {(second.at()[0] - first.at()[0]) / gap, (second.at()[1] - first.at()[1]) / gap};
  const Point2 along = {-across[1], across[0]};
  struct Rolled {
    Circle circle;
    double pull = 0;  ///< which way it could grow: positive along `along`
  };
  // The circle that touches both, rolled by `way` between them.
  const auto rolled = [&](double way) {
    Point2 z = {start.centre[0] + way * along[0], start.centre[1] + way * along[1]};
    double radius = 0;
    for (int i = 0; i < 12; ++i) {
      follow(first, z);
      follow(second, z);
      const double a = distance(first.at(), z), b = distance(second.at(), z), shift = (b - a) / 2;
      radius = std::min(a, b);
      if (std::abs(shift) < rounding * start.radius) break;
      z = {z[0] + shift * across[0], z[1] + shift * across[1]};
    }
    double pull = 0;
    for (const Point2& foot : {first.at(), second.at()})
      for (std::size_t c = 0; c < 2; ++c) pull += (z[c] - foot[c]) / radius * along[c];
    return Rolled{{z, radius}, pull};
  };
  double low = -farthest_polished * start.radius, high = -low;
  Rolled at_low = rolled(low), at_high = rolled(high);
  if (at_low.pull <= 0 || at_high.pull >= 0)
    return at_low.circle.radius > at_high.circle.radius ? at_low.circle : at_high.circle;
  // Regula falsi, with the weight of an end halved that stays once more (the Illinois rule).
  double weight_low = at_low.pull, weight_high = at_high.pull;
  Rolled best = at_low;
  int moved = 0;
  for (int i = 0; i < 60 && high - low > 1e-9 * start.radius; ++i) {
    const double way = low + (high - low) * weight_low / (weight_low - weight_high);
    best = rolled(way);
    if (std::abs(best.pull) < 1e-12) break;
    const int side = best.pull > 0 ? 1 : -1;
    if (side > 0) {
      low = way, weight_low = best.pull;
      if (moved == side) weight_high /= 2;
    } else {
      high = way, weight_high = best.pull;
      if (moved == side) weight_low /= 2;
    }
    moved = side;
  }
  return best.circle;
}

}  // namespace

Circle polished(const Circle& start, const std::vector<Obstacle>& obstacles, const Polyline& points, double tolerance) {
  const double slack = 4 * tolerance + 1e-3 * start.radius;
  Circle now = start;
  for (int i = 0; i < rounds; ++i) {
    const std::vector<Contact> touching = contacts(now, obstacles, points, slack);
    std::optional<Circle> next = largest_between(touching, now.centre);
    if (!next && touching.size() == 2) next = widest_between(touching[0], touching[1], now);
    if (!next || distance(next->centre, start.centre) > farthest_polished * start.radius) break;
    const bool settled = distance(next->centre, now.centre) < settled_at * start.radius;
    now = *next;
    if (settled) break;
  }
  // What counts in the end is the distance of the centre from the curves.
  const auto free_radius = [&](const Point2& centre) {
    return least_distance(contacts({centre, start.radius}, obstacles, points, slack), centre);
  };
  const double first = free_radius(start.centre), last = free_radius(now.centre);
  Circle best = last >= first ? Circle{now.centre, last} : Circle{start.centre, first};
  if (!std::isfinite(best.radius)) best = {start.centre, start.radius - tolerance};
  best.radius -= rounding * (best.radius + std::hypot(best.centre[0], best.centre[1]));
  return best;
}

}  // namespace clearloci::loci
