#include "symbolic/limits.hpp"

#include "mechanism/actions.hpp"

namespace clearloci::symbolic {
namespace {

using core::Expression;

std::vector<Poly> components(const Geometry& geometry, mechanism::PointIndex from, mechanism::PointIndex to) {
  std::vector<Poly> list;
  for (const GiNaC::ex& component : geometry.vector(mechanism::way(from, to))) list.push_back(geometry.poly(component));
  return list;
}

Poly dot(const std::vector<Poly>& a, const std::vector<Poly>& b) {
  Poly sum(a.front().ring());
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

std::vector<LimitCondition> limit_conditions(const Geometry& geometry) {
  const mechanism::Mechanism& m = geometry.mechanism();
  std::vector<LimitCondition> all;
  for (std::size_t i = 0; i < m.limits.size(); ++i) {
    const mechanism::Limit& limit = m.limits[i];
    const auto number = [&](const Expression& e) { return geometry.poly(geometry.expression(e).expand()); };
    const auto inverse = [&](bool second) {
      return geometry.poly(geometry.inverse_length(Geometry::arm_name(i, second)).natural);
    };
    const auto& p = limit.points;
    if (limit.is_angle()) {
      const Poly cosine =
          dot(components(geometry, p[1], p[0]), components(geometry, p[1], p[2])) * inverse(false) * inverse(true);
      const auto cos = [&](const Expression& angle) {
        return number(Expression::apply(Expression::Kind::cos, {angle}));
      };
      if (limit.keeps_lower())
        all.push_back({cos(limit.lower) - cosine, mechanism::words_of(m, limit, false), limit.where});
      if (limit.keeps_upper())
        all.push_back({cosine - cos(limit.upper), mechanism::words_of(m, limit, true), limit.where});
      continue;
    }
    const std::vector<Poly> way = components(geometry, p[0], p[1]);
    const Poly square = dot(way, way), lower = number(limit.lower), upper = number(limit.upper);
    if (limit.keeps_lower()) all.push_back({square - lower * lower, mechanism::words_of(m, limit, false), limit.where});
    all.push_back({upper * upper - square, mechanism::words_of(m, limit, true), limit.where});
  }
  for (const TorsionAngle& angle : geometry.torsion_angles()) {
    if (angle.tangent) continue;  // it is cut nowhere
    const mechanism::Spring& spring = m.springs[angle.spring];
    Poly cosine = geometry.poly(angle.way[0]);
    for (const bool second : {false, true})
      cosine *= geometry.poly(geometry.inverse_length(Geometry::arm_name(spring, second)).natural);
    const Poly least(geometry.ring(), mechanism::least_torsion_cosine());
    all.push_back({cosine - least, mechanism::words_of_reach(spring), spring.where, spring.name});
  }
  return all;
}

}  // namespace clearloci::symbolic
