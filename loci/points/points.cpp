#include "loci/points/points.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "core/dense_terms.hpp"
#include "core/errors.hpp"
#include "core/fold.hpp"
#include "core/reduced.hpp"
#include "loci/curves/curves.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/points/sheet_roots.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusFactor;
using core::LocusKind;
using core::LocusMap;
using core::LocusProblem;
using core::Polynomial;
using core::Rational;
using sheet::MultiInterval;

/// Halvings of an isolating interval before its point is given as a double and before intervals decide signs.
constexpr int halvings = 120;
/// The same of a zero on the sheet, whose function may be too small next to it for signs at more: still far below the
/// spacing of doubles.
constexpr int least_halvings = 80;

/// The degree from which on zeros are looked for on the sheets: eliminating its roots and isolating those of the
/// product takes longer than enclosures do, and with the degree more and more of them belong to other modes.
constexpr double heavy_degree = 48;

/// A sign at a zero that is known by its enclosure alone was not told by intervals.
struct NotTold {};

/// The configurations of one mode at one value of the coordinate.
class RootPlace {
 public:
  RootPlace(const core::RootTower& tower, const core::WorkingMode& mode, RealRoot& root)
      : RootPlace(tower, mode, root, tower.roots.size()) {}
  /// Of the roots whose squares hold an angle those before `first_unplaced` alone.
  RootPlace(const core::RootTower& tower, const core::WorkingMode& mode, RealRoot& root, std::size_t first_unplaced)
      : tower_(tower), root_(&root) {
    place_roots(mode, {root.lower, root.upper}, {}, first_unplaced);
  }
  /// Where no polynomial is known: signs are told by intervals, or throw NotTold. `vanishing`: a root that is zero
  /// there.
  RootPlace(const core::RootTower& tower, const core::WorkingMode& mode, const SheetRoot& root,
            std::optional<std::size_t> vanishing)
      : tower_(tower), root_(nullptr) {
    place_roots(mode, {root.lower, root.upper}, vanishing, tower.roots.size());
  }

  bool reachable() const { return reachable_; }
  /// One a root; required: reachable(). What holds an angle counts where it is not told from zero.
  std::vector<bool> vanishing_roots() const {
    std::vector<bool> list;
    for (const int sign : signs_) list.push_back(sign == 0);
    return list;
  }

  /// Exact: intervals where they decide, else signs of the parts (loci/curves/sheet_sign.hpp). Of what holds an angle 0
  /// means that it is not told from zero.
  int sign(const LocusFactor& factor) {
    const Polynomial& p = factor.sheet;
    if (const int quick = evaluate(p, values_).sign(); quick != 0 || p.is_zero()) return quick;
    const bool norm_vanishes =
        root_ != nullptr && is_of_determinants(factor.role) &&
        std::any_of(factor.implicit.begin(), factor.implicit.end(),
                    [&](const Polynomial& curve) { return sign_at(univariate_signed(curve), *root_) == 0; });
    return norm_vanishes && vanishes_where_norm_does(p, tower_, values_) ? 0 : sign(p);
  }
  int sign(const Polynomial& p) {
    const int quick = evaluate(p, values_).sign();
    if (quick != 0 || p.is_zero()) return quick;
    if (root_ == nullptr) throw NotTold{};
    if (has_angle(p, tower_)) return 0;
    const int top = top_root(p, tower_);
    if (top < 0) return sign_at(univariate_signed(p), *root_) * leading_sign(p);
    const auto [a, b] = split(p, static_cast<int>(tower_.coordinates.size()) + top);
    const int sign_a = sign(a);
    const int product = sign(b) * signs_[static_cast<std::size_t>(top)];
    if (product == 0 || product == sign_a) return sign_a;
    if (sign_a == 0) return product;
    return sign_a * sign(conjugate_product(p, top, tower_));
  }

