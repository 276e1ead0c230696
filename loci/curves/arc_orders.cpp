#include "loci/curves/arc_orders.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/dense_terms.hpp"
#include "core/errors.hpp"
#include "core/fold.hpp"
#include "core/interval.hpp"
#include "loci/curves/simple_zeros.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {
namespace {

using core::Interval;
using core::Polynomial;
using core::Rational;
using sheet::MultiInterval;

/// Halvings of a point's interval: below what MultiInterval resolves.
constexpr int halvings = 260;

/// +1 or -1 where intervals of doubles prove it, else 0.
int sign_in_doubles(const Polynomial& p, const std::vector<MultiInterval>& at) {
  std::vector<Interval> nearly;
  for (const MultiInterval& value : at) nearly.emplace_back(value.lower(), value.upper());
  Interval sum;
  for (const core::Term& term : p.terms) {
    Interval product = Interval(term.coefficient.get_d()) + Interval();  // GMP truncates: a step outwards encloses
    for (std::size_t v = 0; v < term.exponents.size(); ++v)
      for (int k = 0; k < term.exponents[v]; ++k) product = product * nearly[v];
    sum = sum + product;
  }
  return std::isfinite(sum.lower()) && std::isfinite(sum.upper()) ? sum.sign() : 0;
}

/// By what the result is to be multiplied to be what it was.
Rational scale_for_doubles(Polynomial& p) {
  if (p.is_zero()) return 1;
  const Rational before = p.terms.front().coefficient;
  p = core::scaled_for_doubles(p);
  return before / p.terms.front().coefficient;
}

/// The coefficients of the powers of an angle, of which the variable is the angle + angle_shift.
std::vector<Polynomial> powers_of_angle(const Polynomial& p, std::size_t variable) {
  std::vector<std::map<std::vector<int>, Rational, std::greater<>>> powers;
  for (core::Term term : p.terms) {
    const int power = std::exchange(term.exponents[variable], 0);
    if (powers.size() <= static_cast<std::size_t>(power)) powers.resize(static_cast<std::size_t>(power) + 1);
    core::Integer factor = 1;  // binomial(power, k) shift^(power - k)
    for (int k = power; k >= 0; --k) {
      powers[static_cast<std::size_t>(k)][term.exponents] += term.coefficient * Rational(factor);
      factor = factor * k / (power - k + 1) * core::angle_shift;
    }
  }
  std::vector<Polynomial> list;
  for (const auto& power : powers) {
    Polynomial& coefficient = list.emplace_back();
    coefficient.variables = p.variables;
    for (const auto& [exponents, value] : power)
      if (value != 0) coefficient.terms.push_back({exponents, value});
  }
  return list;
}

}  // namespace

std::optional<EnclosedPoint> curve_point(const Polynomial& curve, const std::array<double, 2>& near, double reach) {
  // Along the axis that the curve runs across.
  const std::array<double, 2> slope = {std::abs(core::evaluate(core::derivative(curve, 0), near)),
                                       std::abs(core::evaluate(core::derivative(curve, 1), near))};
  const std::size_t across = slope[0] > slope[1] ? 0 : 1, fixed = 1 - across;
  const Rational level(near[fixed]), centre(near[across]), radius(reach);
  std::vector<Rational> of_level = {1};
  std::map<int, Rational, std::greater<>> powers;
  for (const core::Term& term : curve.terms) {
    const auto power = static_cast<std::size_t>(term.exponents[fixed]);
    while (of_level.size() <= power) of_level.emplace_back(of_level.back() * level);
    powers[term.exponents[across]] += term.coefficient * of_level[power];
  }
  Polynomial line;
  line.variables = 1;
  for (const auto& [exponent, coefficient] : powers)
    if (coefficient != 0) line.terms.push_back({{exponent}, coefficient});
  if (line.is_zero() || line.is_constant()) return std::nullopt;
  std::vector<RealRoot> roots = real_roots(square_free_part(univariate(line)), centre - radius, centre + radius);
  if (roots.size() != 1) return std::nullopt;
  narrow_by(roots.front(), halvings);
  EnclosedPoint point(2);
  point[fixed] = {level, level};
  point[across] = {roots.front().lower, roots.front().upper};
  return point;
}

