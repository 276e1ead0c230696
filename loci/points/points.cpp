#include "loci/points/points.hpp"

#include <algorithm>
#include <optional>

#include "core/errors.hpp"
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
      : RootPlace(tower, mode, root.lower, root.upper, &root) {}
  /// Where no polynomial is known: signs are told by intervals, or throw NotTold.
  RootPlace(const core::RootTower& tower, const core::WorkingMode& mode, const SheetRoot& root)
      : RootPlace(tower, mode, root.lower, root.upper, nullptr) {}

 private:
  RootPlace(const core::RootTower& tower, const core::WorkingMode& mode, const Rational& lower, const Rational& upper,
            RealRoot* root)
      : tower_(tower), root_(root) {
    values_.emplace_back(lower, upper);
    for (std::size_t j = 0; j < tower.roots.size(); ++j) {
      if (tower.roots[j].is_angle()) {
        place_angle(tower.roots[j]);
        continue;
      }
      const int square = sign(tower.roots[j].square);
      if (square < 0) {
        reachable_ = false;
        return;
      }
      const MultiInterval s = square == 0 ? MultiInterval(0.0) : square_root(evaluate(tower.roots[j].square, values_));
      values_.push_back(mode[j] > 0 ? s : -s);
      signs_.push_back(square == 0 ? 0 : mode[j]);
    }
  }

 public:
  bool reachable() const { return reachable_; }
  /// One a root; required: reachable().
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

/// How the zeros of a factor are found. `open`: it holds an angle, and enclosures have not told its zeros.
enum class Search { by_polynomial, on_sheet, open };

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
  if (has_angle(factor.sheet, tower)) return Search::on_sheet;
  const bool heavy = factor.role != FactorRole::workspace_boundary && norm_degree(factor.sheet, tower) > heavy_degree;
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

/// The same at a simple zero of one factor where nothing else vanishes. Where something else may, throws NotTold; with
/// an angle, which polynomials would tell nothing of, it is not proven.
std::vector<EdgeLabel> labels_at(const LocusProblem& problem, std::size_t factor, RootPlace& place) {
  std::vector<bool> vanishing(problem.factors.size()), margins(problem.factors.size());
  const bool own_angle = has_angle(problem.factors[factor].sheet, problem.tower);
  bool proven = true;
  const auto look_at = [&](const Polynomial& other) {
    try {
      place.sign(other);
    } catch (const NotTold&) {
      if (!own_angle && !has_angle(other, problem.tower)) throw;
      proven = false;
    }
  };
  for (std::size_t f = 0; f < problem.factors.size(); ++f)
    if (f != factor && problem.factors[f].role != FactorRole::construction) look_at(problem.factors[f].sheet);
  for (const auto& [sheet, power] : problem.factors[factor].cleared) look_at(sheet);
  vanishing[factor] = true;
  margins[factor] = problem.factors[factor].role == FactorRole::margin;
  const bool compared = is_of_determinants(problem.factors[factor].role);
  const ReactionOrders orders = compared ? orders_at_simple_zero(problem, static_cast<int>(factor)) : ReactionOrders{};
  std::vector<EdgeLabel> labels = labels_from(problem, orders, vanishing, margins);
  for (EdgeLabel& label : labels) label.proven = proven;
  return labels;
}

/// Whether a mode reaches the open interval between two neighbouring candidates.
bool reaches(const LocusProblem& problem, const core::WorkingMode& mode, const Rational& from, const Rational& to) {
  const Rational at = (from + to) / 2;
  RealRoot sample = {{-at.get_num(), at.get_den()}, at, at};
  return RootPlace(problem.tower, mode, sample).reachable();
}

/// A point of a mode before it is one of the map's: an exact one, or a zero of one factor on the sheet.
struct Event {
  RealRoot* exact = nullptr;
  SheetRoot zero;
  std::size_t factor = 0;