 private:
  void place_roots(const core::WorkingMode& mode, const MultiInterval& at, std::optional<std::size_t> vanishing,
                   std::size_t first_unplaced) {
    values_.push_back(at);
    for (std::size_t j = 0; j < tower_.roots.size(); ++j) {
      if (tower_.roots[j].is_angle()) {
        place_angle(tower_.roots[j]);
        continue;
      }
      const bool unplaced = j >= first_unplaced && is_root_of_angle(tower_, j);
      const int square = unplaced ? 1 : j == vanishing ? 0 : sign(tower_.roots[j].square);
      if (square < 0) {
        reachable_ = false;
        return;
      }
      const MultiInterval s =
          square == 0 || unplaced ? MultiInterval(0.0) : square_root(evaluate(tower_.roots[j].square, values_));
      values_.push_back(mode[j] > 0 ? s : -s);
      signs_.push_back(square == 0 ? 0 : mode[j]);
    }
  }
  void place_angle(const core::Root& root) {
    const std::size_t placed = values_.size();
    values_.resize(static_cast<std::size_t>(tower_.variables()), MultiInterval(0.0));
    const MultiInterval turned = sheet::angle_root(root, values_);
    values_.resize(placed);
    values_.push_back(turned);
    signs_.push_back(1);
  }
  Univariate univariate_signed(const Polynomial& p) const { return univariate(core::with_variables(p, 1)); }
  /// `univariate` makes the leading coefficient positive.
  static int leading_sign(const Polynomial& p) { return sgn(p.terms.front().coefficient); }

  const core::RootTower& tower_;
  RealRoot* root_;
  std::vector<MultiInterval> values_;  ///< coordinate, then the roots placed so far
  std::vector<int> signs_;
  bool reachable_ = true;
};

/// How the zeros of a factor are found. `with_its_root`: it bounds the workspace with an angle.
enum class Search { by_polynomial, on_sheet, with_its_root };

/// Every value of the coordinate where some factor may vanish, ascending, but for those that are looked for on sheets.
std::vector<RealRoot> candidates(const LocusProblem& problem, const std::vector<Search>& searches) {
  std::vector<Univariate> polynomials;
  const auto add = [&](const Polynomial& p) {
    if (p.is_zero() || p.is_constant()) return;
    Univariate part = square_free_part(univariate(p));
    if (std::find(polynomials.begin(), polynomials.end(), part) == polynomials.end())
      polynomials.push_back(std::move(part));
  };
  for (std::size_t f = 0; f < problem.factors.size(); ++f) {
    const LocusFactor& factor = problem.factors[f];
    if (factor.role == FactorRole::construction || searches[f] != Search::by_polynomial) continue;
    for (const Polynomial& p : factor.implicit) add(p);
    if (factor.implicit.empty()) add(norm(factor.sheet, problem.tower));
  }
  for (const core::Root& root : problem.tower.roots)
    if (!root.is_angle() && !has_angle(root.square, problem.tower)) add(norm(root.square, problem.tower));
  std::vector<RealRoot> roots;
  for (const Univariate& p : coprime_base(polynomials))
    for (RealRoot& root : real_roots(p, problem.lower[0], problem.upper[0])) {
      narrow_by(root, halvings);
      roots.push_back(std::move(root));
    }
  // No two are equal: narrowing ends.
  for (std::size_t i = 0; i < roots.size(); ++i)
    for (std::size_t k = i + 1; k < roots.size(); ++k)
      while (roots[i].lower <= roots[k].upper && roots[k].lower <= roots[i].upper) {
        narrow(roots[i]);
        narrow(roots[k]);
      }
  std::sort(roots.begin(), roots.end(), [](const RealRoot& a, const RealRoot& b) { return a.lower < b.lower; });
  return roots;
}

/// How polynomials in the coordinate vanish towards a root: to the order of the first derivative that does not.
CoordinateGerm germs_at(RealRoot& root) {
  return [&root](const Polynomial& p, int side) -> std::optional<Germ> {
    Polynomial derivative = core::with_variables(p, 1);
    Germ germ;
    for (int direction = 1; !derivative.is_zero(); direction *= side) {
      germ.sign = direction * sgn(derivative.terms.front().coefficient) * sign_at(univariate(derivative), root);
      if (germ.sign != 0) break;
      germ.order += 1;
      derivative = core::derivative(derivative, 0);
    }
    return germ;
  };
}

Search search_of(const LocusFactor& factor, const core::RootTower& tower) {
  if (factor.role == FactorRole::construction || !factor.implicit.empty()) return Search::by_polynomial;
  const bool bounds = factor.role == FactorRole::workspace_boundary;
  if (has_angle(factor.sheet, tower)) return bounds ? Search::with_its_root : Search::on_sheet;
  const bool heavy = !bounds && norm_degree(factor.sheet, tower) > heavy_degree;
  return heavy ? Search::on_sheet : Search::by_polynomial;
}

