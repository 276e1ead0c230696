#include "loci/curves/sheet_loci.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "loci/curves/arc_stretches.hpp"
#include "loci/curves/arcs.hpp"
#include "loci/curves/edge_labels.hpp"
#include "loci/curves/isolated_points.hpp"
#include "loci/curves/margin_nodes.hpp"
#include "loci/curves/open_regions.hpp"
#include "loci/curves/plane_curve.hpp"
#include "loci/curves/vertex_placement.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusCurve;
using core::LocusFactor;
using core::LocusMap;
using core::LocusProblem;
using core::Point2;
using sheet::TracedArc;

// A point is on a curve where the curve is this near, relative to the box, to first order.
constexpr double on_curve = 1e-9;
// Of a patch: several times what a curve without doubtful places takes.
constexpr int patch_cells_of_a_sketch = 8000;

/// Curves of the factor are asked for: alone, or where others vanish too.
bool is_wanted(const LocusProblem& problem, std::size_t f) {
  const LocusFactor& factor = problem.factors[f];
  if (factor.implicit.empty() && !factor.implicit_too_heavy) return false;
  if (factor.role == FactorRole::construction) return false;
  return factor.role != FactorRole::reaction || !widest_label(problem, f).vanishing.empty();
}

bool is_line_or_circle(const core::ClosedForm& form) {
  return std::holds_alternative<core::LineForm>(form) || std::holds_alternative<core::CircleForm>(form);
}

/// The side of the box that a line is: 0 to 3 for x0, x1, y0, y1; -1: none.
int side_along(const LocusProblem& problem, const core::Polynomial& implicit) {
  for (int side = 0; side < 4; ++side) {
    const core::Rational& at = (side % 2 == 0 ? problem.lower : problem.upper)[static_cast<std::size_t>(side / 2)];
    if (implicit == core::primitive_part(core::variable_polynomial(2, side / 2) - core::constant_polynomial(2, at)))
      return side;
  }
  return -1;
}

/// A branch of |A| = 0 reaches the star on the mode's sheet.
bool is_singular(const LocusProblem& problem, const core::WorkingMode& mode, const sheet::Star& star) {
  return std::any_of(problem.factors.begin(), problem.factors.end(), [&](const LocusFactor& factor) {
    return factor.role == FactorRole::direct_singularity && reaches(problem, mode, factor, star);
  });
}

/// An exact point of a curve next to one of an arc of it.
std::optional<EnclosedPoint> point_of(const LocusProblem& problem, const core::Polynomial& curve, const Point2& at) {
  const double reach = on_curve * std::max(core::to_double(problem.upper[0] - problem.lower[0]),
                                           core::to_double(problem.upper[1] - problem.lower[1]));
  return curve_point(curve, at, reach);
}

/// Whether a factor vanishes all along every arc of a trace of another.
bool vanishes_along_all(const LocusProblem& problem, const core::WorkingMode& mode, const LocusFactor& factor,
                        const std::vector<std::shared_ptr<CurveAlgebra>>& algebra, const sheet::SheetTrace& trace,
                        const core::Polynomial& sheet) {
  return std::all_of(trace.arcs.begin(), trace.arcs.end(), [&](const TracedArc& traced) {
    const core::Polynomial& curve = factor.implicit[static_cast<std::size_t>(traced.colour)];
    const std::optional<EnclosedPoint> point = point_of(problem, curve, traced.inner);
    if (!point) return false;
    ArcOrders arc(problem.tower, mode, algebra[static_cast<std::size_t>(traced.colour)], *point);
    if (!arc.decided()) return false;
    return std::all_of(arc.sides().begin(), arc.sides().end(), [&](int side) {
      const std::optional<Germ> germ = arc.germ(sheet, side);
      return germ && (germ->is_zero() || germ->order > 0);
    });
  });
}

double length_of(const core::Polyline& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i)
    sum += std::hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]);
  return sum;
}

