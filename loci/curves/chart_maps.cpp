#include "loci/curves/chart_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "loci/curves/arc_check.hpp"
#include "loci/curves/chart_points.hpp"
#include "loci/curves/curve_projection.hpp"
#include "loci/curves/open_regions.hpp"
#include "loci/curves/place_words.hpp"
#include "loci/curves/sheet_maps.hpp"

namespace clearloci::loci {
namespace {

using core::Arc;
using core::ArcEnd;
using core::LocusCurve;
using core::LocusMap;
using core::LocusProblem;
using core::Point2;
using core::Polyline;

/// Vertices of two charts on their seam are one place: either is on the curve to 1e-12 of the box.
constexpr double same_place = 1e-8;
/// Largest |d²θ/dt²| of θ = 2 atan t.
constexpr double most_bend = 1.3;

double distance(const Point2& a, const Point2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Per coordinate, where the charts' boxes together begin and end: lengths, and angles.
std::array<std::vector<double>, 2> joined_box(const std::vector<const LocusProblem*>& charts) {
  std::array<std::vector<double>, 2> box;
  for (std::size_t i = 0; i < 2; ++i)
    for (const LocusProblem* chart : charts) {
      const auto at = [&](const core::Rational& end) {
        const double value = core::to_double(end);
        return chart->charts[i] ? core::angle_at(*chart->charts[i], value) : value;
      };
      const double lower = at(chart->lower[i]), upper = at(chart->upper[i]);
      if (box[0].size() <= i) box[0].push_back(lower), box[1].push_back(upper);
      box[0][i] = std::min(box[0][i], lower);
      box[1][i] = std::max(box[1][i], upper);
    }
  return box;
}

/// One chart's map with angles in place of their t.
class Unrolled {
 public:
  /// `reach`: by how much a vertex over the angles may be off.
  Unrolled(const LocusProblem& problem, const LocusMap& map, double tolerance, double reach)
      : problem_(problem), map_(map), projections_(problem, map), tolerance_(tolerance), reach_(reach) {}

  Point2 place(const Point2& at) const {
    Point2 result = at;
    for (std::size_t i = 0; i < 2; ++i)
      if (problem_.charts[i]) result[i] = core::angle_at(*problem_.charts[i], at[i]);
    return result;
  }

  Polyline ring(const Polyline& points) const {
    Polyline result = {place(points.front())};
    for (std::size_t k = 1; k < points.size(); ++k) append_chord(points[k - 1], points[k], result);
    return result;
  }

  /// `open`: where vertices fail the last check (arc_check.hpp), and where chords bend more than is allowed since none
  /// was found between their ends.
  Arc arc(int curve, const Arc& arc, Polyline& open) {
    const CurveProjection& onto = projections_.of(curve);
    const auto [found, fresh] = checks_.try_emplace(curve);
    if (fresh) found->second = checks_of(problem_, map_.curves[static_cast<std::size_t>(curve)]);
    const OneCurve on{onto, found->second, open};
    Arc result = arc;
    result.points = {place(arc.points.front())};
    if (!holds(on.checks, result.points.front(), arc.ends[0])) open.push_back(result.points.front());
    for (std::size_t k = 1; k < arc.points.size(); ++k) {
      append_curve(arc.points[k - 1], arc.points[k], pieces_of(arc.points[k - 1], arc.points[k]), on, result.points);
      const ArcEnd end = k + 1 == arc.points.size() ? arc.ends[1] : ArcEnd::none;
      if (!holds(on.checks, result.points.back(), end)) open.push_back(result.points.back());
    }
    return result;
  }

  /// The polynomial may say more than the closed form: only a line of constant length stays one.
  bool keeps_closed_form(const LocusCurve& curve) const {
    const auto* line = std::get_if<core::LineForm>(&curve.closed_form);
    return line != nullptr && ((line->b == 0 && !problem_.charts[0]) || (line->a == 0 && !problem_.charts[1]));
  }

 private:
  struct OneCurve {
    const CurveProjection& onto;
    std::deque<ArcCheck>& checks;
    Polyline& open;
  };

  /// Into how many parts the image of a chord is cut, for it bends.
  int pieces_of(const Point2& from, const Point2& to) const {
    double bend = 0;
    for (std::size_t i = 0; i < 2; ++i)
      if (problem_.charts[i]) bend = std::max(bend, most_bend / 8 * (to[i] - from[i]) * (to[i] - from[i]));
    return std::max(1, static_cast<int>(std::ceil(std::sqrt(bend / (tolerance_ / 2)))));
  }

  void append_chord(const Point2& from, const Point2& to, Polyline& points) const {
    const int pieces = pieces_of(from, to);
    for (int k = 1; k < pieces; ++k) points.push_back(place(between(from, to, static_cast<double>(k) / pieces)));
    points.push_back(place(to));
  }

  void append_curve(const Point2& from, const Point2& to, int pieces, const OneCurve& curve, Polyline& points) const {
    if (pieces > 1) {
      const int half = pieces / 2;
      if (const auto on = point_between(from, to, static_cast<double>(half) / pieces, curve)) {
        append_curve(from, *on, half, curve, points);
        append_curve(*on, to, pieces - half, curve, points);
        return;
      }
      curve.open.push_back(place(between(from, to, 0.5)));
    }
    points.push_back(place(to));
  }

  /// A point of the curve beside its chord that passes the last check.
  std::optional<Point2> point_between(const Point2& from, const Point2& to, double share, const OneCurve& curve) const {
    const Point2 near = between(from, to, share);
    const auto fits = [&](const Point2& at) {
      return is_beside_chord(at, from, to, 2 * map_.tolerance) && holds(curve.checks, place(at), ArcEnd::none);
    };
    if (const Point2 on = curve.onto(near).at; fits(on)) return on;
    if (const auto on = curve.onto.between(from, to); on && fits(*on)) return on;
    return std::nullopt;
  }

  static Point2 between(const Point2& from, const Point2& to, double share) {
    return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
  }

  /// Whether a vertex over the angles, as it is handed out, passes the last check.
  bool holds(std::deque<ArcCheck>& checks, const Point2& at, ArcEnd end) const {
    Point2 point = at, reach = {reach_, reach_};
    for (std::size_t i = 0; i < 2; ++i) {
      if (!problem_.charts[i]) continue;
      point[i] = core::parameter_at(*problem_.charts[i], at[i]);
      reach[i] *= (1 + point[i] * point[i]) / 2;
      reach[i] += std::numeric_limits<double>::epsilon();  // of what the tangent is rounded by
    }
    return checks.empty() ||
           std::any_of(checks.begin(), checks.end(), [&](ArcCheck& check) { return check.holds(point, end, reach); });
  }

  const LocusProblem& problem_;
  const LocusMap& map_;
  CurveProjections projections_;
  std::map<int, std::deque<ArcCheck>> checks_;
  double tolerance_, reach_;
};

/// Where charts meet: per coordinate, the angles at which one of them ends and another begins.
using Seams = std::array<std::vector<double>, 2>;

Seams seams_of(const std::vector<const LocusProblem*>& charts) {
  Seams seams;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!charts.front()->charts[i]) continue;
    const auto at = [i](const LocusProblem& chart, const core::Rational& t) {
      return core::angle_at(*chart.charts[i], core::to_double(t));
    };
    for (const LocusProblem* below : charts)
      for (const LocusProblem* above : charts)
        if (std::abs(at(*below, below->upper[i]) - at(*above, above->lower[i])) < same_place)
          seams[i].push_back(at(*below, below->upper[i]));
  }
  return seams;
}

bool on_seam(const Seams& seams, const Point2& at) {
  for (std::size_t i = 0; i < 2; ++i)
    for (const double seam : seams[i])
      if (std::abs(at[i] - seam) < same_place) return true;
  return false;
}

/// Whether an arc is within another one: both run along a seam, and either chart has found it.
bool is_within(const Arc& arc, const Arc& other) {
  const auto holds = [&](const Point2& at) {
    for (std::size_t k = 1; k < other.points.size(); ++k) {
      const Point2 &a = other.points[k - 1], &b = other.points[k];
      if (distance(a, at) + distance(at, b) <= distance(a, b) + same_place) return true;
    }
    return false;
  };
  return std::all_of(arc.points.begin(), arc.points.end(), holds);
}

double length_of(const Polyline& points) {
  double sum = 0;
  for (std::size_t k = 1; k < points.size(); ++k) sum += distance(points[k - 1], points[k]);
  return sum;
}

/// Joins arcs that end in the same place on a seam, where no others do.
class Joining {
 public:
  /// `box`: where it begins and ends, by coordinate.
  Joining(std::vector<Arc> arcs, const Seams& seams, const std::array<std::vector<double>, 2>& box)
      : arcs_(std::move(arcs)), seams_(seams), box_(box) {
    std::vector<End> loose;
    for (std::size_t a = 0; a < arcs_.size(); ++a)
      for (const int end : {0, 1})
        if (!arcs_[a].closed && arcs_[a].ends[static_cast<std::size_t>(end)] == ArcEnd::box &&
            on_seam(seams_, at({a, end})))
          loose.push_back({a, end});
    partner_.assign(arcs_.size(), {nobody, nobody});
    for (const End& one : loose) {
      std::vector<End> here;
      for (const End& other : loose)
        if (distance(at(one), at(other)) < same_place) here.push_back(other);
      for (const End& other : here) {
        if (other.arc == one.arc && other.end == one.end) continue;
        if (here.size() == 2) partner_of(one) = other;
      }
      if (here.size() > 2) arcs_[one.arc].ends[static_cast<std::size_t>(one.end)] = ArcEnd::crossing;
      // In one chart only: the other one lost the arc, or has it elsewhere. The chart ends here, the box may not.
      if (here.size() == 1 && !on_side(at(one))) {
        arcs_[one.arc].ends[static_cast<std::size_t>(one.end)] = ArcEnd::none;
        lost_.push_back(at(one));
      }
    }
  }