template <class Value, class Compute>
const Value& CurveAlgebra::known_or(Known<Value>& values, const Polynomial& p, const Compute& compute) {
  const auto find = [&] {
    return std::find_if(values.begin(), values.end(), [&](const auto& entry) { return entry.first == p; });
  };
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = find(); found != values.end()) return found->second;
  }
  Value value = compute();
  const std::lock_guard lock(mutex_);
  if (const auto found = find(); found != values.end()) return found->second;
  return values.emplace_back(p, std::move(value)).second;
}

const CurveAlgebra::Divided& CurveAlgebra::divided(const Polynomial& p) {
  return known_or(divided_, p, [&] {
    Divided divided{0, core::with_variables(p, curve_.variables)};
    while (std::optional<Polynomial> quotient = core::exact_quotient(divided.rest, curve_)) {
      divided.rest = std::move(*quotient);
      ++divided.order;
    }
    // What a curve with long coefficients leaves of a product is below what MultiInterval resolves.
    divided.scale = scale_for_doubles(divided.rest);
    return divided;
  });
}

const CurveAlgebra::Conjugate& CurveAlgebra::conjugate(const Polynomial& p, int root) {
  // A polynomial names its own root: the last that it holds.
  return known_or(conjugates_, p, [&] {
    Conjugate conjugate{conjugate_product(p, root, tower_)};
    conjugate.scale = scale_for_doubles(conjugate.product);
    return conjugate;
  });
}

std::shared_ptr<CurveAlgebra> CurveAlgebras::of(const Polynomial& curve) const {
  const std::lock_guard lock(mutex_);
  for (const auto& [other, algebra] : curves_)
    if (other == curve) return algebra;
  return curves_.emplace_back(curve, std::make_shared<CurveAlgebra>(tower_, curve)).second;
}

ArcOrders::ArcOrders(const core::RootTower& tower, core::WorkingMode mode, Polynomial curve, const EnclosedPoint& at)
    : ArcOrders(tower, std::move(mode), std::make_shared<CurveAlgebra>(tower, std::move(curve)), at) {}

ArcOrders::ArcOrders(const core::RootTower& tower, core::WorkingMode mode, std::shared_ptr<CurveAlgebra> curve,
                     const EnclosedPoint& at)
    : tower_(tower), mode_(std::move(mode)), algebra_(std::move(curve)) {
  place_roots(at);
}

ArcOrders::ArcOrders(const core::RootTower& tower, core::WorkingMode mode, CoordinateGerm germ, const EnclosedPoint& at)
    : tower_(tower),
      mode_(std::move(mode)),
      algebra_(std::make_shared<CurveAlgebra>(tower, Polynomial{})),
      rule_(std::move(germ)) {
  place_roots(at);
}

void ArcOrders::place_roots(const EnclosedPoint& at) {
  for (const auto& [lower, upper] : at) at_.emplace_back(lower, upper);
  const std::vector<MultiInterval> coordinates = at_;
  for (const int side : {1, -1}) {
    at_ = coordinates;
    if (place_roots_on(side)) sides_.push_back(side);
    if (!decided_) return;
  }
  // A root has one value on the curve whatever the side: at_ may be left from either. Where the mode reaches the curve
  // from the side that was tried first only, its roots are placed again.
  if (sides_ == std::vector<int>{1}) {
    at_ = coordinates;
    place_roots_on(1);
  }
  for (const int side : sides_)
    for (std::size_t j = 0; j < squares_[side].size(); ++j) {
      // The workspace ends at a limit, but nothing depends on the root of what is left to it.
      if (tower_.roots[j].name == core::limit_name) continue;
      const Rational order = squares_[side][j].order / 2;
      ramification_ = std::lcm(ramification_, static_cast<int>(order.get_den().get_si()));
    }
}