/// The vertices of lines and circles from their closed forms; other arcs have theirs.
core::Arc finished(const TracedArc& traced, const core::ClosedForm& form, double tolerance) {
  core::Arc arc = traced.arc;
  if (std::holds_alternative<core::LineForm>(form)) {
    arc.points = {arc.points.front(), arc.points.back()};
    arc.length = length_of(arc.points);
  }
  if (const auto* circle = std::get_if<core::CircleForm>(&form)) {
    const Point2 centre = {core::to_double(circle->centre[0]), core::to_double(circle->centre[1])};
    const double radius = std::sqrt(core::to_double(circle->radius_squared));
    const auto on_circle = [&](const Point2& p) -> Point2 {
      const double distance = std::hypot(p[0] - centre[0], p[1] - centre[1]);
      return {centre[0] + radius * (p[0] - centre[0]) / distance, centre[1] + radius * (p[1] - centre[1]) / distance};
    };
    const Point2 start = on_circle(arc.points.front());
    const Point2 end = arc.closed ? start : on_circle(arc.points.back());
    arc.points = circle_arc(centre, radius, start, traced.inner, end, arc.closed, tolerance);
    arc.length = 0;
    for (std::size_t i = 1; i < arc.points.size(); ++i) {
      const double chord = std::hypot(arc.points[i][0] - arc.points[i - 1][0], arc.points[i][1] - arc.points[i - 1][1]);
      arc.length += 2 * radius * std::asin(std::min(1.0, chord / (2 * radius)));
    }
  }
  return arc;
}

/// Vertices of a finished arc close enough together to see where roots come close to zero along it.
core::Polyline close_vertices(const core::Polyline& points, const core::ClosedForm& form) {
  if (!std::holds_alternative<core::LineForm>(form)) return points;
  constexpr int pieces = 256;
  core::Polyline line;
  const Point2 &a = points.front(), &b = points.back();
  for (int i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    line.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
  }
  return line;
}

/// Where legs have no length, for one function: none where it is smooth, for it passes through there as it is. One that
/// holds no root which vanishes there is no longer of the order of the leg, but of the second one like any other.
void fit_legs(const core::RootTower& tower, const core::Polynomial& function, std::vector<sheet::Star>& stars) {
  std::erase_if(stars, [&](const sheet::Star& star) { return star.no_length && sheet::is_smooth_at(star, function); });
  for (sheet::Star& star : stars) {
    const bool has_root = std::any_of(star.roots.begin(), star.roots.end(),
                                      [&](int root) { return core::depends_on(function, 2 + root); });
    if (!star.no_length || !star.is_sheared() || has_root) continue;
    star.shape = sheet::Star::Shape::cone;
    sheet::settle_roots(star, tower);
  }
}

