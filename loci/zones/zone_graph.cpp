#include "loci/zones/zone_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "loci/curves/curves.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"
#include "loci/zones/circle_crossings.hpp"
#include "loci/zones/margin_crossings.hpp"
#include "loci/zones/near_passes.hpp"
#include "loci/zones/segment_crossings.hpp"
#include "loci/zones/workspace_area.hpp"

namespace clearloci::loci {
namespace {

using core::LocusKind;
using core::Point2;
using core::Polyline;

// Relative to the box. Ends of arcs are known to 1e-12; what lies closer than the first is one place.
constexpr double same_place = 1e-8;
// Of a curve that touches a side; of a chord that is longer, both ends of which are there, the curve runs along the
// side.
constexpr double on_side = 1e-12, along_side = 1e-4;
// How far from a touch the parts beside it are looked at.
constexpr double beside_a_touch = 1e-5;
// The order of edges around a node is read off circles of these radii, from the largest that fits. A node
// stands for what is as near to it as one place.
constexpr double largest_circle = 0.02, smallest_circle = same_place;
constexpr int agreeing_circles = 1;
// Nodes whose order is not told are joined with those that edges lead to within this distance.
constexpr double widest_join = 1e-5, beyond_join = 1.5;
constexpr double widest_doubt = 1e-4;  // rad; of bearings that are looked for by other means
// Of the tolerance: a curve is that near to its chords, and crosses a circle about its node under no flat angle.
constexpr double drawn_doubt = 4;
constexpr double rounding = 1e-13;  // of points moved onto a curve
// Tolerances by which chords may cross beside the curves' crossing.
constexpr double drawn_off = 100;
// Tolerances by which polylines of arcs that meet are apart at most, with room for rounding.
constexpr double chords_apart = 2.5;
// Of chords that cross where their curves do not: as many halvings leave a 65000th of the tolerance between chord and
// curve.
constexpr int most_halvings = 8;
// How far beside a boundary the workspace is looked for, relative to the box.
constexpr double farthest_aside = 1e-8, nearest_aside = 1e-10;
// Curves that leave a star side by side are told apart this far from it.
constexpr double around_a_star = 0.15;
// The exact arrangement of two curves is quick up to this degree.
constexpr int exact_degree = 8;

double distance(const Point2& a, const Point2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

struct Foot {
  std::size_t segment = 0;
  double t = 0, distance = 0;
  std::size_t last = 0;  ///< of the segments of its pass
  double position() const { return static_cast<double>(segment) + t; }
};

Foot foot_on(const Polyline& line, std::size_t i, const Point2& at) {
  const Point2 &a = line[i], &b = line[i + 1];
  const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0.0;
  return {i, t, std::hypot(a[0] + t * dx - at[0], a[1] + t * dy - at[1]), i};
}

/// Where a polyline passes within `reach` of a point: the nearest place of every pass.
std::vector<Foot> passes(const Polyline& line, const BoxedPolyline& boxed, const Point2& at, double reach) {
  std::vector<Foot> list;
  for (const std::size_t i : boxed.pieces_near(at, reach)) {
    const Foot foot = foot_on(line, i, at);
    if (foot.distance > reach) continue;
    if (list.empty() || list.back().last + 1 < i)
      list.push_back(foot);
    else if (foot.distance < list.back().distance)
      list.back() = foot;
    list.back().last = i;
  }
  return list;
}

/// One arc to be split.
struct Strand {
  int owner = box_owner;
  bool closed = false;
  Polyline points;
  std::vector<std::pair<double, int>> cuts;  ///< position along the points, node
};

class Builder {
 public:
  Builder(const core::LocusProblem& problem, const core::LocusMap& map, const core::WorkingMode& mode,
          CurveProjections& projections, bool sketch)
      : problem_(problem), map_(map), mode_(mode), sketch_(sketch), projections_(projections) {
    for (std::size_t i = 0; i < 2; ++i) {
      low_[i] = core::to_double(map.lower[i]);
      high_[i] = core::to_double(map.upper[i]);
    }
    size_ = std::max(high_[0] - low_[0], high_[1] - low_[1]);
    if (sketch) return;
    effort_.touches = true;
    effort_.special = sheet::enclosed_cones(problem.tower, mode, problem.lower, problem.upper);
    stars_ = sheet::bases(problem.tower);
    for (const std::vector<sheet::Star>& list : {sheet::touches(problem.tower), effort_.special})
      for (const sheet::Star& star : list) stars_.push_back({core::to_double(star.x), core::to_double(star.y)});
  }

  ZoneGraph build() {
    result_.certified = !sketch_;
    collect_strands();
    for (const Strand& strand : strands_) {
      if (strand.closed) continue;
      node_at(strand.points.front());
      node_at(strand.points.back());
    }
    add_stars();
    for (const Strand& strand : strands_) {
      if (strand.owner == box_owner) continue;
      for (const std::size_t axis : {0u, 1u})
        for (const double side : {low_[axis], high_[axis]}) add_touches(strand, axis, side);
    }
    add_crossings();
    for (std::size_t n = 0; n < result_.graph.nodes.size(); ++n) cut_at(static_cast<int>(n));
    for (Strand& strand : strands_) split(strand);
    order_edges();
    if (!is_planar(result_.graph)) doubt("the order of curves around a crossing is not clear");
    if (!sketch_) check_separation();
    return std::move(result_);
  }

 private:
  const core::LocusCurve& curve(int owner) const { return map_.curves[static_cast<std::size_t>(owner)]; }
  PlaneGraph& graph() { return result_.graph; }

  void doubt(const std::string& note) {
    result_.certified = false;
    if (std::find(result_.notes.begin(), result_.notes.end(), note) == result_.notes.end())
      result_.notes.push_back(note);
  }

  /// What no finer polyline tells.
  void doubt_for_good(const std::string& note) {
    result_.finer_may_tell = false;
    doubt(note);
  }

  void collect_strands() {
    for (std::size_t c = 0; c < map_.curves.size(); ++c) {
      const core::LocusCurve& curve = map_.curves[c];
      if (curve.mode != mode_ || !cuts_workspace(curve.kind)) continue;
      if (!curve.certified) doubt_for_good("curve " + curve.id + " is not certified");
      for (const core::Arc& arc : curve.arcs) {
        if (arc.points.size() > 1) strands_.push_back({static_cast<int>(c), arc.closed, arc.points, {}});
      }
    }
    for (const core::OpenRegion& region : map_.open)
      if (region.mode == mode_ && !region.point && cuts_workspace(region.kind))
        doubt_for_good("what is open of " + curve_words(region) + " may run through them");
    const Polyline corners = {low_, {high_[0], low_[1]}, high_, {low_[0], high_[1]}, low_};
    for (std::size_t i = 0; i < 4; ++i) strands_.push_back({box_owner, false, {corners[i], corners[i + 1]}, {}});
  }

  int node_at(const Point2& at) {
    Polyline& nodes = graph().nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (distance(nodes[n], at) <= same_place * size_) return static_cast<int>(n);
    }
    nodes.push_back(at);
    return static_cast<int>(nodes.size()) - 1;
  }

  std::size_t vertices_at(const Point2& place) const {
    std::size_t count = 0;
    for (const Strand& strand : strands_)
      if (strand.owner != box_owner)
        count +=
            static_cast<std::size_t>(std::count_if(strand.points.begin(), strand.points.end(), [&](const Point2& at) {
              return distance(at, place) <= same_place * size_;
            }));
    return count;
  }

  /// Where the sheet is not smooth branches of curves arrive and leave side by side, of one curve or of several that
  /// have no isolated zero in common there. Such a place has a vertex of each; where several arrive it is a node. A
  /// curve that is smooth where a leg has no length passes there without one: a single vertex of another one will do.
  void add_stars() {
    for (const Point2& star : stars_)
      if (vertices_at(star) > 1) node_at(star);
    for (const sheet::Star& star : effort_.special) {
      const Point2 at = {core::to_double(star.x), core::to_double(star.y)};
      if (star.no_length && vertices_at(at) > 0) node_at(at);
    }
  }

  /// Where a curve touches a side of the box nothing crosses, yet what lies between them is pinched: the place is a
  /// node.
  void add_touches(const Strand& strand, std::size_t axis, double side) {
    const Polyline& points = strand.points;
    const auto off = [&](const Point2& p) { return std::abs(p[axis] - side); };
    for (std::size_t i = strand.closed ? 0 : 1; i + 1 < points.size(); ++i) {
      const Point2 &at = points[i], &before = points[i == 0 ? points.size() - 2 : i - 1], &after = points[i + 1];
      if (off(at) > chords_apart * map_.tolerance + same_place * size_) continue;
      if (off(before) < off(at) || off(after) <= off(at)) continue;
      if (off(before) <= on_side * size_ && distance(before, at) > along_side * size_) continue;
      const Point2 nearest = nearest_to_side(strand.owner, axis, before, after);
      Point2 node = off(at) < off(nearest) ? at : nearest;
      const double gap = off(node);
      node[axis] = side;
      if (gap > on_side * size_ && gap <= same_place * size_)
        doubt_for_good("curve " + curve(strand.owner).id + " comes too near to a side of the box to be resolved");
      if (gap <= on_side * size_ && differ_beside(node, axis)) node_at(node);
    }
  }

  /// Whether some factor has another sign on the one side of a touch than on the other, or one that is not decided.
  bool differ_beside(const Point2& touch, std::size_t axis) {
    if (!factors_) {
      std::vector<sheet::SheetFunction> functions;
      for (const core::LocusFactor& factor : problem_.factors) functions.push_back({factor.sheet, factor.line});
      factors_ = std::make_unique<sheet::SheetProgram>(problem_.tower, functions);
    }
    sheet::PointSign sign(*factors_, mode_);
    Point2 before = touch, after = touch;
    before[1 - axis] -= beside_a_touch * size_;
    after[1 - axis] += beside_a_touch * size_;
    for (int f = 0; f < factors_->functions(); ++f) {
      const int one = sign(before[0], before[1], f).value_or(0), other = sign(after[0], after[1], f).value_or(0);
      if (one * other <= 0) return true;
    }
    return false;
  }

  /// The point of a curve beside a chord at which its tangent is along the side.
  Point2 nearest_to_side(int owner, std::size_t axis, const Point2& from, const Point2& to) {
    const CurveProjection& curve = projections_.of(owner);
    const Point2 way = {to[0] - from[0], to[1] - from[1]};
    const auto at = [&](double part) { return curve({from[0] + part * way[0], from[1] + part * way[1]}); };
    const auto rises = [&](const CurvePoint& point) {
      const double along = point.tangent[0] * way[0] + point.tangent[1] * way[1];
      return point.tangent[axis] * along > 0;
    };
    double a = 0, b = 1;
    const bool first = rises(at(a));
    constexpr int halvings = 52;
    for (int k = 0; k < halvings; ++k) (rises(at((a + b) / 2)) == first ? a : b) = (a + b) / 2;
    return at((a + b) / 2).at;
  }

  /// Arcs of reactions end on the boundary and on direct singularities, preload loci pass through these; among each
  /// other they may cross. A sketch, too, decides this by what the curves are: polylines of two that are one curve
  /// cross anywhere.
  void add_crossings() {
    std::set<std::pair<int, int>> drawn;
    std::vector<int> owners;
    for (const Strand& strand : strands_) {
      if (strand.owner == box_owner || curve(strand.owner).kind == LocusKind::workspace_boundary) continue;
      if (std::find(owners.begin(), owners.end(), strand.owner) == owners.end()) owners.push_back(strand.owner);
    }
    for (std::size_t i = 0; i < owners.size(); ++i)
      for (std::size_t k = i + 1; k < owners.size(); ++k) {
        const core::LocusCurve &a = curve(owners[i]), &b = curve(owners[k]);
        const bool passes = a.kind == LocusKind::preload || b.kind == LocusKind::preload;
        const bool one_singular =
            !passes && (a.kind == LocusKind::direct_singularity) != (b.kind == LocusKind::direct_singularity);
        if (one_singular || add_own_crossings(owners[i], owners[k]) || add_closed_crossings(owners[i], owners[k]))
          continue;
        if (sketch_)
          drawn.emplace(owners[i], owners[k]);
        else
          add_proven_crossings(owners[i], owners[k]);
      }
    if (!drawn.empty()) add_drawn_crossings(drawn);
  }

  void add_proven_crossings(int first, int second) {
    for (const sheet::PlaneCell& place : meeting_places(first, second))
      if (!add_crossings_in(place, first, second)) return add_plane_crossings(curve(first), curve(second));
  }

  /// Of two factors' parts of one plane curve: where it crosses itself, arcs of one factor end, but one of each may
  /// pass, or touch the other. False: they are parts of different curves.
  bool add_own_crossings(int first, int second) {
    if (!is_one_curve(curve(first), curve(second))) return false;
    for (const Point2& at : own_crossings(curve(first).closed_form))
      if (passed_by(first, at) && passed_by(second, at)) node_at(at);
    const core::LocusFactor *one = factor_of(problem_, curve(first)), *other = factor_of(problem_, curve(second));
    if (sketch_ || one == nullptr || other == nullptr || one == other ||
        !core::circles_of(curve(first).closed_form).empty())
      return true;
    // In other points where it crosses itself both factors vanish on the sheet. What is not told shows in the chords.
    for (const sheet::PlaneCell& place : meeting_places(first, second)) {
      const std::vector<core::Rational> lower = {core::Rational(place.x.lower()), core::Rational(place.y.lower())},
                                        upper = {core::Rational(place.x.upper()), core::Rational(place.y.upper())};
      sheet::ZeroSet found = sheet::isolated_zeros(problem_.tower, mode_, {one->sheet, one->line},
                                                   {other->sheet, other->line}, lower, upper, effort_in(place));
      keep_passed(found, first, second);
      add_zeros(found);
    }
    return true;
  }

  static bool is_one_curve(const core::LocusCurve& a, const core::LocusCurve& b) {
    return a.implicit == b.implicit && (!a.implicit.is_zero() || a.factor == b.factor);
  }

  /// Boxes outside which the curves stay apart: their arcs are next to their polylines.
  std::vector<sheet::PlaneCell> meeting_places(int first, int second) {
    std::vector<sheet::PlaneCell> places;
    for (const Strand& one : strands_)
      for (const Strand& other : strands_) {
        if (one.owner != first || other.owner != second) continue;
        const auto passes = near_passes(boxed(one), boxed(other), chords_apart * map_.tolerance + same_place * size_);
        if (!passes) return {{{low_[0], high_[0]}, {low_[1], high_[1]}}};
        places.insert(places.end(), passes->begin(), passes->end());
      }
    for (sheet::PlaneCell& place : places)
      for (const Point2& star : stars_)
        if (place.x.contains(star[0]) && place.y.contains(star[1])) {
          const double reach = around_a_star * size_;
          place = {hull(place.x, {star[0] - reach, star[0] + reach}),
                   hull(place.y, {star[1] - reach, star[1] + reach})};
        }
    return sheet::clusters(std::move(places));
  }

  const BoxedPolyline& boxed(const Strand& strand) { return boxed_.try_emplace(&strand, strand.points).first->second; }
  const BoxedPolyline& boxed_edge(int edge) {
    return boxed_edges_.try_emplace(edge, graph().edges[static_cast<std::size_t>(edge)].points).first->second;
  }

  /// False: there may be more than are found.
  bool add_crossings_in(const sheet::PlaneCell& place, int a, int b) {
    const std::vector<core::Rational> lower = {core::Rational(place.x.lower()), core::Rational(place.y.lower())},
                                      upper = {core::Rational(place.x.upper()), core::Rational(place.y.upper())};
    const core::LocusFactor *first = factor_of(problem_, curve(a)), *second = factor_of(problem_, curve(b));
    if (first == nullptr || second == nullptr) {
      doubt_for_good("crossings of " + curve(a).id + " and " + curve(b).id + " are not proven");
      return true;
    }
    sheet::ZeroOptions effort = effort_in(place);
    // Where both have gradients a leg without length is a crossing like others.
    std::erase_if(effort.special, [&](const sheet::Star& star) {
      return star.no_length && !star.is_sheared() && sheet::is_smooth_at(star, first->sheet) &&
             sheet::is_smooth_at(star, second->sheet);
    });
    if (!margin_nodes_) margin_nodes_ = std::make_unique<MarginNodes>(problem_, mode_, effort_);
    for (sheet::Star& node : margin_nodes_->of(*first, *second)) effort.special.push_back(std::move(node));
    if (first != second && !share_a_curve(*first, *second)) {
      // Where only polynomials are asked for, the second factor's own is.
      sheet::SheetFunction other = {second->sheet, difference_of_margins(*first, *second)};
      if (other.line.empty()) other.line = second->line;
      return add_zeros(sheet::isolated_zeros(problem_.tower, mode_, {first->sheet, first->line}, other, lower, upper,
                                             effort)) ||
             add_margin_crossings(a, b, lower, upper, effort) || add_singular_crossings(a, b, lower, upper, effort);
    }
    // Curves of one factor, and of two that vanish on one curve besides, are told apart in the plane; the tower knows
    // where it is undefined.
    const auto widened = [&](const core::Polynomial& p) { return core::with_variables(p, problem_.tower.variables()); };
    sheet::ZeroSet found = sheet::isolated_zeros(problem_.tower, mode_, widened(curve(a).implicit),
                                                 widened(curve(b).implicit), lower, upper, effort);
    keep_passed(found, a, b);
    return add_zeros(found);
  }

  sheet::ZeroOptions effort_in(const sheet::PlaneCell& place) const {
    sheet::ZeroOptions effort = effort_;
    effort.smallest = std::min(0.1, effort_.smallest * size_ / std::max(place.x.width(), place.y.width()));
    return effort;
  }

  /// Of zeros those in which both curves have arcs.
  void keep_passed(sheet::ZeroSet& found, int a, int b) {
    const auto is_elsewhere = [&](const sheet::SheetZero& zero) {
      return !passed_by(a, {zero.x, zero.y}) || !passed_by(b, {zero.x, zero.y});
    };
    std::erase_if(found.zeros, is_elsewhere);
    std::erase_if(found.touches, is_elsewhere);
  }

  /// Of margins that touch or run side by side: where either crosses what they differ in, or a curve that holds all of
  /// that and that it does not touch. False: there may be more.
  bool add_margin_crossings(int a, int b, const std::vector<core::Rational>& lower,
                            const std::vector<core::Rational>& upper, const sheet::ZeroOptions& effort) {
    if (curve(a).kind != LocusKind::margin || curve(b).kind != LocusKind::margin) return false;
    const core::LocusFactor &first = *factor_of(problem_, curve(a)), &second = *factor_of(problem_, curve(b));
    const auto [known, is_new] = apart_.try_emplace({&first, &second});
    Apart& apart = known->second;
    if (is_new) apart.on_sheet = margins_apart(problem_, first, second);
    const auto crosses_all = [&](const core::LocusFactor& margin, const core::Polynomial& other) {
      if (other.is_zero()) return false;
      sheet::ZeroSet found = sheet::isolated_zeros(problem_.tower, mode_, {margin.sheet, margin.line},
                                                   sheet::SheetFunction{other}, lower, upper, effort);
      keep_passed(found, a, b);
      return add_zeros(found);
    };
    if (crosses_all(first, apart.on_sheet) || crosses_all(second, apart.on_sheet)) return true;
    if (!apart.in_plane)
      apart.in_plane =
          core::with_variables(curve_through_crossings(problem_, first, second).value_or(core::Polynomial{2, {}}),
                               problem_.tower.variables());
    return crosses_all(first, *apart.in_plane) || crosses_all(second, *apart.in_plane);
  }

  /// Of a locus and a margin of the same reaction: w = 0 and |w| = f > 0 hold together nowhere but where |A| = 0. So
  /// the one crosses |A| wherever it meets the other, beside which it may run for long. False: there may be more.
  bool add_singular_crossings(int a, int b, const std::vector<core::Rational>& lower,
                              const std::vector<core::Rational>& upper, const sheet::ZeroOptions& effort) {
    const bool first_is_margin = curve(a).kind == LocusKind::margin;
    const core::LocusFactor &margin = *factor_of(problem_, curve(first_is_margin ? a : b)),
                            &locus = *factor_of(problem_, curve(first_is_margin ? b : a));
    if (margin.role != core::FactorRole::margin || locus.role != core::FactorRole::reaction ||
        !is_margin_of(problem_, margin, locus))
      return false;
    return std::all_of(margin.cleared.begin(), margin.cleared.end(), [&](const auto& part) {
      sheet::ZeroSet found = sheet::isolated_zeros(problem_.tower, mode_, {locus.sheet, locus.line},
                                                   sheet::SheetFunction{part.first}, lower, upper, effort);
      keep_passed(found, a, b);
      return add_zeros(found);
    });
  }

  /// Then their common zeros are not isolated, wherever other curves of theirs meet.
  bool share_a_curve(const core::LocusFactor& first, const core::LocusFactor& second) {
    const auto [found, is_new] = sharing_.try_emplace({&first, &second}, false);
    if (!is_new) return found->second;
    if (factors_of_curves_.empty())
      for (const core::LocusCurve& curve : map_.curves) factors_of_curves_.push_back(factor_of(problem_, curve));
    for (std::size_t i = 0; i < map_.curves.size(); ++i)
      for (std::size_t k = 0; k < map_.curves.size() && factors_of_curves_[i] == &first; ++k)
        if (factors_of_curves_[k] == &second && is_one_curve(map_.curves[i], map_.curves[k])) found->second = true;
    return found->second;
  }

  /// Whether a curve has arcs there.
  bool passed_by(int owner, const Point2& at) {
    return std::any_of(strands_.begin(), strands_.end(), [&](const Strand& strand) {
      return strand.owner == owner && !passes(strand.points, boxed(strand), at, reach_of(strand)).empty();
    });
  }

  /// Of lines and circles. False: they are others.
  bool add_closed_crossings(int first, int second) {
    const auto points = circle_crossings(curve(first).closed_form, curve(second).closed_form);
    if (!points) return false;
    for (const Point2& at : *points)
      if (passed_by(first, at) && passed_by(second, at)) node_at(at);
    return true;
  }

  /// Those that the polylines of these pairs of owners show, moved onto both curves.
  void add_drawn_crossings(const std::set<std::pair<int, int>>& pairs) {
    std::set<int> owners;
    for (const auto& [first, second] : pairs) owners.insert({first, second});
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < strands_.size(); ++i)
      if (owners.contains(strands_[i].owner)) add_segments(strands_[i].points, static_cast<int>(i), segments);
    each_crossing(std::move(segments), [&](const Segment& s, const Segment& t) {
      const int first = strands_[static_cast<std::size_t>(s.of)].owner,
                second = strands_[static_cast<std::size_t>(t.of)].owner;
      if (!pairs.contains({first, second}) && !pairs.contains({second, first})) return;
      const double part = turn(t.a, t.b, s.a) / (turn(t.a, t.b, s.a) - turn(t.a, t.b, s.b));
      const Point2 drawn = {s.a[0] + part * (s.b[0] - s.a[0]), s.a[1] + part * (s.b[1] - s.a[1])};
      const Point2 at = on_both(*projection(first), *projection(second), drawn);
      node_at(distance(at, drawn) <= drawn_off * map_.tolerance ? at : drawn);
    });
  }