/// False: the mode does not reach the curve from this side.
bool ArcOrders::place_roots_on(int side) {
  std::vector<Germ>& squares = squares_[side];
  squares.clear();
  for (std::size_t j = 0; j < tower_.roots.size(); ++j) {
    if (tower_.roots[j].is_angle()) {
      std::vector<MultiInterval> at = at_;
      at.resize(static_cast<std::size_t>(tower_.variables()), MultiInterval(0.0));
      at_.push_back(sheet::angle_root(tower_.roots[j], at));
      squares.push_back(Germ{0, 1});
      continue;
    }
    // What is computed in fewer steps than its polynomial has terms is known more sharply by them, too.
    const core::Root& tower_root = tower_.roots[j];
    if (tower_root.square.terms.size() > tower_root.line.steps.size())
      if (const std::optional<MultiInterval> value = evaluate(tower_root.line, at_); value && value->sign() != 0) {
        if (value->sign() < 0) return false;
        const MultiInterval root = square_root(*value);
        at_.push_back(mode_[j] > 0 ? root : -root);
        squares.push_back(Germ{0, 1});
        continue;
      }
    const std::optional<Germ> square = germ(tower_.roots[j].square, side);
    if (!square) decided_ = false;
    if (!square || square->sign < 0) return false;
    MultiInterval root(0.0);
    if (square->order == 0 && !square->is_zero()) root = square_root(evaluate(tower_.roots[j].square, at_));
    at_.push_back(mode_[j] > 0 ? root : -root);
    squares.push_back(*square);
  }
  return true;
}

std::optional<Germ> ArcOrders::coordinate_germ(const Polynomial& p, int side) {
  if (rule_) return rule_(p, side);
  const CurveAlgebra::Divided& divided = algebra_->divided(p);
  const int cofactor = sign_at_point(divided.rest);
  if (cofactor == 0) return std::nullopt;
  return Germ{divided.order, divided.order % 2 == 0 ? cofactor : side * cofactor};
}

std::optional<Germ> ArcOrders::angle_germ(int root, int side) {
  const core::Root& tower_root = tower_.roots[static_cast<std::size_t>(root)];
  const std::optional<Germ> cosine = germ(tower_root.cosine_and_sine[0], side);
  std::optional<Germ> sine = germ(tower_root.cosine_and_sine[1], side);
  if (!cosine || !sine) return std::nullopt;
  if (sine->order == 0 || (cosine->order == 0 && cosine->sign > 0)) return sine;
  return std::nullopt;
}

std::optional<Germ> ArcOrders::germ_with_angle(const Polynomial& p, int root, int side) {
  const std::vector<Polynomial> powers = powers_of_angle(p, tower_.coordinates.size() + static_cast<std::size_t>(root));
  const std::optional<Germ> angle = angle_germ(root, side);
  if (!angle) return std::nullopt;
  Germ lowest;
  bool opposed = false;
  for (std::size_t k = 0; k < powers.size(); ++k) {
    std::optional<Germ> order = germ(powers[k], side);
    if (!order) return std::nullopt;
    if (k > 0) {
      order->order += angle->order * static_cast<int>(k);
      order->sign *= k % 2 == 0 ? std::abs(angle->sign) : angle->sign;
    }
    if (order->is_zero() || (!lowest.is_zero() && order->order > lowest.order)) continue;
    opposed = !lowest.is_zero() && order->order == lowest.order && (opposed || order->sign != lowest.sign);
    lowest = *order;
  }
  if (!opposed) return lowest;
  const std::optional<MultiInterval> sum = lead_with_angle(p, root, side);
  if (!sum || sum->sign() == 0) return std::nullopt;
  return Germ{lowest.order, sum->sign()};
}

