#include "loci/sheet/star.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "core/dense_terms.hpp"
#include "core/errors.hpp"
#include "loci/sheet/remembered.hpp"

namespace clearloci::loci::sheet {

namespace {

using core::Polynomial;
using core::Rational;

// Exponents in lexicographically descending order, as core::Polynomial wants them.
using Collected = std::map<std::vector<int>, Rational, std::greater<>>;

Polynomial as_polynomial(int variables, const Collected& collected) {
  Polynomial result{variables, {}};
  for (const auto& [exponents, coefficient] : collected)
    if (coefficient != 0) result.terms.push_back({exponents, coefficient});
  return result;
}

bool has_roots(const core::Term& term) {
  return std::any_of(term.exponents.begin() + 2, term.exponents.end(), [](int e) { return e != 0; });
}

void add(std::vector<Star>& stars, Star star) {
  const bool again =
      std::any_of(stars.begin(), stars.end(), [&](const Star& other) { return other.at_same_place(star); });
  if (!again) stars.push_back(std::move(star));
}

bool is_algebraic(const Star& star) { return star.apex && star.apex->exact; }

/// The other roots' squares do not vanish there too: what happens then is not told by two circles.
bool alone(const core::RootTower& tower, const Star& star) {
  std::vector<Rational> at(static_cast<std::size_t>(tower.variables()), Rational(0));
  at[0] = star.x;
  at[1] = star.y;
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    const Polynomial& square = tower.roots[j].square;
    if (tower.roots[j].is_angle()) continue;  // it stays smooth, for both ends of a link do not meet
    if (star.power_of_root(static_cast<int>(j)) > 0) continue;
    const bool plain = std::none_of(square.terms.begin(), square.terms.end(), has_roots);
    if (!plain || core::evaluate(square, at) == 0) return false;
  }
  return true;
}

}  // namespace

std::array<int, 2> Star::weights() const {
  const int along = is_doubled() ? 2 : 1, off = is_sheared() ? 2 * along : along;
  return along_y ? std::array{off, along} : std::array{along, off};
}

int Star::power_of_root(int root) const { return static_cast<int>(std::count(roots.begin(), roots.end(), root)); }

bool Star::is_undefined() const {
  if (no_length) return true;
  if (shape == Shape::corner)
    return std::any_of(roots.begin(), roots.end(), [&](int root) { return power_of_root(root) > 1; });
  return shape == Shape::cone && !roots.empty();
}

bool Star::is_near(const Interval& at_x, const Interval& at_y, double reach) const {
  const auto is_near = [&](const Interval& range, const Rational& own) {
    return (range - constant_as(own, static_cast<Interval*>(nullptr))).magnitude() <= reach;
  };
  return is_near(at_x, x) && is_near(at_y, y);
}

std::optional<std::array<Rational, 2>> double_point(const Polynomial& d) {
  static const Rational zero;
  const Rational *xx = &zero, *yy = &zero, *x = &zero, *y = &zero, *constant = &zero;
  for (const core::Term& term : d.terms) {
    if (has_roots(term)) return std::nullopt;
    const int i = term.exponents[0], j = term.exponents[1];
    if (i == 2 && j == 0)
      xx = &term.coefficient;
    else if (i == 0 && j == 2)
      yy = &term.coefficient;
    else if (i == 1 && j == 0)
      x = &term.coefficient;
    else if (i == 0 && j == 1)
      y = &term.coefficient;
    else if (i == 0 && j == 0)
      constant = &term.coefficient;
    else
      return std::nullopt;
  }
  if (*xx == 0 || *xx != *yy) return std::nullopt;
  const Rational a = -*x / (2 * *xx), b = -*y / (2 * *xx);
  if (*xx * (a * a + b * b) != *constant) return std::nullopt;
  return std::array<Rational, 2>{a, b};
}