/// `vanishing`: of every factor, whether it does; `margins`: of those that are margins, whether reactions are at
/// theirs.
std::vector<EdgeLabel> labels_from(const LocusProblem& problem, const ReactionOrders& orders,
                                   const std::vector<bool>& vanishing, const std::vector<bool>& margins) {
  std::vector<EdgeLabel> labels;
  const auto context = [&](LocusKind kind, const LocusFactor& factor) {
    const bool named = kind == LocusKind::margin || kind == LocusKind::preload;
    for (EdgeLabel& label : labels)
      if (label.kind == kind && !named) {
        label.factor += "; " + factor.expression;
        if (!factor.cause.empty()) label.cause += (label.cause.empty() ? "" : "; ") + factor.cause;
        return;
      }
    const std::vector<core::Vanishing> held = named ? factor.vanishing : std::vector<core::Vanishing>{};
    const bool excited = kind != LocusKind::direct_singularity || !orders.decided || orders.excited;
    labels.push_back({kind, held, factor.expression, factor.cause, excited});
  };
  for (std::size_t f = 0; f < problem.factors.size(); ++f) {
    const LocusFactor& factor = problem.factors[f];
    if (!vanishing[f]) continue;
    if (factor.role == FactorRole::margin && margins[f]) context(LocusKind::margin, factor);
    if (factor.role == FactorRole::preload) context(LocusKind::preload, factor);
    if (factor.role == FactorRole::direct_singularity) context(LocusKind::direct_singularity, factor);
    if (factor.role == FactorRole::workspace_boundary) context(LocusKind::workspace_boundary, factor);
  }
  EdgeLabel label = reaction_label(problem, orders);
  if (!label.vanishing.empty()) labels.insert(labels.begin(), std::move(label));
  return labels;
}

/// The factors of the workspace boundary alone.
std::vector<EdgeLabel> ends_of_reach_at(const LocusProblem& problem, RootPlace& place) {
  std::vector<bool> vanishing, margins(problem.factors.size());
  for (const LocusFactor& factor : problem.factors)
    vanishing.push_back(factor.role == FactorRole::workspace_boundary && place.sign(factor) == 0);
  std::vector<EdgeLabel> labels = labels_from(problem, ReactionOrders{}, vanishing, margins);
  for (EdgeLabel& label : labels) label.proven = true;
  return labels;
}

/// What vanishes at one point of a mode.
std::vector<EdgeLabel> labels_at(const LocusProblem& problem, const core::WorkingMode& mode, RealRoot& root,
                                 RootPlace& place) {
  std::vector<int> compared;
  std::vector<const LocusFactor*> untold;
  std::vector<bool> vanishing(problem.factors.size()), margins(problem.factors.size());
  bool proven = true;
  for (std::size_t f = 0; f < problem.factors.size(); ++f) {
    const LocusFactor& factor = problem.factors[f];
    vanishing[f] = factor.role != FactorRole::construction && place.sign(factor) == 0;
    if (!vanishing[f]) continue;
    // Whether what holds an angle vanishes at the very zero of something else is never told.
    if (has_angle(factor.sheet, problem.tower)) {
      proven = false;
      if (factor.role == FactorRole::reaction) untold.push_back(&factor);
    } else if (is_of_determinants(factor.role)) {
      compared.push_back(static_cast<int>(f));
    }
  }
  ArcOrders point(problem.tower, mode, germs_at(root), {{root.lower, root.upper}});
  const ReactionOrders orders = compared.empty() ? ReactionOrders{} : reaction_orders(problem, point, compared);
  // The end of the range and of the reach at once: no side to come from.
  const bool decided = compared.empty() || orders.decided || point.sides().empty();
  core::ensure(decided || core::has_angles(problem.tower), "orders at a point are always decided");
  for (std::size_t f = 0; f < problem.factors.size(); ++f) {
    if (!vanishing[f] || problem.factors[f].role != FactorRole::margin) continue;
    margins[f] =
        has_angle(problem.factors[f].sheet, problem.tower) || is_margin(problem.factors[f], point).value_or(true);
  }
  std::vector<EdgeLabel> labels = labels_from(problem, orders, vanishing, margins);
  if (!untold.empty() && !orders.singular) {
    EdgeLabel label = reaction_label(problem, untold);
    if (!label.vanishing.empty()) labels.insert(labels.begin(), std::move(label));
  }
  for (EdgeLabel& label : labels) label.proven = proven && decided;
  return labels;
}

