// Where the points of a mechanism are over the tower (method.md section 1).
#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "core/powers_of_two.hpp"
#include "core/reduced.hpp"
#include "mechanism/evaluate.hpp"
#include "symbolic/geometry.hpp"
#include "symbolic/ginac_number.hpp"

namespace clearloci::symbolic {
namespace {

using core::Expression;
using core::Rational;
using core::RootRole;
using mechanism::DyadPoint;
using mechanism::ExplicitPoint;
using mechanism::MeanPoint;
using mechanism::OffsetPoint;
using mechanism::PointIndex;
using mechanism::SliderPoint;

using Vector = std::array<Poly, 3>;

Poly dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Over the tower. A longer one is written anew: dyads on dyads have thousands of terms where hundreds will do.
constexpr std::size_t most_terms_of_a_distance = 100;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

void Geometry::place(PointIndex point) {
  const mechanism::PointForm& form = mechanism_->points[index(point)].form;
  if (const auto* by_coordinates = std::get_if<ExplicitPoint>(&form)) place_explicit(point, *by_coordinates);
  if (const auto* mean = std::get_if<MeanPoint>(&form)) place_mean(point, *mean);
  if (const auto* dyad = std::get_if<DyadPoint>(&form)) place_dyad(point, *dyad);
  if (const auto* offset = std::get_if<OffsetPoint>(&form)) place_offset(point, *offset);
  if (const auto* slider = std::get_if<SliderPoint>(&form)) place_slider(point, *slider);
  if (const auto* shifted = std::get_if<mechanism::ShiftedPoint>(&form)) place_shifted(point, *shifted);
  if (const auto* crossing = std::get_if<mechanism::CrossingPoint>(&form)) place_crossing(point, *crossing);
}

void Geometry::place_explicit(PointIndex point, const ExplicitPoint& form) {
  auto& components = natural_[index(point)];
  for (std::size_t i = 0; i < form.coordinates.size(); ++i) components[i] = expression(form.coordinates[i]).expand();
  TowerPoint place(poly(components[0]), poly(components[1]), poly(components[2]), Poly(*ring_, 1));
  for (const Substitution& angle : angles_) {
    const int degree = std::max({degree_in(place.x, angle), degree_in(place.y, angle), degree_in(place.z, angle)});
    place = {substituted(place.x, angle, degree), substituted(place.y, angle, degree),
             substituted(place.z, angle, degree), place.w * angle.place.w.pow(static_cast<unsigned>(degree))};
  }
  tower_[index(point)] = place;
}

void Geometry::add_denominator(const Poly& squared_length) {
  denominators_.push_back(squared_length);
  if (has_root(squared_length)) return add_positive(squared_length);
  // Over the coordinates alone no factor of what is nowhere negative changes its sign, but where it is there twice: the
  // squared distance of two points of one line.
  Rational constant;
  for (const PolyFactor& factor : squared_length.factors(constant))
    add_positive(factor.multiplicity % 2 == 0 ? factor.poly * factor.poly : factor.poly);
}

Poly Geometry::without_cuts(Poly squared_length, const Poly& below) const {
  Poly rest(*ring_);
  for (const Fold& fold : folds_)
    while (!below.divides(fold.where, rest) && squared_length.divides(fold.where, rest))
      std::swap(squared_length, rest);
  return squared_length;
}

void Geometry::add_positive(const Poly& divisor) {
  if (divisor.is_constant()) return;
  // Which of the two signs is the positive one is told by any place where it is not zero.
  const core::Polynomial plain = divisor.plain();
  std::vector<Rational> at(static_cast<std::size_t>(ring_->size()), Rational(1));
  Rational value = core::evaluate(plain, at);
  for (int step = 1; value == 0; ++step) {
    for (std::size_t v = 0; v < at.size(); ++v) at[v] = core::reduced(step, static_cast<long>(v) + 2);
    value = core::evaluate(plain, at);
  }
  const Poly positive = value > 0 || has_root(divisor) ? divisor : -divisor;
  if (std::find(positive_.begin(), positive_.end(), positive) == positive_.end()) positive_.push_back(positive);
}

Poly Geometry::common_positive(Poly a, Poly b) const {
  Poly common(*ring_, 1), rest_a(*ring_), rest_b(*ring_);
  for (const Poly& divisor : positive_) {
    while (a.divides(divisor, rest_a) && b.divides(divisor, rest_b)) {
      common *= divisor;
      std::swap(a, rest_a);
      std::swap(b, rest_b);
    }
  }
  return common;
}

void Geometry::lighten(TowerPoint& place) const {
  Poly x(*ring_), y(*ring_), z(*ring_), w(*ring_);
  for (const Poly& divisor : positive_)
    while (place.w.divides(divisor, w) && place.x.divides(divisor, x) && place.y.divides(divisor, y) &&
           place.z.divides(divisor, z))
      place = {x, y, z, w};
  // Divisors are primitive: by the powers of two that they leave behind places would leave the range of doubles.
  const core::Polynomial plain = place.w.plain();
  const Rational unit = core::scaled_for_doubles(plain).terms.front().coefficient / plain.terms.front().coefficient;
  constexpr long far = 64;  // powers of two
  const Rational most = core::times_power_of_two(1, far), least = 1 / most;
  if (least <= unit && unit <= most) return;
  for (Poly* const part : {&place.x, &place.y, &place.z, &place.w}) *part = part->scaled(unit);
}

TowerPoint Geometry::difference(const TowerPoint& to, const TowerPoint& from) const {
  const Poly common = common_positive(to.w, from.w);
  const Poly a = from.w.exact_quotient(common), b = to.w.exact_quotient(common);
  TowerPoint way{reduce(to.x * a - from.x * b), reduce(to.y * a - from.y * b), reduce(to.z * a - from.z * b),
                 reduce(to.w * a)};
  lighten(way);
  return way;
}

void Geometry::place_mean(PointIndex point, const MeanPoint& form) {
  const TowerPoint& a = tower(form.first);
  const TowerPoint& b = tower(form.second);
  for (std::size_t i = 0; i < 3; ++i) {
    natural_[index(point)][i] = ((natural(form.first)[i] + natural(form.second)[i]) / 2).expand();
  }
  TowerPoint place = sum(a, b);
  place.w = place.w.scaled(2);
  tower_[index(point)] = place;
}

const ConstructedPoint& Geometry::constructed(PointIndex point) const {
  return *std::find_if(constructed_.begin(), constructed_.end(), [&](const auto& c) { return c.point == point; });
}

void Geometry::construct(PointIndex point) {
  const ConstructedPoint& own = constructed(point);
  natural_[index(point)] = {GiNaC::ex(symbol(ring_->name(own.x))), GiNaC::ex(symbol(ring_->name(own.y))),
                            own.z < 0 ? GiNaC::ex(0) : GiNaC::ex(symbol(ring_->name(own.z)))};
}

bool Geometry::has_root(const Poly& p) const {
  return std::any_of(roots_.begin(), roots_.end(), [&](const TowerRoot& root) { return p.depends_on(root.variable); });
}

Poly Geometry::by_known_lengths(Poly squared) const {
  const auto squared_way = [&](PointIndex from, PointIndex to) {
    const auto &a = natural(from), &b = natural(to);
    const Poly x = poly((b[0] - a[0]).expand()), y = poly((b[1] - a[1]).expand());
    return x * x + y * y;
  };
  for (auto elbow = constructed_.rbegin(); elbow != constructed_.rend(); ++elbow) {
    const auto* dyad = std::get_if<DyadPoint>(&mechanism_->points[index(elbow->point)].form);
    const std::vector<int> pair = {elbow->x, elbow->y};
    if (dyad == nullptr || dyad->axis || squared.degree(pair) != 2) continue;
    const Poly factor = squared.coefficients(elbow->x).back();
    if (!factor.is_constant()) continue;
    std::optional<Poly> best;
    for (const auto& [end, length] : {std::pair{dyad->from, dyad->from_length}, {dyad->to, dyad->to_length}}) {
      if (dyad->right_angle && end == dyad->to) continue;
      Poly less = squared - factor * (squared_way(end, elbow->point) - squared_length(length));
      if (less.degree(pair) < 2 && (!best || less.length() < best->length())) best = std::move(less);
    }
    if (best) squared = std::move(*best);
  }
  return squared;
}

std::array<Poly, 2> Geometry::squared_distance(PointIndex from, PointIndex to) const {
  const auto &a = natural(from), &b = natural(to);
  const Poly x = poly((b[0] - a[0]).expand()), y = poly((b[1] - a[1]).expand());
  Poly above = by_known_lengths(x * x + y * y), below(*ring_, 1), less_above(*ring_), less_below(*ring_);
  for (const Substitution& pair : substitutions()) {
    const int degree = degree_in(above, pair);
    if (degree == 0) continue;
    above = substituted(above, pair, degree);
    below = reduce(below * pair.place.w.pow(static_cast<unsigned>(degree)));
    for (const Poly& divisor : positive_)
      while (above.divides(divisor, less_above) && below.divides(divisor, less_below)) {
        std::swap(above, less_above);
        std::swap(below, less_below);
      }
  }
  return {above, below};
}

Poly Geometry::squared_length(const Expression& length) const {
  const Poly length_poly = poly(expression(length).expand());
  if (!length_poly.is_constant() || is_free(length) || crank_lengths_.contains(length_poly.constant()))
    return length_poly * length_poly;
  const Expression square = Expression::apply(Expression::Kind::power, {length, Expression::number(2)});
  const mechanism::ExactValue exact = mechanism::evaluate(square, mechanism_->parameters);
  return exact.exact ? Poly(*ring_, exact.value) : length_poly * length_poly;
}

void Geometry::list_crank_lengths() {
  const std::function<void(const Expression&)> walk = [&](const Expression& e) {
    if (e.kind() == Expression::Kind::sqrt && !is_free(e)) {
      const mechanism::ExactValue root = mechanism::evaluate(e, mechanism_->parameters);
      if (!root.exact) crank_lengths_.insert(root.value);
    }
    for (const Expression& argument : e.arguments()) walk(argument);
  };
  for (const mechanism::Point& point : mechanism_->points) {
    if (const auto* form = std::get_if<ExplicitPoint>(&point.form))
      for (const Expression& coordinate : form->coordinates) walk(coordinate);
    if (const auto* form = std::get_if<mechanism::ShiftedPoint>(&point.form))
      for (const Expression& number : mechanism::numbers_of(form->by)) walk(number);
  }
}

void Geometry::place_dyad(PointIndex point, const DyadPoint& form) {
  construct(point);
  const TowerPoint& a = tower(form.from);
  const Poly from2 = squared_length(form.from_length);
  const Poly to2 = form.right_angle ? Poly(*ring_) : squared_length(form.to_length);
  // P - A = way / w; D = d / w^2; k = kn / w^2; Q = square / w^4 and s is scaled by w^2 > 0 likewise.
  const auto [x, y, w, z] = difference(tower(form.to), a);
  const Vector way = {x, y, z};
  const Vector n = form.axis ? direction(*form.axis) : Vector{Poly(*ring_), Poly(*ring_), Poly(*ring_, 1)};
  const Poly n2 = reduce(dot(n, n)), h = reduce(dot(n, way)), way2 = reduce(dot(way, way));
  const Poly whole_w2 = reduce(w * w), whole_d = reduce(n2 * way2 - h * h);
  // Between two points of one link D is the same number in every pose, and k and Q are: with D / 1 in place of d / w^2
  // the point is a fixed combination of the two, and no denominator of theirs is taken twice.
  const std::optional<Poly> rigid = form.axis ? std::nullopt : constant_quotient(whole_d, whole_w2);
  Poly w2 = rigid ? Poly(*ring_, 1) : whole_w2, d = rigid.value_or(whole_d);
  bool is_squared = true;
  if (!rigid && !form.axis && d.length() > most_terms_of_a_distance) {
    auto [above, below] = squared_distance(form.from, form.to);
    if (above.length() < d.length()) {
      is_squared = false;
      d = std::move(above);
      w2 = std::move(below);
    }
  }
  Poly kn =
      form.right_angle ? reduce((from2 * w2).scaled(2)) : reduce((from2 - to2) * w2 + (rigid || !form.axis ? d : way2));
  Poly square = reduce((from2 * d * w2).scaled(4) - n2 * kn * kn);
  // What divides k and the root alike is taken out of the root.
  Poly scale(*ring_, 1), less(*ring_), quotient(*ring_);
  for (const Poly& divisor : positive_)
    while (kn.divides(scale * divisor, less) && square.divides(divisor * divisor, quotient)) {
      scale *= divisor;
      std::swap(square, quotient);
    }
  const Poly shared = common_positive(w2, scale);
  const Poly s = add_root({point, next_root(), RootRole::working_mode, square, w2.exact_quotient(shared),
                           scale.exact_quotient(shared)}) *
                 shared;
  if (!d.is_constant()) add_denominator(d);
  const Vector left = cross(n, way);
  const auto component = [&](std::size_t i) { return reduce(kn * (n2 * way[i] - h * n[i]) + s * left[i]); };
  TowerPoint step{component(0), component(1), component(2), reduce(d * w).scaled(2)};
  const bool is_cut = roots_.back().is_cut;
  if (!form.axis && !rigid && !is_cut) dyad_ways_.push_back({point, x, y, w, w2, d, step.w, is_squared});
  lighten(step);
  if (is_cut) denominators_.back() = without_cuts(denominators_.back(), step.w);
  tower_[index(point)] = sum(a, step);
  if (form.axis) keep_in_plane(point, form.from, n);
  if (roots_.back().value) keep_beside_another(point);
  if (form.axis || (roots_.back().value && close_loop(point, form, {w2 * x, w2 * y, d * w}, {w2, Poly(*ring_), d})))
    return;
  if (!has_root(d)) return;
  const ConstructedPoint& own = constructed(point);
  const Poly u = Poly::variable(*ring_, own.x), v = Poly::variable(*ring_, own.y);
  TowerPoint in_frame{kn, s, d.scaled(2)};
  lighten(in_frame);
  frames_.emplace(point, std::array{sum(a, {u * x - v * y, u * y + v * x, w}), std::move(in_frame)});
}

bool Geometry::close_loop(PointIndex point, const DyadPoint& form, TowerPoint way, TowerPoint part) {
  const TowerPoint& own = tower(point);
  const auto differs = [&](const TowerPoint& place, const Sample& sample) {
    constexpr double rounding = 1e-6;
    if (!sample.is_reached) return false;
    const auto value = [&](const Poly& p) { return core::evaluate(p.plain(), std::span<const double>(sample.at)); };
    const double by_x = value(place.x) / value(place.w) - value(own.x) / value(own.w);
    const double by_y = value(place.y) / value(place.w) - value(own.y) / value(own.w);
    return std::hypot(by_x, by_y) > rounding * std::hypot(value(own.x), value(own.y)) / std::abs(value(own.w));
  };
  const auto is_own = [&](const TowerPoint& place) {
    return std::none_of(samples_.begin(), samples_.end(), [&](const Sample& at) { return differs(place, at); }) &&
           reduce(place.x * own.w - own.x * place.w).is_zero() && reduce(place.y * own.w - own.y * place.w).is_zero();
  };
  const Poly along =
      squared_length(form.from_length) - (form.right_angle ? Poly(*ring_) : squared_length(form.to_length));
  const bool may_cross = !form.right_angle && along.is_constant();
  for (TowerPoint* const place : {&way, &part}) {
    *place = {reduce(place->x * along), reduce(place->y * along), reduce(place->w)};
    lighten(*place);
  }
  const GiNaC::ex m = symbol(ring_->name(constructed(point).x));
  const auto &from = natural(form.from), &to = natural(form.to);
  for (PointIndex fourth = 0; fourth < point; ++fourth) {
    if (fourth == form.from || fourth == form.to) continue;
    const auto& other = natural(fourth);
    TowerPoint place = sum(tower(form.to), difference(tower(form.from), tower(fourth)));
    const bool is_parallelogram = is_own(place);
    if (!is_parallelogram) {
      if (!may_cross) continue;
      place = sum(tower(fourth), way);
      if (!is_own(place)) continue;
    }
    std::array<GiNaC::ex, 2> by_others;
    for (std::size_t i = 0; i < 2; ++i)
      by_others[i] = is_parallelogram ? from[i] + to[i] - other[i] : other[i] + m * (to[i] - from[i]);
    tower_[index(point)] = std::move(place);
    Closing closing{fourth, {poly(by_others[0].expand()), poly(by_others[1].expand()), Poly(*ring_, 1)}};
    if (!is_parallelogram) {
      closing.part = std::move(part);
      closing.along = along.constant();
    }
    closings_.emplace(point, std::move(closing));
    return true;
  }
  return false;
}

std::optional<Poly> Geometry::constant_quotient(const Poly& p, const Poly& divisor) const {
  Poly quotient(*ring_);
  if (p.is_zero() || !p.divides(divisor, quotient)) return std::nullopt;
  for (const int variable : tower_variables())
    if (quotient.depends_on(variable)) return std::nullopt;
  return quotient;
}

void Geometry::keep_beside_another(PointIndex point) {
  const auto beside = [&](PointIndex other) {
    const auto [x, y, w, z] = difference(tower(point), tower(other));
    auto components = natural(other);
    const Vector way = {x, y, z};
    bool same = true;
    for (std::size_t i = 0; i < 3; ++i) {
      Poly step(*ring_);
      if (!way[i].is_zero() && (!way[i].divides(w, step) || !step.is_constant())) return false;
      same = same && step.is_zero();
      components[i] += number(step.constant());
    }
    // A point in the place of another one makes modes that are singular in every pose, of which its own factor tells
    // why.
    if (!same) natural_[index(point)] = components;
    return !same;
  };
  for (PointIndex other = 0; other < point; ++other)
    if (beside(other)) return;
}

void Geometry::keep_in_plane(PointIndex point, PointIndex base, const Vector& normal) {
  if (std::any_of(normal.begin(), normal.end(), [](const Poly& n) { return !n.is_constant(); })) return;
  // The last coordinate that the others tell.
  std::size_t told = 3;
  for (std::size_t i = 0; i < 3; ++i)
    if (!normal[i].is_zero()) told = i;
  if (told == 3) return;
  auto& components = natural_[index(point)];
  const auto& from = natural(base);
  GiNaC::ex value = from[told];
  for (std::size_t i = 0; i < 3; ++i)
    if (i != told) value -= number(normal[i].constant() / normal[told].constant()) * (components[i] - from[i]);
  components[told] = value.expand();
}

void Geometry::keep_on_line(PointIndex point, PointIndex base, const Vector& along) {
  if (std::any_of(along.begin(), along.end(), [](const Poly& u) { return !u.is_constant(); })) return;
  const auto free = static_cast<std::size_t>(
      std::find_if(along.begin(), along.end(), [](const Poly& u) { return !u.is_zero(); }) - along.begin());
  if (free == 3) return;
  auto& components = natural_[index(point)];
  const auto& from = natural(base);
  for (std::size_t i = 0; i < 3; ++i)
    if (i != free)
      components[i] =
          (from[i] + number(along[i].constant() / along[free].constant()) * (components[free] - from[free])).expand();
}

TowerPoint Geometry::sum(const TowerPoint& a, const TowerPoint& way) const {
  const Poly common = common_positive(a.w, way.w);
  const Poly to_a = way.w.exact_quotient(common), to_way = a.w.exact_quotient(common);
  TowerPoint place{reduce(a.x * to_a + way.x * to_way), reduce(a.y * to_a + way.y * to_way),
                   reduce(a.z * to_a + way.z * to_way), reduce(a.w * to_a)};
  lighten(place);
  return place;
}

TowerPoint Geometry::offset_over_tower(const OffsetPoint& form, const Poly& length_numerator,
                                       const Poly& length_denominator) const {
  return offset_over_tower(form, {poly(expression(form.along).expand()), poly(expression(form.left).expand())},
                           length_numerator, length_denominator);
}

TowerPoint Geometry::offset_over_tower(const OffsetPoint& form, const std::array<Poly, 2>& offset,
                                       const Poly& length_numerator, const Poly& length_denominator) const {
  const TowerPoint& a = tower(form.first);
  const auto& [along, left] = offset;
  const auto [u, v, w, h] = difference(tower(form.second), a);
  // A + (along u - left v) / (w length)
  TowerPoint way{reduce((along * u - left * v) * length_denominator),
                 reduce((along * v + left * u) * length_denominator), reduce(along * h * length_denominator),
                 reduce(w * length_numerator)};
  lighten(way);
  return sum(a, way);
}

std::array<Poly, 3> Geometry::direction(const mechanism::VectorExpression& vector_) const {
  const std::vector<GiNaC::ex> natural = vector(vector_);
  Vector u = {poly(natural[0]), poly(natural[1]), natural.size() > 2 ? poly(natural[2]) : Poly(*ring_)};
  for (const Substitution& pair : substitutions()) {
    const int degree = std::max({degree_in(u[0], pair), degree_in(u[1], pair), degree_in(u[2], pair)});
    if (degree == 0) continue;
    for (Poly& component : u) component = substituted(component, pair, degree);
  }
  return u;
}

void Geometry::divide_by_length(const mechanism::VectorExpression& axis) {
  const Vector u = direction(axis);
  const Poly size = reduce(dot(u, u));
  const std::vector<int> free = tower_variables();
  if (std::any_of(free.begin(), free.end(), [&](int variable) { return size.depends_on(variable); }))
    add_denominator(size);
}

// S = Q + (p +- s) u / U,  p = u . (C - Q),  U = u . u,  s^2 = l^2 U - (u x (C - Q))^2: the sign + is ahead.
void Geometry::place_slider(PointIndex point, const SliderPoint& form) {
  const TowerPoint& q = tower(form.base);
  const Poly length2 = squared_length(form.length);
  const Vector u = direction(form.along);
  // C - Q = way / w; p = pn / w, s is scaled by w > 0 likewise.
  const auto [x, y, w, z] = difference(tower(form.from), q);
  const Vector way = {x, y, z};
  const Poly size = reduce(dot(u, u)), pn = reduce(dot(u, way));
  const Vector across = cross(u, way);
  const Poly s =
      add_root({point, next_root(), RootRole::working_mode, reduce(length2 * size * w * w - dot(across, across)), w});
  if (!size.is_constant()) add_denominator(size);
  TowerPoint step{reduce((pn + s) * u[0]), reduce((pn + s) * u[1]), reduce((pn + s) * u[2]), reduce(w * size)};
  lighten(step);
  tower_[index(point)] = sum(q, step);
  construct(point);
  keep_on_line(point, form.base, u);
}

void Geometry::place_shifted(PointIndex point, const mechanism::ShiftedPoint& form) {
  const std::vector<GiNaC::ex> by = vector(form.by);
  auto& components = natural_[index(point)];
  TowerPoint way{Poly(*ring_), Poly(*ring_), Poly(*ring_), Poly(*ring_, 1)};
  std::array<Poly*, 3> parts = {&way.x, &way.y, &way.z};
  for (std::size_t i = 0; i < by.size(); ++i) {
    components[i] = (natural(form.from)[i] + by[i]).expand();
    *parts[i] = poly(by[i]);
  }
  for (std::size_t i = by.size(); i < 3; ++i) components[i] = natural(form.from)[i];
  for (const Substitution& pair : substitutions()) {
    const int degree = std::max({degree_in(way.x, pair), degree_in(way.y, pair), degree_in(way.z, pair)});
    if (degree == 0) continue;
    for (Poly* part : parts) *part = substituted(*part, pair, degree);
    way.w = reduce(way.w * pair.place.w.pow(static_cast<unsigned>(degree)));
  }
  lighten(way);
  tower_[index(point)] = sum(tower(form.from), way);
}

// X = Q + (((R - Q) x v) / (u x v)) u, with (u x v)^2 below: a denominator is nowhere negative.
void Geometry::place_crossing(PointIndex point, const mechanism::CrossingPoint& form) {
  const TowerPoint& q = tower(form.first);
  const Vector u = direction(form.along_first), v = direction(form.along_second);
  const auto [x, y, w, z] = difference(tower(form.second), q);
  const Poly turn = reduce(u[0] * v[1] - u[1] * v[0]), square = reduce(turn * turn);
  const Poly part = reduce((x * v[1] - y * v[0]) * turn);
  if (!square.is_constant()) add_denominator(square);
  TowerPoint step{reduce(part * u[0]), reduce(part * u[1]), Poly(*ring_), reduce(w * square)};
  lighten(step);
  tower_[index(point)] = sum(q, step);
  construct(point);
  keep_on_line(point, form.first, u);
}

void Geometry::place_offset(PointIndex point, const OffsetPoint& form) {
  const TowerPoint& a = tower(form.first);
  const TowerPoint& b = tower(form.second);
  const auto [u, v, w, h] = difference(b, a);
  const Poly d = reduce(u * u + v * v + h * h);
  const Poly one(*ring_, 1);
  // On a rigid link the distance is constant: then the point is linear in the two others.
  const std::optional<Poly> squared_length = constant_quotient(d, reduce(w * w));
  Poly length(*ring_);
  bool has_root = squared_length && squared_length->square_root(length);
  if (squared_length && !has_root && squared_length->is_constant()) {
    const Expression root = Expression::apply(Expression::Kind::sqrt, {Expression::number(squared_length->constant())});
    length = Poly(*ring_, mechanism::value_of(root, *mechanism_));
    has_root = true;
  }
  if (has_root && length.is_constant()) {
    // Parts of the way to the second point: rational numbers where the offsets and the length have a root in common.
    const auto part = [&](const Expression& offset) -> GiNaC::ex {
      if (squared_length->is_constant() && !keep_parameters_ && !is_free(offset)) {
        const Expression root =
            Expression::apply(Expression::Kind::sqrt, {Expression::number(squared_length->constant())});
        const mechanism::ExactValue exact =
            mechanism::evaluate(Expression::apply(Expression::Kind::divide, {offset, root}), mechanism_->parameters);
        if (exact.exact) return number(exact.value);
      }
      return expression(offset) * number(1 / length.constant());
    };
    const GiNaC::ex along = part(form.along), left = part(form.left);
    const auto& p = natural(form.first);
    const auto& q = natural(form.second);
    natural_[index(point)] = {(p[0] + along * (q[0] - p[0]) - left * (q[1] - p[1])).expand(),
                              (p[1] + along * (q[1] - p[1]) + left * (q[0] - p[0])).expand(),
                              (p[2] + along * (q[2] - p[2])).expand()};
    tower_[index(point)] = offset_over_tower(form, {poly(along.expand()), poly(left.expand())}, one, one);
    return;
  }
  construct(point);
  if (has_root) {
    tower_[index(point)] = offset_over_tower(form, length, one);
    return;
  }
  // A varying distance (a telescopic leg): s = |AB| w, always positive. 1 / |AB| = s w / d.
  const Poly s = add_root({point, next_root(), RootRole::length, d, w});
  add_denominator(d);
  tower_[index(point)] = offset_over_tower(form, d, reduce(s * w));
}

}  // namespace clearloci::symbolic
