#include "loci/search/exact_zero.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "core/rational.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::sheet {

namespace {

using core::Rational;

/// Where an enclosure is a point its own rounding counts.
Rational reach_of(const Interval& range) {
  constexpr double rounding = 0x1p-50;
  return std::max(range.width(), rounding * range.magnitude());
}

Rational shortest_in(const Interval& range) {
  return core::simplest_rational_near(Rational(range.middle()), reach_of(range));
}

/// The base of a dyad or leg next to the place, which may have many digits; else the shortest point in it.
std::array<Rational, 2> point_in(const core::RootTower& tower, const PlaneCell& place) {
  const auto is_in = [](const Rational& at, const Interval& range) {
    return abs(at - Rational(range.middle())) <= reach_of(range);
  };
  for (const core::Polynomial& denominator : tower.denominators)
    if (const auto base = double_point(denominator))
      if (is_in((*base)[0], place.x) && is_in((*base)[1], place.y)) return *base;
  return {shortest_in(place.x), shortest_in(place.y)};
}

/// What a function is at a point, by powers of the roots that are angles: those are no roots of rational numbers.
std::map<std::vector<int>, Surd> by_angles(const core::RootTower& tower, const core::Polynomial& p,
                                           const std::vector<Surd>& point) {
  std::map<std::vector<int>, Surd> sums;
  for (const core::Term& term : p.terms) {
    std::vector<int> of_angles;
    Surd value(term.coefficient);
    for (std::size_t v = 0; v < term.exponents.size(); ++v) {
      if (v >= 2 && tower.roots[v - 2].is_angle())
        of_angles.push_back(term.exponents[v]);
      else
        for (int k = 0; k < term.exponents[v]; ++k) value = value * point[v];
    }
    Surd& sum = sums[of_angles];
    sum = sum + value;
  }
  return sums;
}

bool depends_on_angles(const core::RootTower& tower, const core::Polynomial& p) {
  for (std::size_t j = 0; j < tower.roots.size(); ++j)
    if (tower.roots[j].is_angle() && core::depends_on(p, 2 + static_cast<int>(j))) return true;
  return false;
}

}  // namespace

bool vanish_exactly(const core::RootTower& tower, const core::WorkingMode& mode,
                    const std::vector<core::Polynomial>& functions, const PlaneCell& place) {
  std::vector<Surd> point(static_cast<std::size_t>(tower.variables()));
  const std::array<Rational, 2> at = point_in(tower, place);
  point[0] = at[0];
  point[1] = at[1];
  const auto is_zero = [](const auto& sum) { return sum.second.is_zero(); };
  // Whatever the angles are.
  const auto vanishes = [&](const core::Polynomial& p) {
    const auto sums = by_angles(tower, p, point);
    return std::all_of(sums.begin(), sums.end(), is_zero);
  };
  bool is_on_boundary = false;
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    if (depends_on_angles(tower, tower.roots[j].square)) return false;
    if (tower.roots[j].is_angle()) {
      if (vanishes(tower.roots[j].square)) return false;  // it is undefined
      continue;
    }
    const auto squares = by_angles(tower, tower.roots[j].square, point);
    const std::optional<Rational> square = squares.empty() ? Rational(0) : squares.begin()->second.rational();
    if (!square || *square < 0) return false;
    is_on_boundary = is_on_boundary || *square == 0;
    const Surd root = Surd::root_of(*square);
    point[2 + j] = mode[j] > 0 ? root : Surd() - root;
  }
  // Where the ends of a dyad meet its root vanishes with the denominator. A leg without length alone leaves all roots
  // as they are.
  const auto may_vanish = [&](const core::Polynomial& denominator) {
    return depends_on_angles(tower, denominator) || vanishes(denominator);
  };
  if (is_on_boundary && std::any_of(tower.denominators.begin(), tower.denominators.end(), may_vanish)) return false;
  return std::all_of(functions.begin(), functions.end(), vanishes);
}

}  // namespace clearloci::loci::sheet
