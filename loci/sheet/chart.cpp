#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/rational.hpp"
#include "loci/sheet/patch.hpp"

namespace clearloci::loci::sheet {

namespace {

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
  if (at.apex) radius_ = at.apex->radius, slope_radius_ = at.apex->slope_radius;
  take_numbers();
}

void Chart::take_numbers() {
  const Rational &a = along_x() ? origin_x : origin_y, &b = along_x() ? origin_y : origin_x;
  // What is counted from the apex is known as well as the apex is.
  const auto near = [&](const Rational& value) { return enclosed_as(value, radius_, static_cast<Interval*>(nullptr)); };
  interval_ = {near(a),
               near(b),
               near(exact_depth_),
               near(exact_middle_),
               enclosed(exact_half_),
               enclosed_as(exact_slope_, slope_radius_, static_cast<Interval*>(nullptr))};
  double_ = {core::to_double(a),
             core::to_double(b),
             core::to_double(exact_depth_),
             core::to_double(exact_middle_),
             core::to_double(exact_half_),
             core::to_double(exact_slope_)};
}

std::vector<Chart> Chart::parts(const Star& at) const {
  // Of the way from the tangent to the nearer end of the side, and the least of that way, of the side.
  static const Rational share(2, 5), least(1, 8);
  if (at.tangential.empty() || along_x() == at.tangential.front().along_y) return {*this};
  const Star& tangential = at.tangential.front();
  const Rational on_side = tangential.slope * exact_depth_ - exact_middle_;
  const Rational room = exact_half_ - abs(on_side);
  if (room < least * exact_half_) return {*this};
  const Rational reach = share * room;
  std::vector<Chart> parts;
  for (const Part p : {Part::before, Part::wing_before, Part::middle, Part::wing_beyond, Part::beyond}) {
    Chart& chart = parts.emplace_back(*this);
    chart.part = p;
    if (p == Part::before || p == Part::beyond) {
      const Rational from = p == Part::before ? Rational(-exact_half_) : Rational(on_side + reach);
      const Rational to = p == Part::before ? Rational(on_side - reach) : exact_half_;
      chart.exact_middle_ = exact_middle_ + (from + to) / 2;
      chart.exact_half_ = (to - from) / 2;
    } else {
      chart.sheared_ = true;
      chart.doubled_ = false;
      chart.deep_is_along_ = true;
      chart.exact_slope_ = tangential.slope;
      chart.exact_middle_ = exact_middle_ + on_side;
      chart.exact_half_ = p == Part::wing_before ? -reach : reach;
    }
    chart.take_numbers();
  }
  return parts;
}

bool Chart::operator==(const Chart& other) const {
  const auto key = [](const Chart& c) {
    return std::tie(c.side, c.part, c.origin_x, c.origin_y, c.sheared_, c.doubled_, c.deep_is_along_, c.radius_,
                    c.slope_radius_, c.exact_depth_, c.exact_middle_, c.exact_half_, c.exact_slope_);
  };
  return key(*this) == key(other);
}

bool Chart::is_at_star(const PlaneCell& cell, double reach) const {
  if (side == Side::plane) return false;
  const auto at = [&](const Interval& away) { return away.lower() <= 0 && away.upper() <= reach; };
  return at(cell.x) || (is_wing() && at(cell.y + Interval(1.0)));
}

double Chart::scale_of_root(int root, const Star& at, double p, double q) const {
  if (side == Side::plane) return 1;
  if (!is_tangential()) return std::pow(p, at.power_of_root(root));
  const double along = std::pow(p, at.tangential.front().power_of_root(root));
  return is_wing() ? along * std::pow((1 + q) / 2, at.power_of_root(root)) : along;
}

Rational Chart::shortest_direction(const Interval& t) const {
  const Rational reach = std::max(Rational(t.width()), Rational(0x1p-50)) * abs(exact_half_ / exact_depth_);
  const Rational rise =
      core::simplest_rational_near((exact_middle_ + Rational(t.middle()) * exact_half_) / exact_depth_, reach);
  return (rise * exact_depth_ - exact_middle_) / exact_half_;
}

namespace {

/// How far a wing's place is along its other coordinate.
template <class T>
T rho_at(const T& t) {
  return (T(1) + t) * T(0.5);
}

}  // namespace

template <class T>
std::array<T, 2> Chart::from_star(const Frame<T>& f, const T& u, const T& t) const {
  if (is_wing()) {
    const T rho = rho_at(t), along = u * rho * rho;
    return {along * f.depth, along * (f.slope * f.depth + u * f.half)};
  }
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

std::optional<PlaneCell> Chart::share_of_wing(const Interval& deep, const Interval& wide) const {
  const std::optional<Interval> along = clipped(deep * inverse(interval_.depth), 0, 1);
  const std::optional<Interval> off = clipped((wide - interval_.slope * deep) * inverse(interval_.half), 0, 1);
  if (!along || !off) return std::nullopt;
  if (along->lower() <= 0) return PlaneCell{{0, 1}, {-1, 1}};
  const std::optional<Interval> u = clipped(*off * inverse(*along), 0, 1);
  if (!u) return std::nullopt;
  const auto square_at = [](double a, double o) { return squared(Interval(a)) * inverse(Interval(o)); };
  const double least = square_at(along->lower(), off->upper()).lower();
  const double most = off->lower() > 0 ? square_at(along->upper(), off->lower()).upper() : 1;
  const std::optional<Interval> square = clipped({std::min(least, most), most}, 0, 1);
  if (!square) return std::nullopt;
  const std::optional<Interval> t = clipped(square_root(*square) * Interval(2.0) - Interval(1.0), -1, 1);
  if (!t) return std::nullopt;
  return PlaneCell{*u, *t};
}

std::optional<PlaneCell> Chart::share_of(const PlaneCell& place) const {
  if (side == Side::plane) return place;
  const Interval deep = (along_x() ? place.x : place.y) - interval_.a;
  const Interval wide = (along_x() ? place.y : place.x) - interval_.b;
  if (is_wing()) return share_of_wing(deep, wide);
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
  if (is_wing()) {
    const Interval along = deep * inverse(interval_.depth);
    const Interval off = (wide - interval_.slope * deep) * inverse(interval_.half);
    if (along.lower() <= 0 || off.lower() <= 0) return std::nullopt;
    const Interval u = off * inverse(along), square = squared(along) * inverse(off);
    if (u.lower() <= 0 || u.upper() > 1 || square.lower() <= 0 || square.upper() > 1) return std::nullopt;
    return PlaneCell{u, meet(square_root(square) * Interval(2.0) - Interval(1.0), {-1, 1})};
  }
  const Interval u = distance(deep, wide);
  if (u.lower() <= 0 || u.upper() > 1) return std::nullopt;
  const Interval t = (on_side(u, deep, wide) - interval_.middle) * inverse(interval_.half);
  if (t.lower() < -1 || t.upper() > 1) return std::nullopt;
  return PlaneCell{u, t};
}

core::StraightLine Chart::in_chart(const core::StraightLine& polar) const {
  using Operation = core::StraightLine::Operation;
  core::StraightLine line;
  line.steps = {
      {Operation::variable, 1, 0}, core::constant_step(exact_half_), core::constant_step(exact_middle_, radius_),
      {Operation::multiply, 0, 1}, {Operation::add, 2, 3},           core::constant_step(exact_depth_, radius_)};
  int wide = 4, deep = 5, rho = -1;
  if (is_wing()) {  // how far it is off the tangent is a number
    wide = 1;
    const int first = static_cast<int>(line.steps.size());
    line.steps.push_back(core::constant_step(1));
    line.steps.push_back({Operation::add, 0, first});
    line.steps.push_back(core::constant_step(Rational(1, 2)));
    line.steps.push_back({Operation::multiply, first + 1, first + 2});
    rho = first + 3;
  } else if (sheared_) {  // the one off the tangent is counted from it
    line.steps.push_back(core::constant_step(exact_slope_, slope_radius_));
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
    if (step.operation == Operation::variable && step.first == 3 && rho >= 0) {
      place.back() = rho;
      continue;
    }
    core::StraightLine::Step moved = step;
    if (step.operation == Operation::variable) {
      moved.first = step.first == 0 ? 0 : step.first - (rho >= 0 ? 2 : 1);
    } else if (step.operation != Operation::constant) {
      moved.first = place[step.first];
      moved.second = step.operation == Operation::inverse ? 0 : place[step.second];
    }
    line.steps.push_back(std::move(moved));
  }
  if (place.back() < offset) line.steps.push_back(line.steps[place.back()]);  // the result is X' or Y' itself
  return line;
}

}  // namespace clearloci::loci::sheet