namespace {

enum class Roots { absent, smooth, halved };

/// Whether a square is negative at a star, where it stands on no other root.
bool is_negative_at(const Star& star, const core::RootTower& tower, const Polynomial& around_star) {
  NumberField::Element value;
  for (const core::Term& term : around_star.terms) {
    const auto roots = term.exponents.begin() + 2;
    if (std::any_of(roots, roots + static_cast<std::ptrdiff_t>(tower.roots.size()), [](int e) { return e != 0; }))
      return false;
    if (term.exponents[0] != 0 || term.exponents[1] != 0) continue;
    const auto power = static_cast<std::size_t>(is_algebraic(star) ? term.exponents.back() : 0);
    if (value.size() <= power) value.resize(power + 1);
    value[power] += term.coefficient;
  }
  if (is_algebraic(star)) return star.apex->exact->field.enclosure(value).sign() < 0;
  return !value.empty() && value.front() < 0;
}

/// Finds the roots that vanish at a star, by the orders of their squares. Halved: of an odd order one vanishes as the
/// root of the distance does, for a workspace boundary passes through.
Roots find_roots(Star& star, const core::RootTower& tower) {
  star.roots.clear();
  bool is_halved = false;
  // Nothing is asked of the roots above one that is not there: their squares may have thousands of terms.
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    if (tower.roots[j].is_angle()) continue;  // in every direction it has a value
    const Polynomial square = around(star, tower.roots[j].square);
    if (square.is_zero()) continue;
    const int order = order_at(star, square);
    is_halved = is_halved || order % 2 != 0;
    star.roots.insert(star.roots.end(), static_cast<std::size_t>(order / 2), static_cast<int>(j));
    if (!square.is_constant() && is_negative_at(star, tower, square)) return Roots::absent;
  }
  return is_halved ? Roots::halved : Roots::smooth;
}

void set_tangent(Star& star, const std::array<Rational, 2>& normal) {
  const auto& [dx, dy] = normal;
  star.along_y = abs(dx) > abs(dy);
  star.slope = star.along_y ? -dy / dx : -dx / dy;
}

/// The gradient of a square that is of the first order at a star.
std::optional<std::array<Rational, 2>> gradient_of(const Polynomial& around_star) {
  std::array<Rational, 2> gradient;
  for (const core::Term& term : around_star.terms) {
    const int order = term.exponents[0] + term.exponents[1];
    if (order > 1) continue;
    if (order == 0 || has_roots(term)) return std::nullopt;
    gradient[term.exponents[0] == 1 ? 0 : 1] = term.coefficient;
  }
  if (gradient[0] == 0 && gradient[1] == 0) return std::nullopt;
  return gradient;
}

/// The star along the tangent that all boundaries through it have in common; none: there is no such tangent, or more
/// than the squares' first orders is to be known.
std::vector<Star> tangential_of(const Star& star, const core::RootTower& tower) {
  if (star.apex) return {};
  std::optional<std::array<Rational, 2>> normal;
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    if (star.power_of_root(static_cast<int>(j)) != 1) continue;
    const auto own = gradient_of(around(star, tower.roots[j].square));
    if (!own || (normal && (*normal)[0] * (*own)[1] != (*normal)[1] * (*own)[0])) return {};
    normal = own;
  }
  if (!normal) return {};
  Star result = star;
  result.shape = Star::Shape::touch;
  set_tangent(result, *normal);
  if (find_roots(result, tower) != Roots::smooth) return {};
  return {std::move(result)};
}

}  // namespace

std::vector<Star> cones(const core::RootTower& tower) {
  std::vector<Star> result;
  for (const Polynomial& denominator : tower.denominators) {
    const auto place = double_point(denominator);
    if (!place) continue;
    Star star;
    star.x = (*place)[0];
    star.y = (*place)[1];
    if (settle_roots(star, tower) && !star.roots.empty()) add(result, std::move(star));
  }
  return result;
}

bool settle_roots(Star& star, const core::RootTower& tower) {
  Roots found = find_roots(star, tower);
  if (found == Roots::halved && (star.no_length || !star.roots.empty())) {
    if (star.is_sheared()) return false;
    star.shape = Star::Shape::corner;
    found = find_roots(star, tower);
    star.tangential = tangential_of(star, tower);
  }
  return found != Roots::absent;
}

bool is_smooth_at(const Star& star, const Polynomial& function) {
  if (std::any_of(star.roots.begin(), star.roots.end(), [&](int root) { return core::depends_on(function, 2 + root); }))
    return false;
  const Polynomial around_star = around(star, function);
  return std::any_of(around_star.terms.begin(), around_star.terms.end(),
                     [](const core::Term& term) { return term.exponents[0] + term.exponents[1] <= 1; });
}

namespace {

void set_tangent(Star& star, const BoundaryCurve& curve) { set_tangent(star, curve.normal_at({star.x, star.y})); }

/// Where two boundaries cross and both roots are 0: whether the function is too, whatever the other roots are there.
bool vanishes_at(const Polynomial& function, const std::array<Rational, 2>& point, const BoundaryMeeting& meeting) {
  std::vector<Rational> at(static_cast<std::size_t>(function.variables), Rational(1));
  at[0] = point[0];
  at[1] = point[1];
  Collected by_others;
  for (const core::Term& term : function.terms) {
    std::vector<int> others = term.exponents;
    others[0] = others[1] = 0;
    if (others[2 + static_cast<std::size_t>(meeting.first.root)] != 0 ||
        others[2 + static_cast<std::size_t>(meeting.second.root)] != 0)
      continue;
    by_others[std::move(others)] += core::evaluate(Polynomial{function.variables, {term}}, at);
  }
  return as_polynomial(function.variables, by_others).is_zero();
}

}  // namespace

