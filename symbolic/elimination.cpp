#include "symbolic/elimination.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/errors.hpp"
#include "symbolic/dependent_roots.hpp"
#include "symbolic/tower_steps.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;

void insert_distinct(std::vector<Poly>& list, const Poly& p) {
  if (std::find(list.begin(), list.end(), p) == list.end()) list.push_back(p);
}

/// Of a factor of denominators, which are nowhere negative: whether it may be negative, as that of a square.
bool changes_sign(const Poly& factor, const Geometry& geometry) {
  bool is_squared = false;
  for (const Poly& denominator : geometry.denominators()) {
    if (std::any_of(geometry.roots().begin(), geometry.roots().end(),
                    [&](const TowerRoot& root) { return denominator.depends_on(root.variable); }))
      continue;
    Rational constant;
    for (const PolyFactor& part : denominator.factors(constant)) {
      if (!(part.poly == factor) && !(part.poly == -factor)) continue;
      if (part.multiplicity % 2 != 0) return false;
      is_squared = true;
    }
  }
  return is_squared;
}

}  // namespace

Elimination::Elimination(const Geometry& geometry, KnownEliminations* known)
    : geometry_(&geometry), substitutions_(geometry.substitutions()) {
  std::vector<Poly> found;
  // Of a plane what is beyond use divides no norm that is made.
  for (const Poly& denominator : geometry.denominators())
    if (geometry.coordinates() != 2 || !is_beyond_use(norm_degree(denominator))) eliminate(denominator, found);
  denominator_factors_ = std::move(found);
  for (const Poly& factor : denominator_factors_)
    stripped_.push_back(changes_sign(factor, geometry) ? factor * factor : factor);
  // Most of those without roots are products of these factors.
  for (const Poly& denominator : geometry.denominators())
    if (!strip_denominators(denominator).is_constant()) known_denominators_.push_back(denominator);
  // What vanishes nowhere is divided out like a denominator, but is no place where the mode may change.
  const auto& units = geometry.positive_units();
  known_denominators_.insert(known_denominators_.end(), units.begin(), units.end());
  for (const TowerRoot& root : geometry.roots())
    if (!root.is_angle() && (!root.value || root.square.constant() != 1)) independent_roots_.push_back(root);
  find_divided_roots();
  know_stretched();
  if (known != nullptr && known->is_for(geometry.ring(), common_sources())) known_ = known;
}

KnownEliminations::Sources Elimination::common_sources() const {
  KnownEliminations::Sources sources;
  for (const TowerRoot& root : geometry_->roots()) {
    sources.push_back(Poly::variable(geometry_->ring(), root.variable));
    sources.push_back(root.square);
    sources.insert(sources.end(), root.cosine_and_sine.begin(), root.cosine_and_sine.end());
  }
  for (const TowerRoot& root : independent_roots_) sources.push_back(Poly::variable(geometry_->ring(), root.variable));
  sources.insert(sources.end(), denominator_factors_.begin(), denominator_factors_.end());
  sources.insert(sources.end(), known_denominators_.begin(), known_denominators_.end());
  // Which side of a fold the sheet is on is the place of the point that folds.
  for (const Fold& fold : geometry_->folds()) sources.push_back(fold.where.primitive());
  return sources;
}

KnownEliminations::Sources Elimination::sources_over_tower(const Poly& natural) const {
  KnownEliminations::Sources sources = {natural};
  for (const Substitution& pair : substitutions_) {
    const bool is_put_in =
        std::any_of(sources.begin(), sources.end(), [&](const Poly& p) { return Geometry::degree_in(p, pair) > 0; });
    if (is_put_in)
      sources.insert(sources.end(),
                     {Poly::variable(natural.ring(), pair.x), pair.place.x, pair.place.y, pair.place.z, pair.place.w});
  }
  return sources;
}

