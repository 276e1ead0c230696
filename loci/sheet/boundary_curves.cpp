#include "loci/sheet/boundary_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "loci/sheet/remembered.hpp"
#include "loci/sheet/star.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Polynomial;
using core::Rational;

using Quadratic = std::array<Rational, 3>;  ///< from the constant up

std::vector<Rational> rational_zeros(const Quadratic& c) {
  std::vector<Rational> zeros;
  if (c[2] == 0) {
    if (c[1] != 0) zeros.emplace_back(-c[0] / c[1]);
  } else if (const auto root = core::square_root(Rational(c[1] * c[1] - 4 * c[0] * c[2]))) {
    zeros.emplace_back((-c[1] + *root) / (2 * c[2]));
    if (*root != 0) zeros.emplace_back((-c[1] - *root) / (2 * c[2]));
  }
  return zeros;
}

/// The coefficients of p as a polynomial of degree 1 or 2 in D, if it is one.
std::optional<Quadratic> in_powers_of(const Polynomial& distance, Polynomial p) {
  Quadratic coefficients = {0, 0, 0};
  const Polynomial square = distance * distance;
  const std::vector<int> x4 = square.terms.front().exponents, x2 = distance.terms.front().exponents;
  coefficients[2] = core::coefficient(p, x4) / square.terms.front().coefficient;
  p = p - core::constant_polynomial(p.variables, coefficients[2]) * square;
  coefficients[1] = core::coefficient(p, x2) / distance.terms.front().coefficient;
  p = p - core::constant_polynomial(p.variables, coefficients[1]) * distance;
  if (!p.is_constant()) return std::nullopt;
  coefficients[0] = p.is_zero() ? Rational(0) : p.terms.front().coefficient;
  return coefficients;
}

/// Of root 0.
std::vector<BoundaryCurve> circles_of_square(const Polynomial& square, const std::vector<Polynomial>& denominators) {
  std::vector<BoundaryCurve> circles;
  for (const Polynomial& denominator : denominators) {
    const auto centre = double_point(denominator);
    if (!centre) continue;
    const auto coefficients = in_powers_of(denominator, square);
    if (!coefficients) continue;
    const Rational scale = denominator.terms.front().coefficient;
    for (const Rational& zero : rational_zeros(*coefficients))
      if (zero > 0) circles.push_back({0, false, (*centre)[0], (*centre)[1], zero / scale, {}, {}});
    break;
  }
  return circles;
}

std::vector<BoundaryCurve> circles_of(const core::RootTower& tower, int root) {
  const Polynomial& square = tower.roots[static_cast<std::size_t>(root)].square;
  const auto compute = [&] { return circles_of_square(square, tower.denominators); };
  thread_local Remembered<std::vector<BoundaryCurve>, Polynomial, std::vector<Polynomial>> known;
  std::vector<BoundaryCurve> circles =
      square.terms.size() > most_terms_remembered ? compute() : known(compute, square, tower.denominators);
  for (BoundaryCurve& circle : circles) circle.root = root;
  return circles;
}

/// Of a square that changes in one direction of the plane only, and there as a quadratic polynomial at most.
std::vector<BoundaryCurve> lines_of(const core::RootTower& tower, int root) {
  const Polynomial& square = tower.roots[static_cast<std::size_t>(root)].square;
  if (square.is_constant() || core::total_degree(square) > 2) return {};
  const auto part = [&](int i, int k) {
    std::vector<int> exponents(static_cast<std::size_t>(square.variables), 0);
    exponents[0] = i;
    exponents[1] = k;
    return core::coefficient(square, exponents);
  };
  for (int v = 2; v < square.variables; ++v)
    if (core::depends_on(square, v)) return {};
  const Rational xx = part(2, 0), xy = part(1, 1), yy = part(0, 2), x = part(1, 0), y = part(0, 1);
  if (xy * xy != 4 * xx * yy) return {};
  // Square = second t^2 + first t + constant with t = a x + b y.
  std::array<Rational, 2> normal = xx != 0 ? std::array<Rational, 2>{2 * xx, xy} : std::array<Rational, 2>{xy, 2 * yy};
  if (normal[0] == 0 && normal[1] == 0) normal = {x, y};
  if (x * normal[1] != y * normal[0]) return {};
  const std::size_t larger = normal[0] != 0 ? 0 : 1;
  const Rational second = (larger == 0 ? xx : yy) / (normal[larger] * normal[larger]);
  const Rational first = (larger == 0 ? x : y) / normal[larger];
  std::vector<BoundaryCurve> lines;
  for (const Rational& level : rational_zeros({part(0, 0), first, second}))
    lines.push_back({root, true, {}, {}, {}, normal, level});
  return lines;
}