std::optional<MultiInterval> ArcOrders::lead_of_angle(int root, int side) {
  const core::Root& tower_root = tower_.roots[static_cast<std::size_t>(root)];
  const std::optional<Germ> angle = angle_germ(root, side);
  if (!angle) return std::nullopt;
  if (angle->order == 0)
    return at_[tower_.coordinates.size() + static_cast<std::size_t>(root)] - MultiInterval(Rational(core::angle_shift));
  const std::optional<MultiInterval> cosine = lead(tower_root.cosine_and_sine[0], side);
  const std::optional<MultiInterval> sine = lead(tower_root.cosine_and_sine[1], side);
  if (!cosine || !sine) return std::nullopt;
  return *sine * inverse(*cosine);
}

std::optional<MultiInterval> ArcOrders::lead_with_angle(const Polynomial& p, int root, int side) {
  const std::vector<Polynomial> powers = powers_of_angle(p, tower_.coordinates.size() + static_cast<std::size_t>(root));
  const std::optional<Germ> angle = angle_germ(root, side);
  const std::optional<MultiInterval> turn = lead_of_angle(root, side);
  if (!angle || !turn) return std::nullopt;
  std::optional<Rational> least;
  MultiInterval sum(0.0), power(1.0);
  for (std::size_t k = 0; k < powers.size(); ++k, power = power * *turn) {
    const std::optional<Germ> germ_order = germ(powers[k], side);
    if (!germ_order) return std::nullopt;
    if (germ_order->is_zero() || (k > 0 && angle->is_zero())) continue;
    const Rational order = germ_order->order + angle->order * static_cast<int>(k);
    if (least && order > *least) continue;
    const std::optional<MultiInterval> coefficient = lead(powers[k], side);
    if (!coefficient) return std::nullopt;
    const MultiInterval term = *coefficient * power;
    sum = least && order == *least ? sum + term : term;
    least = order;
  }
  return sum;
}

std::optional<MultiInterval> ArcOrders::lead(const Polynomial& p, int side) {
  if (rule_) return std::nullopt;
  const std::optional<Germ> order = germ(p, side);
  if (!order) return std::nullopt;
  if (order->is_zero()) return MultiInterval(0.0);
  if (order->order == 0) {
    std::vector<MultiInterval> at = at_;
    at.resize(std::max(at.size(), static_cast<std::size_t>(p.variables)), MultiInterval(0.0));
    return evaluate(p, at);
  }
  const int top = top_root(p, tower_);
  if (top < 0) {
    const CurveAlgebra::Divided& divided = algebra_->divided(p);
    const MultiInterval rest = evaluate(divided.rest, at_) * MultiInterval(divided.scale);
    return divided.order % 2 != 0 && side < 0 ? -rest : rest;
  }
  if (tower_.roots[static_cast<std::size_t>(top)].is_angle()) return lead_with_angle(p, top, side);
  return lead_over_root(p, top, side);
}

/// Of a + b s, with the orders of both as germ() compares them.
std::optional<MultiInterval> ArcOrders::lead_over_root(const Polynomial& p, int root, int side) {
  const auto [a, b] = split(p, static_cast<int>(tower_.coordinates.size()) + root);
  const Germ& square = squares_.at(side)[static_cast<std::size_t>(root)];
  const std::optional<Germ> plain = germ(a, side), rooted = germ(b, side);
  std::optional<MultiInterval> first = lead(a, side), second = lead(b, side);
  const std::optional<MultiInterval> under = lead(tower_.roots[static_cast<std::size_t>(root)].square, side);
  if (!plain || !rooted || !first || !second || !under || !under->non_negative()) return std::nullopt;
  const MultiInterval value = square_root(*under);
  second = *second * (mode_[static_cast<std::size_t>(root)] > 0 ? value : -value);
  const Rational order = rooted->order + square.order / 2;
  if (rooted->is_zero() || square.is_zero()) return first;
  if (plain->is_zero()) return second;
  if (plain->order != order) return plain->order < order ? first : second;
  if (const MultiInterval sum = *first + *second; sum.sign() != 0) return sum;
  const CurveAlgebra::Conjugate& conjugate = algebra_->conjugate(p, root);
  const std::optional<MultiInterval> both = lead(conjugate.product, side);
  if (!both) return std::nullopt;
  return *both * MultiInterval(conjugate.scale) * inverse(*first - *second);
}