namespace {

/// The way between two points of the plane, in natural coordinates.
std::array<Poly, 2> way(const Geometry& geometry, mechanism::PointIndex from, mechanism::PointIndex to) {
  const auto &a = geometry.natural(from), &b = geometry.natural(to);
  return {geometry.poly((b[0] - a[0]).expand()), geometry.poly((b[1] - a[1]).expand())};
}

/// Of what the polynomial is times its primitive part.
int sign_of_content(const Poly& p) { return sgn(p.exact_quotient(p.primitive()).constant()); }

const mechanism::DyadPoint* plane_dyad(const Geometry& geometry, mechanism::PointIndex point) {
  if (point < 0) return nullptr;
  const auto* dyad =
      std::get_if<mechanism::DyadPoint>(&geometry.mechanism().points[static_cast<std::size_t>(point)].form);
  return dyad == nullptr || dyad->axis ? nullptr : dyad;
}

}  // namespace

void Elimination::know_stretched() {
  const auto& roots = geometry_->roots();
  for (const TowerRoot& root : roots) {
    const mechanism::DyadPoint* const dyad = plane_dyad(*geometry_, root.point);
    const bool nested = std::any_of(roots.begin(), roots.end(),
                                    [&](const TowerRoot& below) { return root.square.depends_on(below.variable); });
    if (dyad == nullptr || !nested || root.value) continue;
    const auto [u, v] = way(*geometry_, dyad->from, dyad->to);
    const auto [x, y] = way(*geometry_, dyad->from, root.point);
    const Poly twice = u * y - v * x;
    const Poly s = Poly::variable(geometry_->ring(), root.variable);
    stretched_.push_back({twice.primitive(), s.scaled(sign_of_content(twice))});
  }
}

const Elimination::Stretched* Elimination::stretched(const Poly& natural) const {
  if (stretched_.empty() || natural.is_zero()) return nullptr;
  const Poly primitive = natural.primitive();
  const auto found = std::find_if(stretched_.begin(), stretched_.end(),
                                  [&](const Stretched& scaled) { return scaled.natural == primitive; });
  return found == stretched_.end() ? nullptr : &*found;
}

bool Elimination::are_components_of_link(const Poly& a, const Poly& b) const {
  for (const ConstructedPoint& elbow : geometry_->constructed()) {
    const mechanism::DyadPoint* const dyad = plane_dyad(*geometry_, elbow.point);
    if (dyad == nullptr) continue;
    for (const mechanism::PointIndex end : {dyad->from, dyad->to}) {
      const auto [x, y] = way(*geometry_, end, elbow.point);
      const auto is = [](const Poly& one, const Poly& other) { return one.primitive() == other.primitive(); };
      if (!x.is_zero() && !y.is_zero() && ((is(a, x) && is(b, y)) || (is(a, y) && is(b, x)))) return true;
    }
  }
  return false;
}

const Poly& Elimination::over_tower(const Poly& natural) const {
  for (const auto& [asked, result] : over_tower_)
    if (asked == natural) return result;
  if (const Stretched* const scaled = stretched(natural))
    return over_tower_.emplace_back(natural, scaled->root.scaled(sign_of_content(natural))).second;
  const KnownEliminations::Sources sources = known_ ? sources_over_tower(natural) : KnownEliminations::Sources{};
  if (known_)
    if (const auto found = known_->find(KnownEliminations::Kind::over_tower, sources, natural.ring()))
      return over_tower_.emplace_back(natural, found->front().poly).second;
  Poly result = put_in(natural, 0);
  if (known_) known_->keep(KnownEliminations::Kind::over_tower, sources, {{result, 1}});
  return over_tower_.emplace_back(natural, std::move(result)).second;
}

Poly Elimination::put_in(Poly natural, std::size_t first) const {
  for (std::size_t i = first; i < substitutions_.size(); ++i) {
    const Substitution& pair = substitutions_[i];
    const int degree = Geometry::degree_in(natural, pair);
    // Clearing puts the denominators of every point to all terms: those that are not needed go before the next point.
    if (degree > 0) natural = strip_denominators(geometry_->substituted(natural, pair, degree));
  }
  return natural;
}

Poly Elimination::at_one_pose(Poly p) const {
  for (int i = 0; i < geometry_->coordinates(); ++i) p = p.at(i, Rational(37 + 11 * i, 101 + 2 * i));
  return p;
}

