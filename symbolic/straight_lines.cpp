#include "symbolic/straight_lines.hpp"

#include <algorithm>

namespace clearloci::symbolic {

using core::Polynomial;
using core::Rational;
using core::StraightLine;

StraightLines::StraightLines(const Geometry& geometry) : geometry_(&geometry) {
  // Free coordinates and roots are the tower's own variables, in its order.
  const std::vector<int> own = geometry.tower_variables();
  for (std::size_t i = 0; i < own.size(); ++i) known_[own[i]] = builder_.variable(static_cast<int>(i));
}

StraightLine StraightLines::of(const Poly& natural) { return builder_.line(value(natural.plain())); }

StraightLine StraightLines::square(std::size_t root) {
  const std::optional<Dyad> known = dyad(geometry_->roots()[root].point);
  if (!known || geometry_->roots()[root].role != core::RootRole::working_mode) return {};
  const Rational sum = known->from_length + known->to_length, difference = known->from_length - known->to_length;
  const int outer = builder_.subtract(builder_.constant(sum * sum), known->distance2);
  const int inner = builder_.subtract(known->distance2, builder_.constant(difference * difference));
  const int scale = builder_.power(known->scale, 2);
  return builder_.line(builder_.multiply(scale, builder_.multiply(outer, inner)));
}

std::optional<std::array<StraightLine, 2>> StraightLines::way(mechanism::PointIndex point) {
  const std::optional<Dyad> known = dyad(point);
  if (!known) return std::nullopt;
  return std::array{builder_.line(known->u), builder_.line(known->v)};
}

int StraightLines::value(const Polynomial& p) {
  std::vector<int> variables(static_cast<std::size_t>(p.variables), 0);
  for (int v = 0; v < p.variables; ++v)
    if (core::depends_on(p, v)) variables[static_cast<std::size_t>(v)] = variable(v);
  return builder_.polynomial(p, variables);
}

int StraightLines::variable(int ring_variable) {
  if (const auto found = known_.find(ring_variable); found != known_.end()) return found->second;
  for (const ConstructedPoint& point : geometry_->constructed()) {
    if (point.x != ring_variable && point.y != ring_variable) continue;
    const Place place = constructed_place(point);
    known_[point.x] = place.x;
    known_[point.y] = place.y;
    return known_.at(ring_variable);
  }
  for (const Substitution& pair : geometry_->substitutions()) {
    if (pair.x != ring_variable && pair.y != ring_variable) continue;
    const Place place = over_tower(pair.place);
    known_[pair.x] = place.x;
    known_[pair.y] = place.y;
  }
  return known_.at(ring_variable);
}

StraightLines::Place StraightLines::natural_place(mechanism::PointIndex point) {
  const auto& natural = geometry_->natural(point);
  return {value(geometry_->poly(natural[0]).plain()), value(geometry_->poly(natural[1]).plain())};
}

StraightLines::Place StraightLines::over_tower(const TowerPoint& place) {
  const int w = builder_.inverse(value(place.w.plain()));
  return {builder_.multiply(value(place.x.plain()), w), builder_.multiply(value(place.y.plain()), w)};
}

std::optional<StraightLines::Dyad> StraightLines::dyad(mechanism::PointIndex point) {
  const mechanism::PointForm& form = geometry_->mechanism().points[static_cast<std::size_t>(point)].form;
  const auto* own = std::get_if<mechanism::DyadPoint>(&form);
  if (own == nullptr) return std::nullopt;
  const Poly from_length = geometry_->poly(geometry_->expression(own->from_length).expand());
  const Poly to_length = geometry_->poly(geometry_->expression(own->to_length).expand());
  if (!from_length.is_constant() || !to_length.is_constant()) return std::nullopt;
  const Place a = natural_place(own->from), p = natural_place(own->to);
  const int u = builder_.subtract(p.x, a.x), v = builder_.subtract(p.y, a.y);
  const int distance2 = builder_.add(builder_.multiply(u, u), builder_.multiply(v, v));
  const auto root = std::find_if(geometry_->roots().begin(), geometry_->roots().end(),
                                 [&](const TowerRoot& r) { return r.point == point; });
  if (root == geometry_->roots().end()) return std::nullopt;
  const int scale = builder_.multiply(value(root->scale.plain()), builder_.inverse(value(root->scale_divisor.plain())));
  return Dyad{u, v, distance2, scale, from_length.constant(), to_length.constant()};
}

StraightLines::Place StraightLines::constructed_place(const ConstructedPoint& point) {
  const auto root = std::find_if(geometry_->roots().begin(), geometry_->roots().end(),
                                 [&](const TowerRoot& r) { return r.point == point.point; });
  const std::optional<Dyad> known = dyad(point.point);
  if (!known || root == geometry_->roots().end()) return over_tower(geometry_->tower(point.point));
  const auto& form =
      std::get<mechanism::DyadPoint>(geometry_->mechanism().points[static_cast<std::size_t>(point.point)].form);
  const Place a = natural_place(form.from);
  const Rational half(1, 2);
  const int inverse = builder_.inverse(known->distance2);
  const Rational excess = known->from_length * known->from_length - known->to_length * known->to_length;
  const int lambda =
      builder_.add(builder_.constant(half), builder_.multiply(builder_.constant(excess * half), inverse));
  const int s = builder_.multiply(known_.at(root->variable), builder_.inverse(known->scale));
  const int mu = builder_.multiply(builder_.multiply(builder_.constant(half), s), inverse);
  const int x = builder_.subtract(builder_.multiply(lambda, known->u), builder_.multiply(mu, known->v));
  const int y = builder_.add(builder_.multiply(lambda, known->v), builder_.multiply(mu, known->u));
  return {builder_.add(a.x, x), builder_.add(a.y, y)};
}

}  // namespace clearloci::symbolic