/// The same at a simple zero of one factor where nothing else vanishes, but for what has the same sheet. Where
/// something else may, throws NotTold; with an angle, which polynomials would tell nothing of, it is not proven.
std::vector<EdgeLabel> labels_at(const LocusProblem& problem, std::size_t factor, RootPlace& place) {
  const LocusFactor& own = problem.factors[factor];
  std::vector<bool> vanishing(problem.factors.size()), margins(problem.factors.size());
  std::vector<const LocusFactor*> perhaps;  // reactions, with that which is zero for certain
  const bool own_angle = has_angle(own.sheet, problem.tower);
  bool proven = true;
  std::vector<int> compared;  // each of the first order
  const auto is_told = [&](const Polynomial& other) {
    try {
      place.sign(other);
    } catch (const NotTold&) {
      if (!own_angle && !has_angle(other, problem.tower)) throw;
      return false;
    }
    return true;
  };
  for (std::size_t f = 0; f < problem.factors.size(); ++f) {
    const LocusFactor& other = problem.factors[f];
    if (other.role == FactorRole::construction) continue;
    vanishing[f] = f == factor || (own_angle && other.sheet == own.sheet);
    margins[f] = vanishing[f] && other.role == FactorRole::margin;
    if (vanishing[f] && is_of_determinants(other.role)) compared.push_back(static_cast<int>(f));
    const bool told = vanishing[f] || is_told(other.sheet);
    proven = proven && told;
    if (other.role == FactorRole::reaction && (vanishing[f] || !told)) perhaps.push_back(&other);
  }
  for (const auto& [sheet, power] : own.cleared) proven = is_told(sheet) && proven;
  const ReactionOrders orders = compared.empty() ? ReactionOrders{} : orders_at_simple_zero(problem, compared.front());
  std::vector<EdgeLabel> labels = labels_from(problem, orders, vanishing, margins);
  for (std::size_t k = 1; k < compared.size(); ++k) {
    EdgeLabel label = reaction_label(problem, orders_at_simple_zero(problem, compared[k]));
    if (!label.vanishing.empty()) labels.insert(labels.begin(), std::move(label));
  }
  if (perhaps.size() > 1 && !orders.singular) {  // what no factor makes vanish alone two may together
    EdgeLabel label = reaction_label(problem, perhaps);
    for (const LocusFactor* one : perhaps) {
      const std::vector<core::Vanishing> alone = reaction_label(problem, std::vector{one}).vanishing;
      std::erase_if(label.vanishing, [&](const core::Vanishing& each) {
        return std::find(alone.begin(), alone.end(), each) != alone.end();
      });
    }
    if (!label.vanishing.empty()) labels.insert(labels.begin(), std::move(label));
  }
  for (EdgeLabel& label : labels) label.proven = proven;
  return labels;
}

/// A point of a mode before it is one of the map's: an exact one, or a zero of one factor on the sheet.
struct Event {
  RealRoot* exact = nullptr;
  SheetRoot zero = {};
  std::size_t factor = 0;
  std::optional<std::size_t> root = {};  ///< of the tower, which holds an angle and ends the reach in `zero`
  bool open = false;                     ///< it may do so in `zero`, or not

  const Rational& lower() const { return exact != nullptr ? exact->lower : zero.lower; }
  const Rational& upper() const { return exact != nullptr ? exact->upper : zero.upper; }
};

bool is_before(const Event& a, const Event& b) { return a.lower() < b.lower(); }

/// Whether the reach may end where root j vanishes, which no polynomial tells.
bool ends_by_angle(const core::RootTower& tower, std::size_t j) {
  const core::Root& root = tower.roots[j];
  return is_root_of_angle(tower, j) &&
         (root.role == core::RootRole::working_mode || root.name == core::limit_name || root.name == core::fold_name);
}