Rational square_of(const std::array<Rational, 2>& a) { return a[0] * a[0] + a[1] * a[1]; }

std::optional<BoundaryMeeting> meeting_of_circles(const BoundaryCurve& a, const BoundaryCurve& b) {
  const std::array<Rational, 2> way = {b.x - a.x, b.y - a.y};
  const Rational length = square_of(way);
  if (length == 0) return std::nullopt;
  const Rational along = (length + a.radius_squared - b.radius_squared) / (2 * length);
  const Rational rise = a.radius_squared / length - along * along;
  return BoundaryMeeting{a, b, {a.x + along * way[0], a.y + along * way[1]}, {-way[1], way[0]}, rise, rise == 0};
}

std::optional<BoundaryMeeting> meeting_with_line(const BoundaryCurve& line, const BoundaryCurve& circle) {
  const Rational length = square_of(line.normal);
  const Rational off = (line.level - line.normal[0] * circle.x - line.normal[1] * circle.y) / length;
  const Rational rise = circle.radius_squared / length - off * off;
  return BoundaryMeeting{line,
                         circle,
                         {circle.x + off * line.normal[0], circle.y + off * line.normal[1]},
                         {-line.normal[1], line.normal[0]},
                         rise,
                         rise == 0};
}

std::optional<BoundaryMeeting> meeting_of_lines(const BoundaryCurve& a, const BoundaryCurve& b) {
  const Rational turn = a.normal[0] * b.normal[1] - a.normal[1] * b.normal[0];
  if (turn == 0) return std::nullopt;
  const Rational x = (a.level * b.normal[1] - b.level * a.normal[1]) / turn;
  const Rational y = (a.normal[0] * b.level - b.normal[0] * a.level) / turn;
  return BoundaryMeeting{a, b, {x, y}, {0, 0}, 0, false};
}

}  // namespace

std::array<Rational, 2> BoundaryCurve::normal_at(const std::array<Rational, 2>& at) const {
  if (is_line) return normal;
  return {at[0] - x, at[1] - y};
}

std::vector<std::array<Rational, 2>> BoundaryMeeting::rational_points() const {
  const std::optional<Rational> root = core::square_root(rise);
  if (!root) return {};
  std::vector<std::array<Rational, 2>> points = {{foot[0] + *root * way[0], foot[1] + *root * way[1]}};
  if (*root != 0) points.push_back({foot[0] - *root * way[0], foot[1] - *root * way[1]});
  return points;
}

std::optional<BoundaryMeeting> meeting_of(const BoundaryCurve& a, const BoundaryCurve& b) {
  std::optional<BoundaryMeeting> meeting = a.is_line && b.is_line ? meeting_of_lines(a, b)
                                           : a.is_line            ? meeting_with_line(a, b)
                                           : b.is_line            ? meeting_with_line(b, a)
                                                                  : meeting_of_circles(a, b);
  if (meeting && meeting->rise < 0) meeting.reset();
  return meeting;
}

std::vector<BoundaryMeeting> boundary_meetings(const core::RootTower& tower) {
  std::vector<BoundaryCurve> curves;
  for (int root = 0; root < static_cast<int>(tower.roots.size()); ++root)
    for (const auto& limit : {circles_of(tower, root), lines_of(tower, root)})
      curves.insert(curves.end(), limit.begin(), limit.end());
  std::vector<BoundaryMeeting> meetings;
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (std::size_t k = i + 1; k < curves.size(); ++k) {
      const BoundaryCurve &a = curves[i], &b = curves[k];
      if (a.root == b.root) continue;
      if (std::optional<BoundaryMeeting> meeting = meeting_of(a, b)) meetings.push_back(std::move(*meeting));
    }
  return meetings;
}

namespace {

/// The root that a square stands on; none where there are several or none.
std::optional<int> only_root_below(const Polynomial& square, int roots) {
  std::optional<int> only;
  for (int j = 0; j < roots; ++j) {
    if (!core::depends_on(square, 2 + j)) continue;
    if (only) return std::nullopt;
    only = j;
  }
  return only;
}

/// A polynomial's values in doubles in the plane, all roots being 0.
class PlaneValues {
 public:
  explicit PlaneValues(const Polynomial& p) {
    for (const core::Term& term : p.terms) {
      if (std::any_of(term.exponents.begin() + 2, term.exponents.end(), [](int e) { return e != 0; })) continue;
      terms_.push_back({core::to_double(term.coefficient), static_cast<std::size_t>(term.exponents[0]),
                        static_cast<std::size_t>(term.exponents[1])});
      degree_ = std::max(degree_, term.exponents[0] + term.exponents[1]);
    }
  }

