// Polynomials of points that dyads construct, by the ways from their ends and by the lengths of the dyads.
#include <algorithm>
#include <utility>

#include "symbolic/straight_lines.hpp"

namespace clearloci::symbolic {

using core::Polynomial;
using core::Rational;

namespace {

/// p with v + by in the place of v, of which there may be none.
Poly moved(const Poly& p, int v, const Poly& by) {
  if (v < 0) return p;
  const std::vector<Poly> powers = p.coefficients(v);
  if (powers.size() <= 1) return p;
  const Poly place = Poly::variable(p.ring(), v) + by;
  Poly sum(p.ring());
  for (auto power = powers.rbegin(); power != powers.rend(); ++power) sum = sum * place + *power;
  return sum;
}

/// slope (v + rest), v a variable.
struct LinearIn {
  int variable;
  Rational slope;
  Poly rest;
};

/// In a variable that is not in `other`.
std::optional<LinearIn> linear_in(const Poly& p, const std::optional<Poly>& other) {
  if (p.total_degree() != 1) return std::nullopt;
  for (int v = p.ring().size() - 1; v >= 0; --v) {
    if (!p.depends_on(v) || (other && other->depends_on(v))) continue;
    const std::vector<Poly> sides = p.coefficients(v);
    const Rational slope = sides[1].constant();
    return LinearIn{v, slope, sides[0].scaled(1 / slope)};
  }
  return std::nullopt;
}

}  // namespace

int StraightLines::scaled_value_by_ways(const Poly& natural, const Polynomial& scaled) {
  if (scaled.terms.empty()) return builder_.constant(0);
  return value_by_ways(natural, scaled.terms.front().coefficient / natural.plain().terms.front().coefficient);
}

std::optional<int> StraightLines::value_by_directions(const Poly& natural, const Rational& scale) {
  if (geometry_->mechanism().space != mechanism::Space::planar) return std::nullopt;
  for (const InverseLength& length : geometry_->inverse_lengths()) {
    if (length.root < 0 || geometry_->roots()[static_cast<std::size_t>(length.root)].value) continue;
    if (!natural.depends_on(length.variable)) continue;
    const std::vector<Poly> parts = natural.coefficients(length.variable);
    if (parts.size() != 2) continue;
    const std::vector<GiNaC::ex> way = geometry_->vector(length.along);
    const std::array<Poly, 2> v = {geometry_->poly(way[0].expand()), geometry_->poly(way[1].expand())};
    const std::optional<LinearIn> x = linear_in(v[0], std::nullopt), y = linear_in(v[1], v[0]);
    if (!x || !y || v[1].depends_on(x->variable)) continue;
    // In the way's parts: x / x->slope and y / y->slope in the place of the two variables.
    const Poly by_way = moved(moved(parts[1], x->variable, -x->rest), y->variable, -y->rest);
    const Poly without_x = by_way.at(x->variable, 0);
    if (!without_x.at(y->variable, 0).is_zero()) continue;
    const auto factor = [&](const Poly& p, const LinearIn& part) {
      const Poly over = p.exact_quotient(Poly::variable(p.ring(), part.variable));
      return moved(moved(over, x->variable, x->rest), y->variable, y->rest).scaled(1 / part.slope);
    };
    const Poly with_x = by_way - without_x;
    const Place steps = vector(length.along);
    const auto value = [&](const Poly& p) { return p.is_zero() ? builder_.constant(0) : value_by_ways(p, scale); };
    const int along = builder_.add(builder_.multiply(value(factor(with_x, *x)), steps[0]),
                                   builder_.multiply(value(factor(without_x, *y)), steps[1]));
    return builder_.add(value(parts[0]), builder_.multiply(along, variable(length.variable)));
  }
  return std::nullopt;
}

int StraightLines::value_by_ways(const Poly& natural, const Rational& scale) {
  if (const auto value = value_by_directions(natural, scale)) return *value;
  const std::vector<ArmedPoint>& points = armed_points();
  const auto written = [&](const std::vector<std::size_t>& arms) {
    Poly result = natural;
    for (std::size_t i = points.size(); i-- > 0;) {
      const Arm& arm = points[i].arms[arms[i]];
      for (std::size_t k = 0; k < 3; ++k) result = moved(result, points[i].variables[k], arm.end[k]);
    }
    return result;
  };
  std::vector<std::size_t> arms(points.size(), 0), others(points.size(), 1);
  Poly best = written(arms);
  if (Poly other = written(others); other.length() < best.length()) {
    best = std::move(other);
    arms = others;
  }
  for (bool improved = true; improved;) {
    improved = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      others = arms;
      others[i] = 1 - others[i];
      if (Poly other = written(others); other.length() < best.length()) {
        best = std::move(other);
        arms = others;
        improved = true;
      }
    }
  }
  if (const auto value = value_by_lengths(best.scaled(scale), arms)) return *value;
  if (best.length() >= natural.length()) return value(natural.scaled(scale).plain());
  return value_of_arms(best.scaled(scale), arms);
}

int StraightLines::value_of_arms(const Poly& p, const std::vector<std::size_t>& arms) {
  const std::vector<ArmedPoint>& points = armed_points();
  const Polynomial plain = p.plain();
  std::vector<int> variables(static_cast<std::size_t>(plain.variables), 0);
  for (int v = 0; v < plain.variables; ++v) {
    if (!core::depends_on(plain, v)) continue;
    int& this_variable = variables[static_cast<std::size_t>(v)];
    bool is_arm = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Place& step = points[i].arms[arms[i]].step;
      for (std::size_t k = 0; k < 3; ++k)
        if (v == points[i].variables[k]) this_variable = step[k], is_arm = true;
    }
    if (!is_arm) this_variable = variable(v);
  }
  return builder_.polynomial(plain, variables);
}

