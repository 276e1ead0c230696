#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "numeric/reach.hpp"

namespace clearloci::numeric {

namespace {

/// Of a bound: a few dozen.
constexpr double operations = 64;

/// n = (cos angle, sin angle).
struct Direction {
  double c = 1, s = 0;
};

Direction direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// The support function of the positions that the end effector's point can take.
class Support {
 public:
  Support(const std::vector<Reach>& all, int row) {
    terms_.reserve(all.size());
    for (const Reach& reach : all) add({reach(row, 0), reach(row + 1, 0), reach(row, 1), reach(row + 1, 1)});
  }

  double operator()(const Direction& n) const {
    double sum = 0;
    for (const Term& term : terms_) sum += term.size(n);
    return sum;
  }

  /// The direction of the place that is farthest along n: it is at least as far away as h(n), so is h there.
  Direction of_farthest(const Direction& n) const {
    Direction place{0, 0};
    for (const Term& term : terms_) {
      const double first = term.first(n), second = term.second(n), size = term.size(n);
      if (!(size > 0)) continue;
      place.c += (first * term.xx + second * term.xy) / size;
      place.s += (first * term.yx + second * term.yy) / size;
    }
    const double distance = std::hypot(place.c, place.s);
    return distance > 0 ? Direction{place.c / distance, place.s / distance} : n;
  }

  /// An upper bound of h between two directions, good where every term changes little from `middle` on:
  /// sqrt(q) <= (q/c + c)/2 with c = sqrt(q) there, and q is a sinusoid of twice the angle. Infinite where a term is 0.
  /// `cosine_of_width`: of the angle between `from` and `to`.
  double sinusoid_bound(const Direction& from, const Direction& middle, const Direction& to,
                        double cosine_of_width) const {
    double constant = 0, cosine = 0, sine = 0;
    for (const Term& term : terms_) {
      const double size = term.size(middle);
      if (!(size > 1e-7 * term.frame)) return std::numeric_limits<double>::infinity();
      constant += ((term.a + term.d) / 2 / size + size) / 2;
      cosine += (term.a - term.d) / 4 / size;
      sine += term.b / 2 / size;
    }
    const auto wave = [&](const Direction& n) { return cosine * (n.c - n.s) * (n.c + n.s) + sine * 2 * n.c * n.s; };
    const double amplitude = std::hypot(cosine, sine);
    // Whether its peak lies within, or may for what rounding leaves of the cosines; then the bound is but larger.
    constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
    if (wave(middle) >= amplitude * (cosine_of_width - rounding)) return constant + amplitude;
    return constant + std::max(wave(from), wave(to));
  }

 private:
  /// A clearance moves the point by (xx, yx) u + (xy, yy) v, u^2 + v^2 <= 1. Its size in a direction is the root of
  /// a c^2 + 2 b c s + d s^2.
  struct Term {
    double xx, yx, xy, yy;
    double a = xx * xx + xy * xy, b = xx * yx + xy * yy, d = yx * yx + yy * yy;
    double frame = std::sqrt(a + d);
    double first(const Direction& n) const { return n.c * xx + n.s * yx; }
    double second(const Direction& n) const { return n.c * xy + n.s * yy; }
    double size(const Direction& n) const {
      const double u = first(n), v = second(n);
      return std::sqrt(u * u + v * v);
    }
  };
  void add(const Term& term) {
    if (term.xx != 0 || term.yx != 0 || term.xy != 0 || term.yy != 0) terms_.push_back(term);
  }

  std::vector<Term> terms_;
};

/// Directions a width apart, with what bounds want of it.
struct Width {
  double angle, cosine;           ///< of the sector
  double half_cosine, half_sine;  ///< of its half
  double quarter_sine;

  explicit Width(double of)
      : angle(of),
        cosine(std::cos(of)),
        half_cosine(std::cos(of / 2)),
        half_sine(std::sin(of / 2)),
        quarter_sine(std::sin(of / 4)) {}
};

struct Sector {
  double from_angle;
  const Width* width;
  Direction from, middle, to;
  double at_from, at_middle, at_to;  ///< h there
  double bound;                      ///< of h in between
  bool operator<(const Sector& other) const { return bound < other.bound; }