  /// Where the tangents of both curves meet, time and again.
  static Point2 on_both(const CurveProjection& first, const CurveProjection& second, Point2 at) {
    for (int round = 0; round < 6; ++round) {
      const auto [p, v] = first(at);
      const auto [q, w] = second(at);
      const double cross = v[0] * w[1] - v[1] * w[0];
      if (cross == 0) break;
      const double part = ((q[0] - p[0]) * w[1] - (q[1] - p[1]) * w[0]) / cross;
      at = {p[0] + part * v[0], p[1] + part * v[1]};
    }
    return at;
  }

  /// False: there may be more. An open cell where something ends anyway is no doubt.
  bool add_zeros(const sheet::ZeroSet& found) {
    for (const std::vector<sheet::SheetZero>* list : {&found.zeros, &found.touches})
      for (const sheet::SheetZero& zero : *list) node_at({zero.x, zero.y});
    for (const sheet::PlaneCell& cell : found.at_cones) node_at({cell.x.middle(), cell.y.middle()});
    return !found.gave_up &&
           std::all_of(found.undecided.begin(), found.undecided.end(), [&](const sheet::PlaneCell& cell) {
             const Point2 at = {cell.x.middle(), cell.y.middle()};
             const double width = std::max(cell.x.width(), cell.y.width());
             return width <= map_.tolerance &&
                    std::any_of(graph().nodes.begin(), graph().nodes.end(), [&](const Point2& node) {
                      return distance(node, at) <= 2 * width + same_place * size_;
                    });
           });
  }