/// +1 or -1 where it is proven, else 0.
int ArcOrders::sign_at_point(const Polynomial& p) {
  const auto found = std::find_if(signs_.begin(), signs_.end(), [&](const auto& sign) { return sign.first == p; });
  if (found != signs_.end()) return found->second;
  // The variables of roots that are still to be placed do not occur.
  std::vector<MultiInterval> at = at_;
  at.resize(std::max(at.size(), static_cast<std::size_t>(p.variables)), MultiInterval(0.0));
  int sign = sign_in_doubles(p, at);
  if (sign == 0) sign = evaluate(p, at).sign();
  signs_.emplace_back(p, sign);
  return sign;
}

bool ArcOrders::is_nonzero(const core::StraightLine& line) const {
  const std::optional<MultiInterval> value = evaluate(line, at_);
  return value && value->sign() != 0;
}

std::optional<Germ> ArcOrders::germ(const Polynomial& p, int side) {
  if (p.is_zero()) return Germ{};
  if (const int sign = sign_at_point(p); sign != 0) return Germ{0, sign};
  const int top = top_root(p, tower_);
  if (top < 0) return coordinate_germ(p, side);
  if (tower_.roots[static_cast<std::size_t>(top)].is_angle()) return germ_with_angle(p, top, side);
  const auto [a, b] = split(p, static_cast<int>(tower_.coordinates.size()) + top);
  const Germ& square = squares_.at(side)[static_cast<std::size_t>(top)];
  std::optional<Germ> plain = germ(a, side);
  std::optional<Germ> rooted = germ(b, side);
  if (!plain || !rooted) return std::nullopt;
  rooted->order += square.order / 2;
  rooted->sign *= square.is_zero() ? 0 : mode_[static_cast<std::size_t>(top)];
  if (rooted->is_zero()) return plain;
  if (plain->is_zero()) return rooted;
  if (plain->order != rooted->order) return plain->order < rooted->order ? plain : rooted;
  if (plain->sign == rooted->sign) return plain;
  const Polynomial& product = algebra_->conjugate(p, top).product;
  if (product.is_zero()) return Germ{};
  std::optional<Germ> both = germ(product, side);
  if (!both || both->is_zero()) return both;
  return Germ{both->order - plain->order, both->sign * plain->sign};
}

std::optional<int> ArcOrders::slope_of(const core::LocusFactor& factor) {
  if (!core::is_of_determinants(factor.role) || sign_at_point(factor.sheet) != 0) return std::nullopt;
  const std::vector<Polynomial>& curves = factor.implicit;
  if (!rule_)
    return std::find(curves.begin(), curves.end(), algebra_->curve()) == curves.end()
               ? std::nullopt
               : slope_at_simple_zero(factor.sheet, algebra_->curve(), tower_, at_);
  if (tower_.coordinates.size() != 1) return std::nullopt;
  const bool norm_vanishes = std::any_of(curves.begin(), curves.end(), [&](const Polynomial& curve) {
    const std::optional<Germ> germ = rule_(curve, 1);
    return germ && germ->order > 0;
  });
  const int slope = norm_vanishes ? slope_on_sheet(factor.sheet, 0, tower_, at_) : 0;
  if (slope == 0 || !vanishes_where_norm_does(factor.sheet, tower_, at_)) return std::nullopt;
  return slope;
}

std::optional<Germ> ArcOrders::germ(const core::LocusFactor& factor, int side) {
  const auto found =
      std::find_if(slopes_.begin(), slopes_.end(), [&](const auto& one) { return one.first == &factor; });
  const std::optional<int> slope = found != slopes_.end() ? found->second : slope_of(factor);
  if (found == slopes_.end()) slopes_.emplace_back(&factor, slope);
  return slope ? Germ{1, side * *slope} : germ(factor.sheet, side);
}

}  // namespace clearloci::loci
