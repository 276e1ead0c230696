#include "symbolic/fold_quotient.hpp"

#include <algorithm>

namespace clearloci::symbolic {
namespace {

Poly with(const Poly& p, int variable, const Poly& place) {
  const std::vector<Poly> powers = p.coefficients(variable);
  Poly sum(p.ring());
  for (auto power = powers.rbegin(); power != powers.rend(); ++power) sum = sum * place + *power;
  return sum;
}

}  // namespace

core::StraightLine FoldQuotients::of(const Poly& natural, const PolyFactor& sheet) {
  const std::vector<Fold>& folds = geometry_->folds();
  for (std::size_t i = 0; i < folds.size(); ++i) {
    if (!(folds[i].where.primitive() == sheet.poly.primitive()) || !elimination_->fold_element(i)) continue;
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
    for (; times < sheet.multiplicity && rest.divides(*elimination_->fold_element(i), quotient); ++times)
      std::swap(rest, quotient);
    if (times == sheet.multiplicity) return lines_->of(rest, point, closing.along);
  }
  return {};
}

}  // namespace clearloci::symbolic