Poly Elimination::over_tower_at_one_pose(const Poly& natural) const {
  Poly result = at_one_pose(natural);
  if (at_one_pose_.empty()) {
    at_one_pose_ = substitutions_;
    for (Substitution& pair : at_one_pose_)
      pair.place = {at_one_pose(pair.place.x), at_one_pose(pair.place.y), at_one_pose(pair.place.z),
                    at_one_pose(pair.place.w)};
  }
  for (const Substitution& pair : at_one_pose_) {
    const int degree = Geometry::degree_in(result, pair);
    if (degree > 0) result = at_one_pose(geometry_->substituted(result, pair, degree));
  }
  return result;
}

bool Elimination::vanishes_everywhere(const Poly& natural) const {
  for (const auto& [asked, result] : vanishing_)
    if (asked == natural) return result;
  const bool vanishes = over_tower_at_one_pose(natural).is_zero() && over_tower(natural).is_zero();
  vanishing_.emplace_back(natural, vanishes);
  return vanishes;
}

std::optional<Rational> Elimination::constant_over_tower(const Poly& natural) const {
  // natural + t: the coefficient of t is the common denominator that homogenising put to both.
  const int t = geometry_->auxiliary();
  const Poly with_t = natural + Poly::variable(natural.ring(), t);
  const auto constant_in = [&](const Poly& element) -> std::optional<Rational> {
    const std::vector<Poly> parts = element.coefficients(t);
    Poly quotient(natural.ring());
    if (parts.size() != 2 || !parts[0].divides(parts[1], quotient) || !quotient.is_constant()) return std::nullopt;
    return quotient.constant();
  };
  // A number in every pose is one in this, with what is divided by not zero there; most others are none.
  const Poly here = over_tower_at_one_pose(with_t);
  if (here.depends_on(t) && !constant_in(here)) return std::nullopt;
  return constant_in(over_tower(with_t));
}

bool Elimination::is_denominator(const Poly& irreducible) const {
  return std::find(denominator_factors_.begin(), denominator_factors_.end(), irreducible) != denominator_factors_.end();
}

bool Elimination::has_free_coordinate(const Poly& p) const {
  for (const int variable : geometry_->tower_variables()) {
    if (p.depends_on(variable)) return true;
  }
  return false;
}

Poly Elimination::strip_denominators(Poly p) const {
  if (p.is_zero()) return p;
  Poly quotient(p.ring());
  for (const Poly& denominator : stripped_) {
    while (p.divides(denominator, quotient)) p = quotient;
  }
  for (const Poly& denominator : known_denominators_) {
    while (!denominator.is_constant() && p.divides(denominator, quotient)) p = quotient;
  }
  return p;
}

std::vector<PolyFactor> Elimination::factors_over_tower(const Poly& sheet) const {
  if (!known_) return found_factors(sheet);
  if (auto found = known_->find(KnownEliminations::Kind::factors, {sheet}, sheet.ring())) return std::move(*found);
  std::vector<PolyFactor> factors = found_factors(sheet);
  known_->keep(KnownEliminations::Kind::factors, {sheet}, factors);
  return factors;
}

std::vector<PolyFactor> Elimination::found_factors(Poly sheet) const {
  Rational constant;
  std::vector<PolyFactor> elements;
  const auto split_off = [&](const Poly& element) {
    if (!line_image().may_divide(element, line_image().of(sheet))) return;
    PolyFactor found{element, 0};
    while (std::optional<Poly> rest = quotient_over_tower(sheet, element, independent_roots_)) {
      sheet = strip_denominators(std::move(*rest));
      ++found.multiplicity;
    }
    if (found.multiplicity > 0) elements.push_back(std::move(found));
  };
  for (const Fold& fold : geometry_->folds())
    for (const PolyFactor& part : fold.where.factors(constant)) split_off(part.poly);
  for (const TowerRoot& root : independent_roots_) {
    if (root.role != core::RootRole::working_mode || root.square.is_constant()) continue;  // a number's is never zero
    PolyFactor found{Poly::variable(sheet.ring(), root.variable), 0};
    while (std::optional<Poly> rest = without_root(sheet, root)) {
      sheet = strip_denominators(std::move(*rest));
      ++found.multiplicity;
    }
    if (found.multiplicity > 0) elements.push_back(std::move(found));
  }
  std::vector<PolyFactor> factors = sheet.factors(constant);
  factors.insert(factors.end(), elements.begin(), elements.end());
  return factors;
}