sheet::SheetTrace trace_share(const LocusProblem& problem, const LocusFactor& factor, const core::WorkingMode& mode,
                              const CurveAlgebras& algebras, const std::vector<sheet::NestedMeeting>& nested,
                              const MarginNodes& nodes, sheet::SheetTraceOptions options) {
  std::vector<core::ClosedForm> forms;
  std::vector<std::shared_ptr<CurveAlgebra>> algebra;
  for (const core::Polynomial& p : factor.implicit) {
    algebra.push_back(algebras.of(p));
    forms.push_back(core::recognise_closed_form(p));
    options.closed_form.push_back(is_line_or_circle(forms.back()));
    options.along_side.push_back(side_along(problem, p));
  }
  if (factor.implicit.size() > 1)
    options.colour = [&factor](const Point2& at) { return curve_through(factor.implicit, at); };
  for (sheet::Star& corner : sheet::corners_on(problem.tower, factor.sheet, nested)) {
    corner.singular = is_singular(problem, mode, corner);
    options.special.push_back(std::move(corner));
  }
  fit_legs(problem.tower, factor.sheet, options.special);
  for (sheet::Star& node : nodes.of(factor)) options.special.push_back(std::move(node));
  std::vector<sheet::Cutter> cutters;
  std::vector<const LocusFactor*> shared;
  const bool cut = factor.role == FactorRole::reaction || factor.role == FactorRole::margin;
  for (const LocusFactor& other : problem.factors) {
    if (!cut || other.role != FactorRole::direct_singularity) continue;
    if (shares_curve(factor, other))
      shared.push_back(&other);
    else
      cutters.push_back({{other.sheet, other.line}, core::ArcEnd::direct_singularity});
  }
  const auto trace = [&] {
    return sheet::trace_sheet(problem.tower, mode, problem.lower, problem.upper, {factor.sheet, factor.line}, cutters,
                              options);
  };
  sheet::SheetTrace traced = trace();
  // Where |A| vanishes all along an arc it does not cut it. Where it does so in another mode only, it may.
  const bool along = std::all_of(shared.begin(), shared.end(), [&](const LocusFactor* other) {
    return vanishes_along_all(problem, mode, factor, algebra, traced, other->sheet);
  });
  if (!along) {
    for (const LocusFactor* other : shared)
      cutters.push_back({{other->sheet, other->line}, core::ArcEnd::direct_singularity});
    traced = trace();
  }
  for (TracedArc& arc : traced.arcs) {
    const auto colour = static_cast<std::size_t>(arc.colour);
    if (colour >= forms.size()) continue;
    arc.arc = finished(arc, forms[colour], problem.tolerance);
    // What vanishes along it must do so all along; else it is left to the exact engine.
    if (same_orders_all_along(problem, mode, factor.implicit[colour], algebra[colour],
                              close_vertices(arc.arc.points, forms[colour])))
      continue;
    traced.certified = false;
    traced.undecided.push_back({arc.inner[0], arc.inner[0], arc.inner[1], arc.inner[1]});
  }
  return traced;
}

/// Whether a sheet polynomial vanishes along an arc that lies on a factor of its norm: where it does not, it is zero at
/// a few points at most.
class VanishesAlong {
 public:
  VanishesAlong(const LocusProblem& problem, const core::WorkingMode& mode, const core::Polynomial& p)
      : part_(sheet::subtower(problem.tower, mode, {p})),
        program_(part_.tower, std::vector<core::Polynomial>{sheet::narrowed(p, part_)}),
        registers_(program_.registers<double>()),
        size_(core::to_double(problem.upper[0] - problem.lower[0])) {}

  bool operator()(const TracedArc& traced) {
    const core::Polyline& points = traced.arc.points;
    return at(traced.inner) && at(points[points.size() / 3]) && at(points[2 * points.size() / 3]);
  }

 private:
  bool at(const Point2& p) {
    for (const int v : {0, 1}) registers_.set(v, p[static_cast<std::size_t>(v)]);
    for (int j = 0; j < program_.roots(); ++j) {
      registers_.run_square(j);
      registers_.set(2 + j, part_.mode[static_cast<std::size_t>(j)] * std::sqrt(std::max(0.0, registers_.square(j))));
    }
    registers_.run_values();
    registers_.run_gradients();
    double slope = 0;
    for (int v = 0; v < program_.variables(); ++v) slope = std::max(slope, std::abs(registers_.partial(0, v)));
    return std::abs(registers_.value(0)) <= on_curve * size_ * slope;
  }

  sheet::Subtower part_;
  sheet::SheetProgram program_;
  sheet::SheetProgram::Registers<double> registers_;
  double size_;
};

/// Collects the arcs of one mode into curves.
class Gathering {
 public:
  /// `shares`: of one mode, those that are settled too.
  Gathering(const LocusProblem& problem, const std::vector<const SheetShare*>& shares, const CurveAlgebras& algebras,
            LocusMap& map)
      : problem_(problem), all_shares_(shares), algebras_(algebras), map_(map) {
    for (const SheetShare* share : shares)
      if (!share->settled) shares_.push_back(share);
  }

