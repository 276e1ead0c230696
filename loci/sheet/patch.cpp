#include "loci/sheet/patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/errors.hpp"

namespace clearloci::loci::sheet {

namespace {

using core::Polynomial;
using core::Rational;

// Exponents in lexicographically descending order, as core::Polynomial wants them.
using Collected = std::map<std::vector<int>, Rational, std::greater<>>;

Polynomial as_polynomial(int variables, const Collected& collected) {
  Polynomial result{variables, {}};
  for (const auto& [exponents, coefficient] : collected)
    if (coefficient != 0) result.terms.push_back({exponents, coefficient});
  return result;
}

/// Coefficients of (c + d t)^n, lowest power first.
std::vector<Rational> binomial_power(const Rational& c, const Rational& d, int n) {
  std::vector<Rational> result = {1};
  for (int i = 0; i < n; ++i) {
    result.emplace_back(0);
    for (std::size_t k = result.size() - 1; k > 0; --k) result[k] = c * result[k] + d * result[k - 1];
    result[0] *= c;
  }
  return result;
}

bool holds_root(const Star& star, int root) {
  return std::find(star.roots.begin(), star.roots.end(), root) != star.roots.end();
}

/// Lowest degree in the distance from a star at the origin; its roots count as a distance.
int order_at_star(const Polynomial& p, const Star& star) {
  int order = std::numeric_limits<int>::max();
  for (const core::Term& term : p.terms) {
    int degree = term.exponents[0] + term.exponents[1];
    for (const int j : star.roots) degree += term.exponents[2 + j];
    order = std::min(order, degree);
  }
  return order;
}

Polynomial moved_to(const Star& star, const Polynomial& p) { return shifted(shifted(p, 0, star.x), 1, star.y); }

/// The polynomial in (u, t, ...), divided by u^divide. Required: written around the star.
Polynomial in_polar(const Polynomial& p, const Star& star, const Chart& chart, int divide) {
  const auto& [x0, x1, y0, y1] = chart.rectangle;
  const bool along_x = chart.side == Chart::Side::right || chart.side == Chart::Side::left;
  const Rational depth = chart.side == Chart::Side::right  ? x1 - star.x
                         : chart.side == Chart::Side::left ? x0 - star.x
                         : chart.side == Chart::Side::top  ? y1 - star.y
                                                           : y0 - star.y;
  const Rational start = (along_x ? y0 + y1 : x0 + x1) / 2 - (along_x ? star.y : star.x);
  const Rational length = (along_x ? y1 - y0 : x1 - x0) / 2;
  const int deep = along_x ? 0 : 1, wide = 1 - deep;
  std::vector<std::vector<Rational>> across;
  for (int n = 0; n <= std::max(0, core::degree_in(p, wide)); ++n) across.push_back(binomial_power(start, length, n));
  std::vector<Rational> depths = {1};
  for (int n = 0; n < core::degree_in(p, deep); ++n) depths.emplace_back(depths.back() * depth);

  Collected collected;
  for (const core::Term& term : p.terms) {
    std::vector<int> exponents = term.exponents;
    exponents[0] = term.exponents[0] + term.exponents[1] - divide;
    for (const int j : star.roots) exponents[0] += term.exponents[2 + j];
    const Rational coefficient = term.coefficient * depths[term.exponents[deep]];
    const std::vector<Rational>& powers = across[term.exponents[wide]];
    for (std::size_t k = 0; k < powers.size(); ++k) {
      exponents[1] = static_cast<int>(k);
      collected[exponents] += coefficient * powers[k];
    }
  }
  return as_polynomial(p.variables, collected);
}

/// The real zero of c ((x - a)^2 + (y - b)^2), if the polynomial is one.
std::optional<Star> double_point(const Polynomial& d) {
  Rational xx, yy, x, y, constant;
  for (const core::Term& term : d.terms) {
    for (std::size_t v = 2; v < term.exponents.size(); ++v)
      if (term.exponents[v] != 0) return std::nullopt;
    const int i = term.exponents[0], j = term.exponents[1];
    if (i == 2 && j == 0)
      xx = term.coefficient;
    else if (i == 0 && j == 2)
      yy = term.coefficient;
    else if (i == 1 && j == 0)
      x = term.coefficient;
    else if (i == 0 && j == 1)
      y = term.coefficient;
    else if (i == 0 && j == 0)
      constant = term.coefficient;
    else
      return std::nullopt;
  }
  if (xx == 0 || xx != yy) return std::nullopt;
  const Rational a = -x / (2 * xx), b = -y / (2 * xx);
  if (xx * (a * a + b * b) != constant) return std::nullopt;
  return Star{a, b, {}};
}

}  // namespace

std::optional<Polynomial> exact_quotient(const Polynomial& p, const Polynomial& divisor) {
  core::ensure(!divisor.is_zero(), "a divisor is not zero");
  const core::Term& leading = divisor.terms.front();
  Collected rest, quotient;
  for (const core::Term& term : p.terms) rest.emplace_hint(rest.end(), term.exponents, term.coefficient);
  while (!rest.empty()) {
    const auto [exponents, coefficient] = *rest.begin();
    if (coefficient == 0) {
      rest.erase(rest.begin());
      continue;
    }
    std::vector<int> factor = exponents;
    for (std::size_t v = 0; v < factor.size(); ++v)
      if ((factor[v] -= leading.exponents[v]) < 0) return std::nullopt;
    const Rational scale = coefficient / leading.coefficient;
    quotient[factor] += scale;
    for (const core::Term& term : divisor.terms) {
      std::vector<int> place = factor;
      for (std::size_t v = 0; v < place.size(); ++v) place[v] += term.exponents[v];
      rest[place] -= scale * term.coefficient;
    }
  }
  return as_polynomial(p.variables, quotient);
}

std::vector<Star> stars(const core::RootTower& tower) {
  std::vector<Star> result;
  for (const Polynomial& denominator : tower.denominators) {
    std::optional<Star> star = double_point(denominator);
    if (!star) continue;
    const bool again = std::any_of(result.begin(), result.end(),
                                   [&](const Star& other) { return other.x == star->x && other.y == star->y; });
    bool reachable = true;
    for (std::size_t j = 0; j < tower.roots.size(); ++j) {
      const Polynomial square = moved_to(*star, tower.roots[j].square);
      if (order_at_star(square, *star) >= 2) star->roots.push_back(static_cast<int>(j));
      if (!square.is_zero() && square.is_constant()) continue;
      const std::vector<int> origin(square.variables, 0);
      if (!square.terms.empty() && square.terms.back().exponents == origin && square.terms.back().coefficient < 0 &&
          std::none_of(square.terms.begin(), square.terms.end(), [](const core::Term& term) {
            return std::any_of(term.exponents.begin() + 2, term.exponents.end(), [](int e) { return e != 0; });
          }))
        reachable = false;
    }
    if (!again && reachable && !star->roots.empty()) result.push_back(std::move(*star));
  }
  return result;
}

core::Point2 Chart::to_plane(double p, double q) const {
  if (side == Side::plane) return {p, q};
  const double a = core::to_double(origin_x), b = core::to_double(origin_y);
  const double x0 = core::to_double(rectangle[0]), x1 = core::to_double(rectangle[1]);
  const double y0 = core::to_double(rectangle[2]), y1 = core::to_double(rectangle[3]);
  const double mx = 0.5 * (x0 + x1), hx = 0.5 * (x1 - x0), my = 0.5 * (y0 + y1), hy = 0.5 * (y1 - y0);
  switch (side) {
    case Side::right:
      return {a + p * (x1 - a), b + p * (my - b + q * hy)};
    case Side::left:
      return {a + p * (x0 - a), b + p * (my - b + q * hy)};
    case Side::top:
      return {a + p * (mx - a + q * hx), b + p * (y1 - b)};
    default:
      return {a + p * (mx - a + q * hx), b + p * (y0 - b)};
  }
}

Cell Chart::to_plane(const Cell& cell) const {
  if (side == Side::plane) return cell;
  const auto interval = [](const Rational& value) { return constant_as(value, static_cast<Interval*>(nullptr)); };
  const Interval a = interval(origin_x), b = interval(origin_y);
  const Interval x0 = interval(rectangle[0]), x1 = interval(rectangle[1]);
  const Interval y0 = interval(rectangle[2]), y1 = interval(rectangle[3]);
  const Interval half = 0.5, &p = cell.x, &q = cell.y;
  const Interval mx = half * (x0 + x1), hx = half * (x1 - x0), my = half * (y0 + y1), hy = half * (y1 - y0);
  switch (side) {
    case Side::right:
      return {a + p * (x1 - a), b + p * (my - b + q * hy)};
    case Side::left:
      return {a + p * (x0 - a), b + p * (my - b + q * hy)};
    case Side::top:
      return {a + p * (mx - a + q * hx), b + p * (y1 - b)};
    default:
      return {a + p * (mx - a + q * hx), b + p * (y0 - b)};
  }
}

namespace {

/// [lower, upper] of `a`; none: they do not meet.
std::optional<Interval> clipped(const Interval& a, double lower, double upper) {
  if (a.upper() < lower || upper < a.lower()) return std::nullopt;
  return meet(a, {lower, upper});
}

}  // namespace

std::optional<Cell> Chart::share_of(const Cell& place) const {
  if (side == Side::plane) return place;
  const auto interval = [](const Rational& value) { return constant_as(value, static_cast<Interval*>(nullptr)); };
  const bool along_x = side == Side::right || side == Side::left;
  const Interval x = place.x - interval(origin_x), y = place.y - interval(origin_y);
  const Interval depth = side == Side::right  ? interval(rectangle[1] - origin_x)
                         : side == Side::left ? interval(rectangle[0] - origin_x)
                         : side == Side::top  ? interval(rectangle[3] - origin_y)
                                              : interval(rectangle[2] - origin_y);
  const std::optional<Interval> u = clipped((along_x ? x : y) * inverse(depth), 0, 1);
  if (!u) return std::nullopt;
  if (u->lower() <= 0) return Cell{*u, {-1, 1}};
  const std::size_t wide = along_x ? 2 : 0;
  const Interval middle = interval((rectangle[wide] + rectangle[wide + 1]) / 2 - (along_x ? origin_y : origin_x));
  const Interval half = interval((rectangle[wide + 1] - rectangle[wide]) / 2);
  const std::optional<Interval> t = clipped(((along_x ? y : x) * inverse(*u) - middle) * inverse(half), -1, 1);
  if (!t) return std::nullopt;
  return Cell{*u, *t};
}

std::optional<Cell> Chart::from_plane(const Cell& place) const {
  if (side == Side::plane) return place;
  const auto interval = [](const Rational& value) { return constant_as(value, static_cast<Interval*>(nullptr)); };
  const bool along_x = side == Side::right || side == Side::left;
  const Interval x = place.x - interval(origin_x), y = place.y - interval(origin_y);
  const Interval depth = side == Side::right  ? interval(rectangle[1] - origin_x)
                         : side == Side::left ? interval(rectangle[0] - origin_x)
                         : side == Side::top  ? interval(rectangle[3] - origin_y)
                                              : interval(rectangle[2] - origin_y);
  const Interval u = (along_x ? x : y) * inverse(depth);
  if (u.lower() <= 0 || u.upper() > 1) return std::nullopt;
  const Interval middle = along_x ? interval((rectangle[2] + rectangle[3]) / 2 - origin_y)
                                  : interval((rectangle[0] + rectangle[1]) / 2 - origin_x);
  const Interval half =
      along_x ? interval((rectangle[3] - rectangle[2]) / 2) : interval((rectangle[1] - rectangle[0]) / 2);
  const Interval t = ((along_x ? y : x) * inverse(u) - middle) * inverse(half);
  if (t.lower() < -1 || t.upper() > 1) return std::nullopt;
  return Cell{u, t};
}

core::Polynomial without_denominators(core::Polynomial function, const core::RootTower& tower) {
  for (const Polynomial& denominator : tower.denominators) {
    if (!double_point(denominator)) continue;
    while (std::optional<Polynomial> quotient = exact_quotient(function, denominator)) {
      if (quotient->is_zero()) break;
      function = std::move(*quotient);
    }
  }
  return function;
}

ChartedSheet charted(const core::RootTower& tower, const std::vector<SheetFunction>& functions, const Chart& chart,
                     const std::vector<Star>& all_stars) {
  if (chart.side == Chart::Side::plane) {
    ChartedSheet sheet{tower, {}};
    for (const SheetFunction& f : functions)
      sheet.functions.push_back({f.line.empty() ? without_denominators(f.polynomial, tower) : f.polynomial, f.line});
    return sheet;
  }
  const Star& star = all_stars[chart.star];
  ChartedSheet sheet;
  sheet.tower.coordinates = {"u", "t"};
  sheet.tower.roots = tower.roots;
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    const int divide = holds_root(star, static_cast<int>(j)) ? 2 : 0;
    sheet.tower.roots[j].line = {};
    sheet.tower.roots[j].square = in_polar(moved_to(star, tower.roots[j].square), star, chart, divide);
  }
  for (const SheetFunction& f : functions) {
    const Polynomial local = moved_to(star, f.polynomial);
    sheet.functions.push_back({in_polar(local, star, chart, local.is_zero() ? 0 : order_at_star(local, star))});
  }
  return sheet;
}