std::optional<Poly> Elimination::without_root(const Poly& sheet, const TowerRoot& root) {
  if (!sheet.depends_on(root.variable)) return std::nullopt;
  const auto [a, b] = split(sheet, root.variable);
  Poly quotient(sheet.ring());
  if (!a.divides(root.square, quotient)) return std::nullopt;
  return b + quotient * Poly::variable(sheet.ring(), root.variable);
}

std::vector<SheetFactor> Elimination::sheet_factors(const Poly& sheet, bool with_implicit,
                                                    std::vector<Poly>* without_curves) const {
  return described(factors_over_tower(strip_denominators(sheet)), with_implicit, without_curves);
}

std::vector<SheetFactor> Elimination::boundary_factors(const Poly& square) const {
  std::vector<SheetFactor> factors = sheet_factors(square, true);
  if (!factors.empty()) return factors;
  for (const PolyFactor& factor : factors_over_tower(square))
    if (factor.multiplicity % 2 != 0 && has_free_coordinate(factor.poly))
      factors.push_back({factor.poly, factor.multiplicity, implicit_of_divisor(factor.poly)});
  return factors;
}

void Elimination::find_divided_roots() {
  for (std::size_t i = 0; i < geometry_->roots().size(); ++i) {
    const TowerRoot& root = geometry_->roots()[i];
    if (root.role != core::RootRole::working_mode || root.value || root.square.is_constant()) continue;
    if (!strip_denominators(root.square).is_constant()) continue;
    Rational constant;
    for (const PolyFactor& factor : root.square.factors(constant))
      if (factor.multiplicity % 2 != 0 && has_free_coordinate(factor.poly))
        divided_roots_.push_back({i, factor.poly, factor.multiplicity});
  }
}

int Elimination::order_over_tower(const Poly& sheet, const DividedRoot& divided) const {
  const auto [even, odd] = split(sheet, geometry_->roots()[divided.root].variable);
  const auto twice_in = [&](Poly part) {
    int times = 0;
    while (std::optional<Poly> rest = quotient_over_tower(part, divided.divisor, independent_roots_)) {
      part = std::move(*rest);
      times += 2;
    }
    return times;
  };
  core::ensure(!sheet.is_zero(), "what is not zero in every pose has an order");
  // One is even and the other odd: they do not cancel.
  if (odd.is_zero()) return twice_in(even);
  if (even.is_zero()) return twice_in(odd) + divided.multiplicity;
  return std::min(twice_in(even), twice_in(odd) + divided.multiplicity);
}

int Elimination::order_along(const Poly& natural, const DividedRoot& divided) const {
  Poly p = natural;
  int order = 0;
  for (const Substitution& pair : substitutions_) {
    const int degree = Geometry::degree_in(p, pair);
    if (degree == 0) continue;
    order -= degree * order_over_tower(pair.place.w, divided);
    p = geometry_->substituted(p, pair, degree);
    // As elsewhere, but for what holds the divisor.
    Poly quotient(p.ring());
    for (const std::vector<Poly>* const list : {&stripped_, &known_denominators_})
      for (const Poly& denominator : *list)
        if (!denominator.is_constant() && order_over_tower(denominator, divided) == 0)
          while (p.divides(denominator, quotient)) p = quotient;
  }
  return order + order_over_tower(p, divided);
}

std::optional<Poly> Elimination::found_element(const Fold& fold) const {
  const mechanism::PointIndex point = geometry_->roots()[fold.root].point;
  const auto closing = geometry_->closings().find(point);
  if (closing == geometry_->closings().end()) return std::nullopt;
  const auto& dyad =
      std::get<mechanism::DyadPoint>(geometry_->mechanism().points[static_cast<std::size_t>(point)].form);
  const mechanism::PointIndex fourth = closing->second.fourth;
  const auto [a, b] = way(*geometry_, fourth, dyad.from);
  const auto [u, v] = way(*geometry_, fourth, dyad.to);
  const Poly element = a * v - b * u;
  Poly quotient(geometry_->ring());
  if (!over_tower(element).divides(fold.where, quotient) || !quotient.is_constant()) return std::nullopt;
  return element.primitive();
}