  void run() {
    for (const SheetShare* share : shares_) {
      note(*share);
      for (const TracedArc& traced : share->traced.arcs) take(*share, traced);
    }
    for (LocusCurve& curve : curves_) map_.curves.push_back(std::move(curve));
  }

 private:
  const LocusFactor& factor(const SheetShare& share) const {
    return problem_.factors[static_cast<std::size_t>(share.factor)];
  }
  const core::WorkingMode& mode(const SheetShare& share) const {
    return problem_.modes[static_cast<std::size_t>(share.mode)];
  }

  /// Where a dyad's construction is undefined every numerator vanishes, which says nothing of the reaction.
  bool at_base(const Point2& at, const core::WorkingMode& mode) const {
    const double near = on_curve * core::to_double(problem_.upper[0] - problem_.lower[0]);
    std::vector<Point2> all = sheet::bases(problem_.tower);
    for (const sheet::Star& cone : sheet::enclosed_cones(problem_.tower, mode, problem_.lower, problem_.upper))
      all.push_back({core::to_double(cone.x), core::to_double(cone.y)});
    return std::any_of(all.begin(), all.end(),
                       [&](const Point2& base) { return std::hypot(base[0] - at[0], base[1] - at[1]) <= near; });
  }

  void note(const SheetShare& share) {
    const LocusFactor& locus_factor = factor(share);
    if (share.traced.stopped) map_.out_of_time = true;
    if (!share.traced.certified) {
      const EdgeLabel label = widest_label(problem_, static_cast<std::size_t>(share.factor));
      for (const sheet::Region& region : share.traced.undecided)
        leave_open(label, mode(share), {region.x0, region.x1, region.y0, region.y1}, map_);
    }
    const EdgeLabel label = label_of(problem_, {share.factor});
    if (locus_factor.role == FactorRole::reaction && label.vanishing.empty()) return;
    if (locus_factor.role == FactorRole::workspace_boundary) return;
    for (const Point2& at : share.traced.isolated_points) {
      if (at_base(at, mode(share))) continue;
      map_.isolated_points.push_back({label.kind, label.vanishing, {at[0], at[1]}, mode(share), false});
    }
  }

  /// Orders along an arc, exactly. Undecided where no point of it lends itself, or the arc's own factor is not among
  /// what vanishes there.
  ReactionOrders orders_along(const SheetShare& share, const TracedArc& traced, const core::Polynomial& implicit,
                              const std::function<void(ArcOrders&)>& look) const {
    const core::Polyline& points = traced.arc.points;
    ReactionOrders orders;
    orders.decided = false;
    for (const Point2& at : {traced.inner, points[points.size() / 3], points[2 * points.size() / 3]}) {
      const std::optional<EnclosedPoint> point = point_of(problem_, implicit, at);
      if (!point) continue;
      ArcOrders arc(problem_.tower, mode(share), algebras_.of(implicit), *point);
      orders = reaction_orders(problem_, arc, factors_on(problem_, implicit));
      const bool is_other = !core::is_of_determinants(factor(share).role);
      orders.decided = orders.decided && (is_other || std::find(orders.vanishes.begin(), orders.vanishes.end(),
                                                                share.factor) != orders.vanishes.end());
      if (!orders.decided) continue;
      look(arc);
      break;
    }
    return orders;
  }

  /// What is claimed of an arc of a reaction or a margin: nothing, for |A| vanishes along it too and orders are not
  /// known. A ratio of the two need not vanish.
  static EdgeLabel unknown_label() {
    EdgeLabel label;
    label.proven = false;
    return label;
  }

