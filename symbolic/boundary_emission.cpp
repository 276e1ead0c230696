#include "symbolic/factor_emission.hpp"

#include <algorithm>
#include <iterator>

#include "core/fold.hpp"
#include "mechanism/actions.hpp"
#include "symbolic/effort_limits.hpp"

namespace clearloci::symbolic {

using core::FactorRole;
using core::LocusFactor;

LocusFactor FactorEmission::stretched(const TowerRoot& root) const {
  LocusFactor factor;
  const auto& form = d_.mechanism.points[static_cast<std::size_t>(root.point)].form;
  if (const auto* dyad = std::get_if<mechanism::DyadPoint>(&form)) {
    factor.expression = d_.words.of(d_.causes.stretched(root.point, *dyad));
    factor.cause = d_.causes.stretched_wording(root.point, *dyad);
  } else {
    const auto& slider = std::get<mechanism::SliderPoint>(form);
    const Poly across = d_.causes.perpendicular(slider.from, root.point, slider.along);
    factor.expression = d_.words.of(across);
    factor.cause = "line " + d_.point_name(slider.from) + "-" + d_.point_name(root.point) +
                   " perpendicular to the path of " + d_.point_name(root.point);
  }
  return factor;
}

bool FactorEmission::is_divided_in_vain(const core::Polynomial& square, const core::StraightLine& line) const {
  const bool has_roots = std::any_of(square.terms.begin(), square.terms.end(), [&](const core::Term& term) {
    return std::any_of(term.exponents.begin() + d_.geometry.coordinates(), term.exponents.end(),
                       [](int exponent) { return exponent != 0; });
  });
  return !has_roots && std::any_of(line.steps.begin(), line.steps.end(), [](const core::StraightLine::Step& step) {
    return step.operation == core::StraightLine::Operation::inverse;
  });
}

void FactorEmission::add_flip(const TowerRoot& root, const Fold& fold, LocusFactor factor) {
  factor.role = FactorRole::workspace_boundary;
  if (root.point >= 0)
    if (const auto* offset =
            std::get_if<mechanism::OffsetPoint>(&d_.mechanism.points[static_cast<std::size_t>(root.point)].form))
      factor.cause = d_.point_name(offset->second) + " on " + d_.point_name(offset->first) + ", where " +
                     d_.point_name(root.point) + " has no place";
  core::Rational constant;
  for (const PolyFactor& part : fold.where.factors(constant)) {
    LocusFactor locus_factor = factor;
    locus_factor.sheet = core::scaled_for_doubles(part.poly.plain(d_.geometry.tower_variables()));
    put_implicit({part.poly, 1, d_.elimination.implicit_of_divisor(part.poly)}, locus_factor);
    d_.result.problem.factors.push_back(std::move(locus_factor));
  }
}

std::optional<LocusFactor> FactorEmission::ends_meet(const TowerRoot& root, const Fold& fold) const {
  if (!root.is_cut || root.point < 0) return std::nullopt;
  const auto* dyad = std::get_if<mechanism::DyadPoint>(&d_.mechanism.points[static_cast<std::size_t>(root.point)].form);
  if (dyad == nullptr) return std::nullopt;
  const TowerPoint &a = d_.geometry.tower(dyad->from), &b = d_.geometry.tower(dyad->to);
  Poly rest(d_.geometry.ring());
  for (const auto& [from, to] : {std::pair(&a.x, &b.x), std::pair(&a.y, &b.y), std::pair(&a.z, &b.z)})
    if (!(*to * a.w - *from * b.w).divides(fold.where, rest)) return std::nullopt;
  LocusFactor factor;
  // The same words on both sides and in every chart.
  const auto &from = d_.geometry.natural(dyad->from), &to = d_.geometry.natural(dyad->to);
  GiNaC::ex squared = 0;
  for (std::size_t i = 0; i < from.size(); ++i) squared += (to[i] - from[i]) * (to[i] - from[i]);
  factor.expression = d_.words.of(d_.geometry.poly(squared.expand()).primitive());
  factor.cause = d_.point_name(dyad->to) + " on " + d_.point_name(dyad->from) + ", where " + d_.point_name(root.point) +
                 " has no place";
  return factor;
}

void FactorEmission::add_fold(const Fold& fold) {
  const TowerRoot& root = d_.geometry.roots()[fold.root];
  std::optional<LocusFactor> meeting = ends_meet(root, fold);
  LocusFactor factor = meeting                                     ? std::move(*meeting)
                       : root.role == core::RootRole::working_mode ? stretched(root)
                                                                   : LocusFactor{};
  if (factor.expression.empty()) factor.expression = d_.words.of(fold.where);
  if (d_.elimination.sheet_factors(fold.where, true).empty())
    add_flip(root, fold, factor);
  else
    add(FactorRole::workspace_boundary, nullptr, fold.where, true, factor);
  more_roots_.push_back({core::fold_name, "", core::RootRole::length,
                         core::scaled_for_doubles(fold.where.plain(d_.geometry.tower_variables()))});
}

void FactorEmission::add_limits() {
  for (const LimitCondition& limit : bounding_limits(d_.geometry, d_.elimination)) add_limit(limit);
  if (!d_.preload.joints.empty()) return;  // what gears bear depends on the efforts
  for (const LimitCondition& limit : effort_limits(d_.geometry, d_.reactions, d_.determinants.determinant))
    if (!d_.elimination.vanishes_everywhere(limit.natural)) add_limit(limit);
}

void FactorEmission::add_limit(const LimitCondition& limit) {
  const Poly sheet = d_.elimination.over_tower(limit.natural);
  LocusFactor factor;
  factor.expression = d_.words.of(limit.natural);
  factor.cause = std::string(mechanism::limit_cause) + limit.words;
  if (!limit.natural.is_constant()) add(FactorRole::workspace_boundary, &limit.natural, sheet, true, factor);
  more_roots_.push_back({core::limit_name, "", core::RootRole::length,
                         core::scaled_for_doubles(sheet.plain(d_.geometry.tower_variables()))});
  core::StraightLine line = d_.lines.of(limit.natural);
  if (!is_divided_in_vain(more_roots_.back().square, line)) more_roots_.back().line = std::move(line);
  more_roots_.back().bounds = limit.bounds;
  if (!limit.bounds.empty()) more_roots_.back().rims = sides_of_cut(limit.bounds);
}

std::vector<core::Rim> FactorEmission::sides_of_cut(const std::string& spring) const {
  if (d_.geometry.coordinates() != 2) return {};
  const std::vector<TorsionAngle>& angles = d_.geometry.torsion_angles();
  const auto angle = std::find_if(angles.begin(), angles.end(), [&](const TorsionAngle& torsion_angle) {
    return !torsion_angle.tangent && torsion_angle.root >= 0 && d_.geometry.name_of(torsion_angle) == spring;
  });
  if (angle == angles.end()) return {};
  const std::vector<Poly>& way = d_.geometry.roots()[static_cast<std::size_t>(angle->root)].cosine_and_sine;
  const core::Rational cosine = mechanism::least_torsion_cosine(), sine = mechanism::torsion_sine_at_end();
  std::vector<core::Rim> sides;
  for (const core::Rational& end : {sine, core::Rational(-sine)}) {
    const Poly off_end = way[1].scaled(cosine) - way[0].scaled(end);
    if (off_end.is_constant()) return {};
    sides.push_back({core::scaled_for_doubles(off_end.plain(d_.geometry.tower_variables())), {}});
  }
  return sides;
}

bool FactorEmission::add_rims(std::size_t index) {
  const TowerRoot& root = d_.geometry.roots()[index];
  if (d_.geometry.coordinates() != 2) return false;
  const auto dyad_way = std::find_if(d_.geometry.dyad_ways().begin(), d_.geometry.dyad_ways().end(),
                                     [&](const Geometry::Way& way) { return way.point == root.point; });
  if (dyad_way == d_.geometry.dyad_ways().end() || !d_.elimination.is_too_heavy(root.square)) return false;
  const auto lines = d_.lines.rims(root.point);
  if (!lines) return false;
  const auto& dyad = std::get<mechanism::DyadPoint>(d_.mechanism.points[static_cast<std::size_t>(root.point)].form);
  const auto squared = [](const Poly& length) { return length * length; };
  // Rims are of a length itself, of which the square alone may be rational.
  if (dyad.right_angle) return false;
  const Poly a = d_.geometry.poly(d_.geometry.expression(dyad.from_length).expand());
  const Poly b = d_.geometry.poly(d_.geometry.expression(dyad.to_length).expand());
  if (!(d_.geometry.squared_length(dyad.from_length) == squared(a)) ||
      !(d_.geometry.squared_length(dyad.to_length) == squared(b)))
    return false;
  const std::array<Poly, 2> rims = {d_.geometry.reduce(squared(a + b) * dyad_way->w2 - dyad_way->d),
                                    d_.geometry.reduce(dyad_way->d - squared(a - b) * dyad_way->w2)};
  for (std::size_t k = 0; k < rims.size(); ++k) {
    const std::size_t first = d_.result.problem.factors.size();
    add(FactorRole::workspace_boundary, nullptr, rims[k], true, stretched(root));
    const bool alone = d_.result.problem.factors.size() == first + 1;
    for (std::size_t f = first; f < d_.result.problem.factors.size(); ++f) {
      LocusFactor& factor = d_.result.problem.factors[f];
      if (alone) factor.line = (*lines)[k];
      d_.result.problem.tower.roots[index].rims.push_back({factor.sheet, factor.line});
    }
  }
  return true;
}

void FactorEmission::join_boundaries(std::size_t first) {
  std::vector<LocusFactor>& factors = d_.result.problem.factors;
  std::vector<LocusFactor> different;
  for (std::size_t f = first; f < factors.size(); ++f) {
    const auto known = std::find_if(different.begin(), different.end(),
                                    [&](const LocusFactor& other) { return other.sheet == factors[f].sheet; });
    if (known == different.end())
      different.push_back(std::move(factors[f]));
    else if (known->cause.empty())
      known->cause = factors[f].cause;
    else if (!factors[f].cause.empty() &&
             ("; " + known->cause + "; ").find("; " + factors[f].cause + "; ") == std::string::npos)
      known->cause += "; " + factors[f].cause;
  }
  factors.erase(factors.begin() + static_cast<std::ptrdiff_t>(first), factors.end());
  std::move(different.begin(), different.end(), std::back_inserter(factors));
}

void FactorEmission::boundaries() {
  const std::size_t first = d_.result.problem.factors.size();
  for (std::size_t i = 0; i < d_.geometry.roots().size(); ++i) {
    const TowerRoot& root = d_.geometry.roots()[i];
    if (root.role != core::RootRole::working_mode || root.value || add_rims(i)) continue;
    LocusFactor factor = stretched(root);
    factor.role = FactorRole::workspace_boundary;
    add_parts(nullptr, d_.elimination.boundary_factors(root.square), factor);
  }
  for (const Fold& fold : d_.geometry.folds()) add_fold(fold);
  add_limits();
  join_boundaries(first);
  const std::vector<int> variables = d_.geometry.tower_variables();
  const std::vector<int> free(variables.begin(), variables.begin() + d_.geometry.coordinates());
  for (const Poly& denominator : d_.elimination.denominator_factors()) {
    LocusFactor factor;
    factor.role = FactorRole::construction;
    factor.sheet = core::scaled_for_doubles(denominator.plain(variables));
    factor.implicit = {denominator.plain(free)};
    d_.result.problem.factors.push_back(std::move(factor));
  }
}

}  // namespace clearloci::symbolic