const std::optional<Poly>& Elimination::fold_element(std::size_t fold) const {
  elements_.resize(geometry_->folds().size());
  if (!elements_[fold]) elements_[fold] = found_element(geometry_->folds()[fold]);
  return *elements_[fold];
}

Poly Elimination::with_closings(Poly natural) const {
  for (std::size_t i = 0; i < geometry_->closings().size(); ++i)
    if (const int degree = Geometry::degree_in(natural, substitutions_[i]); degree > 0)
      natural = geometry_->substituted(natural, substitutions_[i], degree);
  return natural;
}

const Poly& Elimination::fold_divisor(std::size_t fold) const {
  divisors_.resize(geometry_->folds().size());
  if (!divisors_[fold]) divisors_[fold] = with_closings(*fold_element(fold));
  return *divisors_[fold];
}

std::vector<SheetFactor> Elimination::natural_factors(const Poly& natural, bool with_implicit,
                                                      std::vector<Poly>* without_curves) const {
  // With the closing points written by others, which is the first that is put in, elements divide as polynomials.
  Poly rest = with_closings(natural);
  const std::size_t closings = geometry_->closings().size();
  core::ensure(!rest.is_zero(), "what is factored over the tower is not zero there");
  std::vector<PolyFactor> elements;
  for (std::size_t i = 0; i < geometry_->folds().size() && closings > 0; ++i) {
    if (!fold_element(i)) continue;
    Poly quotient(natural.ring());
    int times = 0;
    for (; rest.divides(fold_divisor(i), quotient); ++times) std::swap(rest, quotient);
    if (times == 0) continue;
    Rational constant;
    for (const PolyFactor& part : geometry_->folds()[i].where.factors(constant))
      elements.push_back({part.poly, part.multiplicity * times});
  }
  if (elements.empty()) return sheet_factors(over_tower(natural), with_implicit, without_curves);
  std::vector<PolyFactor> factors = factors_over_tower(strip_denominators(put_in(std::move(rest), closings)));
  for (PolyFactor& element : elements) {
    const auto known = std::find_if(factors.begin(), factors.end(),
                                    [&](const PolyFactor& factor) { return factor.poly == element.poly; });
    if (known == factors.end())
      factors.push_back(std::move(element));
    else
      known->multiplicity += element.multiplicity;
  }
  return described(factors, with_implicit, without_curves);
}

std::vector<SheetFactor> Elimination::described(const std::vector<PolyFactor>& factors, bool with_implicit,
                                                std::vector<Poly>* without_curves) const {
  std::vector<SheetFactor> result;
  for (const PolyFactor& factor : factors) {
    if (!has_free_coordinate(factor.poly) || is_denominator(factor.poly)) continue;
    SheetFactor entry{factor.poly, factor.multiplicity, {}};
    entry.of_divided = std::any_of(divided_roots_.begin(), divided_roots_.end(), [&](const DividedRoot& divided) {
      return factor.poly == Poly::variable(factor.poly.ring(), geometry_->roots()[divided.root].variable);
    });
    if (entry.of_divided) {
      result.push_back(std::move(entry));
      continue;
    }
    if (with_implicit && is_too_heavy(factor.poly)) {
      entry.too_heavy = true;
    } else if (with_implicit) {
      entry.implicit = implicit_factors(factor.poly);
      if (entry.implicit.empty()) {
        if (without_curves != nullptr) without_curves->push_back(factor.poly);
        continue;
      }
    }
    result.push_back(std::move(entry));
  }
  return result;
}

const std::vector<double>& Elimination::degree_weights() const {
  if (!degree_weights_.empty()) return degree_weights_;
  // A root weighs half the degree of its square; weights of nested ones add up from the first on.
  std::vector<double> weight(static_cast<std::size_t>(geometry_->ring().size()), 0.0);
  for (int i = 0; i < geometry_->coordinates(); ++i) weight[static_cast<std::size_t>(i)] = 1;
  for (const TowerRoot& root : geometry_->roots())
    weight[static_cast<std::size_t>(root.variable)] = root.square.weighted_degree(weight) / 2;
  return degree_weights_ = std::move(weight);
}