  /// The polynomial of |A| that an arc of a factor without polynomials runs along. Zero: |A| vanishes along it and has
  /// none. Nothing: |A| does not vanish along it.
  std::optional<core::Polynomial> singular_curve(const SheetShare& share, const TracedArc& traced) const {
    const core::Polyline& points = traced.arc.points;
    const double near = on_curve * box_size();
    for (const LocusFactor& other : problem_.factors) {
      if (other.role != FactorRole::direct_singularity) continue;
      if (other.implicit.empty() && VanishesAlong(problem_, mode(share), other.sheet)(traced))
        return core::Polynomial{2, {}};
      for (const core::Polynomial& p : other.implicit) {
        const PlaneCurve curve(p);
        const auto is_on = [&](const Point2& at) {
          const PlaneCurve::Jet jet = curve.jet(at);
          return std::abs(jet.f) <= near * jet.slope();
        };
        if (is_on(traced.inner) && is_on(points[points.size() / 3]) && is_on(points[2 * points.size() / 3])) return p;
      }
    }
    return std::nullopt;
  }

  /// What vanishes along an arc of a reaction's factor without polynomials: with the angle of a torsion spring, or too
  /// large ones. Nothing where the arc is among those of a factor before.
  std::optional<EdgeLabel> label_without_polynomial(const SheetShare& share, const TracedArc& traced) const {
    const std::optional<core::Polynomial> curve = singular_curve(share, traced);
    if (!curve) return label_of(problem_, {share.factor});
    if (curve->is_zero()) return unknown_label();
    const ReactionOrders orders = orders_along(share, traced, *curve, [](ArcOrders&) {});
    if (!orders.decided) return unknown_label();
    const bool is_told_before = std::any_of(all_shares_.begin(), all_shares_.end(), [&](const SheetShare* other) {
      return (other->factor < share.factor || other->settled) && factor(*other).role == FactorRole::reaction &&
             std::find(orders.vanishes.begin(), orders.vanishes.end(), other->factor) != orders.vanishes.end();
    });
    if (is_told_before) return std::nullopt;
    return reaction_label(problem_, orders);
  }

  /// What vanishes along an arc; nothing where the arc is among those of a factor before, or is none of a margin.
  std::optional<EdgeLabel> label_along(const SheetShare& share, const TracedArc& traced,
                                       const core::Polynomial& implicit) const {
    const LocusFactor& locus_factor = factor(share);
    const auto plain = [&](const std::vector<int>& together, bool proven) {
      EdgeLabel label = label_of(problem_, together);
      label.proven = proven;
      return label;
    };
    if (locus_factor.implicit.empty() && locus_factor.role == FactorRole::reaction)
      return label_without_polynomial(share, traced);
    if (locus_factor.implicit.empty() && locus_factor.role == FactorRole::margin && singular_curve(share, traced))
      return unknown_label();
    if (locus_factor.implicit.empty() || locus_factor.role == FactorRole::workspace_boundary)
      return plain({share.factor}, true);
    std::vector<const SheetShare*> others;
    for (const SheetShare* other : shares_) {
      const auto& list = factor(*other).implicit;
      if (other != &share && locus_factor.role == FactorRole::reaction && factor(*other).role == FactorRole::reaction &&
          std::find(list.begin(), list.end(), implicit) != list.end())
        others.push_back(other);
    }
    const bool compare = locus_factor.role == FactorRole::direct_singularity ? locus_factor.may_be_idle
                         : locus_factor.role == FactorRole::margin           ? !locus_factor.cleared.empty()
                                                                             : locus_factor.role != FactorRole::preload;
    if ((others.empty() && !needs_orders(problem_, implicit)) || !compare) return plain({share.factor}, true);

    std::optional<bool> margin = true;
    const ReactionOrders orders = orders_along(share, traced, implicit, [&](ArcOrders& arc) {
      if (locus_factor.role == FactorRole::margin) margin = is_margin(locus_factor, arc);
    });
    if (locus_factor.role == FactorRole::margin) {
      if (margin && !*margin) return std::nullopt;
      return orders.decided && margin ? plain({share.factor}, true) : unknown_label();
    }
    if (locus_factor.role == FactorRole::direct_singularity) {
      EdgeLabel label = plain({share.factor}, true);
      label.excited = !orders.decided || orders.excited;
      return label;
    }
    const auto vanishes = [&](const SheetShare& other) {
      if (orders.decided)
        return std::find(orders.vanishes.begin(), orders.vanishes.end(), other.factor) != orders.vanishes.end();
      return VanishesAlong(problem_, mode(share), factor(other).sheet)(traced);
    };
    std::vector<int> together = {share.factor};
    bool proven = true;
    for (const SheetShare* other : others) {
      if (!vanishes(*other)) continue;
      if (other->factor < share.factor) return std::nullopt;
      together.push_back(other->factor);
      proven = proven && other->traced.certified;
    }
    if (!orders.decided && singular_curve(share, traced)) return unknown_label();
    EdgeLabel label = orders.decided ? reaction_label(problem_, orders) : plain(together, false);
    label.proven = label.proven && proven;
    return label;
  }