  /// Where arcs end at a seam and nothing goes on.
  const Polyline& lost() const { return lost_; }

  std::vector<Arc> run() {
    std::vector<Arc> result;
    std::vector<bool> done(arcs_.size(), false);
    // Chains from their loose ends first; what is left then runs in loops.
    for (const bool loops : {false, true})
      for (std::size_t a = 0; a < arcs_.size(); ++a)
        for (const int end : {0, 1})
          if (!done[a] && (loops || partner_of({a, end}).arc == nobody.arc)) result.push_back(chain({a, end}, done));
    return result;
  }

 private:
  struct End {
    std::size_t arc = 0;
    int end = 0;  ///< 0: the first point, 1: the last
  };
  static constexpr End nobody = {static_cast<std::size_t>(-1), 0};

  bool on_side(const Point2& place) const {
    for (std::size_t i = 0; i < 2; ++i)
      if (place[i] < box_[0][i] + same_place || place[i] > box_[1][i] - same_place) return true;
    return false;
  }

  const Point2& at(const End& end) const {
    return end.end == 0 ? arcs_[end.arc].points.front() : arcs_[end.arc].points.back();
  }
  End& partner_of(const End& end) { return partner_[end.arc][static_cast<std::size_t>(end.end)]; }

  /// From an end on, through partners, to a loose end or around.
  Arc chain(const End& first, std::vector<bool>& done) {
    Arc result = arcs_[first.arc];
    if (result.closed) {
      done[first.arc] = true;
      result.length = length_of(result.points);
      return result;
    }
    result.points.clear();
    result.ends[0] = arcs_[first.arc].ends[static_cast<std::size_t>(first.end)];
    for (End start = first;;) {
      done[start.arc] = true;
      Polyline points = arcs_[start.arc].points;
      if (start.end == 1) std::reverse(points.begin(), points.end());
      result.points.insert(result.points.end(), points.begin() + (result.points.empty() ? 0 : 1), points.end());
      const End last = {start.arc, 1 - start.end};
      result.ends[1] = arcs_[last.arc].ends[static_cast<std::size_t>(last.end)];
      start = partner_of(last);
      if (start.arc == nobody.arc) break;
      if (done[start.arc]) {  // around
        result.closed = true;
        result.ends = {ArcEnd::none, ArcEnd::none};
        result.points.back() = result.points.front();
        break;
      }
    }
    result.length = length_of(result.points);
    return result;
  }