template <class P>
double Elimination::norm_degree(const P& sheet) const {
  const auto& roots = geometry_->roots();
  const std::vector<std::size_t> under = core::roots_under(
      roots.size(), [&](std::size_t j) { return sheet.depends_on(roots[j].variable); },
      [&](std::size_t k, std::size_t j) { return roots[k].square.depends_on(roots[j].variable); });
  return std::ldexp(sheet.weighted_degree(degree_weights()), static_cast<int>(under.size()));
}

template <class P>
bool Elimination::has_angle(const P& sheet) const {
  const auto& roots = geometry_->roots();
  return std::any_of(roots.begin(), roots.end(),
                     [&](const TowerRoot& root) { return root.is_angle() && sheet.depends_on(root.variable); });
}

bool Elimination::has_angle_over_tower(const Poly& natural) const { return has_angle(over_tower_on_line(natural)); }

bool Elimination::is_too_heavy(const Poly& sheet) const {
  return has_angle(sheet) /* no polynomial has its zeros */ || is_beyond_use(norm_degree(sheet));
}

bool Elimination::is_beyond_use(double norm_degree) const {
  // Three coordinates have many more terms of one degree than two, one has few.
  return norm_degree > (geometry_->coordinates() == 1 ? 400 : geometry_->coordinates() == 2 ? 140 : 40);
}

bool Elimination::is_too_heavy_over_tower(const Poly& natural) const {
  // On the line its degree is the same, and so is what divides it.
  const ResiduePoly& image = over_tower_on_line(natural);
  return has_angle(image) || is_beyond_use(norm_degree(image));
}

const LineImage& Elimination::line_image() const {
  if (!line_image_) {
    std::vector<Poly> divisors = stripped_;
    divisors.insert(divisors.end(), known_denominators_.begin(), known_denominators_.end());
    line_image_ = std::make_unique<LineImage>(*geometry_, divisors, denominator_factors_, independent_roots_);
  }
  return *line_image_;
}

std::vector<Poly> Elimination::implicit_factors(const Poly& sheet) const {
  std::vector<Poly> found;
  eliminate(sheet, found);
  return found;
}

std::vector<Poly> Elimination::implicit_of_divisor(const Poly& divisor) const {
  std::vector<Poly> found;
  eliminate(divisor, found, true);
  return found;
}

void Elimination::eliminate(Poly p, std::vector<Poly>& found, bool keeps_divisors) const {
  if (!keeps_divisors) p = strip_denominators(std::move(p));
  const auto& roots = geometry_->roots();
  const auto top = std::find_if(roots.rbegin(), roots.rend(), [&](const auto& r) { return p.depends_on(r.variable); });
  if (top == roots.rend()) {
    Rational constant;
    for (const PolyFactor& factor : p.factors(constant)) {
      if (has_free_coordinate(factor.poly) && (keeps_divisors || !is_denominator(factor.poly)))
        insert_distinct(found, factor.poly);
    }
    return;
  }
  auto [a, b] = split(p, top->variable);
  // What the two parts share vanishes for either sign; only the rest needs its conjugate.
  const Poly shared = gcd(a, b);
  if (!shared.is_constant()) {
    eliminate(shared, found, keeps_divisors);
    a = a.exact_quotient(shared);
    b = b.exact_quotient(shared);
  }
  const Poly norm = geometry_->reduce(a.squared() - b.squared() * top->square);
  // Roots that are equal but for their signs: p vanishes identically for one sign and is 2 a for the other.
  if (norm.is_zero())
    eliminate(a, found, keeps_divisors);
  else
    eliminate(norm, found, keeps_divisors);
}

const ResiduePoly& Elimination::over_tower_on_line(const Poly& natural) const {
  for (const auto& [asked, result] : over_tower_on_line_)
    if (asked == natural) return result;
  const LineImage& line = line_image();
  return over_tower_on_line_
      .emplace_back(natural, stretched(natural) != nullptr ? line.of(over_tower(natural)) : line.over_tower(natural))
      .second;
}

ResiduePoly Elimination::norm_on_line(const Poly& natural) const {
  return line_image().norm(over_tower_on_line(natural));
}

bool Elimination::may_share_curve(const ResiduePoly& norm_a, const ResiduePoly& norm_b) {
  return !gcd(norm_a, norm_b).is_constant();
}

}  // namespace clearloci::symbolic
