#include "loci/curves/vertex_placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clearloci::loci {
namespace {

using core::Point2;

// Angles between points that are known to rounding, on circles that are not much larger than the box.
constexpr double angle_rounding = 1e-9, small_gap = 1e-6;

double distance(const Point2& a, const Point2& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

class Placement {
 public:
  Placement(const CurveArrangement& arrangement, int edge, const PlaneCurve& curve, double tolerance)
      : arrangement_(arrangement), edge_(edge), curve_(curve), tolerance_(tolerance) {
    const ArrangementEdge& e = arrangement.edges()[static_cast<std::size_t>(edge)];
    start_ = arrangement.at(e.from);
    end_ = arrangement.at(e.to);
    cautious_ = std::sqrt(8 * tolerance * distance(start_, end_));
  }

  core::Polyline run() {
    core::Polyline line{start_};
    double reach = cautious_;
    while (true) {
      const Point2 here = line.back();
      if (fits(here, end_)) break;
      const PlaneCurve::Jet jet = curve_.jet(here);
      const double bend = jet.curvature();
      if (jet.slope() > 0 && bend > 0 && std::isfinite(bend)) reach = std::sqrt(8 * tolerance_ / bend);
      Point2 next = stride(line, jet, reach);
      if (next == here) next = step(here, jet, reach);
      if (next[0] <= here[0] || next[0] >= end_[0]) break;  // the rest is shorter than doubles resolve
      line.push_back(next);
    }
    line.push_back(end_);
    return line;
  }

 private:
  /// The curve at an x of the edge.
  Point2 at(double x) const { return {x, arrangement_.y_at(edge_, x)}; }

  /// Whether roots may be isolated exactly where doubles tell nothing: a millisecond each.
  enum class Isolation { none, where_needed };

  /// How far the chord strays from the curve between two of its points; more than the tolerance where the curve may
  /// bend too much in between for samples to tell, or what they tell is not asked for.
  double deviation(const Point2& a, const Point2& b, Isolation isolation) const {
    const double length = distance(a, b);
    double worst = 0;
    for (const double t : {0.5, 0.25, 0.75, 0.1, 0.9}) {
      const Point2 chord = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
      const PlaneCurve::Jet jet = curve_.jet(chord);
      double off = jet.distance();
      if (off < 0) {
        // Where the gradient nearly vanishes, of the curve's point above or below its distance from the chord, which
        // may be steep; it is dear, so only there.
        if (length > cautious_ || isolation == Isolation::none) return 2 * tolerance_;
        if (chord[0] > start_[0] && chord[0] < end_[0])
          off = std::abs(at(chord[0])[1] - chord[1]) * std::abs(b[0] - a[0]) / length;
        else
          off = 0;
      } else if (jet.curvature() * length * length > 32 * tolerance_) {
        off = std::max(off, 2 * tolerance_);
      }
      worst = std::max(worst, off);
      if (worst > 4 * tolerance_) break;
    }
    return worst;
  }

  bool fits(const Point2& a, const Point2& b) const { return deviation(a, b, Isolation::where_needed) <= tolerance_; }

  /// The next vertex about `reach` along the curve, found in doubles and proven to lie on the same branch; `here`
  /// where no proof is had.
  Point2 stride(const core::Polyline& line, PlaneCurve::Jet jet, double reach) const {
    const Point2 here = line.back();
    const double slope = jet.slope();
    if (line.size() < 2 || !(slope > 0)) return here;
    const Point2 before = line[line.size() - 2];
    Point2 tangent = {-jet.fy / slope, jet.fx / slope};
    if (tangent[0] * (here[0] - before[0]) + tangent[1] * (here[1] - before[1]) < 0) {
      tangent = {-tangent[0], -tangent[1]};
    }
    // Towards the centre of curvature: against the gradient where the second derivative along the tangent is positive.
    const double second =
        jet.fxx * tangent[0] * tangent[0] + 2 * jet.fxy * tangent[0] * tangent[1] + jet.fyy * tangent[1] * tangent[1];
    const Point2 bend = {-second * jet.fx / (slope * slope), -second * jet.fy / (slope * slope)};
    reach = std::min(reach, 0.7 * distance(here, end_));
    Point2 best = here;
    for (int attempt = 0; attempt < 6; ++attempt) {
      const Point2 next = curve_.project({here[0] + reach * tangent[0] + 0.5 * reach * reach * bend[0],
                                          here[1] + reach * tangent[1] + 0.5 * reach * reach * bend[1]});
      const bool inside = next[0] > here[0] && next[0] < end_[0];
      const double off = inside ? deviation(here, next, Isolation::none) : 10 * tolerance_;
      if (off <= tolerance_ && curve_.joined(here, next, off)) {
        best = next;
        if (off > 0.6 * tolerance_ || attempt > 2) break;
        reach *= std::min(0.95 * std::sqrt(tolerance_ / std::max(off, 1e-3 * tolerance_)), 2.0);
        if (reach > 0.7 * distance(here, end_)) break;
        continue;
      }
      if (best != here) break;
      reach *= off > tolerance_ ? std::clamp(0.9 * std::sqrt(tolerance_ / off), 0.2, 0.9) : 0.5;
    }
    return best;
  }

  /// The same with exact root isolation, drawn back until the chord holds the tolerance.
  Point2 step(const Point2& here, const PlaneCurve::Jet& jet, double reach) const {
    const double slope = jet.slope();
    double dx = reach;
    if (slope > 0) {
      // Along the tangent, and sideways by the curvature: at a vertical tangent only that moves x.
      const double along = std::abs(jet.fy) / slope;
      dx = reach * along + 0.5 * jet.curvature() * reach * reach * (1 - along);
    }
    if (!std::isfinite(dx)) dx = reach;
    dx = std::clamp(dx, std::min(1e-15, 0.25 * (end_[0] - here[0])), 0.5 * (end_[0] - here[0]));
    Point2 next = at(here[0] + dx);
    for (int attempt = 0; attempt < 60; ++attempt) {
      const double off = deviation(here, next, Isolation::where_needed);
      if (off <= tolerance_) {
        const double room = off > 0 ? std::sqrt(tolerance_ / off) : 4;
        // Well short of the tolerance: try once more, further on.
        if (attempt > 3 || room < 1.25 || next[0] >= 0.5 * (here[0] + end_[0])) break;
        const double further = std::min(dx * std::min(0.9 * room * room, 4.0), 0.5 * (end_[0] - here[0]));
        const Point2 candidate = at(here[0] + further);
        if (deviation(here, candidate, Isolation::where_needed) > tolerance_) break;
        dx = further;
        next = candidate;
        continue;
      }
      dx *= std::clamp(0.9 * tolerance_ / off, 0.1, 0.8);
      if (here[0] + dx <= here[0]) break;
      next = at(here[0] + dx);
    }
    return next;
  }

  const CurveArrangement& arrangement_;
  int edge_;
  const PlaneCurve& curve_;
  double tolerance_;
  Point2 start_{}, end_{};
  double cautious_ = 0;  ///< a chord that a curve of the edge's size would allow, m
};

}  // namespace

core::Polyline place_vertices(const CurveArrangement& arrangement, int edge, const PlaneCurve& curve,
                              double tolerance) {
  const ArrangementEdge& e = arrangement.edges()[static_cast<std::size_t>(edge)];
  if (e.vertical) {
    return {arrangement.at(e.from), arrangement.at(e.to)};
  }
  return Placement(arrangement, edge, curve, tolerance).run();
}

core::Polyline circle_arc(const Point2& centre, double radius, const Point2& start, const Point2& via,
                          const Point2& end, bool closed, double tolerance) {
  const auto angle = [&](const Point2& p) { return std::atan2(p[1] - centre[1], p[0] - centre[0]); };
  const double turn = 2 * std::numbers::pi;
  const auto positive = [&](double a) { return a < 0 ? a + turn : a; };
  const double from = angle(start);
  const double to_via = positive(angle(via) - from);
  double sweep = closed ? turn : positive(angle(end) - from);
  if (!closed && to_via > sweep) sweep -= turn;  // clockwise
  // Ends that are close together leave a small arc or all but one, and rounding must not choose.
  const double gap = std::min(std::abs(sweep), turn - std::abs(sweep));
  if (!closed && gap < small_gap) {
    const bool short_way = std::min(to_via, turn - to_via) <= gap + angle_rounding;
    if (short_way != (std::abs(sweep) < std::numbers::pi)) sweep += sweep > 0 ? -turn : turn;
  }
  const double widest = 2 * std::acos(std::max(0.0, 1 - tolerance / radius));
  const int chords = std::max({1, static_cast<int>(std::ceil(std::abs(sweep) / widest)), closed ? 3 : 1});
  core::Polyline line{start};
  for (int i = 1; i < chords; ++i) {
    const double a = from + sweep * i / chords;
    line.push_back({centre[0] + radius * std::cos(a), centre[1] + radius * std::sin(a)});
  }
  line.push_back(end);
  return line;
}

}  // namespace clearloci::loci