/// The sheet of a mode over the range, cut where polynomials tell that something vanishes, and where roots that hold
/// angles do: between neighbouring cuts it is reached all along, or nowhere, or that is open.
class SheetLine {
 public:
  /// `roots` outlive this.
  SheetLine(const LocusProblem& problem, const core::WorkingMode& mode, std::vector<RealRoot>& roots)
      : problem_(problem), mode_(mode) {
    const Rational range = problem.upper[0] - problem.lower[0];
    width_ = range / Rational(core::Integer(1) << halvings);
    enough_ = range / Rational(core::Integer(1) << least_halvings);
    for (const Rational& side : {problem.lower[0], problem.upper[0]}) sides_.push_back(number(side));
    std::vector<Event> cuts = {{&sides_[0]}};
    for (RealRoot& root : roots)
      if (root.lower > problem.lower[0] && root.upper < problem.upper[0]) cuts.push_back({&root});
    cuts.push_back({&sides_[1]});
    for (std::size_t j = 0; j < problem.tower.roots.size(); ++j) {
      if (!ends_by_angle(problem.tower, j)) continue;
      cuts_ = placed(cuts, j);
      LocusFactor square;
      square.sheet = problem.tower.roots[j].square;
      square.line = problem.tower.roots[j].line;
      squares_.emplace_back(j, std::make_unique<SheetRoots>(problem.tower, mode, square, true));
      const StretchZeros found = zeros(square, *squares_.back().second, j);
      for (const SheetRoot& zero : found.zeros) ends_of_reach_.push_back({nullptr, zero, 0, j});
      for (const SheetRoot& place : found.open) ends_of_reach_.push_back({nullptr, place, 0, j, true});
      const std::size_t added = found.zeros.size() + found.open.size();
      cuts.insert(cuts.end(), ends_of_reach_.end() - static_cast<std::ptrdiff_t>(added), ends_of_reach_.end());
      std::sort(cuts.begin(), cuts.end(), is_before);
    }
    cuts_ = placed(cuts, problem.tower.roots.size());
  }
  SheetLine(const SheetLine&) = delete;
  SheetLine& operator=(const SheetLine&) = delete;

  /// Where roots that hold angles end the reach, or may.
  const std::vector<Event>& ends_of_reach() const { return ends_of_reach_; }

  /// Whether the mode reaches what is between two neighbouring places.
  bool reaches(const Rational& from, const Rational& to) { return reaches(from, to, problem_.tower.roots.size()); }
  /// Where that is not told: it was taken to reach these.
  const std::vector<Event>& untold() const { return untold_; }

  /// Of a function on the sheet, where it is reached; all of them where it holds an angle, else up to the first place
  /// that is open.
  StretchZeros zeros(const LocusFactor& function) {
    SheetRoots search(problem_.tower, mode_, function, has_angle(function.sheet, problem_.tower));
    return zeros(function, search, problem_.tower.roots.size());
  }

 private:
  struct Cut {
    StretchEnd place;
    std::optional<RootPlace> at;  ///< nothing: not told
    bool open;                    ///< what is in the place itself, which is a range
  };

  static RealRoot number(const Rational& at) { return {{-at.get_num(), at.get_den()}, at, at}; }

  std::vector<Cut> placed(const std::vector<Event>& cuts, std::size_t first_unplaced) const {
    std::vector<Cut> list;
    for (const Event& cut : cuts) {
      Cut& added = list.emplace_back(Cut{{cut.lower(), cut.upper(), {}, false}, {}, cut.open});
      if (cut.open) continue;
      try {
        if (cut.exact != nullptr)
          added.at.emplace(problem_.tower, mode_, *cut.exact, first_unplaced);
        else
          added.at.emplace(problem_.tower, mode_, cut.zero, cut.root);
      } catch (const NotTold&) {
        continue;
      }
      if (added.at->reachable()) added.place.vanishing = added.at->vanishing_roots();
    }
    return list;
  }

  bool reaches(const Rational& from, const Rational& to, std::size_t first_unplaced) {
    std::size_t untold = 0;
    // Where one number is next to a zero of what holds an angle, another one is not.
    for (const int part : {8, 7, 11}) {
      const Rational at = from + (to - from) * core::reduced(part, 16);
      RealRoot sample = number(at);
      const RootPlace place(problem_.tower, mode_, sample, first_unplaced);
      if (!place.reachable()) return false;
      const std::vector<bool> vanishing = place.vanishing_roots();
      bool told = true;
      for (auto& [root, square] : squares_) {
        if (root >= first_unplaced || !vanishing[root]) continue;
        const int sign = square->sign(at);
        if (sign < 0) return false;
        if (sign == 0) untold = root;
        told = told && sign > 0;
      }
      if (told) return true;
    }
    const auto is_known = [&](const Event& event) { return event.zero.lower <= from && event.zero.upper >= to; };
    if (std::none_of(untold_.begin(), untold_.end(), is_known))
      untold_.push_back({nullptr, {from, to}, 0, untold, true});
    return true;
  }

