#include "symbolic/fold_quotient.hpp"

#include <algorithm>

namespace clearloci::symbolic {
namespace {

Poly cross(const std::array<Poly, 2>& a, const std::array<Poly, 2>& b) { return a[0] * b[1] - a[1] * b[0]; }
Poly dot(const std::array<Poly, 2>& a, const std::array<Poly, 2>& b) { return a[0] * b[0] + a[1] * b[1]; }

Poly with(const Poly& p, int variable, const Poly& place) {
  const std::vector<Poly> powers = p.coefficients(variable);
  Poly sum(p.ring());
  for (auto power = powers.rbegin(); power != powers.rend(); ++power) sum = sum * place + *power;
  return sum;
}

}  // namespace

std::array<Poly, 2> FoldQuotients::way(mechanism::PointIndex from, mechanism::PointIndex to) const {
  const auto &a = geometry_->natural(from), &b = geometry_->natural(to);
  return {geometry_->poly((b[0] - a[0]).expand()), geometry_->poly((b[1] - a[1]).expand())};
}

std::optional<FoldQuotients::Loop> FoldQuotients::loop_with(const Fold& fold, mechanism::PointIndex other) const {
  const mechanism::PointIndex point = geometry_->roots()[fold.root].point;
  const auto& dyad =
      std::get<mechanism::DyadPoint>(geometry_->mechanism().points[static_cast<std::size_t>(point)].form);
  const auto& constructed = geometry_->constructed();
  const auto own =
      std::find_if(constructed.begin(), constructed.end(), [&](const auto& entry) { return entry.point == point; });
  if (other == point || other == dyad.from || other == dyad.to || own == constructed.end()) return std::nullopt;
  const std::array<Poly, 2> to_v = way(other, dyad.from), to_w = way(other, dyad.to), to_x = way(other, point);
  const std::array<Poly, 2> base = {to_w[0] - to_v[0], to_w[1] - to_v[1]};
  const auto holds_point = [&](const Poly& p) { return p.depends_on(own->x) || p.depends_on(own->y); };
  for (const auto* const ends : {&to_v, &to_w})
    if (holds_point((*ends)[0]) || holds_point((*ends)[1])) return std::nullopt;
  const auto vanishes = [&](const Poly& p) { return p.is_zero() || elimination_->vanishes_everywhere(p); };
  const auto& from = geometry_->natural(other);
  std::array<Poly, 2> place = {geometry_->poly(from[0]), geometry_->poly(from[1])};
  if (holds_point(place[0]) || holds_point(place[1])) return std::nullopt;
  core::Rational along = 0;
  if (vanishes(to_x[0] - to_v[0] - to_w[0]) && vanishes(to_x[1] - to_v[1] - to_w[1])) {
    for (std::size_t i = 0; i < 2; ++i) place[i] = place[i] + to_v[i] + to_w[i];
  } else if (vanishes(cross(to_x, base))) {
    const std::optional<core::Rational> constant = elimination_->constant_over_tower(dot(to_x, base));
    if (!constant) return std::nullopt;
    along = *constant;
    const Poly m = Poly::variable(geometry_->ring(), geometry_->auxiliary());
    for (std::size_t i = 0; i < 2; ++i) place[i] = place[i] + m * base[i];
  } else {
    return std::nullopt;
  }
  const Poly element = cross(to_v, to_w);
  Poly quotient(geometry_->ring());
  if (!elimination_->over_tower(element).divides(fold.where, quotient) || !quotient.is_constant()) return std::nullopt;
  return Loop{point, own->x, own->y, std::move(place), element.primitive(), along};
}

std::optional<FoldQuotients::Loop> FoldQuotients::found_loop(const Fold& fold) const {
  const TowerRoot& root = geometry_->roots()[fold.root];
  if (root.point < 0 || geometry_->mechanism().space != mechanism::Space::planar) return std::nullopt;
  const auto& points = geometry_->mechanism().points;
  const auto* const dyad = std::get_if<mechanism::DyadPoint>(&points[static_cast<std::size_t>(root.point)].form);
  if (dyad == nullptr || dyad->right_angle) return std::nullopt;
  for (std::size_t other = 0; other < points.size(); ++other)
    if (std::optional<Loop> loop = loop_with(fold, static_cast<mechanism::PointIndex>(other))) return loop;
  return std::nullopt;
}

const std::optional<FoldQuotients::Loop>& FoldQuotients::loop(std::size_t fold) {
  loops_.resize(geometry_->folds().size());
  if (!loops_[fold]) loops_[fold] = found_loop(geometry_->folds()[fold]);
  return *loops_[fold];
}

core::StraightLine FoldQuotients::of(const Poly& natural, const PolyFactor& element) {
  const std::vector<Fold>& folds = geometry_->folds();
  for (std::size_t i = 0; i < folds.size(); ++i) {
    if (!(folds[i].where.primitive() == element.poly.primitive())) continue;
    const std::optional<Loop>& known = loop(i);
    if (!known) continue;
    Poly rest = with(with(natural, known->y, known->place[1]), known->x, known->place[0]);
    Poly quotient(rest.ring());
    int times = 0;
    for (; times < element.multiplicity && rest.divides(known->element, quotient); ++times) std::swap(rest, quotient);
    if (times == element.multiplicity) return lines_->of(rest, known->point, known->along);
  }
  return {};
}

}  // namespace clearloci::symbolic