  double operator()(double x, double y) {
    const auto size = static_cast<std::size_t>(degree_) + 1;
    powers_.assign(2 * size, 1.0);
    for (std::size_t i = 1; i < size; ++i) {
      powers_[i] = powers_[i - 1] * x;
      powers_[size + i] = powers_[size + i - 1] * y;
    }
    double sum = 0;
    for (const auto& [factor, i, k] : terms_) sum += factor * powers_[i] * powers_[size + k];
    return sum;
  }

 private:
  struct PlaneTerm {
    double factor;
    std::size_t i, k;
  };
  std::vector<PlaneTerm> terms_;
  int degree_ = 0;
  std::vector<double> powers_;
};

/// Points of a circle with short coordinates at which a polynomial seems to vanish, from doubles: candidates.
std::vector<std::array<Rational, 2>> short_points_near_zeros(const BoundaryCurve& circle, const Polynomial& p) {
  constexpr int pieces = 64, halvings = 50;
  // Of points, relative to the radius; of a double zero's value, relative to the largest.
  constexpr double accuracy = 1e-10, nearly_zero = 1e-12;
  // No piece ends where designs on a lattice have their zeros.
  constexpr double off = 0.0391, step = 2 * std::numbers::pi / pieces;
  PlaneValues value(p), by_x(core::derivative(p, 0)), by_y(core::derivative(p, 1));
  const double a = core::to_double(circle.x), b = core::to_double(circle.y);
  const double radius = std::sqrt(core::to_double(circle.radius_squared));
  const auto at = [&](double angle) { return value(a + radius * std::cos(angle), b + radius * std::sin(angle)); };
  const auto slope = [&](double angle) {
    const double c = std::cos(angle), s = std::sin(angle), x = a + radius * c, y = b + radius * s;
    return c * by_y(x, y) - s * by_x(x, y);
  };
  std::vector<double> angles;
  double largest = 0;
  const auto look = [&](const auto& f, double most) {
    for (int i = 0; i < pieces; ++i) {
      double from = off + i * step, to = from + step;
      const bool before = f(from) > 0;
      if (before == (f(to) > 0)) continue;
      for (int k = 0; k < halvings; ++k) ((f((from + to) / 2) > 0) == before ? from : to) = (from + to) / 2;
      if (std::abs(at(from)) <= most) angles.push_back(from);
    }
  };
  for (int i = 0; i < pieces; ++i) largest = std::max(largest, std::abs(at(off + i * step)));
  look(at, largest);
  look(slope, nearly_zero * largest);
  std::vector<std::array<Rational, 2>> points;
  for (const double angle : angles) {
    const auto shortest = [&](double v) {
      return core::simplest_rational_near(Rational(v), Rational(accuracy * radius));
    };
    points.push_back({shortest(a + radius * std::cos(angle)), shortest(b + radius * std::sin(angle))});
  }
  return points;
}

}  // namespace

std::vector<NestedMeeting> nested_meetings(const core::RootTower& tower) {
  std::vector<NestedMeeting> meetings;
  for (int upper = 1; upper < static_cast<int>(tower.roots.size()); ++upper) {
    const core::Root& root = tower.roots[static_cast<std::size_t>(upper)];
    const std::optional<int> lower = root.is_angle() ? std::nullopt : only_root_below(root.square, upper);
    if (!lower || tower.roots[static_cast<std::size_t>(*lower)].is_angle()) continue;
    for (const BoundaryCurve& circle : circles_of(tower, *lower))
      for (const std::array<Rational, 2>& at : short_points_near_zeros(circle, root.square)) {
        std::vector<Rational> point(static_cast<std::size_t>(tower.variables()), Rational(0));
        point[0] = at[0];
        point[1] = at[1];
        const auto value = [&](const Polynomial& p) { return core::evaluate(p, point); };
        const std::array<Rational, 2> normal = circle.normal_at(at);
        if (square_of(normal) != circle.radius_squared || value(root.square) != 0) continue;
        const Rational along =
            normal[0] * value(core::derivative(root.square, 1)) - normal[1] * value(core::derivative(root.square, 0));
        const bool by_root = value(core::derivative(root.square, 2 + *lower)) != 0;
        meetings.push_back({circle, upper, at, by_root, along != 0});
      }
  }
  return meetings;
}

}  // namespace clearloci::loci::sheet