  /// Whether the function is zero at a cut; what holds an angle counts where it is not told from zero. Nothing: not
  /// told.
  std::optional<bool> is_zero_at(Cut& cut, const LocusFactor& function) const {
    if (!cut.at || !cut.at->reachable()) return std::nullopt;
    try {
      return cut.at->sign(function.sheet) == 0;
    } catch (const NotTold&) {
      return has_angle(function.sheet, problem_.tower) ? std::optional(true) : std::nullopt;
    }
  }

  StretchZeros zeros(const LocusFactor& function, SheetRoots& search, std::size_t first_unplaced) {
    const bool all = has_angle(function.sheet, problem_.tower);
    StretchZeros result;
    for (std::size_t i = 0; i + 1 < cuts_.size() && (all || result.open.empty()); ++i) {
      Cut &from = cuts_[i], &to = cuts_[i + 1];
      const Rational &lower = from.place.upper, &upper = to.place.lower;
      if (lower >= upper || !reaches(lower, upper, first_unplaced)) continue;
      // What is beside an open place ends at a number there.
      const auto end_at = [&](Cut& cut, const Rational& side) -> std::optional<StretchEnd> {
        if (cut.open) return StretchEnd{side, side, {}, false};
        const std::optional<bool> is_zero = is_zero_at(cut, function);
        if (!is_zero) return std::nullopt;
        StretchEnd end = cut.place;
        (all ? end.may_own_zero : end.function_is_zero) = *is_zero;
        return end;
      };
      std::optional<StretchEnd> first = end_at(from, lower), last = end_at(to, upper);
      // At a side of the box a zero is a point itself.
      if (!first || !last || (i == 0 && first->function_is_zero) || (i + 2 == cuts_.size() && last->function_is_zero)) {
        result.open.push_back({lower, upper});
        continue;
      }
      if (i == 0) first->may_own_zero = false;
      if (i + 2 == cuts_.size()) last->may_own_zero = false;
      StretchZeros found = search.between(*first, *last, width_, enough_);
      std::move(found.zeros.begin(), found.zeros.end(), std::back_inserter(result.zeros));
      std::move(found.open.begin(), found.open.end(), std::back_inserter(result.open));
    }
    return result;
  }

  const LocusProblem& problem_;
  const core::WorkingMode& mode_;
  std::vector<RealRoot> sides_;
  std::vector<Event> ends_of_reach_, untold_;
  /// Of the roots that hold angles, by root.
  std::vector<std::pair<std::size_t, std::unique_ptr<SheetRoots>>> squares_;
  std::vector<Cut> cuts_;
  Rational width_, enough_;
};

/// A place where zeros of a factor may be.
struct OpenZeros {
  std::size_t factor;
  SheetRoot place;
};

bool overlap(const SheetRoot& a, const SheetRoot& b) { return a.lower <= b.upper && b.lower <= a.upper; }

/// The points and intervals of one mode.
class ModePoints {
 public:
  ModePoints(const LocusProblem& problem, const core::WorkingMode& mode, const std::vector<Search>& searches,
             std::vector<RealRoot>& roots)
      : problem_(problem), mode_(mode), searches_(searches), line_(problem, mode, roots) {
    for (RealRoot& root : roots) events_.push_back({&root});
    for (const Event& end : line_.ends_of_reach()) {
      events_.push_back(end);
      events_.back().factor = factor_of(*end.root);
    }
  }

  /// The factor that is to be eliminated for the points to be told; nothing: they are the map's now.
  std::optional<std::size_t> add_to(LocusMap& map) {
    if (const auto refused = search_on_sheet()) return refused;
    std::sort(events_.begin(), events_.end(), is_before);
    if (const auto refused = unordered()) return refused;
    for (std::size_t i = 0; i < events_.size(); ++i)
      if (const auto refused = add(events_[i], i + 1 < events_.size() ? events_[i + 1].lower() : problem_.upper[0]))
        return refused;
    end_cell(problem_.upper[0], core::to_double(problem_.upper[0]), false);
    for (const Event& event : line_.untold()) open_.push_back({factor_of(*event.root), event.zero});
    for (const OpenZeros& open : open_) leave_open(open);
    std::move(points_.begin(), points_.end(), std::back_inserter(map.isolated_points));
    std::move(intervals_.begin(), intervals_.end(), std::back_inserter(map.reachable));
    std::move(regions_.begin(), regions_.end(), std::back_inserter(map.open));
    return std::nullopt;
  }

