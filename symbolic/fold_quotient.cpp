#include "symbolic/fold_quotient.hpp"

#include <algorithm>

namespace clearloci::symbolic {
namespace {

Poly cross(const std::array<Poly, 2>& a, const std::array<Poly, 2>& b) { return a[0] * b[1] - a[1] * b[0]; }

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

std::optional<Poly> FoldQuotients::found_element(const Fold& fold) const {
  const mechanism::PointIndex point = geometry_->roots()[fold.root].point;
  const auto closing = geometry_->closings().find(point);
  if (closing == geometry_->closings().end()) return std::nullopt;
  const auto& dyad =
      std::get<mechanism::DyadPoint>(geometry_->mechanism().points[static_cast<std::size_t>(point)].form);
  const mechanism::PointIndex fourth = closing->second.fourth;
  const Poly element = cross(way(fourth, dyad.from), way(fourth, dyad.to));
  Poly quotient(geometry_->ring());
  if (!elimination_->over_tower(element).divides(fold.where, quotient) || !quotient.is_constant()) return std::nullopt;
  return element.primitive();
}

const std::optional<Poly>& FoldQuotients::element(std::size_t fold) {
  elements_.resize(geometry_->folds().size());
  if (!elements_[fold]) elements_[fold] = found_element(geometry_->folds()[fold]);
  return *elements_[fold];
}

core::StraightLine FoldQuotients::of(const Poly& natural, const PolyFactor& sheet) {
  const std::vector<Fold>& folds = geometry_->folds();
  for (std::size_t i = 0; i < folds.size(); ++i) {
    if (!(folds[i].where.primitive() == sheet.poly.primitive()) || !element(i)) continue;
    const mechanism::PointIndex point = geometry_->roots()[folds[i].root].point;
    const Geometry::Closing& closing = geometry_->closings().at(point);
    const auto& constructed = geometry_->constructed();
    const auto own =
        std::find_if(constructed.begin(), constructed.end(), [&](const auto& entry) { return entry.point == point; });
    const Substitution put_in{own->x, own->y, closing.place};
    Poly rest = with(geometry_->substituted(natural, put_in, Geometry::degree_in(natural, put_in)), own->x,
                     Poly::variable(natural.ring(), geometry_->auxiliary()));
    Poly quotient(rest.ring());
    int times = 0;
    for (; times < sheet.multiplicity && rest.divides(*element(i), quotient); ++times) std::swap(rest, quotient);
    if (times == sheet.multiplicity) return lines_->of(rest, point, closing.along);
  }
  return {};
}

}  // namespace clearloci::symbolic
