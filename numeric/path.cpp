#include "numeric/path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/errors.hpp"

namespace clearloci::numeric {

namespace {

using mechanism::Waypoint;

/// Directions that differ by less than this (rad) go straight on: what the rounding of waypoints makes of a line.
constexpr double straight = 1e-9;

double dot(const Place& a, const Place& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// a + s b.
Place plus(const Place& a, double s, const Place& b) {
  Place sum = a;
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] += s * b[i];
  return sum;
}

Place unit(const Place& a) {
  Place u = a;
  const double size = std::sqrt(dot(a, a));
  for (double& x : u) x /= size;
  return u;
}

Place place_of(const Waypoint& waypoint) {
  Place place;
  for (const core::Rational& value : waypoint.at) place.push_back(core::to_double(value));
  return place;
}

/// The waypoints in the order in which the path meets them; a closed path ends with its first.
struct Route {
  std::vector<const Waypoint*> waypoints;
  std::vector<Place> places;
  std::vector<int> numbers;
};

Route route_of(const mechanism::Trajectory& trajectory) {
  Route route;
  const auto add = [&](std::size_t i) {
    route.waypoints.push_back(&trajectory.waypoints[i]);
    route.places.push_back(place_of(trajectory.waypoints[i]));
    route.numbers.push_back(static_cast<int>(i));
  };
  for (std::size_t i = 0; i < trajectory.waypoints.size(); ++i) add(i);
  if (trajectory.closed) add(0);
  return route;
}

class PathBuilder {
 public:
  void add(PathPiece piece) {
    if (!(piece.length > 0)) return;
    piece.start = length_;
    length_ += piece.length;
    path_.pieces.push_back(std::move(piece));
  }
  void stop(int waypoint) {
    path_.stops.push_back(length_);
    path_.stop_waypoints.push_back(waypoint);
  }
  CompiledPath finish() { return std::move(path_); }