 private:
  bool holds_angle(std::size_t factor) const { return has_angle(problem_.factors[factor].sheet, problem_.tower); }

  /// That bounds the workspace where a root vanishes that holds an angle.
  std::size_t factor_of(std::size_t root) const {
    std::optional<std::size_t> first;
    for (std::size_t f = 0; f < problem_.factors.size(); ++f) {
      if (searches_[f] != Search::with_its_root) continue;
      if (core::exact_quotient(problem_.tower.roots[root].square, problem_.factors[f].sheet)) return f;
      if (!first) first = f;
    }
    core::ensure(first.has_value(), "a root that holds an angle has a factor that does");
    return *first;
  }

  /// Of an event that ends the reach: the first such factor that is not told from zero there.
  std::size_t factor_at(const Event& event, RootPlace& place) const {
    for (std::size_t f = 0; event.root && f < problem_.factors.size(); ++f) {
      if (searches_[f] != Search::with_its_root) continue;
      try {
        if (place.sign(problem_.factors[f].sheet) == 0) return f;
      } catch (const NotTold&) {
        return f;
      }
    }
    return event.factor;
  }

  std::optional<std::size_t> search_on_sheet() {
    for (std::size_t f = 0; f < problem_.factors.size(); ++f) {
      if (searches_[f] != Search::on_sheet || is_told_with_another(f)) continue;
      StretchZeros found = line_.zeros(problem_.factors[f]);
      if (!found.open.empty() && !holds_angle(f)) return f;
      for (SheetRoot& zero : found.zeros) events_.push_back({nullptr, std::move(zero), f});
      for (SheetRoot& place : found.open) open_.push_back({f, std::move(place)});
    }
    return std::nullopt;
  }

  /// Of what holds an angle: labels tell all factors of one sheet together.
  bool is_told_with_another(std::size_t factor) const {
    if (!holds_angle(factor)) return false;
    for (std::size_t f = 0; f < factor; ++f)
      if (searches_[f] == Search::on_sheet && problem_.factors[f].sheet == problem_.factors[factor].sheet) return true;
    return false;
  }

  /// Of two events whose order is not known, unless both hold angles: then they may be one, and labels say so.
  std::optional<std::size_t> unordered() const {
    for (std::size_t i = 0; i + 1 < events_.size(); ++i) {
      const Event &a = events_[i], &b = events_[i + 1];
      if (a.upper() < b.lower() || (a.exact != nullptr && b.exact != nullptr)) continue;
      if ((a.exact == nullptr && holds_angle(a.factor)) || (b.exact == nullptr && holds_angle(b.factor))) continue;
      return a.exact == nullptr ? a.factor : b.factor;  // only polynomials can tell
    }
    return std::nullopt;
  }

  /// Up to the next event, at `to`, which is drawn at `end`. Whether the cell is reached.
  bool end_cell(const Rational& to, double end, bool end_reachable) {
    const bool reached = from_ < to && line_.reaches(from_, to);
    if (reached && joined_ && !intervals_.empty())
      intervals_.back().to = end;
    else if (reached)
      intervals_.push_back({mode_, start_, end});
    joined_ = end_reachable && (reached || from_ >= to);
    start_ = end;
    return reached;
  }