  const Rational& lower() const { return exact != nullptr ? exact->lower : zero.lower; }
  const Rational& upper() const { return exact != nullptr ? exact->upper : zero.upper; }
};

/// The zeros on a mode's sheet of the factors that are looked for there; `refused`: the first for which that failed.
std::optional<std::vector<Event>> zeros_on_sheet(const LocusProblem& problem, const core::WorkingMode& mode,
                                                 std::vector<RealRoot>& roots, const std::vector<Search>& searches,
                                                 std::size_t& refused) {
  std::vector<Event> events;
  if (std::find(searches.begin(), searches.end(), Search::on_sheet) == searches.end()) return events;
  struct End {
    StretchEnd place;
    std::optional<RootPlace> at;
  };
  std::vector<RealRoot> box;
  for (const Rational& side : {problem.lower[0], problem.upper[0]})
    box.push_back({{-side.get_num(), side.get_den()}, side, side});
  std::vector<RealRoot*> sides = {&box[0]};
  for (RealRoot& root : roots)
    if (root.lower > problem.lower[0] && root.upper < problem.upper[0]) sides.push_back(&root);
  sides.push_back(&box[1]);
  std::vector<End> ends;
  for (RealRoot* side : sides) {
    End& end = ends.emplace_back(End{{side->lower, side->upper, {}, false}, RootPlace(problem.tower, mode, *side)});
    if (end.at->reachable()) end.place.vanishing = end.at->vanishing_roots();
  }
  const Rational range = problem.upper[0] - problem.lower[0];
  const Rational width = range / Rational(core::Integer(1) << halvings),
                 enough = range / Rational(core::Integer(1) << least_halvings);
  for (std::size_t f = 0; f < problem.factors.size(); ++f) {
    if (searches[f] != Search::on_sheet) continue;
    refused = f;
    SheetRoots search(problem.tower, mode, problem.factors[f]);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (!reaches(problem, mode, ends[i].place.upper, ends[i + 1].place.lower)) continue;
      if (!ends[i].at->reachable() || !ends[i + 1].at->reachable()) return std::nullopt;
      for (const std::size_t side : {i, i + 1})
        ends[side].place.function_is_zero = ends[side].at->sign(problem.factors[f].sheet) == 0;
      // At a side of the box a zero is a point itself.
      if ((i == 0 && ends[i].place.function_is_zero) || (i + 2 == ends.size() && ends[i + 1].place.function_is_zero))
        return std::nullopt;
      std::optional<std::vector<SheetRoot>> found = search.between(ends[i].place, ends[i + 1].place, width, enough);
      if (!found) return std::nullopt;
      for (SheetRoot& zero : *found) events.push_back({nullptr, std::move(zero), f});
    }
  }
  return events;
}