  /// The rung above: the exact arrangement of the two curves, for all modes at once.
  void add_plane_crossings(const core::LocusCurve& a, const core::LocusCurve& b) {
    if (std::max(core::total_degree(a.implicit), core::total_degree(b.implicit)) > exact_degree)
      return doubt_for_good("crossings of " + a.id + " and " + b.id + " are not proven");
    const CurveArrangement both({a.implicit, b.implicit}, {map_.lower[0], map_.lower[1]},
                                {map_.upper[0], map_.upper[1]});
    std::vector<std::array<bool, 2>> on(both.vertices(), {false, false});
    for (const ArrangementEdge& edge : both.edges()) {
      if (edge.curve > 1) continue;
      for (const int v : {edge.from, edge.to})
        on[static_cast<std::size_t>(v)][static_cast<std::size_t>(edge.curve)] = true;
    }
    for (std::size_t v = 0; v < on.size(); ++v) {
      if (on[v][0] && on[v][1]) node_at(both.at(static_cast<int>(v)));
    }
  }

  /// None for the sides of the box.
  const CurveProjection* projection(int owner) { return owner == box_owner ? nullptr : &projections_.of(owner); }

  /// How near its polyline a node of the strand may be.
  double reach_of(const Strand& strand) const {
    return (strand.owner == box_owner ? 0 : 2 * map_.tolerance) + same_place * size_;
  }