std::vector<Star> touches(const core::RootTower& tower) {
  std::vector<Star> result;
  for (const BoundaryMeeting& meeting : boundary_meetings(tower)) {
    if (!meeting.touching) continue;
    Star star;
    star.shape = Star::Shape::touch;
    star.x = meeting.foot[0];
    star.y = meeting.foot[1];
    star.roots = {meeting.first.root, meeting.second.root};
    set_tangent(star, meeting.first);
    if (alone(tower, star)) add(result, std::move(star));
  }
  return result;
}

namespace {

/// With s_j on the boundary of its own and Q_k = a s_j + b X + ..., X along that: where a is 0 both boundaries cross,
/// or, where b is too, the ends of the upper dyad meet on the lower one's boundary; where it is not they touch, and s_j
/// vanishes as X does. None where b alone is 0: there coordinates would have to bend with the boundary.
std::optional<Star> star_of(const NestedMeeting& meeting) {
  const int lower = meeting.lower.root;
  if (meeting.by_root && !meeting.along) return std::nullopt;
  Star star;
  star.x = meeting.at[0];
  star.y = meeting.at[1];
  star.roots = {lower, meeting.upper};
  star.shape = meeting.by_root ? Star::Shape::bend : meeting.along ? Star::Shape::corner : Star::Shape::touch;
  if (meeting.by_root) star.roots.push_back(lower);
  if (star.is_sheared()) set_tangent(star, meeting.lower);
  return star;
}

}  // namespace

namespace {

/// Without the roots that are in every term: where these vanish a curve is traced along their boundaries.
Polynomial without_roots_as_factors(Polynomial function) {
  for (std::size_t v = 2; v < static_cast<std::size_t>(function.variables); ++v)
    while (!function.is_zero() && std::all_of(function.terms.begin(), function.terms.end(),
                                              [&](const core::Term& term) { return term.exponents[v] > 0; }))
      for (core::Term& term : function.terms) --term.exponents[v];
  return function;
}

}  // namespace

std::vector<Star> corners_on(const core::RootTower& tower, const Polynomial& function,
                             const std::vector<NestedMeeting>& nested) {
  std::vector<Star> result;
  for (const BoundaryMeeting& meeting : boundary_meetings(tower)) {
    const int first = meeting.first.root, second = meeting.second.root;
    const bool on_either = core::depends_on(function, 2 + first) || core::depends_on(function, 2 + second);
    if (meeting.touching || !on_either) continue;
    for (const std::array<Rational, 2>& point : meeting.rational_points()) {
      if (!vanishes_at(function, point, meeting)) continue;
      Star star;
      star.shape = Star::Shape::corner;
      star.x = point[0];
      star.y = point[1];
      star.roots = {first, second};
      // Where the function changes with one root only, that root is of the other one's second order.
      const auto changes_by = [&](int root) {
        return !vanishes_at(core::derivative(function, 2 + root), point, meeting);
      };
      const bool by_first = changes_by(first), by_second = changes_by(second);
      if (by_first != by_second) {
        const BoundaryCurve& touched = by_first ? meeting.first : meeting.second;
        star.shape = Star::Shape::bend;
        star.roots.push_back(touched.root);
        set_tangent(star, touched);
      }
      if (alone(tower, star)) add(result, std::move(star));
    }
  }
  const Polynomial inner = without_roots_as_factors(function);
  const bool has_roots_inside =
      std::any_of(inner.terms.begin(), inner.terms.end(), [](const core::Term& term) { return has_roots(term); });
  for (const NestedMeeting& meeting : nested) {
    std::vector<Rational> at(static_cast<std::size_t>(tower.variables()), Rational(0));
    at[0] = meeting.at[0];
    at[1] = meeting.at[1];
    std::optional<Star> star = star_of(meeting);
    if (!star || !alone(tower, *star)) continue;
    // Along boundaries, which are smooth where they only cross or touch, nothing is gained.
    const bool is_singular = star->shape == Star::Shape::touch;
    if (core::evaluate(is_singular ? function : inner, at) != 0 || (!is_singular && !has_roots_inside)) continue;
    const Polynomial& square = tower.roots[static_cast<std::size_t>(meeting.upper)].square;
    if (is_singular || !exact_quotient(square, inner)) add(result, std::move(*star));
  }
  return result;
}