 private:
  CompiledPath path_;
  double length_ = 0;
};

// --- straight lines and rounded corners

struct Corner {
  double cut = 0;   ///< of the segments on both sides
  double turn = 0;  ///< rad
  double radius = 0;
};

Corner corner_at(const Waypoint& waypoint, const Place& before, const Place& after) {
  const double turn = std::atan2(std::sqrt(std::max(0.0, 1 - std::pow(dot(before, after), 2))), dot(before, after));
  Corner corner{0, turn, core::to_double(waypoint.corner)};
  if (waypoint.stop || turn < straight) return {0, turn, 0};
  if (corner.radius == 0)
    throw core::InputError(waypoint.where, "the path turns a sharp corner here without stopping",
                           "write a radius, such as corner: 0.01, or stop: true");
  if (turn > std::numbers::pi - 1e-6)
    throw core::InputError(waypoint.where, "the path turns back here, which no arc can round", "write stop: true");
  corner.cut = corner.radius * std::tan(turn / 2);
  return corner;
}

void check_fit(const Waypoint& waypoint, const Waypoint& next, double length, const Corner& a, const Corner& b) {
  if (a.cut + b.cut <= length * (1 + 1e-12)) return;
  const Waypoint& wrong = a.cut >= b.cut ? waypoint : next;
  char percent[32];
  std::snprintf(percent, sizeof percent, "%.3g", std::floor(1000 * length / (a.cut + b.cut)) / 10);
  throw core::InputError(wrong.where, "the rounded corner does not fit the lines beside it",
                         std::string("write a radius of at most ") + percent + " % of this one");
}

CompiledPath straight_path(const mechanism::Trajectory& trajectory) {
  const Route route = route_of(trajectory);
  const std::size_t last = route.places.size() - 1;
  std::vector<Place> directions;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < last; ++i) {
    const Place step = plus(route.places[i + 1], -1, route.places[i]);
    lengths.push_back(std::sqrt(dot(step, step)));
    directions.push_back(unit(step));
  }
  std::vector<Corner> corners(last + 1);
  for (std::size_t i = 1; i < last; ++i) corners[i] = corner_at(*route.waypoints[i], directions[i - 1], directions[i]);
  PathBuilder builder;
  builder.stop(route.numbers[0]);
  for (std::size_t i = 0; i < last; ++i) {
    check_fit(*route.waypoints[i], *route.waypoints[i + 1], lengths[i], corners[i], corners[i + 1]);
    const Place from = plus(route.places[i], corners[i].cut, directions[i]);
    const double length = lengths[i] - corners[i].cut - corners[i + 1].cut;
    // What is left between two arcs that just fit is rounding.
    if (length > 1e-12 * lengths[i]) builder.add({LinePiece{from, directions[i]}, 0, length});
    const Corner& corner = corners[i + 1];
    if (i + 1 == last || route.waypoints[i + 1]->stop) {
      builder.stop(route.numbers[i + 1]);
    } else if (corner.radius > 0) {
      const Place begin = plus(route.places[i + 1], -corner.cut, directions[i]);
      const Place inward = unit(plus(directions[i + 1], -dot(directions[i + 1], directions[i]), directions[i]));
      Place e1 = inward;
      for (double& x : e1) x = -x;
      builder.add({ArcPiece{plus(begin, corner.radius, inward), e1, directions[i], corner.radius}, 0,
                   corner.radius * corner.turn});
    }
  }
  return builder.finish();
}

// --- smooth curves

/// Gauss-Legendre nodes and weights on [0, 1], Abramowitz and Stegun table 25.4, n = 8.
constexpr std::array<std::array<double, 2>, 4> gauss = {{{0.1834346424956498, 0.3626837833783620},
                                                         {0.5255324099163290, 0.3137066458778873},
                                                         {0.7966664774136267, 0.2223810344533745},
                                                         {0.9602898564975363, 0.1012285362903763}}};

double speed(const CubicPiece& p, double u) {
  double sum = 0;
  for (std::size_t i = 0; i < p.a.size(); ++i) {
    const double v = p.b[i] + u * (2 * p.c[i] + 3 * u * p.d[i]);
    sum += v * v;
  }
  return std::sqrt(sum);
}

double gauss_length(const CubicPiece& p, double from, double to) {
  const double middle = (from + to) / 2, half = (to - from) / 2;
  double sum = 0;
  for (const auto& [node, weight] : gauss)
    sum += weight * (speed(p, middle - half * node) + speed(p, middle + half * node));
  return half * sum;
}

/// Halved until the two halves agree with the whole to a few roundoffs.
double arc_length(const CubicPiece& p, double from, double to, int depth = 0) {
  constexpr int deepest = 40;
  const double whole = gauss_length(p, from, to), middle = (from + to) / 2;
  const double halves = gauss_length(p, from, middle) + gauss_length(p, middle, to);
  if (std::abs(whole - halves) <= 1e-15 * std::abs(halves) || depth == deepest) return halves;
  return arc_length(p, from, middle, depth + 1) + arc_length(p, middle, to, depth + 1);
}

/// Second derivatives of the natural cubic spline through values at the knots h apart (one coordinate).
std::vector<double> spline_curvatures(const std::vector<double>& values, const std::vector<double>& h) {
  struct Row {
    double diagonal = 1, right = 0;
  };
  const std::size_t n = values.size();
  std::vector<double> curvatures(n, 0.0);
  if (n < 3) return curvatures;
  std::vector<Row> rows(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    rows[i].diagonal = 2 * (h[i - 1] + h[i]);
    rows[i].right = 6 * ((values[i + 1] - values[i]) / h[i] - (values[i] - values[i - 1]) / h[i - 1]);
  }
  for (std::size_t i = 2; i + 1 < n; ++i) {
    const double factor = h[i - 1] / rows[i - 1].diagonal;
    rows[i].diagonal -= factor * h[i - 1];
    rows[i].right -= factor * rows[i - 1].right;
  }
  for (std::size_t i = n - 1; i-- > 1;) curvatures[i] = (rows[i].right - h[i] * curvatures[i + 1]) / rows[i].diagonal;
  return curvatures;
}

void add_spline(PathBuilder& builder, const std::vector<Place>& places) {
  std::vector<double> h;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Place step = plus(places[i + 1], -1, places[i]);
    h.push_back(std::sqrt(dot(step, step)));
  }
  const std::size_t dimensions = places.front().size();
  std::vector<CubicPiece> pieces(
      h.size(), CubicPiece{Place(dimensions), Place(dimensions), Place(dimensions), Place(dimensions)});
  for (std::size_t c = 0; c < dimensions; ++c) {
    std::vector<double> values;
    for (const Place& place : places) values.push_back(place[c]);
    const std::vector<double> m = spline_curvatures(values, h);
    for (std::size_t i = 0; i < h.size(); ++i) {
      pieces[i].a[c] = values[i];
      pieces[i].b[c] = values[i + 1] - values[i] - h[i] * h[i] * (2 * m[i] + m[i + 1]) / 6;
      pieces[i].c[c] = h[i] * h[i] * m[i] / 2;
      pieces[i].d[c] = h[i] * h[i] * (m[i + 1] - m[i]) / 6;
    }
  }
  for (CubicPiece& piece : pieces) {
    const double length = arc_length(piece, 0, 1);
    builder.add({std::move(piece), 0, length});
  }
}