  /// Whether the nearest place of a strand is an end of it.
  static bool ends_before(const Strand& strand, const Foot& foot) {
    return !strand.closed && (foot.position() == 0 || foot.position() == static_cast<double>(strand.points.size() - 1));
  }

  /// Splits every strand that passes through the node.
  void cut_at(int node) {
    const Point2 at = graph().nodes[static_cast<std::size_t>(node)];
    for (Strand& strand : strands_) {
      for (const Foot& foot : passes(strand.points, boxed(strand), at, reach_of(strand))) {
        // An arc does not go on beyond its ends, which are known: the curve does, maybe through this node.
        if (ends_before(strand, foot) && foot.distance > same_place * size_) continue;
        // A vertex is on the curve, also where the curve is singular and nothing near could be moved onto it. A curve
        // that passes a place for which the node stands is as near to it as that place.
        const auto is_near = [&](std::size_t i) { return distance(strand.points[i], at) <= same_place * size_; };
        const CurveProjection* const curve_projection =
            is_near(foot.segment) || is_near(foot.segment + 1) ? nullptr : projection(strand.owner);
        if (curve_projection != nullptr && distance((*curve_projection)(at).at, at) > 2 * same_place * size_) continue;
        strand.cuts.emplace_back(foot.position(), node);
      }
    }
  }