/// Adds the points of a mode. False: they are not all told, and the factor `refused` is to be eliminated.
bool add_mode(const LocusProblem& problem, const core::WorkingMode& mode, std::vector<RealRoot>& roots,
              const std::vector<Search>& searches, LocusMap& map, std::size_t& refused) {
  std::optional<std::vector<Event>> events = zeros_on_sheet(problem, mode, roots, searches, refused);
  if (!events) return false;
  for (RealRoot& root : roots) events->push_back({&root, {}, 0});
  std::sort(events->begin(), events->end(), [](const Event& a, const Event& b) { return a.lower() < b.lower(); });
  for (std::size_t i = 0; i + 1 < events->size(); ++i) {
    const Event &a = (*events)[i], &b = (*events)[i + 1];
    if (a.upper() < b.lower() || (a.exact != nullptr && b.exact != nullptr)) continue;
    const auto holds_angle = [&](const Event& event) {
      return event.exact == nullptr && has_angle(problem.factors[event.factor].sheet, problem.tower);
    };
    if (holds_angle(a) || holds_angle(b)) continue;      // perhaps one point: labels say that it is not proven
    refused = a.exact == nullptr ? a.factor : b.factor;  // only polynomials can tell
    return false;
  }
  std::vector<core::IsolatedPoint> points;
  std::vector<core::ReachableInterval> intervals;
  Rational from = problem.lower[0];
  double start = core::to_double(from);
  bool joined = false;  // the point before the cell is reachable, and so is the cell before it
  const auto cell = [&](const Rational& to, double end, bool end_reachable) {
    const bool reached = from < to && reaches(problem, mode, from, to);
    if (reached && joined && !intervals.empty())
      intervals.back().to = end;
    else if (reached)
      intervals.push_back({mode, start, end});
    joined = end_reachable && (reached || from >= to);
    start = end;
  };
  for (const Event& event : *events) {
    refused = event.factor;
    const double at = core::to_double((event.lower() + event.upper()) / 2);
    std::vector<EdgeLabel> labels;
    try {
      RootPlace place = event.exact != nullptr ? RootPlace(problem.tower, mode, *event.exact)
                                               : RootPlace(problem.tower, mode, event.zero);
      cell(event.lower(), at, place.reachable());
      from = event.upper();
      if (!place.reachable()) continue;
      const bool undefined = std::any_of(problem.tower.denominators.begin(), problem.tower.denominators.end(),
                                         [&](const Polynomial& denominator) { return place.sign(denominator) == 0; });
      if (undefined) continue;
      labels = event.exact != nullptr ? labels_at(problem, mode, *event.exact, place)
                                      : labels_at(problem, event.factor, place);
    } catch (const NotTold&) {
      return false;
    }
    for (EdgeLabel& label : labels) {
      core::IsolatedPoint point;
      point.kind = label.kind;
      point.vanishing = std::move(label.vanishing);
      point.at = {at};
      point.mode = mode;
      point.certified = label.proven;
      point.factor = std::move(label.factor);
      point.cause = std::move(label.cause);
      point.excited = label.excited;
      points.push_back(std::move(point));
    }
  }
  cell(problem.upper[0], core::to_double(problem.upper[0]), false);
  map.isolated_points.insert(map.isolated_points.end(), points.begin(), points.end());
  map.reachable.insert(map.reachable.end(), intervals.begin(), intervals.end());
  return true;
}

}  // namespace

namespace {

/// What a factor makes vanish, in a line: formulas of it may fill pages.
std::string words_of(const LocusFactor& factor) {
  if (!factor.cause.empty()) return factor.cause;
  if (factor.role == FactorRole::direct_singularity) return "|A|";
  std::string names;
  for (const Vanishing& vanishing : factor.vanishing)
    names += (names.empty() ? "" : ", ") + core::to_string(vanishing.quantity) + " of " + vanishing.joint;
  return names.empty() ? "a factor" : names;
}

}  // namespace

void add_points_of_one_coordinate(const LocusProblem& problem, const TraceOptions& options, LocusMap& map) {
  core::ensure(problem.tower.coordinates.size() == 1, "one free coordinate");
  std::vector<Search> searches;
  for (const LocusFactor& factor : problem.factors) searches.push_back(search_of(factor, problem.tower));
  std::vector<RealRoot> roots = candidates(problem, searches);
  for (std::size_t m = 0; m < problem.modes.size(); ++m) {
    if (options.progress) options.progress(static_cast<double>(m) / static_cast<double>(problem.modes.size()), "roots");
    for (std::size_t refused = 0;;) {
      if (options.deadline && std::chrono::steady_clock::now() > *options.deadline)
        throw core::LimitReached("the time limit was reached");
      if (add_mode(problem, problem.modes[m], roots, searches, map, refused)) break;
      const LocusFactor& factor = problem.factors[refused];
      if (has_angle(factor.sheet, problem.tower)) {
        searches[refused] = Search::open;
        map.notes.push_back("undecided: zeros of " + words_of(factor) +
                            ", with an angle that enclosures do not tell from its zeros");
      } else {
        searches[refused] = Search::by_polynomial;
        roots = candidates(problem, searches);
      }
    }
  }
}

}  // namespace clearloci::loci