  double box_size() const {
    return std::max(core::to_double(problem_.upper[0] - problem_.lower[0]),
                    core::to_double(problem_.upper[1] - problem_.lower[1]));
  }

  /// By boxes around parts of the arc.
  void leave_arc_open(const SheetShare& share, const core::Polyline& points) {
    constexpr std::size_t most_boxes = 16;
    const EdgeLabel label = widest_label(problem_, static_cast<std::size_t>(share.factor));
    const std::size_t step = std::max<std::size_t>(1, (points.size() + most_boxes - 1) / most_boxes);
    for (std::size_t from = 0; from + 1 < points.size(); from += step) {
      const auto begin = points.begin() + static_cast<std::ptrdiff_t>(from);
      const auto end = points.begin() + static_cast<std::ptrdiff_t>(std::min(from + step + 1, points.size()));
      leave_open(label, mode(share), extent_of(core::Polyline(begin, end)), map_);
    }
  }

  void take(const SheetShare& share, const TracedArc& traced) {
    if (!traced.arc.closed && traced.arc.length <= shortest_arc * box_size()) return;
    const LocusFactor& locus_factor = factor(share);
    const core::Polynomial implicit = locus_factor.implicit.empty()
                                          ? core::Polynomial{2, {}}
                                          : locus_factor.implicit[static_cast<std::size_t>(traced.colour)];
    std::optional<EdgeLabel> label = label_along(share, traced, implicit);
    if (!label) return;
    const bool is_of_reactions = locus_factor.role == FactorRole::reaction || locus_factor.role == FactorRole::margin;
    if (is_of_reactions && label->vanishing.empty()) {
      // Another reaction may vanish there too, and be one that is asked for.
      if (!label->proven) leave_arc_open(share, traced.arc.points);
      return;
    }
    const bool certified = share.traced.certified && label->proven;
    label->proven = true;
    auto curve = std::find_if(curves_.begin(), curves_.end(), [&](const LocusCurve& c) {
      return c.implicit == implicit && EdgeLabel{c.kind, c.vanishing, c.factor, c.cause, c.excited} == *label;
    });
    if (curve == curves_.end()) {
      curve = curves_.insert(curve, LocusCurve{});
      curve->kind = label->kind;
      curve->vanishing = label->vanishing;
      curve->factor = label->factor;
      curve->cause = label->cause;
      curve->excited = label->excited;
      curve->implicit = implicit;
      if (!implicit.is_zero()) curve->closed_form = core::recognise_closed_form(implicit);
      curve->mode = mode(share);
      curve->certified = true;
    }
    curve->certified = curve->certified && certified;
    curve->arcs.push_back(traced.arc);
  }

  const LocusProblem& problem_;
  const std::vector<const SheetShare*>& all_shares_;
  std::vector<const SheetShare*> shares_;
  const CurveAlgebras& algebras_;
  LocusMap& map_;
  std::vector<LocusCurve> curves_;
};

}  // namespace

