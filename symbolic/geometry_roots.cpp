// The roots of the tower: their units, and what becomes of those that depend on earlier ones (method.md section 10).
#include <algorithm>
#include <cmath>
#include <span>

#include "symbolic/dependent_roots.hpp"
#include "symbolic/geometry.hpp"

namespace clearloci::symbolic {

using core::Rational;
using core::RootRole;

int Geometry::next_root() const { return first_root_ + static_cast<int>(roots_.size()); }

int Geometry::side_of(std::size_t root, const std::vector<int>& sides) const {
  if (roots_[root].role != RootRole::working_mode) return 1;
  const auto before = std::count_if(roots_.begin(), roots_.begin() + static_cast<std::ptrdiff_t>(root),
                                    [](const TowerRoot& r) { return r.role == RootRole::working_mode; });
  return sides[static_cast<std::size_t>(before)];
}

Poly Geometry::add_root(TowerRoot root) {
  const Poly s = Poly::variable(*ring_, root.variable);
  Poly over_tower = s;
  if (std::optional<Poly> dependent = keep_parameters_ || sheet_.all_sheets ? std::nullopt : depend(root)) {
    over_tower = *dependent;
    root.value = std::move(dependent);
  } else {
    if (!keep_parameters_ && !sheet_.all_sheets) cut_where_modes_meet(root);
    give_unit(root);
  }
  Poly times_divisor = reduce(over_tower * root.scale_divisor);
  roots_.push_back(std::move(root));
  const TowerRoot& tower_root = roots_.back();
  const int side = side_of(roots_.size() - 1, sheet_.sides);
  if (samples_.empty()) return times_divisor;
  const core::Polynomial own_square = tower_root.square.plain();
  for (Sample& sample : samples_) {
    const double value = core::evaluate(own_square, std::span<const double>(sample.at));
    sample.is_reached = sample.is_reached && value >= 0;
    sample.at[static_cast<std::size_t>(tower_root.variable)] = side * std::sqrt(std::abs(value));
  }
  return times_divisor;
}

void Geometry::give_unit(TowerRoot& root) const {
  constexpr int far = 8;  // powers of two
  if (keep_parameters_) return;
  const core::Polynomial scale = root.scale.plain(), divisor = root.scale_divisor.plain();
  std::vector<double> sizes;
  // Where the box has few poses no sample is one of them.
  for (const bool is_reached : {true, false})
    for (const Sample& sample : samples_) {
      if (sample.is_reached != is_reached || (!is_reached && !sizes.empty())) continue;
      const std::span<const double> at(sample.at);
      if (const double size = core::evaluate(scale, at) / core::evaluate(divisor, at); std::isfinite(size) && size > 0)
        sizes.push_back(size);
    }
  if (sizes.empty()) return;
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
  const int exponent = std::ilogb(sizes[sizes.size() / 2]);
  if (std::abs(exponent) <= far) return;
  Rational unit = 1;
  if (exponent > 0)
    unit >>= static_cast<unsigned>(exponent);
  else
    unit <<= static_cast<unsigned>(-exponent);
  root.square = root.square.scaled(unit * unit);
  root.scale_divisor = root.scale_divisor.scaled(1 / unit);
}

std::optional<Poly> Geometry::depend(TowerRoot& root) {
  // Replaced roots occur in nothing; a number's root is an element like others.
  std::vector<TowerRoot> before;
  for (const TowerRoot& earlier : roots_)
    if (!earlier.value || earlier.square.constant() != 1) before.push_back(earlier);
  const SquareTest test = square_class(root.square, coordinates(), before);
  if (test.open && root.point < 0)
    throw core::InputError({mechanism_->file},
                           "the length of a spring, or of an arm of a limit, may depend on the roots that place the "
                           "points in a way that is not resolved",
                           "move one of its ends by a little");
  if (test.open)
    throw core::InputError(mechanism_->points[index(root.point)].where,
                           "the root that places " + mechanism_->points[index(root.point)].name +
                               " may depend on those of the points before it in a way that is not resolved",
                           "change a length of its links by a little, or place it by its coordinates");
  if (!test.found) return std::nullopt;
  const auto& [number, element] = *test.found;
  if (number != 1 && element.is_constant()) return std::nullopt;  // the root of a number: an element like others
  // s = +-|e| sqrt(c):  the sign of the side times that of e on this sheet times e, and sqrt(c) for what s stood for.
  std::vector<std::size_t> odd_roots;
  const std::size_t roots = roots_.size();
  int sign = sign_on_sheet(element, roots, odd_roots);
  for (const std::size_t earlier : odd_roots) sign *= side_of(earlier, sheet_.sides);
  Poly value = element;
  if (number == 1) {
    // The side is a factor of its own: there is no root left to carry it.
    roots_.push_back(root);
    sign *= side_of(roots, sheet_.sides);
    roots_.pop_back();
    odd_roots.push_back(roots);
  } else {
    value = reduce(value * Poly::variable(*ring_, root.variable));
  }
  sign_choices_.push_back(std::move(odd_roots));
  root.square = Poly(*ring_, number);
  return value.scaled(sign);
}

void Geometry::cut_where_modes_meet(TowerRoot& root) {
  // Over one coordinate these are single points, which are told exactly as they are.
  if (coordinates() < 2 || root.role != core::RootRole::working_mode) return;
  if (root.square.is_constant() || has_root(root.square)) return;
  Rational constant;
  for (const PolyFactor& factor : root.square.factors(constant)) {
    const auto times = static_cast<unsigned>(factor.multiplicity / 2);
    if (times == 0) continue;
    const auto sign_by_folds = [&] {
      for (const Fold& fold : folds_)
        if (fold.where == factor.poly || fold.where == -factor.poly) return fold.where == factor.poly ? 1 : -1;
      return 0;
    };
    int sign = sign_by_folds();
    if (sign == 0) {
      const std::size_t folds = folds_.size();
      std::vector<std::size_t> odd_roots;
      sign = sign_on_sheet(factor.poly, roots_.size(), odd_roots);
      if (folds_.size() == folds) continue;
    }
    const Poly positive = factor.poly.scaled(sign);
    add_positive(positive);
    root.square = root.square.exact_quotient(positive.pow(2 * times));
    root.scale_divisor *= positive.pow(times);
    root.is_cut = true;
  }
}

int Geometry::sign_on_sheet(Poly element, std::size_t root, std::vector<std::size_t>& odd_roots) {
  // Roots themselves have the signs of the mode.
  for (std::size_t j = 0; j < roots_.size(); ++j) {
    const Poly s = Poly::variable(*ring_, roots_[j].variable);
    Poly rest(*ring_);
    bool odd = false;
    while (element.depends_on(roots_[j].variable) && element.divides(s, rest)) {
      std::swap(element, rest);
      odd = !odd;
    }
    if (odd) odd_roots.push_back(j);
  }
  std::vector<Rational> lower, upper;
  for (std::size_t i = 0; i < charts_.size(); ++i) {
    lower.push_back(charts_[i] ? Rational(-1) : mechanism_->coordinates[i].lower);
    upper.push_back(charts_[i] ? Rational(1) : mechanism_->coordinates[i].upper);
  }
  std::vector<int> free;
  for (int i = 0; i < coordinates(); ++i) free.push_back(i);
  Rational constant;
  Poly open(*ring_, 1);
  int sign = 1;
  for (const PolyFactor& factor : element.factors(constant)) {
    if (factor.multiplicity % 2 == 0) continue;
    const auto is = [&](const Poly& p) { return factor.poly == p; };
    int factor_sign = 0;
    if (std::any_of(positive_.begin(), positive_.end(), is)) factor_sign = 1;
    if (std::any_of(positive_.begin(), positive_.end(), [&](const Poly& p) { return is(-p); })) factor_sign = -1;
    if (factor_sign == 0 && !has_root(factor.poly)) factor_sign = sign_over_box(factor.poly.plain(free), lower, upper);
    if (factor_sign == 0)
      open *= factor.poly;
    else
      sign *= factor_sign;
  }
  if (constant < 0) sign = -sign;
  if (open.is_constant()) return sign;
  const int half = folds_.size() < sheet_.halves.size() ? sheet_.halves[folds_.size()] : 1;
  folds_.push_back({root, open.scaled(half)});
  return sign * half;
}

bool Geometry::same_for(const std::vector<int>& sides) const {
  return std::all_of(sign_choices_.begin(), sign_choices_.end(), [&](const std::vector<std::size_t>& signs) {
    int same = 1;
    for (const std::size_t root : signs) same *= side_of(root, sides) * side_of(root, sheet_.sides);
    return same == 1;
  });
}

}  // namespace clearloci::symbolic