  double middle_angle() const { return from_angle + width->angle / 2; }
};

/// An upper bound of h over the directions of half a sector (worst_case.hpp), written without cancellation.
double corner_bound(const Width& width, double at_from, double at_to) {
  const double c = width.half_cosine;
  const bool corner_inside = at_to >= at_from * c && at_from >= at_to * c;
  if (!corner_inside) return std::max(at_from, at_to);
  const double half = width.quarter_sine, difference = at_from - at_to;
  return std::sqrt(difference * difference + 4 * at_from * at_to * half * half) / width.half_sine;
}

/// Finds at_middle and the bound.
Sector bounded(const Support& reach, Sector s) {
  s.at_middle = reach(s.middle);
  s.bound =
      std::min(std::max(corner_bound(*s.width, s.at_from, s.at_middle), corner_bound(*s.width, s.at_middle, s.at_to)),
               reach.sinusoid_bound(s.from, s.middle, s.to, s.width->cosine));
  // The difference of two values is known to their roundings, and is divided by the width.
  const double rounding = 8 * std::numeric_limits<double>::epsilon() / s.width->angle;
  s.bound = std::max({s.bound, s.at_from, s.at_middle, s.at_to}) * (1 + rounding);
  return s;
}

constexpr int sectors = 8;  // of the half turn after which h repeats

/// The corner of so narrow a sector lies farther out than its sides by less than a rounding error: 1 - cos(width/2).
constexpr double narrowest_sector = 1e-8;

/// Of sectors halved again and again.
const std::vector<Width>& widths() {
  static const std::vector<Width> all = [] {
    std::vector<Width> halved;
    for (double width = std::numbers::pi / sectors; width > narrowest_sector / 4; width /= 2)
      halved.emplace_back(width);
    return halved;
  }();
  return all;
}

/// Ends and middles of the first sectors.
const std::array<Direction, 2 * sectors + 1>& first_directions() {
  static const auto all = [] {
    std::array<Direction, 2 * sectors + 1> first_directions;
    for (std::size_t i = 0; i < first_directions.size(); ++i)
      first_directions[i] = direction(static_cast<double>(i) * std::numbers::pi / (2 * sectors));
    return first_directions;
  }();
  return all;
}

std::array<Sector, 2> halves(const Support& reach, const Sector& s) {
  const Width* const width = s.width + 1;
  const double angle = s.middle_angle();
  const Direction before = direction(s.from_angle + width->angle / 2), after = direction(angle + width->angle / 2);
  return {bounded(reach, {s.from_angle, width, s.from, before, s.middle, s.at_from, 0, s.at_middle, 0}),
          bounded(reach, {angle, width, s.middle, after, s.to, s.at_middle, 0, s.at_to, 0})};
}

}  // namespace

double farthest_in_plane(const std::vector<Reach>& all, int row, double accuracy) {
  const Support reach(all, row);
  constexpr int steps = 12;  // towards a largest value, before cells prove that there is none larger
  const auto& directions = first_directions();
  std::vector<Sector> open;
  open.reserve(4 * sectors);
  Direction at_best;
  double best = 0, last = reach(directions[0]);
  for (std::size_t i = 0; i < sectors; ++i) {
    const Direction &middle = directions[2 * i + 1], &to = directions[2 * i + 2];
    const double next = reach(to);
    open.push_back(bounded(reach, {static_cast<double>(i) * widths()[0].angle, widths().data(), directions[2 * i],
                                   middle, to, last, 0, next, 0}));
    for (const auto& [value, n] : {std::pair{next, to}, {open.back().at_middle, middle}})
      if (value > best) best = value, at_best = n;
    last = next;
  }
  for (int i = 0; i < steps; ++i) {
    at_best = reach.of_farthest(at_best);
    best = std::max(best, reach(at_best));
  }
  std::make_heap(open.begin(), open.end());
  while (true) {
    const Sector s = open.front();
    if (s.width->angle < narrowest_sector || s.bound <= best * (1 + accuracy))
      return rounded_up(std::max(best, s.bound), operations);
    std::pop_heap(open.begin(), open.end());
    open.pop_back();
    for (const Sector& half : halves(reach, s)) {
      best = std::max(best, half.at_middle);
      open.push_back(half);
      std::push_heap(open.begin(), open.end());
    }
  }
}

}  // namespace clearloci::numeric