namespace {

/// Those of which it can no longer be told what vanishes there are none of the part's.
std::vector<Star> with_what_vanishes(std::vector<Star> stars) {
  std::erase_if(stars, [](const Star& star) {
    return star.apex && std::any_of(star.apex->vanishing.begin(), star.apex->vanishing.end(),
                                    [](const core::StraightLine& line) { return line.empty(); });
  });
  return stars;
}

}  // namespace

std::vector<Star> narrowed(std::vector<Star> stars, const Subtower& part) {
  for (Star& star : stars) {
    if (star.apex) {
      Apex apex{star.apex->radius, star.apex->slope_radius, {}, {}, star.apex->exact};
      for (const core::StraightLine& line : star.apex->vanishing) apex.vanishing.push_back(narrowed(line, part));
      for (const int root : part.kept) apex.roots.push_back(star.apex->roots[static_cast<std::size_t>(root)]);
      star.apex = std::move(apex);
    }
    std::vector<int> roots;
    for (const int root : star.roots) {
      const auto place = std::find(part.kept.begin(), part.kept.end(), root);
      if (place != part.kept.end()) roots.push_back(static_cast<int>(place - part.kept.begin()));
    }
    star.roots = std::move(roots);
    star.tangential = narrowed(std::move(star.tangential), part);
  }
  return with_what_vanishes(std::move(stars));
}

std::vector<Star> on_rim(std::vector<Star> stars, int root) {
  for (Star& star : stars) {
    if (star.apex) {
      for (core::StraightLine& line : star.apex->vanishing)
        line = core::depends_on(line, 2 + root) ? core::StraightLine{} : without_variable(line, 2 + root);
      star.apex->roots.erase(star.apex->roots.begin() + root);
    }
    star.roots.erase(std::remove(star.roots.begin(), star.roots.end(), root), star.roots.end());
    for (int& other : star.roots)
      if (other > root) --other;
    star.tangential = on_rim(std::move(star.tangential), root);
  }
  return with_what_vanishes(std::move(stars));
}

namespace {

/// p(x, y, roots...) at an algebraic point plus (X, Y), one coordinate after the other; alpha is the last variable.
Polynomial around_algebraic(const AlgebraicPoint& point, const Polynomial& p) {
  using Element = NumberField::Element;
  std::map<std::vector<int>, Element, std::greater<>> moved;
  for (const core::Term& term : p.terms) moved[term.exponents] = {term.coefficient};
  for (const std::size_t c : {0, 1}) {
    std::vector<Element> powers = {{1}};
    for (int k = 0; k < core::degree_in(p, static_cast<int>(c)); ++k)
      powers.push_back(point.field.product(powers.back(), c == 0 ? point.x : point.y));
    std::map<std::vector<int>, Element, std::greater<>> next;
    for (const auto& [exponents, coefficient] : moved) {
      const int power = exponents[c];
      std::vector<int> place = exponents;
      Rational binomial = 1;
      for (int k = 0; k <= power; ++k) {
        place[c] = k;
        Element& sum = next[place];
        const Element part = point.field.product(coefficient, powers[static_cast<std::size_t>(power - k)]);
        sum = point.field.sum(sum, point.field.times(part, binomial));
        binomial = binomial * (power - k) / (k + 1);
      }
    }
    moved = std::move(next);
  }
  Collected collected;
  for (const auto& [exponents, coefficient] : moved)
    for (std::size_t k = 0; k < coefficient.size(); ++k) {
      std::vector<int> place = exponents;
      place.push_back(static_cast<int>(k));
      collected[place] = coefficient[k];
    }
  return as_polynomial(p.variables + 1, collected);
}

Polynomial around_rational(const Star& star, const Polynomial& p) {
  Polynomial moved = shifted(shifted(p, 0, star.x), 1, star.y);
  if (!star.is_sheared() || star.slope == 0) return moved;
  // off = off' + slope along
  const std::size_t along = star.along_y ? 1 : 0, off = 1 - along;
  Collected sheared;
  for (const core::Term& term : moved.terms) {
    const int power = term.exponents[off];
    Rational binomial = 1, slopes = 1;
    for (int k = 0; k <= power; ++k) {
      std::vector<int> exponents = term.exponents;
      exponents[off] = power - k;
      exponents[along] += k;
      sheared[exponents] += term.coefficient * binomial * slopes;
      binomial = binomial * (power - k) / (k + 1);
      slopes *= star.slope;
    }
  }
  return as_polynomial(p.variables, sheared);
}

}  // namespace

