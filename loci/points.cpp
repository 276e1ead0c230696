#include "loci/points.hpp"

#include <algorithm>
#include <optional>

#include "core/errors.hpp"
#include "loci/edge_labels.hpp"
#include "loci/sheet/multi_interval.hpp"
#include "loci/tower_algebra.hpp"
#include "loci/univariate.hpp"

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

/// The configurations of one mode at one value of the coordinate.
class Place {
 public:
  Place(const core::RootTower& tower, const core::WorkingMode& mode, RealRoot& root) : tower_(tower), root_(root) {
    values_.emplace_back(root.lower, root.upper);
    for (std::size_t j = 0; j < tower.roots.size(); ++j) {
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

  bool reachable() const { return reachable_; }

  /// Exact: intervals where they decide, else signs of the parts (loci/sheet_sign.hpp).
  int sign(const Polynomial& p) {
    const int quick = evaluate(p, values_).sign();
    if (quick != 0 || p.is_zero()) return quick;
    const int top = top_root(p, tower_);
    if (top < 0) return sign_at(univariate_signed(p), root_) * leading_sign(p);
    const auto [a, b] = split(p, static_cast<int>(tower_.coordinates.size()) + top);
    const int sign_a = sign(a);
    const int product = sign(b) * signs_[static_cast<std::size_t>(top)];
    if (product == 0 || product == sign_a) return sign_a;
    if (sign_a == 0) return product;
    return sign_a * sign(conjugate_product(p, top, tower_));
  }

 private:
  Univariate univariate_signed(const Polynomial& p) const { return univariate(core::with_variables(p, 1)); }
  /// `univariate` makes the leading coefficient positive.
  static int leading_sign(const Polynomial& p) { return sgn(p.terms.front().coefficient); }

  const core::RootTower& tower_;
  RealRoot& root_;
  std::vector<MultiInterval> values_;  ///< coordinate, then the roots placed so far
  std::vector<int> signs_;
  bool reachable_ = true;
};

/// Every value of the coordinate where some factor may vanish, ascending.
std::vector<RealRoot> candidates(const LocusProblem& problem) {
  std::vector<Univariate> polynomials;
  const auto add = [&](const Polynomial& p) {
    if (p.is_zero() || p.is_constant()) return;
    Univariate part = square_free_part(univariate(p));
    if (std::find(polynomials.begin(), polynomials.end(), part) == polynomials.end())
      polynomials.push_back(std::move(part));
  };
  for (const LocusFactor& factor : problem.factors) {
    if (factor.role == FactorRole::construction) continue;
    for (const Polynomial& p : factor.implicit) add(p);
    if (factor.implicit.empty()) add(norm(factor.sheet, problem.tower));
  }
  for (const core::Root& root : problem.tower.roots) add(norm(root.square, problem.tower));
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

/// What vanishes at one point of a mode.
std::vector<EdgeLabel> labels_at(const LocusProblem& problem, const core::WorkingMode& mode, RealRoot& root,
                                 Place& place) {
  std::vector<EdgeLabel> labels;
  std::vector<int> compared;
  for (std::size_t f = 0; f < problem.factors.size(); ++f) {
    const LocusFactor& factor = problem.factors[f];
    const bool counts = factor.role == FactorRole::reaction || factor.role == FactorRole::direct_singularity;
    if (counts && place.sign(factor.sheet) == 0) compared.push_back(static_cast<int>(f));
  }
  ArcOrders point(problem.tower, mode, germs_at(root), {{root.lower, root.upper}});
  const ReactionOrders orders = compared.empty() ? ReactionOrders{} : reaction_orders(problem, point, compared);
  // The end of the range and of the reach at once: no side to come from.
  core::ensure(compared.empty() || orders.decided || point.sides().empty(), "orders at a point are always decided");
  const auto context = [&](LocusKind kind, const LocusFactor& factor) {
    for (EdgeLabel& label : labels)
      if (label.kind == kind && kind != LocusKind::margin) {
        label.factor += "; " + factor.expression;
        if (!factor.cause.empty()) label.cause += (label.cause.empty() ? "" : "; ") + factor.cause;
        return;
      }
    const std::vector<core::Vanishing> held =
        kind == LocusKind::margin ? factor.vanishing : std::vector<core::Vanishing>{};
    const bool excited = kind != LocusKind::direct_singularity || !orders.decided || orders.excited;
    labels.push_back({kind, held, factor.expression, factor.cause, excited});
  };
  for (const LocusFactor& factor : problem.factors) {
    const bool looked_at = factor.role == FactorRole::construction || factor.role == FactorRole::reaction;
    if (looked_at || place.sign(factor.sheet) != 0) continue;
    if (factor.role == FactorRole::margin && is_margin(factor, point).value_or(true))
      context(LocusKind::margin, factor);
    if (factor.role == FactorRole::direct_singularity) context(LocusKind::direct_singularity, factor);
    if (factor.role == FactorRole::workspace_boundary) context(LocusKind::workspace_boundary, factor);
  }
  EdgeLabel label = reaction_label(problem, orders);
  if (!label.vanishing.empty()) labels.insert(labels.begin(), std::move(label));
  return labels;
}

double middle(const RealRoot& root) { return core::to_double((root.lower + root.upper) / 2); }

/// Whether a mode reaches the open interval between two neighbouring candidates.
bool reaches(const LocusProblem& problem, const core::WorkingMode& mode, const Rational& from, const Rational& to) {
  const Rational at = (from + to) / 2;
  RealRoot sample = {{-at.get_num(), at.get_den()}, at, at};
  return Place(problem.tower, mode, sample).reachable();
}

void add_mode(const LocusProblem& problem, const core::WorkingMode& mode, std::vector<RealRoot>& roots, LocusMap& map) {
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
  for (RealRoot& root : roots) {
    Place place(problem.tower, mode, root);
    cell(root.lower, middle(root), place.reachable());
    from = root.upper;
    if (!place.reachable()) continue;
    const bool undefined = std::any_of(problem.tower.denominators.begin(), problem.tower.denominators.end(),
                                       [&](const Polynomial& denominator) { return place.sign(denominator) == 0; });
    if (undefined) continue;
    for (EdgeLabel& label : labels_at(problem, mode, root, place)) {
      core::IsolatedPoint point;
      point.kind = label.kind;
      point.vanishing = std::move(label.vanishing);
      point.at = {middle(root)};
      point.mode = mode;
      point.certified = true;
      point.factor = std::move(label.factor);
      point.cause = std::move(label.cause);
      point.excited = label.excited;
      map.isolated_points.push_back(std::move(point));
    }
  }
  cell(problem.upper[0], core::to_double(problem.upper[0]), false);
  map.reachable.insert(map.reachable.end(), intervals.begin(), intervals.end());
}

}  // namespace

void add_points_of_one_coordinate(const LocusProblem& problem, const TraceOptions& options, LocusMap& map) {
  core::ensure(problem.tower.coordinates.size() == 1, "one free coordinate");
  std::vector<RealRoot> roots = candidates(problem);
  for (std::size_t m = 0; m < problem.modes.size(); ++m) {
    if (options.deadline && std::chrono::steady_clock::now() > *options.deadline)
      throw core::LimitReached("the time limit was reached");
    if (options.progress) options.progress(static_cast<double>(m) / static_cast<double>(problem.modes.size()), "roots");
    add_mode(problem, problem.modes[m], roots, map);
  }
}

}  // namespace clearloci::loci