std::shared_ptr<const CurveAlgebras> curve_algebras(const LocusProblem& problem, const TraceOptions& options) {
  const auto make = [&] { return std::make_shared<const CurveAlgebras>(problem.tower); };
  if (options.searches == nullptr) return make();
  using Key = sheet::KnownSearches::Key;
  return options.searches->get<CurveAlgebras>(sheet::KnownSearches::key(Key::Kind::algebra, problem.tower, {}, {}, {}),
                                              make);
}

std::vector<SheetShare> trace_on_sheets(const LocusProblem& problem, const TraceOptions& options,
                                        const CurveAlgebras& algebras, const std::vector<int>& settled_after) {
  sheet::SheetTraceOptions sheet_options;
  sheet_options.tolerance = problem.tolerance;
  sheet_options.certificate = options.certificate != nullptr;
  sheet_options.searches = options.searches;
  if (options.sketch) {
    sheet_options.sketch = true;
    sheet_options.most_cells = patch_cells_of_a_sketch;
  }
  if (options.deadline)
    sheet_options.stop = [deadline = *options.deadline] { return std::chrono::steady_clock::now() > deadline; };

  std::vector<std::vector<sheet::Star>> special(problem.modes.size(), sheet::touches(problem.tower));
  for (std::size_t m = 0; m < problem.modes.size(); ++m) {
    for (sheet::Star& touch : special[m]) touch.singular = is_singular(problem, problem.modes[m], touch);
    for (sheet::Star& cone : sheet::enclosed_cones(problem.tower, problem.modes[m], problem.lower, problem.upper))
      special[m].push_back(std::move(cone));
  }

  const std::vector<sheet::NestedMeeting> nested = sheet::nested_meetings(problem.tower);
  std::vector<MarginNodes> nodes;
  for (std::size_t m = 0; m < problem.modes.size(); ++m)
    nodes.emplace_back(
        problem, problem.modes[m],
        sheet::ZeroOptions{.special = special[m], .stop = sheet_options.stop, .searches = options.searches});

  std::vector<SheetShare> shares;
  for (std::size_t m = 0; m < problem.modes.size(); ++m)
    for (std::size_t f = 0; f < problem.factors.size(); ++f)
      if (is_wanted(problem, f)) shares.push_back({static_cast<int>(f), static_cast<int>(m), {}});

  // Long work first, so that the cores end together; under a deadline short work first, so that most is whole by then.
  std::vector<std::size_t> order(shares.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto effort = [&](std::size_t i) {
    return problem.factors[static_cast<std::size_t>(shares[i].factor)].sheet.terms.size();
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return options.deadline ? effort(a) < effort(b) : effort(a) > effort(b);
  });

  std::size_t done = 0;
  std::mutex mutex;
  run_in_order(shares.size(), [&](std::size_t i) {
    SheetShare& share = shares[order[i]];
    const auto mode = static_cast<std::size_t>(share.mode);
    sheet::SheetTraceOptions trace_options = sheet_options;
    trace_options.special = special[mode];
    const auto factor = static_cast<std::size_t>(share.factor);
    if (factor < settled_after.size() && settled_after[factor] > 0) {
      trace_options.whole_or_nothing = true;
      trace_options.most_cells = settled_after[factor];
    }
    share.traced = trace_share(problem, problem.factors[factor], problem.modes[mode], algebras, nested, nodes[mode],
                               std::move(trace_options));
    const std::lock_guard lock(mutex);
    if (options.progress)
      options.progress(0.9 * static_cast<double>(++done) / static_cast<double>(shares.size()), "arcs");
  });
  return shares;
}

void add_sheet_loci(const LocusProblem& problem, const std::vector<SheetShare>& shares, const CurveAlgebras& algebras,
                    LocusMap& map) {
  for (std::size_t m = 0; m < problem.modes.size(); ++m) {
    std::vector<const SheetShare*> sheet_shares;
    for (const SheetShare& share : shares)
      if (share.mode == static_cast<int>(m)) sheet_shares.push_back(&share);
    Gathering(problem, sheet_shares, algebras, map).run();
  }
}

}  // namespace clearloci::loci