Polynomial around(const Star& star, const Polynomial& p) {
  if (is_algebraic(star)) return around_algebraic(*star.apex->exact, p);
  const auto compute = [&] { return around_rational(star, p); };
  if (p.terms.size() > most_terms_remembered) return compute();
  thread_local Remembered<Polynomial, Rational, Rational, Rational, int, Polynomial> known;
  return known(compute, star.x, star.y, star.slope, star.is_sheared() ? star.along_y ? 2 : 1 : 0, p);
}

namespace {

int order_of(const Star& star, const core::Term& term) {
  const auto [v, w] = star.weights();
  int order = v * term.exponents[0] + w * term.exponents[1];
  for (const int root : star.roots) order += term.exponents[2 + root];
  return order;
}

}  // namespace

int order_at(const Star& star, const Polynomial& around_star) {
  int order = std::numeric_limits<int>::max();
  for (const core::Term& term : around_star.terms) order = std::min(order, order_of(star, term));
  return order;
}

bool vanishes_with(const Star& star, const core::RootTower& tower, const Polynomial& around_star, int root) {
  const int v = 2 + root, order = order_at(star, around_star);
  const bool is_stood_on = std::any_of(tower.roots.begin(), tower.roots.end(),
                                       [&](const core::Root& other) { return core::depends_on(other.square, v); });
  if (is_stood_on || around_star.is_zero()) return false;
  return std::all_of(around_star.terms.begin(), around_star.terms.end(), [&](const core::Term& term) {
    return order_of(star, term) > order || term.exponents[static_cast<std::size_t>(v)] == 1;
  });
}

namespace {

/// The same where coefficients are polynomials in alpha: each an enclosure.
core::StraightLine polar_line_algebraic(const Star& star, const Polynomial& around_star, int order) {
  std::map<std::vector<int>, NumberField::Element, std::greater<>> coefficients;
  for (const core::Term& term : around_star.terms) {
    std::vector<int> exponents = {order_of(star, term) - order};
    exponents.insert(exponents.end(), term.exponents.begin(), term.exponents.end() - 1);
    NumberField::Element& coefficient = coefficients[exponents];
    coefficient.resize(std::max(coefficient.size(), static_cast<std::size_t>(term.exponents.back()) + 1));
    coefficient[static_cast<std::size_t>(term.exponents.back())] = term.coefficient;
  }
  // Every coefficient is a variable of its own, which stands for a number.
  const int count = static_cast<int>(coefficients.size());
  core::StraightLineBuilder builder;
  std::vector<int> variables;
  Polynomial polar{count + around_star.variables, {}};
  for (const auto& [exponents, coefficient] : coefficients) {
    const MultiInterval value = star.apex->exact->field.enclosure(coefficient);
    const Rational lower = value.lower_end(), upper = value.upper_end();
    core::Term term{std::vector<int>(static_cast<std::size_t>(count), 0), 1};
    term.exponents[variables.size()] = 1;
    term.exponents.insert(term.exponents.end(), exponents.begin(), exponents.end());
    variables.push_back(builder.constant((lower + upper) / 2, (upper - lower) / 2));
    polar.terms.push_back(std::move(term));
  }
  for (int v = 0; v < around_star.variables; ++v) variables.push_back(builder.variable(v));
  return builder.line(builder.polynomial(polar, variables));
}

}  // namespace

namespace {

core::StraightLine as_line(const Polynomial& polar) {
  core::StraightLineBuilder builder;
  std::vector<int> variables;
  for (int v = 0; v < polar.variables; ++v) variables.push_back(builder.variable(v));
  return builder.line(builder.polynomial(polar, variables));
}

}  // namespace

core::StraightLine polar_line(const Star& star, const Polynomial& around_star, int order) {
  if (is_algebraic(star)) return polar_line_algebraic(star, around_star, order);
  Polynomial polar{around_star.variables + 1, {}};
  for (const core::Term& term : around_star.terms) {
    core::Term moved = term;
    moved.exponents.insert(moved.exponents.begin(), order_of(star, term) - order);
    polar.terms.push_back(std::move(moved));
  }
  return as_line(polar);
}

core::StraightLine wing_line(const Star& star, const Polynomial& around_tangent, const std::array<int, 2>& orders) {
  Polynomial polar{around_tangent.variables + 2, {}};
  for (const core::Term& term : around_tangent.terms) {
    core::Term moved = term;
    moved.exponents.insert(moved.exponents.begin() + 2, order_of(star, term) - orders[1]);
    moved.exponents.insert(moved.exponents.begin(), order_of(star.tangential.front(), term) - orders[0]);
    polar.terms.push_back(std::move(moved));
  }
  return as_line(polar);
}

}  // namespace clearloci::loci::sheet