  void split(Strand& strand) {
    if (strand.closed && strand.cuts.empty()) strand.cuts.emplace_back(0.0, node_at(strand.points.front()));
    std::sort(strand.cuts.begin(), strand.cuts.end());
    const auto piece = [&](double from, int start, double to, int end) {
      Polyline points = {graph().nodes[static_cast<std::size_t>(start)]};
      for (std::size_t i = static_cast<std::size_t>(std::floor(from)) + 1;
           static_cast<double>(i) < to && i < strand.points.size(); ++i) {
        points.push_back(strand.points[i]);
      }
      points.push_back(graph().nodes[static_cast<std::size_t>(end)]);
      return points;
    };
    for (std::size_t i = 1; i < strand.cuts.size(); ++i) {
      const auto& [from, start] = strand.cuts[i - 1];
      const auto& [to, end] = strand.cuts[i];
      add_edge(start, end, piece(from, start, to, end), strand.owner);
    }
    if (!strand.closed) return;
    // From the last cut round to the first.
    const auto& [from, start] = strand.cuts.back();
    const auto& [to, end] = strand.cuts.front();
    const double last = static_cast<double>(strand.points.size() - 1);
    Polyline points = piece(from, start, last, start);
    points.pop_back();
    if (from < last && to > 0) points.push_back(strand.points.front());
    const Polyline rest = piece(0, start, to, end);
    points.insert(points.end(), rest.begin() + 1, rest.end());
    add_edge(start, end, std::move(points), strand.owner);
  }

  static Point2 halfway(const Polyline& points) {
    double length = 0;
    for (std::size_t i = 1; i < points.size(); ++i) length += distance(points[i - 1], points[i]);
    double left = length / 2;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double step = distance(points[i - 1], points[i]);
      if (step >= left && step > 0) {
        const double t = left / step;
        return {points[i - 1][0] + t * (points[i][0] - points[i - 1][0]),
                points[i - 1][1] + t * (points[i][1] - points[i - 1][1])};
      }
      left -= step;
    }
    return points.back();
  }

