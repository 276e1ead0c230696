#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numeric/reach.hpp"

namespace clearloci::numeric {

namespace {

/// Of a bound: a few dozen.
constexpr double operations = 64;

/// The support function of the positions that the end effector's point can take.
class Support {
 public:
  Support(const std::vector<Reach>& all, int row) {
    for (const Reach& reach : all) add({reach(row, 0), reach(row + 1, 0), reach(row, 1), reach(row + 1, 1)});
  }

  /// h(n) at n = (cos angle, sin angle).
  double support(double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    double sum = 0;
    for (const Term& term : terms_) sum += term.size(c, s);
    return sum;
  }

  /// The direction of the place that is farthest along n: it is at least as far away as h(n), so is h there.
  double direction_of_farthest(double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    Point2 place{};
    for (const Term& term : terms_) {
      const double first = term.first(c, s), second = term.second(c, s), size = term.size(c, s);
      if (!(size > 0)) continue;
      place[0] += (first * term.xx + second * term.xy) / size;
      place[1] += (first * term.yx + second * term.yy) / size;
    }
    return std::atan2(place[1], place[0]);
  }

  /// An upper bound of h between two directions, good where every term changes little from `middle` on:
  /// sqrt(q) <= (q/c + c)/2 with c = sqrt(q) there, and q is a sinusoid of twice the angle. Infinite where a term is 0.
  double sinusoid_bound(double from, double middle, double to) const {
    const double c = std::cos(middle), s = std::sin(middle);
    double constant = 0, cosine = 0, sine = 0;
    for (const Term& term : terms_) {
      const double size = term.size(c, s);
      const double a = term.xx * term.xx + term.xy * term.xy, d = term.yx * term.yx + term.yy * term.yy;
      const double b = term.xx * term.yx + term.xy * term.yy;
      if (!(size > 1e-7 * std::sqrt(a + d))) return std::numeric_limits<double>::infinity();
      constant += ((a + d) / 2 / size + size) / 2;
      cosine += (a - d) / 4 / size;
      sine += b / 2 / size;
    }
    const double amplitude = std::hypot(cosine, sine);
    const double peak = std::remainder(std::atan2(sine, cosine) / 2 - middle, std::numbers::pi);
    if (std::abs(peak) <= (to - from) / 2 * (1 + 1e-9) + 1e-12) return constant + amplitude;
    const auto at = [&](double angle) { return constant + cosine * std::cos(2 * angle) + sine * std::sin(2 * angle); };
    return std::max(at(from), at(to));
  }

 private:
  /// A clearance moves the point by (xx, yx) u + (xy, yy) v, u^2 + v^2 <= 1.
  struct Term {
    double xx, yx, xy, yy;
    double first(double c, double s) const { return c * xx + s * yx; }
    double second(double c, double s) const { return c * xy + s * yy; }
    double size(double c, double s) const {
      const double u = first(c, s), v = second(c, s);
      return std::sqrt(u * u + v * v);
    }
  };
  void add(const Term& term) {
    if (term.xx != 0 || term.yx != 0 || term.xy != 0 || term.yy != 0) terms_.push_back(term);
  }

  std::vector<Term> terms_;
};

struct Sector {
  double from, to;                   ///< angles of two directions
  double at_from, at_middle, at_to;  ///< h there
  double bound;                      ///< of h in between
  bool operator<(const Sector& other) const { return bound < other.bound; }

  double middle() const { return (from + to) / 2; }
};

/// An upper bound of h over the directions of a sector (worst_case.hpp), written without cancellation.
double corner_bound(double width, double at_from, double at_to) {
  const double c = std::cos(width);
  const bool corner_inside = at_to >= at_from * c && at_from >= at_to * c;
  if (!corner_inside) return std::max(at_from, at_to);
  const double half = std::sin(width / 2), difference = at_from - at_to;
  return std::sqrt(difference * difference + 4 * at_from * at_to * half * half) / std::sin(width);
}

Sector sector(const Support& reach, double from, double to, double at_from, double at_to) {
  Sector s{from, to, at_from, reach.support((from + to) / 2), at_to, 0};
  const double half = (to - from) / 2;
  s.bound = std::min(std::max(corner_bound(half, at_from, s.at_middle), corner_bound(half, s.at_middle, at_to)),
                     reach.sinusoid_bound(from, s.middle(), to));
  // The difference of two values is known to their roundings, and is divided by the width.
  const double rounding = 8 * std::numeric_limits<double>::epsilon() / (to - from);
  s.bound = std::max({s.bound, at_from, s.at_middle, at_to}) * (1 + rounding);
  return s;
}

/// The corner of so narrow a sector lies farther out than its sides by less than a rounding error: 1 - cos(width/2).
constexpr double narrowest_sector = 1e-8;

}  // namespace

double farthest_in_plane(const std::vector<Reach>& all, int row, double accuracy) {
  const Support reach(all, row);
  constexpr int sectors = 8;  // of the half turn after which h repeats
  constexpr int steps = 12;   // towards a largest value, before cells prove that there is none larger
  constexpr double width = std::numbers::pi / sectors;
  std::vector<Sector> open;
  double best = 0, at_best = 0, last = reach.support(0);
  for (int i = 0; i < sectors; ++i) {
    const double next = reach.support((i + 1) * width);
    open.push_back(sector(reach, i * width, (i + 1) * width, last, next));
    for (const auto& [value, angle] : {std::pair{next, (i + 1) * width}, {open.back().at_middle, open.back().middle()}})
      if (value > best) best = value, at_best = angle;
    last = next;
  }
  for (int i = 0; i < steps; ++i) {
    at_best = reach.direction_of_farthest(at_best);
    best = std::max(best, reach.support(at_best));
  }
  std::make_heap(open.begin(), open.end());
  while (true) {
    const Sector s = open.front();
    if (s.to - s.from < narrowest_sector || s.bound <= best * (1 + accuracy))
      return rounded_up(std::max(best, s.bound), operations);
    std::pop_heap(open.begin(), open.end());
    open.pop_back();
    for (const Sector& half : {sector(reach, s.from, s.middle(), s.at_from, s.at_middle),
                               sector(reach, s.middle(), s.to, s.at_middle, s.at_to)}) {
      best = std::max(best, half.at_middle);
      open.push_back(half);
      std::push_heap(open.begin(), open.end());
    }
  }
}

}  // namespace clearloci::numeric