std::vector<core::Point2> bases(const core::RootTower& tower) {
  std::vector<core::Point2> result;
  for (const Polynomial& denominator : tower.denominators)
    if (const std::optional<Star> base = double_point(denominator))
      result.push_back({core::to_double(base->x), core::to_double(base->y)});
  return result;
}

Partition partition(const core::RootTower& tower, const std::array<double, 4>& box,
                    const std::vector<core::Point2>& bases) {
  // A star this close to the box's edge, relative to its rectangle, has the rectangle reach across the edge.
  constexpr double margin = 0.05;
  constexpr double largest = 0.06;  // half a rectangle's width, relative to the box
  // Functions are small around other bases: polynomials in polar coordinates are no good form there.
  constexpr double share = 0.25;  // of the way to the next base
  Partition result;
  result.domain = box;
  result.charts.emplace_back();
  const double size = std::max(box[1] - box[0], box[3] - box[2]);
  const std::vector<Star> all = stars(tower);
  const auto place = [](const Star& star) { return std::array{core::to_double(star.x), core::to_double(star.y)}; };
  std::vector<std::array<double, 2>> half_widths;
  for (const Star& star : all) {
    const auto [x, y] = place(star);
    double reach = largest * size;
    for (const core::Point2& base : bases) {
      const double distance = std::max(std::abs(base[0] - x), std::abs(base[1] - y));
      if (distance > 0) reach = std::min(reach, share * distance);
    }
    const double edge = margin * reach;
    if (x < box[0] - edge || x > box[1] + edge || y < box[2] - edge || y > box[3] + edge) continue;
    // Short binary fractions, so that the charts' coefficients stay short.
    const double grain = std::exp2(std::floor(std::log2(reach)) - 20);
    const auto side = [&](double centre, double direction, double limit) {
      const double wanted = centre + direction * reach;
      const double rounded = std::round(wanted / grain) * grain;
      const double room = direction * (limit - centre);
      return room >= reach * 1.1 ? rounded : room > edge ? limit : rounded;
    };
    const std::array<double, 4> hole = {side(x, -1, box[0]), side(x, 1, box[1]), side(y, -1, box[2]),
                                        side(y, 1, box[3])};
    const int index = static_cast<int>(result.stars.size());
    result.stars.push_back(star);
    result.holes.push_back(hole);
    for (const Chart::Side s : {Chart::Side::right, Chart::Side::top, Chart::Side::left, Chart::Side::bottom})
      result.charts.push_back({s, index, star.x, star.y, {hole[0], hole[1], hole[2], hole[3]}});
    for (const int c : {0, 2}) {
      result.domain[c] = std::min(result.domain[c], hole[c]);
      result.domain[c + 1] = std::max(result.domain[c + 1], hole[c + 1]);
    }
  }
  return result;
}

std::vector<Cell> outside_holes(const Partition& partition) {
  std::vector<double> xs = {partition.domain[0], partition.domain[1]}, ys = {partition.domain[2], partition.domain[3]};
  for (const auto& hole : partition.holes) {
    xs.insert(xs.end(), {hole[0], hole[1]});
    ys.insert(ys.end(), {hole[2], hole[3]});
  }
  for (auto* cuts : {&xs, &ys}) {
    std::sort(cuts->begin(), cuts->end());
    cuts->erase(std::unique(cuts->begin(), cuts->end()), cuts->end());
  }
  std::vector<Cell> result;
  for (std::size_t i = 0; i + 1 < xs.size(); ++i)
    for (std::size_t k = 0; k + 1 < ys.size(); ++k) {
      const bool in_hole = std::any_of(partition.holes.begin(), partition.holes.end(), [&](const auto& hole) {
        return hole[0] <= xs[i] && xs[i + 1] <= hole[1] && hole[2] <= ys[k] && ys[k + 1] <= hole[3];
      });
      if (!in_hole) result.push_back({{xs[i], xs[i + 1]}, {ys[k], ys[k + 1]}});
    }
  return result;
}

}  // namespace clearloci::loci::sheet