namespace {

/// p = squares (X^2 + Y^2) + along (w . (X, Y)) + across (w x (X, Y)) + rest, D = w . w.
struct ByLengths {
  Poly squares, along, across, rest;
  std::size_t length() const { return squares.length() + along.length() + across.length() + rest.length(); }
};

std::optional<ByLengths> by_lengths(const Poly& p, int x, int y, const Poly& wx, const Poly& wy) {
  if (p.degree({x, y}) > 2 || p.degree({x, y}) == 0) return std::nullopt;
  std::vector<std::vector<Poly>> c(3);
  const std::vector<Poly> in_x = p.coefficients(x);
  for (std::size_t i = 0; i < 3; ++i) {
    if (i < in_x.size()) c[i] = in_x[i].coefficients(y);
    while (c[i].size() < 3) c[i].emplace_back(p.ring());
  }
  if (!(c[2][0] == c[0][2]) || !c[1][1].is_zero()) return std::nullopt;
  const Poly d = wx * wx + wy * wy;
  ByLengths lengths{c[2][0], Poly(p.ring()), Poly(p.ring()), c[0][0]};
  if (d.is_zero() || !(c[1][0] * wx + c[0][1] * wy).divides(d, lengths.along) ||
      !(c[0][1] * wx - c[1][0] * wy).divides(d, lengths.across))
    return std::nullopt;
  return lengths;
}

}  // namespace

/// Of the way w from the end of an arm to the dyad's other end: |arm|^2 = own^2, 2 w . arm = own^2 - other^2 + D,
/// 2 w x arm = +-s.
std::optional<int> StraightLines::value_by_lengths(const Poly& p, const std::vector<std::size_t>& arms) {
  const std::vector<ArmedPoint>& points = armed_points();
  for (std::size_t i = points.size(); i-- > 0;) {
    const ArmedPoint& point = points[i];
    if (!point.lengths) continue;
    const bool from = arms[i] == 0;
    std::array<Poly, 2> w = {point.arms[from ? 1 : 0].end[0] - point.arms[from ? 0 : 1].end[0],
                             point.arms[from ? 1 : 0].end[1] - point.arms[from ? 0 : 1].end[1]};
    for (Poly& poly : w)
      for (std::size_t j = i; j-- > 0;)
        for (std::size_t k = 0; k < 3; ++k) poly = moved(poly, points[j].variables[k], points[j].arms[arms[j]].end[k]);
    const std::optional<ByLengths> parts = by_lengths(p, point.variables[0], point.variables[1], w[0], w[1]);
    if (!parts || parts->length() >= p.length()) continue;
    const auto of = [&](const Poly& part) {
      const std::optional<int> value = value_by_lengths(part, arms);
      return value ? *value : value_of_arms(part, arms);
    };
    const auto& [a2, along, across] = (*point.lengths)[from ? 0 : 1];
    int sum = of(parts->rest);
    for (const auto& [factor, length] :
         {std::pair(&parts->squares, a2), std::pair(&parts->along, along), std::pair(&parts->across, across)})
      if (!factor->is_zero()) sum = builder_.add(sum, builder_.multiply(of(*factor), length));
    return sum;
  }
  return std::nullopt;
}

const std::vector<StraightLines::ArmedPoint>& StraightLines::armed_points() {
  if (armed_points_) return *armed_points_;
  armed_points_.emplace();
  for (const ConstructedPoint& point : geometry_->constructed()) {
    const std::optional<Dyad> this_dyad = dyad(point.point);
    if (!this_dyad || this_dyad->axis.has_value() != (point.z >= 0)) continue;
    const auto root = std::find_if(geometry_->roots().begin(), geometry_->roots().end(),
                                   [&](const TowerRoot& r) { return r.point == point.point; });
    const auto& form =
        std::get<mechanism::DyadPoint>(geometry_->mechanism().points[static_cast<std::size_t>(point.point)].form);
    const std::array<Place, 2> steps = steps_to(*this_dyad, *root);
    const auto arm = [&](mechanism::PointIndex end, const Place& step) {
      const auto& natural = geometry_->natural(end);
      return Arm{{geometry_->poly(natural[0]), geometry_->poly(natural[1]), geometry_->poly(natural[2])}, step};
    };
    armed_points_->push_back({{point.x, point.y, point.z},
                              {arm(form.from, steps[0]), arm(form.to, steps[1])},
                              this_dyad->axis ? std::nullopt : std::optional(lengths_of(*this_dyad, *root))});
  }
  return *armed_points_;
}

std::array<std::array<int, 3>, 2> StraightLines::lengths_of(const Dyad& dyad, const TowerRoot& root) {
  const int this_root = root.value ? value(root.value->plain()) : known_.at(root.variable);
  const int half = builder_.constant(Rational(1, 2));
  const int across = builder_.multiply(half, builder_.multiply(this_root, builder_.inverse(dyad.scale)));
  const int product = builder_.multiply(dyad.sum, dyad.difference);
  const int a = builder_.multiply(half, builder_.add(dyad.sum, dyad.difference)),
            b = builder_.multiply(half, builder_.subtract(dyad.sum, dyad.difference));
  return {{{builder_.power(a, 2), builder_.multiply(half, builder_.add(dyad.distance2, product)), across},
           {builder_.power(b, 2), builder_.multiply(half, builder_.subtract(dyad.distance2, product)),
            builder_.subtract(builder_.constant(0), across)}}};
}

}  // namespace clearloci::symbolic
