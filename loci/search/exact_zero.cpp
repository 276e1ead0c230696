#include "loci/search/exact_zero.hpp"

#include <algorithm>
#include <optional>

#include "core/rational.hpp"

namespace clearloci::loci::sheet {

namespace {

using core::Rational;

/// Where an enclosure is a point its own rounding counts.
Rational shortest_in(const Interval& range) {
  constexpr double rounding = 0x1p-50;
  const double reach = std::max(range.width(), rounding * range.magnitude());
  return core::simplest_rational_near(Rational(range.middle()), Rational(reach));
}

}  // namespace

bool vanish_exactly(const core::RootTower& tower, const core::WorkingMode& mode,
                    const std::vector<core::Polynomial>& functions, const PlaneCell& place) {
  std::vector<Rational> point(static_cast<std::size_t>(tower.variables()));
  point[0] = shortest_in(place.x);
  point[1] = shortest_in(place.y);
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    if (tower.roots[j].is_angle()) return false;
    const std::optional<Rational> root = core::square_root(core::evaluate(tower.roots[j].square, point));
    if (!root || *root == 0) return false;
    point[2 + j] = mode[j] > 0 ? *root : Rational(-*root);
  }
  const auto vanishes = [&](const core::Polynomial& p) { return core::evaluate(p, point) == 0; };
  return std::none_of(tower.denominators.begin(), tower.denominators.end(), vanishes) &&
         std::all_of(functions.begin(), functions.end(), vanishes);
}

}  // namespace clearloci::loci::sheet
