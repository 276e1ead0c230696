#include "symbolic/limits.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/idle_limits.hpp"
#include "symbolic/sheets.hpp"

namespace clearloci::symbolic {
namespace {

using core::Expression;
using core::Rational;

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
    if (limit.is_angle() && (inverse(false).is_zero() || inverse(true).is_zero())) {  // there is no such angle
      for (const bool upper : {false, true})
        if (upper ? limit.keeps_upper() : limit.keeps_lower())
          all.push_back({Poly(geometry.ring(), -1), mechanism::words_of(m, limit, upper), limit.where, {}, i});
      continue;
    }
    if (limit.is_angle()) {
      const Poly cosine =
          dot(components(geometry, p[1], p[0]), components(geometry, p[1], p[2])) * inverse(false) * inverse(true);
      const auto cos = [&](const Expression& angle) {
        return number(Expression::apply(Expression::Kind::cos, {angle}));
      };
      if (limit.keeps_lower())
        all.push_back({cos(limit.lower) - cosine, mechanism::words_of(m, limit, false), limit.where, {}, i});
      if (limit.keeps_upper())
        all.push_back({cosine - cos(limit.upper), mechanism::words_of(m, limit, true), limit.where, {}, i});
      continue;
    }
    const std::vector<Poly> way = components(geometry, p[0], p[1]);
    const Poly square = dot(way, way), lower = number(limit.lower), upper = number(limit.upper);
    if (limit.keeps_lower())
      all.push_back({square - lower * lower, mechanism::words_of(m, limit, false), limit.where, {}, i});
    if (limit.keeps_upper())
      all.push_back({upper * upper - square, mechanism::words_of(m, limit, true), limit.where, {}, i});
  }
  for (const mechanism::JointIndex j : mechanism::bounded_laws(m)) {
    const mechanism::Joint& joint = m.joints[static_cast<std::size_t>(j)];
    const auto& [least, most] = *joint.law_within;
    const Poly effort = geometry.poly(geometry.expression(*joint.effort).expand());
    const auto add = [&](const Poly& left, const Rational& bound) {
      all.push_back({left, mechanism::words_of_law(m, joint, bound), joint.where, {}, m.limits.size()});
    };
    add(effort - Poly(geometry.ring(), least), least);
    add(Poly(geometry.ring(), most) - effort, most);
  }
  for (const TorsionAngle& angle : geometry.torsion_angles()) {
    if (angle.tangent) continue;  // it is cut nowhere
    const mechanism::Spring& spring = m.springs[angle.spring];
    Poly cosine = geometry.poly(angle.way[0]);
    for (const bool second : {false, true})
      cosine *= geometry.poly(geometry.inverse_length(Geometry::arm_name(spring, second)).natural);
    const Poly least(geometry.ring(), mechanism::least_torsion_cosine());
    all.push_back({cosine - least, mechanism::words_of_reach(spring), spring.where, spring.name, m.limits.size()});
  }
  return all;
}

namespace {

/// Whether what is left to a limit is 0 or more, and the same number, on every sheet of the file's working mode.
bool is_idle_on_sheets(const mechanism::Mechanism& mechanism, const Charts& charts, std::size_t condition) {
  const std::vector<SheetGeometry> sheets = sheet_geometries(mechanism, charts, {mechanism::working_mode(mechanism)});
  return std::all_of(sheets.begin(), sheets.end(), [&](const SheetGeometry& sheet) {
    const auto left =
        Elimination(sheet.geometry).constant_over_tower(limit_conditions(sheet.geometry).at(condition).natural);
    return left && *left >= 0;
  });
}

}  // namespace

std::vector<LimitCondition> bounding_limits(const Geometry& geometry, const Elimination& elimination) {
  const mechanism::Mechanism& m = geometry.mechanism();
  std::vector<LimitCondition> all = limit_conditions(geometry), bounding;
  if (all.empty()) return all;
  const std::vector<bool> idle = mechanism::idle_limits(m);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (const auto left = elimination.constant_over_tower(all[i].natural)) {
      if (*left >= 0) continue;
      all[i].natural = Poly(geometry.ring(), -1);  // no pose is reached here; of folds there may be on the other sides
      bounding.push_back(std::move(all[i]));
      continue;
    }
    if (all[i].limit < idle.size() && idle[all[i].limit] && !geometry.has_dependent_roots() &&
        is_idle_on_sheets(m, geometry.charts(), i))
      continue;
    bounding.push_back(std::move(all[i]));
  }
  return bounding;
}

}  // namespace clearloci::symbolic