CompiledPath smooth_path(const mechanism::Trajectory& trajectory) {
  const Route route = route_of(trajectory);
  PathBuilder builder;
  builder.stop(route.numbers[0]);
  std::vector<Place> run = {route.places[0]};
  for (std::size_t i = 1; i < route.places.size(); ++i) {
    run.push_back(route.places[i]);
    if (i + 1 < route.places.size() && !route.waypoints[i]->stop) continue;
    add_spline(builder, run);
    builder.stop(route.numbers[i]);
    run = {route.places[i]};
  }
  return builder.finish();
}

// --- places

/// u of a cubic as a series of the length: u' = s'/|c'(u)|, term by term.
Series parameter_of(const CubicPiece& p, const Series& s) {
  double u = 0;
  const double whole = arc_length(p, 0, 1);
  double low = -0.1, high = 1.1;
  u = s.value() / whole;
  for (int i = 0; i < 60; ++i) {
    const double excess = arc_length(p, 0, u) - s.value();
    (excess > 0 ? high : low) = u;
    double next = u - excess / speed(p, u);
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::abs(next - u) <= 4e-16) break;
    u = next;
  }
  Series result(u);
  for (std::size_t k = 0; k < 3; ++k) {
    Series squared;
    for (std::size_t i = 0; i < p.a.size(); ++i) {
      const Series v = Series(p.b[i]) + result * (Series(2 * p.c[i]) + (3 * p.d[i]) * result);
      squared = squared + v * v;
    }
    Series rate;  // s', as a series of its own
    for (std::size_t i = 0; i < 3; ++i) rate.c[i] = static_cast<double>(i + 1) * s.c[i + 1];
    const Series u_rate = rate / sqrt(squared);
    result.c[k + 1] = u_rate.c[k] / static_cast<double>(k + 1);
  }
  return result;
}

}  // namespace

CompiledPath compile(const mechanism::Trajectory& trajectory) {
  return trajectory.smooth ? smooth_path(trajectory) : straight_path(trajectory);
}

std::vector<Series> place_at(const CompiledPath& path, std::size_t piece, const Series& length) {
  const PathPiece& p = path.pieces[piece];
  const Series s = length - Series(p.start);
  std::vector<Series> place;
  if (const auto* line = std::get_if<LinePiece>(&p.shape)) {
    for (std::size_t i = 0; i < line->from.size(); ++i) place.push_back(Series(line->from[i]) + line->direction[i] * s);
  } else if (const auto* arc = std::get_if<ArcPiece>(&p.shape)) {
    Series sine, cosine;
    sin_cos((1 / arc->radius) * s, sine, cosine);
    for (std::size_t i = 0; i < arc->centre.size(); ++i)
      place.push_back(Series(arc->centre[i]) + arc->radius * (arc->e1[i] * cosine + arc->e2[i] * sine));
  } else {
    const auto& cubic = std::get<CubicPiece>(p.shape);
    const Series u = parameter_of(cubic, s);
    for (std::size_t i = 0; i < cubic.a.size(); ++i)
      place.push_back(Series(cubic.a[i]) + u * (Series(cubic.b[i]) + u * (Series(cubic.c[i]) + cubic.d[i] * u)));
  }
  return place;
}

}  // namespace clearloci::numeric
