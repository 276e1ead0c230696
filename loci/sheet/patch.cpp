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

/// The power of the distance with which a root vanishes at a star.
int power_of_root(const Star& star, int root) {
  return static_cast<int>(std::count(star.roots.begin(), star.roots.end(), root));
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
      if (!square.is_zero())
        star->roots.insert(star->roots.end(), static_cast<std::size_t>(order_at_star(square, *star) / 2),
                           static_cast<int>(j));
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

Chart::Chart(Side own_side, int own_star, const Star& at, const std::array<Rational, 4>& own_rectangle)
    : side(own_side), star(own_star), origin_x(at.x), origin_y(at.y), rectangle(own_rectangle) {
  const auto& [x0, x1, y0, y1] = rectangle;
  const bool x = along_x();
  const Rational a = x ? origin_x : origin_y, b = x ? origin_y : origin_x;
  const Rational depth = side == Side::right  ? x1 - a
                         : side == Side::left ? x0 - a
                         : side == Side::top  ? y1 - a
                                              : y0 - a;
  const Rational middle = (x ? y0 + y1 : x0 + x1) / 2 - b, half = (x ? y1 - y0 : x1 - x0) / 2;
  const auto interval = [](const Rational& value) { return constant_as(value, static_cast<Interval*>(nullptr)); };
  frame_ = {interval(a),
            interval(b),
            interval(depth),
            interval(middle),
            interval(half),
            core::to_double(a),
            core::to_double(b),
            core::to_double(depth),
            core::to_double(middle),
            core::to_double(half),
            depth,
            middle,
            half};
}

core::Point2 Chart::to_plane(double p, double q) const {
  if (side == Side::plane) return {p, q};
  const double deep = frame_.a_ + p * frame_.depth_, wide = frame_.b_ + p * (frame_.middle_ + q * frame_.half_);
  return along_x() ? core::Point2{deep, wide} : core::Point2{wide, deep};
}

Cell Chart::to_plane(const Cell& cell) const {
  if (side == Side::plane) return cell;
  const Interval deep = frame_.a + cell.x * frame_.depth;
  const Interval wide = frame_.b + cell.x * (frame_.middle + cell.y * frame_.half);
  return along_x() ? Cell{deep, wide} : Cell{wide, deep};
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
  const Interval deep = (along_x() ? place.x : place.y) - frame_.a, wide = (along_x() ? place.y : place.x) - frame_.b;
  const std::optional<Interval> u = clipped(deep * inverse(frame_.depth), 0, 1);
  if (!u) return std::nullopt;
  if (u->lower() <= 0) return Cell{*u, {-1, 1}};
  const std::optional<Interval> t = clipped((wide * inverse(*u) - frame_.middle) * inverse(frame_.half), -1, 1);
  if (!t) return std::nullopt;
  return Cell{*u, *t};
}

std::optional<Cell> Chart::from_plane(const Cell& place) const {
  if (side == Side::plane) return place;
  const Interval deep = (along_x() ? place.x : place.y) - frame_.a, wide = (along_x() ? place.y : place.x) - frame_.b;
  const Interval u = deep * inverse(frame_.depth);
  if (u.lower() <= 0 || u.upper() > 1) return std::nullopt;
  const Interval t = (wide * inverse(u) - frame_.middle) * inverse(frame_.half);
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

namespace {

/// A polynomial in (X, Y, roots...) around a star as a straight line in (u, X / u, Y / u, roots...), the star's roots
/// divided by their powers of u, without `order` powers of u.
core::StraightLine polar_line(const Polynomial& around_star, const Star& star, int order) {
  Polynomial polar{around_star.variables + 1, {}};
  for (const core::Term& term : around_star.terms) {
    core::Term own = term;
    int power = term.exponents[0] + term.exponents[1] - order;
    for (const int root : star.roots) power += term.exponents[2 + root];
    own.exponents.insert(own.exponents.begin(), power);
    polar.terms.push_back(std::move(own));
  }
  core::StraightLineBuilder builder;
  std::vector<int> variables;
  for (int v = 0; v < polar.variables; ++v) variables.push_back(builder.variable(v));
  return builder.line(builder.polynomial(polar, variables));
}

}  // namespace

core::StraightLine Chart::in_chart(const core::StraightLine& polar) const {
  using Operation = core::StraightLine::Operation;
  core::StraightLine line;
  line.steps = {{Operation::variable, 1, 0, {}},
                {Operation::constant, 0, 0, frame_.exact_half},
                {Operation::constant, 0, 0, frame_.exact_middle},
                {Operation::multiply, 0, 1, {}},
                {Operation::add, 2, 3, {}},
                {Operation::constant, 0, 0, frame_.exact_depth}};
  constexpr int wide = 4, deep = 5;
  const int offset = static_cast<int>(line.steps.size());
  std::vector<int> place;
  line.steps.reserve(line.steps.size() + polar.steps.size() + 1);
  for (const core::StraightLine::Step& step : polar.steps) {
    place.push_back(static_cast<int>(line.steps.size()));
    if (step.operation == Operation::variable && (step.first == 1 || step.first == 2)) {
      place.back() = (step.first == 1) == along_x() ? deep : wide;
      continue;
    }
    core::StraightLine::Step own = step;
    if (step.operation == Operation::variable) {
      own.first = step.first == 0 ? 0 : step.first - 1;
    } else if (step.operation != Operation::constant) {
      own.first = place[step.first];
      own.second = step.operation == Operation::inverse ? 0 : place[step.second];
    }
    line.steps.push_back(std::move(own));
  }
  if (place.back() < offset) line.steps.push_back(line.steps[place.back()]);  // the result is X / u or Y / u itself
  return line;
}

Charting::Charting(const core::RootTower& tower, std::vector<SheetFunction> functions, const std::vector<Star>& stars)
    : tower_(tower), functions_(std::move(functions)), stars_(stars) {}

const Charting::AtStar& Charting::at_star(int index) {
  for (const AtStar& known : known_)
    if (known.star == index) return known;
  AtStar own;
  own.star = index;
  const Star& star = stars_[index];
  for (std::size_t j = 0; j < tower_.roots.size(); ++j)
    own.squares.push_back(
        polar_line(moved_to(star, tower_.roots[j].square), star, 2 * power_of_root(star, static_cast<int>(j))));
  for (const SheetFunction& f : functions_) {
    const Polynomial moved = moved_to(star, f.polynomial);
    own.functions.push_back(polar_line(moved, star, moved.is_zero() ? 0 : order_at_star(moved, star)));
  }
  known_.push_back(std::move(own));
  return known_.back();
}

ChartedSheet Charting::in(const Chart& chart) {
  if (chart.side == Chart::Side::plane) {
    ChartedSheet sheet{tower_, {}};
    for (const SheetFunction& f : functions_)
      sheet.functions.push_back({f.line.empty() ? without_denominators(f.polynomial, tower_) : f.polynomial, f.line});
    return sheet;
  }
  const AtStar& around = at_star(chart.star);
  const Polynomial nothing{tower_.variables(), {}};  // only the straight lines are written in polar coordinates
  ChartedSheet sheet;
  sheet.tower.coordinates = {"u", "t"};
  sheet.tower.roots = tower_.roots;
  for (std::size_t j = 0; j < tower_.roots.size(); ++j) {
    sheet.tower.roots[j].square = nothing;
    sheet.tower.roots[j].line = chart.in_chart(around.squares[j]);
  }
  for (const core::StraightLine& f : around.functions) sheet.functions.push_back({nothing, chart.in_chart(f)});
  return sheet;
}

ChartedSheet charted(const core::RootTower& tower, const std::vector<SheetFunction>& functions, const Chart& chart,
                     const std::vector<Star>& stars) {
  return Charting(tower, functions, stars).in(chart);
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
      result.charts.emplace_back(s, index, star, std::array<Rational, 4>{hole[0], hole[1], hole[2], hole[3]});
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