  /// Pieces of one curve with the same ends and the same middle are one edge with several owners.
  void add_edge(int from, int to, Polyline points, int owner) {
    double extent = 0;
    for (const Point2& p : points) extent = std::max(extent, distance(p, points.front()));
    if (from == to && extent <= 4 * same_place * size_) return;
    const Point2 middle = halfway(points);
    for (GraphEdge& edge : graph().edges) {
      const bool same_ends = (edge.from == from && edge.to == to) || (edge.from == to && edge.to == from);
      if (!same_ends) continue;
      const bool same_curve = std::any_of(edge.owners.begin(), edge.owners.end(), [&](int other) {
        if (owner == box_owner || other == box_owner) return on_box(points) && on_box(edge.points);
        return curve(other).implicit == curve(owner).implicit;
      });
      double off = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i + 1 < edge.points.size(); ++i)
        off = std::min(off, foot_on(edge.points, i, middle).distance);
      if (!same_curve || off > 2 * map_.tolerance + same_place * size_) continue;
      if (std::find(edge.owners.begin(), edge.owners.end(), owner) == edge.owners.end()) edge.owners.push_back(owner);
      return;
    }
    graph().edges.push_back({from, to, std::move(points), {owner}});
  }

  bool on_box(const Polyline& points) const {
    const double slack = same_place * size_;
    for (std::size_t i = 0; i < 2; ++i) {
      for (const double side : {low_[i], high_[i]}) {
        if (std::all_of(points.begin(), points.end(), [&](const Point2& p) { return std::abs(p[i] - side) <= slack; }))
          return true;
      }
    }
    return false;
  }

  void order_edges() {
    PlaneGraph& g = graph();
    g.around.assign(g.nodes.size(), {});
    for (std::size_t e = 0; e < g.edges.size(); ++e) {
      g.around[static_cast<std::size_t>(g.edges[e].from)].push_back({static_cast<int>(e), false});
      g.around[static_cast<std::size_t>(g.edges[e].to)].push_back({static_cast<int>(e), true});
    }
    extents_.assign(g.nodes.size(), 0.0);
    std::vector<std::size_t> unclear;
    for (std::size_t n = 0; n < g.nodes.size(); ++n)
      if (!order_around(n)) unclear.push_back(n);
    for (const std::size_t n : unclear) {
      bool is_told = order_around(n);
      while (!is_told && join_nearest(n)) is_told = order_around(n);
      if (!is_told) doubt("the order of curves around a crossing is not clear");
    }
    for (const auto& [half, lead] : leads_) put_before(half, lead);
    std::vector<bool> is_within(g.edges.size(), false);
    for (std::size_t e = 0; e < g.edges.size(); ++e)
      is_within[e] = !is_among(g.around[static_cast<std::size_t>(g.edges[e].from)], static_cast<int>(e));
    if (std::find(is_within.begin(), is_within.end(), true) != is_within.end()) g = without_edges(g, is_within);
    for (std::size_t n = 0; n < g.nodes.size(); ++n)
      if (extents_[n] > 0) result_.joined.push_back({{g.nodes[n], extents_[n]}, static_cast<int>(n)});
  }

  using End = std::pair<int, bool>;  ///< edge, reversed

  /// From the node of a half-edge to that at its other end, also where these were joined with others.
  Polyline whole_way(HalfEdge half) const {
    Polyline points = result_.graph.edges[static_cast<std::size_t>(half.edge)].points;
    if (half.reversed) std::reverse(points.begin(), points.end());
    if (const auto lead = leads_.find({half.edge, half.reversed}); lead != leads_.end())
      points.insert(points.begin(), lead->second.begin(), lead->second.end() - 1);
    if (const auto lead = leads_.find({half.edge, !half.reversed}); lead != leads_.end())
      points.insert(points.end(), lead->second.rbegin() + 1, lead->second.rend());
    return points;
  }

  void put_before(const End& end, const Polyline& lead) {
    Polyline& points = graph().edges[static_cast<std::size_t>(end.first)].points;
    if (end.second)
      points.insert(points.end(), lead.rbegin() + 1, lead.rend());
    else
      points.insert(points.begin(), lead.begin(), lead.end() - 1);
  }

  static bool is_among(const std::vector<HalfEdge>& around, int edge) {
    return std::any_of(around.begin(), around.end(), [&](HalfEdge half) { return half.edge == edge; });
  }

  /// Shrinks the shortest edge that leads from a node to another one, so that both are one node. Faces stay what they
  /// are, but for those between edges that are all in the circle about the node: these are left out. False: none is
  /// near.
  bool join_nearest(std::size_t n) {
    PlaneGraph& g = graph();
    const Point2 centre = g.nodes[n];
    std::optional<HalfEdge> shortest;
    double extent = widest_join * size_;
    for (const HalfEdge half : g.around[n]) {
      const auto other = static_cast<std::size_t>(head(g, half));
      if (other == n) continue;
      const double reach =
          std::max({extents_[n], reach_of(half, centre), distance(g.nodes[other], centre) + extents_[other]});
      if (reach > extent) continue;
      shortest = half;
      extent = reach;
    }
    if (!shortest) return false;
    const auto nearest = static_cast<std::size_t>(head(g, *shortest));
    const Polyline way = whole_way(*shortest);
    for (const HalfEdge half : g.around[nearest]) {
      Polyline& lead = leads_[{half.edge, half.reversed}];
      lead.insert(lead.begin(), way.begin(), lead.empty() ? way.end() : way.end() - 1);
      GraphEdge& edge = g.edges[static_cast<std::size_t>(half.edge)];
      (half.reversed ? edge.to : edge.from) = static_cast<int>(n);
      g.around[n].push_back(half);
    }
    g.around[nearest].clear();
    extents_[nearest] = 0;
    extents_[n] = extent;
    std::erase_if(g.around[n], [&](HalfEdge half) {
      const GraphEdge& edge = g.edges[static_cast<std::size_t>(half.edge)];
      return edge.from == edge.to && reach_of(half, centre) <= extent;
    });
    return true;
  }

  /// Loci that meet the boundary do so tangentially: chords would lie about their order, points of the curves do not.
  /// No curves meet between the node and the circles, so that any circle would do; two that agree guard against a point
  /// that was moved onto another branch. False: rounding hides the order.
  bool order_around(std::size_t n) {
    auto& around = graph().around[n];
    if (around.size() < 3) return true;
    double radius = largest_circle * size_;
    for (const HalfEdge half : around) radius = std::min(radius, 0.4 * reach_of(half, graph().nodes[n]));
    for (std::size_t k = 0; k < graph().nodes.size(); ++k) {
      if (k != n && !graph().around[k].empty())
        radius = std::min(radius, 0.5 * distance(graph().nodes[k], graph().nodes[n]));
    }
    std::vector<HalfEdge> order;
    int agreeing = 0;
    const double smallest = std::max(smallest_circle * size_, beyond_join * extents_[n]);
    // A curve is followed from the node where no point near it could be moved onto it.
    for (const bool follow : {false, true})
      for (double r = radius; r > smallest && agreeing < agreeing_circles; r *= follow ? 0.9 : 0.6) {
        std::vector<HalfEdge> now = order_on_circle(n, r, follow);
        if (now.empty()) continue;
        agreeing = now == order ? agreeing + 1 : 0;
        order = std::move(now);
      }
    if (!order.empty()) around = std::move(order);
    return agreeing >= agreeing_circles;
  }

  /// How far from its node a half-edge gets.
  double reach_of(HalfEdge half, const Point2& node) const {
    double most = 0;
    for (const Point2& p : result_.graph.edges[static_cast<std::size_t>(half.edge)].points)
      most = std::max(most, distance(p, node));
    return most;
  }

  /// Empty where rounding hides the order.
  std::vector<HalfEdge> order_on_circle(std::size_t n, double radius, bool follow) {
    const Point2 centre = graph().nodes[n];
    std::vector<std::pair<Bearing, HalfEdge>> bearings;
    for (const HalfEdge half : graph().around[n]) {
      const GraphEdge& edge = graph().edges[static_cast<std::size_t>(half.edge)];
      Polyline points = edge.points;
      if (half.reversed) std::reverse(points.begin(), points.end());
      Point2 at = points.back();
      for (std::size_t i = 1; i < points.size(); ++i) {
        const double before = distance(points[i - 1], centre), after = distance(points[i], centre);
        if (after < radius) continue;
        const double t = (radius - before) / (after - before);
        at = {points[i - 1][0] + t * (points[i][0] - points[i - 1][0]),
              points[i - 1][1] + t * (points[i][1] - points[i - 1][1])};
        break;
      }
      Bearing bearing = bearing_of_curve(edge.owners.front(), centre, at, radius);
      if (follow && bearing.doubt > widest_doubt) {
        const Bearing drawn = drawn_bearing(centre, at, radius);
        if (drawn.doubt < bearing.doubt) bearing = drawn;
        const auto followed = followed_bearing(edge.owners.front(), centre, points, radius);
        // Where several branches leave a node another one may be followed.
        if (followed && std::abs(std::remainder(followed->angle - drawn.angle, 2 * std::numbers::pi)) <= drawn.doubt)
          bearing = *followed;
      }
      bearings.emplace_back(bearing, half);
    }
    std::sort(bearings.begin(), bearings.end(),
              [](const auto& a, const auto& b) { return a.first.angle < b.first.angle; });
    const std::size_t count = bearings.size();
    std::vector<bool> is_told(count);  // before the next one
    for (std::size_t i = 0; i < count; ++i) {
      const Bearing &bearing = bearings[i].first, &next = bearings[(i + 1) % count].first;
      const double turn = i + 1 < count ? 0 : 2 * std::numbers::pi;
      is_told[i] = next.angle + turn - bearing.angle > bearing.doubt + next.doubt;
    }
    std::vector<HalfEdge> order;
    for (const auto& [bearing, half] : bearings) order.push_back(half);
    for (std::size_t i = 0; i < count; ++i) {
      if (is_told[i]) continue;
      HalfEdge &first = order[i], &second = order[(i + 1) % count];
      const bool is_pair = count > 2 && is_told[(i + 1) % count] && is_told[(i + count - 1) % count];
      const int turn = is_pair ? turn_within_workspace(first, second) : 0;
      if (turn == 0) return {};
      if (turn < 0) std::swap(first, second);
    }
    // Start from the same half-edge on every circle.
    const auto first = std::min_element(order.begin(), order.end(), [](HalfEdge a, HalfEdge b) {
      return std::pair(a.edge, a.reversed) < std::pair(b.edge, b.reversed);
    });
    std::rotate(order.begin(), first, order.end());
    return order;
  }

  struct Bearing {
    double angle = 0;
    double doubt = 0;  ///< by which it may be wrong
  };

  /// A locus that leaves a node beside a boundary, nearer than rounding, is on the side of the workspace. 1: the second
  /// edge is on the left of the first one, -1: on its right. 0: they are no locus and boundary, or it is not told.
  int turn_within_workspace(HalfEdge first, HalfEdge second) {
    const auto is_boundary = [&](HalfEdge half) {
      const std::vector<int>& owners = graph().edges[static_cast<std::size_t>(half.edge)].owners;
      return std::all_of(owners.begin(), owners.end(), [&](int owner) {
        return owner != box_owner && curve(owner).kind == LocusKind::workspace_boundary;
      });
    };
    const auto is_locus = [&](HalfEdge half) {
      const std::vector<int>& owners = graph().edges[static_cast<std::size_t>(half.edge)].owners;
      return std::all_of(owners.begin(), owners.end(), [&](int owner) {
        return owner != box_owner && curve(owner).kind != LocusKind::workspace_boundary;
      });
    };
    if (is_boundary(first) && is_locus(second)) return side_of_workspace(first);
    if (is_locus(first) && is_boundary(second)) return -side_of_workspace(second);
    return 0;
  }

  /// 1: the workspace is on the left of a boundary, as it leaves its node; -1: on its right; 0: that is not told.
  int side_of_workspace(HalfEdge half) {
    const GraphEdge& edge = graph().edges[static_cast<std::size_t>(half.edge)];
    const CurveProjection* const curve_projection = projection(edge.owners.front());
    if (curve_projection == nullptr) return 0;
    if (!workspace_) workspace_ = std::make_unique<ModeWorkspace>(problem_.tower, mode_);
    const std::size_t i = (edge.points.size() - 1) / 2;
    const Point2 &from = edge.points[i], &to = edge.points[i + 1];
    const double length = distance(from, to);
    if (!(length > 0)) return 0;
    const double sense = half.reversed ? -1 : 1;
    const Point2 left = {sense * (from[1] - to[1]) / length, sense * (to[0] - from[0]) / length};
    const Point2 at = (*curve_projection)({(from[0] + to[0]) / 2, (from[1] + to[1]) / 2}).at;
    // As near as it is told: farther away there may be other boundaries.
    for (double off = nearest_aside * size_; off <= farthest_aside * size_; off *= 4) {
      const auto is_held = [&](double side) {
        return workspace_->holds({at[0] + side * off * left[0], at[1] + side * off * left[1]});
      };
      const std::optional<bool> on_left = is_held(1), on_right = is_held(-1);
      if (on_left && on_right) return *on_left == *on_right ? 0 : *on_left ? 1 : -1;
    }
    return 0;
  }

  /// The same of a curve that is followed from the start of its edge, a node or near the centre; none where it is not
  /// found.
  std::optional<Bearing> followed_bearing(int owner, const Point2& centre, const Polyline& points, double radius) {
    const CurveProjection* const curve_projection = projection(owner);
    if (curve_projection == nullptr) return std::nullopt;
    double ahead = radius, off = std::numeric_limits<double>::infinity();
    Point2 at{};
    for (int i = 0; i < 6 && std::abs(off) > rounding * size_; ++i) {
      const std::optional<Point2> found = curve_projection->at_distance(points.front(), points[1], ahead);
      if (!found) return std::nullopt;
      at = *found;
      off = radius - distance(at, centre);
      ahead += off;
    }
    return Bearing{std::atan2(at[1] - centre[1], at[0] - centre[0]), (std::abs(off) + 2 * rounding * size_) / radius};
  }

  /// The same by where the chords of a curve cross the circle.
  Bearing drawn_bearing(const Point2& centre, const Point2& at, double radius) const {
    return {std::atan2(at[1] - centre[1], at[0] - centre[0]), drawn_doubt * map_.tolerance / radius};
  }

  /// The angle under which a curve crosses the circle: along its tangent to the radius, then back onto the curve.
  Bearing bearing_of_curve(int owner, const Point2& centre, Point2 at, double radius) {
    const CurveProjection* const curve_projection = projection(owner);
    const auto bearing = [&](double off) {
      return Bearing{std::atan2(at[1] - centre[1], at[0] - centre[0]), off / radius + rounding * size_ / radius};
    };
    if (curve_projection == nullptr) return bearing(0);
    const Point2 start = at;
    double off = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 12; ++i) {
      const auto [on, tangent] = (*curve_projection)(at);
      at = on;
      const double rx = on[0] - centre[0], ry = on[1] - centre[1], r = std::hypot(rx, ry);
      off = std::abs(r - radius);
      if (r == 0 || off <= rounding * size_) break;
      const double outward = (rx * tangent[0] + ry * tangent[1]) / r;
      if (std::abs(outward) < 0.1)
        at = {centre[0] + rx * radius / r, centre[1] + ry * radius / r};
      else
        at = {on[0] + (radius - r) / outward * tangent[0], on[1] + (radius - r) / outward * tangent[1]};
    }
    const double beside = std::min(0.5 * radius, drawn_doubt * map_.tolerance + same_place * size_);
    return bearing(distance(at, start) < beside ? off : std::numeric_limits<double>::infinity());
  }

  /// Edges that are proven to meet at nodes only must not seem to cross elsewhere, unless they are too close to tell.
  /// Chords that do are halved until they do not.
  void check_separation() {
    for (int round = 0;; ++round) {
      std::vector<Segment> amiss;
      each_crossing(segments_of_edges(), [&](const Segment& s, const Segment& t) {
        if (!close_to_node(s.of, t.of, s.a) && !close_to_node(s.of, t.of, s.b)) amiss.insert(amiss.end(), {s, t});
      });
      if (amiss.empty()) return;
      if (round == most_halvings || !halve(amiss))
        return doubt("two curves come closer to each other than the tolerance");
    }
  }

  std::vector<Segment> segments_of_edges() {
    std::vector<Segment> segments;
    for (std::size_t e = 0; e < graph().edges.size(); ++e)
      add_segments(graph().edges[e].points, static_cast<int>(e), segments);
    return segments;
  }

  /// A point of the curve amid every one of the chords. False: one is not found.
  bool halve(const std::vector<Segment>& chords) {
    for (const Segment& chord : chords) {
      GraphEdge& edge = graph().edges[static_cast<std::size_t>(chord.of)];
      if (edge.owners.front() == box_owner) continue;
      const auto start =
          std::adjacent_find(edge.points.begin(), edge.points.end(),
                             [&](const Point2& p, const Point2& q) { return p == chord.a && q == chord.b; });
      if (start == edge.points.end()) continue;  // halved already: it crosses two
      const std::optional<Point2> on = projection(edge.owners.front())->between(chord.a, chord.b);
      // Amid the chord of the lifted curve it need not be over the middle of this one.
      if (!on || !is_beside_chord(*on, chord.a, chord.b, chords_apart * map_.tolerance)) return false;
      edge.points.insert(start + 1, *on);
      boxed_edges_.erase(chord.of);
    }
    return true;
  }

  /// Polylines of curves that touch at a node may cross up to where the curves are a tolerance apart.
  bool close_to_node(int first, int second, const Point2& at) {
    const PlaneGraph& g = graph();
    const GraphEdge &a = g.edges[static_cast<std::size_t>(first)], &b = g.edges[static_cast<std::size_t>(second)];
    for (const int n : {a.from, a.to}) {
      if (n != b.from && n != b.to) continue;
      const double close = 3 * map_.tolerance + same_place * size_ + 2 * extents_[static_cast<std::size_t>(n)];
      // From the node along the first edge, as long as the second is next to it.
      Polyline points = a.points;
      if (n == a.to) std::reverse(points.begin(), points.end());
      for (const Point2& p : points) {
        if (passes(b.points, boxed_edge(second), p, close).empty()) break;
        if (p == at || distance(p, at) <= close) return true;
      }
    }
    return false;
  }

  const core::LocusProblem& problem_;
  const core::LocusMap& map_;
  core::WorkingMode mode_;
  bool sketch_;
  sheet::ZeroOptions effort_;
  Polyline stars_;
  Point2 low_{}, high_{};
  double size_ = 1;
  std::vector<Strand> strands_;
  std::map<End, Polyline> leads_;  ///< from a node that others are joined with to where an edge begins
  std::vector<double> extents_;    ///< how far from a node those are that are joined with it; 0: there are none
  std::map<const Strand*, BoxedPolyline> boxed_;
  std::map<int, BoxedPolyline> boxed_edges_;
  CurveProjections& projections_;
  std::vector<const core::LocusFactor*> factors_of_curves_;
  std::map<std::pair<const core::LocusFactor*, const core::LocusFactor*>, bool> sharing_;
  /// Of two margins: functions that vanish where both do; zero: none is known.
  struct Apart {
    core::Polynomial on_sheet;
    std::optional<core::Polynomial> in_plane;  ///< made where the other one does not tell
  };
  std::map<std::pair<const core::LocusFactor*, const core::LocusFactor*>, Apart> apart_;
  std::unique_ptr<MarginNodes> margin_nodes_;     // made where two curves may meet
  std::unique_ptr<ModeWorkspace> workspace_;      // made where a curve leaves a node beside a boundary
  std::unique_ptr<sheet::SheetProgram> factors_;  // made where a curve touches a side
  ZoneGraph result_;
};

}  // namespace

ZoneGraph zone_graph(const core::LocusProblem& problem, const core::LocusMap& map, const core::WorkingMode& mode,
                     CurveProjections& projections, bool sketch) {
  return Builder(problem, map, mode, projections, sketch).build();
}

}  // namespace clearloci::loci