  std::vector<Arc> arcs_;
  const Seams& seams_;
  const std::array<std::vector<double>, 2>& box_;
  std::vector<std::array<End, 2>> partner_;
  Polyline lost_;
};

/// `open`: over the angles.
std::string note_of_open(const LocusCurve& curve, const Polyline& open) {
  std::array<double, 4> box = {open[0][0], open[0][0], open[0][1], open[0][1]};
  for (const Point2& at : open)
    for (std::size_t i = 0; i < 2; ++i) {
      box[2 * i] = std::min(box[2 * i], at[i]);
      box[2 * i + 1] = std::max(box[2 * i + 1], at[i]);
    }
  return "vertices of " + curve_words(curve) + " are not known to rounding, " + place_words(box);
}

bool is_same(const LocusCurve& a, const LocusCurve& b) {
  return a.kind == b.kind && a.vanishing == b.vanishing && a.factor == b.factor && a.cause == b.cause &&
         a.mode == b.mode && a.excited == b.excited;
}

}  // namespace

double chart_tolerance(double tolerance) { return tolerance / 4; }

LocusMap join_charts(const std::vector<const LocusProblem*>& charts, std::vector<LocusMap> maps,
                     std::vector<core::WorkingMode> modes, double tolerance) {
  core::ensure(!charts.empty() && charts.size() == maps.size(), "a map for each chart");
  // Sides of a fold, whole forces and margins have roots of their own: modes are compared without, vertices are checked
  // with them.
  const std::vector<LocusMap> traced = maps;
  if (charts.size() > 1) {
    for (LocusMap& map : maps) drop_own_roots(map);
    for (core::WorkingMode& mode : modes) drop_own_roots(traced.front().tower, mode);
  }
  if (charts.front()->tower.coordinates.size() == 1) return join_point_charts(charts, maps, modes);
  core::ensure(charts.front()->charts.size() == 2, "two free coordinates, some of them angles");
  const Seams seams = seams_of(charts);
  LocusMap joined = maps.front();
  joined.curves.clear();
  joined.isolated_points.clear();
  joined.open.clear();
  joined.workspace.clear();
  joined.tolerance = tolerance;
  joined.angles = {charts.front()->charts[0].has_value(), charts.front()->charts[1].has_value()};

  const std::array<std::vector<double>, 2> box = joined_box(charts);
  const double reach = vertex_reach(box[0], box[1]);
  std::vector<std::set<std::size_t>> charts_with;  // by curve of the joined map
  for (std::size_t m = 0; m < maps.size(); ++m) {
    Unrolled unrolled_chart(*charts[m], traced[m], tolerance, reach);
    joined.complete = joined.complete && maps[m].complete;
    joined.out_of_time = joined.out_of_time || maps[m].out_of_time;
    for (core::OpenRegion region : maps[m].open) {
      const Point2 from = unrolled_chart.place({region.lower[0], region.lower[1]});
      const Point2 to = unrolled_chart.place({region.upper[0], region.upper[1]});
      region.lower = {from[0], from[1]};
      region.upper = {to[0], to[1]};
      joined.open.push_back(std::move(region));
    }
    for (const std::string& note : maps[m].notes)
      if (std::find(joined.notes.begin(), joined.notes.end(), note) == joined.notes.end()) joined.notes.push_back(note);
    for (std::size_t c = 0; c < maps[m].curves.size(); ++c) {
      const LocusCurve& curve = maps[m].curves[c];
      auto found = std::find_if(joined.curves.begin(), joined.curves.end(),
                                [&](const LocusCurve& other) { return is_same(other, curve); });
      // Two curves of one factor have polynomials of their own, in every chart other ones: together they are one.
      if (found == joined.curves.end() || charts.size() == 1) {
        found = joined.curves.insert(joined.curves.end(), curve);
        found->arcs.clear();
        found->variables = charts[m]->tower.coordinates;
        if (!unrolled_chart.keeps_closed_form(curve)) found->closed_form = {};
        charts_with.emplace_back();
      }
      const auto index = static_cast<std::size_t>(found - joined.curves.begin());
      charts_with[index].insert(m);
      if (!(found->implicit == curve.implicit)) charts_with[index].insert(maps.size());  // of no single polynomial
      found->certified = found->certified && curve.certified;
      Polyline open;
      const bool twice = may_be_on_fold(traced[m].curves[c], *charts[m]);
      const auto before = static_cast<std::ptrdiff_t>(found->arcs.size());
      for (const Arc& arc : curve.arcs) {
        Arc unrolled = unrolled_chart.arc(static_cast<int>(c), arc, open);
        const bool known_already = std::all_of(unrolled.points.begin(), unrolled.points.end(),
                                               [&](const Point2& p) { return on_seam(seams, p); }) &&
                                   std::any_of(found->arcs.begin(), found->arcs.end(),
                                               [&](const Arc& other) { return is_within(unrolled, other); });
        const bool on_other_side =
            twice && std::any_of(found->arcs.begin(), found->arcs.begin() + before,
                                 [&](const Arc& other) { return is_on(unrolled, other, 4 * tolerance); });
        if (!known_already && !on_other_side) found->arcs.push_back(std::move(unrolled));
      }
      if (!open.empty()) {
        found->certified = false;
        joined.notes.push_back(note_of_open(curve, open));
      }
    }
    for (core::IsolatedPoint point : maps[m].isolated_points) {
      const Point2 at = unrolled_chart.place({point.at[0], point.at[1]});
      point.at = {at[0], at[1]};
      const bool is_present = std::any_of(
          joined.isolated_points.begin(), joined.isolated_points.end(), [&](const core::IsolatedPoint& other) {
            return other.kind == point.kind && other.vanishing == point.vanishing && other.mode == point.mode &&
                   distance({other.at[0], other.at[1]}, at) < same_place;
          });
      if (!is_present) joined.isolated_points.push_back(std::move(point));
    }
    for (const core::WorkspaceRegion& region : maps[m].workspace) {
      auto found = std::find_if(joined.workspace.begin(), joined.workspace.end(),
                                [&](const core::WorkspaceRegion& other) { return other.mode == region.mode; });
      if (found == joined.workspace.end()) found = joined.workspace.insert(found, {region.mode, {}});
      for (const Polyline& ring : region.rings) found->rings.push_back(unrolled_chart.ring(ring));
    }
  }
  for (std::size_t c = 0; c < joined.curves.size(); ++c) {
    LocusCurve& curve = joined.curves[c];
    Joining joining(std::move(curve.arcs), seams, box);
    curve.arcs = joining.run();
    for (const Point2& at : joining.lost()) {
      curve.certified = false;
      leave_open(label_of(curve), curve.mode, {at[0], at[0], at[1], at[1]}, joined);
    }
    joined.complete = joined.complete && joining.lost().empty();
    if (charts_with[c].size() > 1) {
      curve.implicit = {2, {}};
      curve.variables.clear();
    }
  }
  const auto rank = [&](const LocusCurve& curve) {
    return std::pair(std::find(modes.begin(), modes.end(), curve.mode) - modes.begin(), curve.kind);
  };
  std::stable_sort(joined.curves.begin(), joined.curves.end(),
                   [&](const LocusCurve& a, const LocusCurve& b) { return rank(a) < rank(b); });
  number_curves(joined.curves);
  return joined;
}

}  // namespace clearloci::loci
