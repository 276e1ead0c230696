#include "loci/sheet/patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/dense_terms.hpp"
#include "core/errors.hpp"
#include "loci/sheet/apex.hpp"
#include "loci/sheet/remembered.hpp"

namespace clearloci::loci::sheet {

namespace {

using core::Polynomial;
using core::Rational;

Interval enclosed(const Rational& value) { return constant_as(value, static_cast<Interval*>(nullptr)); }

/// [lower, upper] of `a`; none: they do not meet.
std::optional<Interval> clipped(const Interval& a, double lower, double upper) {
  if (a.upper() < lower || upper < a.lower()) return std::nullopt;
  return meet(a, {lower, upper});
}

}  // namespace

Chart::Chart(Side own_side, int own_star, const Star& at, const std::array<Rational, 4>& own_rectangle)
    : side(own_side),
      star(own_star),
      origin_x(at.x),
      origin_y(at.y),
      rectangle(own_rectangle),
      sheared_(at.is_sheared()),
      doubled_(at.is_doubled()) {
  const auto& [x0, x1, y0, y1] = rectangle;
  const bool x = along_x();
  const Rational a = x ? origin_x : origin_y, b = x ? origin_y : origin_x;
  exact_depth_ = side == Side::right ? x1 - a : side == Side::left ? x0 - a : side == Side::top ? y1 - a : y0 - a;
  exact_middle_ = (x ? y0 + y1 : x0 + x1) / 2 - b;
  exact_half_ = (x ? y1 - y0 : x1 - x0) / 2;
  exact_slope_ = at.slope;
  deep_is_along_ = x != at.along_y;
  if (at.apex) radius_ = at.apex->radius;
  // What is counted from the apex is known as well as the apex is.
  const auto near = [&](const Rational& value) { return enclosed_as(value, radius_, static_cast<Interval*>(nullptr)); };
  interval_ = {
      near(a), near(b), near(exact_depth_), near(exact_middle_), enclosed(exact_half_), enclosed(exact_slope_)};
  double_ = {core::to_double(a),
             core::to_double(b),
             core::to_double(exact_depth_),
             core::to_double(exact_middle_),
             core::to_double(exact_half_),
             core::to_double(exact_slope_)};
}

template <class T>
std::array<T, 2> Chart::from_star(const Frame<T>& f, const T& u, const T& t) const {
  const T wide = f.middle + t * f.half, v = doubled_ ? u * u : u;
  if (!sheared_) return {v * f.depth, v * wide};
  // What lies along the tangent shrinks with v, what is off it with v^2.
  if (deep_is_along_) return {v * f.depth, v * f.slope * f.depth + v * v * (wide - f.slope * f.depth)};
  return {v * f.slope * wide + v * v * (f.depth - f.slope * wide), v * wide};
}

core::Point2 Chart::to_plane(double p, double q) const {
  if (side == Side::plane) return {p, q};
  const auto [depth, width] = from_star(double_, p, q);
  const double deep = double_.a + depth, wide = double_.b + width;
  return along_x() ? core::Point2{deep, wide} : core::Point2{wide, deep};
}

PlaneCell Chart::to_plane(const PlaneCell& cell) const {
  if (side == Side::plane) return cell;
  const auto [depth, width] = from_star(interval_, cell.x, cell.y);
  const Interval deep = interval_.a + depth, wide = interval_.b + width;
  return along_x() ? PlaneCell{deep, wide} : PlaneCell{wide, deep};
}

Interval Chart::distance(const Interval& deep, const Interval& wide) const {
  const auto root = [](const Interval& square) { return square.upper() < 0 ? Interval(-1) : square_root(square); };
  Interval v = deep * inverse(interval_.depth);
  if (sheared_ && !deep_is_along_) {
    // depth v^2 - slope wide v - (deep - slope wide) = 0
    const Interval along = interval_.slope * wide, middle = along * inverse(interval_.depth) * Interval(0.5);
    const Interval square = squared(middle) + (deep - along) * inverse(interval_.depth);
    if (square.upper() < 0) return -1;
    v = middle + square_root(square);
  }
  return doubled_ ? root(v) : v;
}

Interval Chart::on_side(const Interval& u, const Interval& deep, const Interval& wide) const {
  const Interval far = doubled_ ? inverse(u) * inverse(u) : inverse(u);
  if (!sheared_ || !deep_is_along_) return wide * far;
  return interval_.slope * interval_.depth + (wide - interval_.slope * deep) * far * far;
}

std::optional<PlaneCell> Chart::share_of(const PlaneCell& place) const {
  if (side == Side::plane) return place;
  const Interval deep = (along_x() ? place.x : place.y) - interval_.a;
  const Interval wide = (along_x() ? place.y : place.x) - interval_.b;
  const std::optional<Interval> u = clipped(distance(deep, wide), 0, 1);
  if (!u) return std::nullopt;
  if (u->lower() <= 0) return PlaneCell{*u, {-1, 1}};
  const Interval local = (on_side(*u, deep, wide) - interval_.middle) * inverse(interval_.half);
  const std::optional<Interval> t = clipped(local, -1, 1);
  if (!t) return std::nullopt;
  return PlaneCell{*u, *t};
}

std::optional<PlaneCell> Chart::from_plane(const PlaneCell& place) const {
  if (side == Side::plane) return place;
  const Interval deep = (along_x() ? place.x : place.y) - interval_.a;
  const Interval wide = (along_x() ? place.y : place.x) - interval_.b;
  const Interval u = distance(deep, wide);
  if (u.lower() <= 0 || u.upper() > 1) return std::nullopt;
  const Interval t = (on_side(u, deep, wide) - interval_.middle) * inverse(interval_.half);
  if (t.lower() < -1 || t.upper() > 1) return std::nullopt;
  return PlaneCell{u, t};
}

core::Polynomial without_denominators(core::Polynomial function, const core::RootTower& tower) {
  const auto compute = [&] {
    Polynomial rest = function;
    for (const Polynomial& denominator : tower.denominators) {
      if (!double_point(denominator)) continue;
      while (std::optional<Polynomial> quotient = exact_quotient(rest, denominator)) {
        if (quotient->is_zero()) break;
        rest = std::move(*quotient);
      }
    }
    return rest;
  };
  if (function.terms.size() > most_terms_remembered) return compute();
  thread_local Remembered<Polynomial, Polynomial, std::vector<Polynomial>> known;
  return known(compute, function, tower.denominators);
}

core::StraightLine Chart::in_chart(const core::StraightLine& polar) const {
  using Operation = core::StraightLine::Operation;
  core::StraightLine line;
  line.steps = {
      {Operation::variable, 1, 0}, core::constant_step(exact_half_), core::constant_step(exact_middle_, radius_),
      {Operation::multiply, 0, 1}, {Operation::add, 2, 3},           core::constant_step(exact_depth_, radius_)};
  int wide = 4, deep = 5;
  if (sheared_) {  // the one off the tangent is counted from it
    line.steps.push_back(core::constant_step(exact_slope_));
    line.steps.push_back({Operation::multiply, 6, deep_is_along_ ? deep : wide});
    line.steps.push_back({Operation::subtract, deep_is_along_ ? wide : deep, 7});
    (deep_is_along_ ? wide : deep) = 8;
  }
  const int offset = static_cast<int>(line.steps.size());
  std::vector<int> place;
  line.steps.reserve(line.steps.size() + polar.steps.size() + 1);
  for (const core::StraightLine::Step& step : polar.steps) {
    place.push_back(static_cast<int>(line.steps.size()));
    if (step.operation == Operation::variable && (step.first == 1 || step.first == 2)) {
      place.back() = (step.first == 1) == along_x() ? deep : wide;
      continue;
    }
    core::StraightLine::Step moved = step;
    if (step.operation == Operation::variable) {
      moved.first = step.first == 0 ? 0 : step.first - 1;
    } else if (step.operation != Operation::constant) {
      moved.first = place[step.first];
      moved.second = step.operation == Operation::inverse ? 0 : place[step.second];
    }
    line.steps.push_back(std::move(moved));
  }
  if (place.back() < offset) line.steps.push_back(line.steps[place.back()]);  // the result is X' or Y' itself
  return line;
}

namespace {

/// The square of an angle's root: common powers of u turn no way.
core::StraightLine polar_angle(const Star& star, const core::Root& root) {
  const Polynomial x = around(star, root.cosine_and_sine[0]), y = around(star, root.cosine_and_sine[1]);
  const int order = x.is_zero()   ? order_at(star, y)
                    : y.is_zero() ? order_at(star, x)
                                  : std::min(order_at(star, x), order_at(star, y));
  return core::line_of_angle(polar_line(star, y, order), polar_line(star, x, order));
}

/// A polynomial around a star as a straight line without `order` powers of u; none: all that it has in common.
core::StraightLine polar_form(const Star& star, const Polynomial& p, std::optional<int> order) {
  const auto compute = [&] {
    const Polynomial moved = around(star, p);
    return polar_line(star, moved, order ? *order : moved.is_zero() ? 0 : order_at(star, moved));
  };
  if (star.apex || p.terms.size() > most_terms_remembered) return compute();
  std::vector<int> shape = {static_cast<int>(star.shape), star.along_y ? 1 : 0, order.value_or(-1)};
  shape.insert(shape.end(), star.roots.begin(), star.roots.end());
  thread_local Remembered<core::StraightLine, Rational, Rational, Rational, std::vector<int>, Polynomial> known;
  return known(compute, star.x, star.y, star.slope, shape, p);
}

}  // namespace

Charting::Charting(const core::RootTower& tower, std::vector<SheetFunction> functions, const std::vector<Star>& stars)
    : tower_(tower), functions_(std::move(functions)), stars_(stars) {}

const Charting::AtStar& Charting::at_star(int index) {
  for (const AtStar& at_star : known_)
    if (at_star.star == index) return at_star;
  AtStar at_star;
  at_star.star = index;
  const Star& star = stars_[index];
  if (star.apex && !star.apex->exact) {
    for (std::size_t j = 0; j < tower_.roots.size(); ++j) {
      const core::Root& root = tower_.roots[j];
      at_star.squares.push_back(root.is_angle() ? polar_angle(star, tower_, root)
                                                : polar_line(star, tower_, SheetFunction{root.square, root.line},
                                                             2 * star.power_of_root(static_cast<int>(j))));
    }
    for (const SheetFunction& f : functions_) at_star.functions.push_back(polar_line(star, tower_, f));
    known_.push_back(at_star);
    return known_.back();
  }
  for (std::size_t j = 0; j < tower_.roots.size(); ++j) {
    if (tower_.roots[j].is_angle()) {
      at_star.squares.push_back(polar_angle(star, tower_.roots[j]));
      continue;
    }
    at_star.squares.push_back(polar_form(star, tower_.roots[j].square, 2 * star.power_of_root(static_cast<int>(j))));
  }
  for (const SheetFunction& f : functions_) at_star.functions.push_back(polar_form(star, f.polynomial, std::nullopt));
  known_.push_back(std::move(at_star));
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
    if (const auto base = double_point(denominator))
      result.push_back({core::to_double((*base)[0]), core::to_double((*base)[1])});
  return result;
}

namespace {

core::Point2 place_of(const Star& star) { return {core::to_double(star.x), core::to_double(star.y)}; }

/// The rectangle around a star; none: it has nothing to do with the box.
std::optional<std::array<double, 4>> rectangle_around(const Star& star, const std::array<double, 4>& box,
                                                      const std::vector<core::Point2>& bases, bool skewed) {
  // A star this close to the box's edge, relative to its rectangle, has the rectangle reach across the edge.
  constexpr double margin = 0.05;
  // No round numbers, since sides of rectangles on sides of the box are hard to tell apart.
  constexpr double largest = 0.0607;  // half a rectangle's width, relative to the box
  // Functions are small around other bases: polynomials in polar coordinates are no good form there.
  constexpr double share = 0.2473;  // of the way to the next base
  // Along a common tangent, relative to the way off it: every curve towards the touch then stays in the rectangle.
  constexpr double flat = 0.4931;
  // Of the way to the sides x0, x1, y0, y1: no corner in a direction in which designs on a lattice have branches.
  constexpr std::array<double, 4> shares = {0.9371, 0.8533, 0.9713, 0.8117};
  const auto [x, y] = place_of(star);
  double reach = largest * std::max(box[1] - box[0], box[3] - box[2]);
  for (const core::Point2& base : bases) {
    const double distance = std::max(std::abs(base[0] - x), std::abs(base[1] - y));
    if (distance > 0) reach = std::min(reach, share * distance);
  }
  reach = std::min(reach, star.room);
  const double edge = margin * reach;
  if (x < box[0] - edge || x > box[1] + edge || y < box[2] - edge || y > box[3] + edge) return std::nullopt;
  // Short binary fractions, so that the charts' coefficients stay short.
  const double grain = std::exp2(std::floor(std::log2(reach)) - 20);
  const bool sheared = star.is_sheared();
  const auto side = [&](double centre, double wanted_reach, double direction, double limit) {
    const double rounded = std::round((centre + direction * wanted_reach) / grain) * grain;
    const double room = direction * (limit - centre);
    if (sheared) return rounded;
    return room >= wanted_reach * 1.1 ? rounded : room > edge ? limit : rounded;
  };
  const double across = sheared && !star.along_y ? flat * reach : reach;
  const double up = sheared && star.along_y ? flat * reach : reach;
  const auto reach_to = [&](std::size_t s) { return (s < 2 ? across : up) * (skewed ? shares[s] : 1.0); };
  return std::array{side(x, reach_to(0), -1, box[0]), side(x, reach_to(1), 1, box[1]), side(y, reach_to(2), -1, box[2]),
                    side(y, reach_to(3), 1, box[3])};
}

}  // namespace

Partition partition(const core::RootTower& tower, const std::array<double, 4>& box, std::vector<core::Point2> bases,
                    const std::vector<Star>& special, bool skewed) {
  std::vector<Star> all = cones(tower);
  for (const Star& star : special) {
    const auto known =
        std::find_if(all.begin(), all.end(), [&](const Star& other) { return other.at_same_place(star); });
    if (known == all.end())
      all.push_back(star);
    else
      known->no_length = known->no_length || star.no_length;
    bases.push_back(place_of(star));
  }
  Partition result;
  result.domain = box;
  result.charts.emplace_back();
  for (const Star& star : all) {
    const auto hole = rectangle_around(star, box, bases, skewed);
    if (!hole) continue;
    const int index = static_cast<int>(result.stars.size());
    result.stars.push_back(star);
    result.holes.push_back(*hole);
    for (const Chart::Side s : {Chart::Side::right, Chart::Side::top, Chart::Side::left, Chart::Side::bottom})
      result.charts.emplace_back(s, index, star,
                                 std::array<Rational, 4>{(*hole)[0], (*hole)[1], (*hole)[2], (*hole)[3]});
    for (const std::size_t c : {0, 2}) {
      result.domain[c] = std::min(result.domain[c], (*hole)[c]);
      result.domain[c + 1] = std::max(result.domain[c + 1], (*hole)[c + 1]);
    }
  }
  return result;
}

std::vector<PlaneCell> outside_holes(const Partition& partition) {
  std::vector<double> xs = {partition.domain[0], partition.domain[1]}, ys = {partition.domain[2], partition.domain[3]};
  for (const auto& hole : partition.holes) {
    xs.insert(xs.end(), {hole[0], hole[1]});
    ys.insert(ys.end(), {hole[2], hole[3]});
  }
  for (auto* cuts : {&xs, &ys}) {
    std::sort(cuts->begin(), cuts->end());
    cuts->erase(std::unique(cuts->begin(), cuts->end()), cuts->end());
  }
  std::vector<PlaneCell> result;
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