  /// `next`: where the cell behind the event ends.
  std::optional<std::size_t> add(const Event& event, const Rational& next) {
    if (event.open) {
      end_cell(event.lower(), core::to_double(event.lower()), false);
      open_.push_back({event.factor, event.zero});
      from_ = event.upper();
      start_ = core::to_double(from_);
      return std::nullopt;
    }
    const double at = core::to_double((event.lower() + event.upper()) / 2);
    std::vector<EdgeLabel> labels;
    try {
      RootPlace place = event.exact != nullptr ? RootPlace(problem_.tower, mode_, *event.exact)
                                               : RootPlace(problem_.tower, mode_, event.zero, event.root);
      const bool reached = end_cell(event.lower(), at, place.reachable());
      from_ = event.upper();
      if (!place.reachable()) return std::nullopt;
      const bool undefined = std::any_of(problem_.tower.denominators.begin(), problem_.tower.denominators.end(),
                                         [&](const Polynomial& denominator) { return place.sign(denominator) == 0; });
      // Nothing is claimed where the ends of equal links meet, but that the reach ends there, if it does.
      if (undefined && reached && from_ < next && line_.reaches(from_, next)) return std::nullopt;
      labels = undefined                ? ends_of_reach_at(problem_, place)
               : event.exact != nullptr ? labels_at(problem_, mode_, *event.exact, place)
                                        : labels_at(problem_, factor_at(event, place), place);
      // What a force must do is a condition on its numerator times |A|, which tells nothing where |A| is zero.
      const std::vector<bool> vanishing = place.vanishing_roots();
      bool at_limit = false;
      for (std::size_t j = 0; j < vanishing.size(); ++j)
        at_limit = at_limit || (vanishing[j] && problem_.tower.roots[j].name == core::limit_name);
      const bool singular = std::any_of(labels.begin(), labels.end(), [](const EdgeLabel& label) {
        return label.kind == LocusKind::direct_singularity;
      });
      if (at_limit && singular && !reached && from_ < next && !line_.reaches(from_, next)) return std::nullopt;
    } catch (const NotTold&) {
      if (!holds_angle(event.factor)) return event.factor;
      open_.push_back({event.factor, event.zero});
      return std::nullopt;
    }
    for (EdgeLabel& label : labels) {
      core::IsolatedPoint point;
      point.kind = label.kind;
      point.vanishing = std::move(label.vanishing);
      point.at = {at};
      point.mode = mode_;
      point.certified = label.proven;
      point.factor = std::move(label.factor);
      point.cause = std::move(label.cause);
      point.excited = label.excited;
      points_.push_back(std::move(point));
    }
    return std::nullopt;
  }

  /// Where a component alone is no locus, with the others that may vanish there.
  void leave_open(const OpenZeros& open) {
    EdgeLabel label = label_of(problem_, {static_cast<int>(open.factor)});
    if (problem_.factors[open.factor].role == FactorRole::reaction) {
      std::vector<const LocusFactor*> together = {&problem_.factors[open.factor]};
      const auto also = [&](std::size_t factor, const SheetRoot& place) {
        const LocusFactor* other = &problem_.factors[factor];
        if (other->role == FactorRole::reaction && overlap(place, open.place) &&
            std::find(together.begin(), together.end(), other) == together.end())
          together.push_back(other);
      };
      for (const OpenZeros& other : open_) also(other.factor, other.place);
      for (std::size_t f = 0; f < problem_.factors.size(); ++f)
        if (problem_.factors[f].sheet == problem_.factors[open.factor].sheet) also(f, open.place);
      for (const Event& event : events_)
        if (event.exact == nullptr) also(event.factor, event.zero);
      label = reaction_label(problem_, together);
      if (label.vanishing.empty()) return;
    }
    regions_.push_back({label.kind,
                        label.vanishing,
                        label.factor,
                        label.cause,
                        mode_,
                        {core::to_double(open.place.lower)},
                        {core::to_double(open.place.upper)}});
  }

  const LocusProblem& problem_;
  const core::WorkingMode& mode_;
  const std::vector<Search>& searches_;
  SheetLine line_;
  std::vector<Event> events_;
  std::vector<OpenZeros> open_;
  std::vector<core::IsolatedPoint> points_;
  std::vector<core::ReachableInterval> intervals_;
  std::vector<core::OpenRegion> regions_;
  // The cell behind the last event.
  Rational from_ = problem_.lower[0];
  double start_ = core::to_double(from_);
  bool joined_ = false;  ///< the last event is reachable, and so is the cell before it
};

}  // namespace

void add_points_of_one_coordinate(const LocusProblem& problem, const TraceOptions& options, LocusMap& map) {
  core::ensure(problem.tower.coordinates.size() == 1, "one free coordinate");
  std::vector<Search> searches;
  for (const LocusFactor& factor : problem.factors) searches.push_back(search_of(factor, problem.tower));
  std::vector<RealRoot> roots = candidates(problem, searches);
  for (std::size_t m = 0; m < problem.modes.size(); ++m) {
    if (options.progress) options.progress(static_cast<double>(m) / static_cast<double>(problem.modes.size()), "roots");
    while (true) {
      if (options.deadline && std::chrono::steady_clock::now() > *options.deadline)
        throw core::LimitReached("the time limit was reached");
      const auto refused = ModePoints(problem, problem.modes[m], searches, roots).add_to(map);
      if (!refused) break;
      searches[*refused] = Search::by_polynomial;
      roots = candidates(problem, searches);
    }
  }
}

}  // namespace clearloci::loci
