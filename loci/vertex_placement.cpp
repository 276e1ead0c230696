#include "loci/vertex_placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clearloci::loci {
namespace {

using core::Point2;

double distance(const Point2& a, const Point2& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

class Placement {
 public:
  Placement(const CurveArrangement& arrangement, int edge, const PlaneCurve& curve, double tolerance)
      : arrangement_(arrangement), edge_(edge), curve_(curve), tolerance_(tolerance) {
    const ArrangementEdge& e = arrangement.edges()[static_cast<std::size_t>(edge)];
    start_ = arrangement.vertices()[static_cast<std::size_t>(e.from)].at;
    end_ = arrangement.vertices()[static_cast<std::size_t>(e.to)].at;
  }

  core::Polyline run() {
    core::Polyline line{start_};
    double reach = std::sqrt(8 * tolerance_ * distance(start_, end_));
    while (true) {
      const Point2 here = line.back();
      if (fits(here, end_)) break;
      const PlaneCurve::Jet jet = curve_.jet(here);
      const double bend = jet.curvature();
      if (jet.slope() > 0 && bend > 0) reach = std::sqrt(8 * tolerance_ / bend);
      const Point2 next = step(here, jet, reach);
      if (next[0] <= here[0] || next[0] >= end_[0]) break;  // the rest is shorter than doubles resolve
      line.push_back(next);
    }
    line.push_back(end_);
    return line;
  }

 private:
  /// The curve at an x of the edge.
  Point2 at(double x) const { return {x, arrangement_.y_at(edge_, x)}; }

  /// How far the chord strays from the curve between two of its points; more than the tolerance where the curve may
  /// bend too much in between for samples to tell.
  double deviation(const Point2& a, const Point2& b) const {
    const double length = distance(a, b);
    double worst = 0;
    for (const double t : {0.5, 0.25, 0.75, 0.1, 0.9}) {
      const Point2 chord = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
      const PlaneCurve::Jet jet = curve_.jet(chord);
      double off = jet.distance();
      // Where the gradient nearly vanishes the vertical distance bounds the true one.
      if (off < 0) off = chord[0] > start_[0] && chord[0] < end_[0] ? std::abs(at(chord[0])[1] - chord[1]) : 0;
      else if (jet.curvature() * length * length > 32 * tolerance_) off = std::max(off, 2 * tolerance_);
      worst = std::max(worst, off);
    }
    return worst;
  }

  bool fits(const Point2& a, const Point2& b) const { return deviation(a, b) <= tolerance_; }

  /// The next vertex about `reach` along the curve, drawn back until the chord holds the tolerance.
  Point2 step(const Point2& here, const PlaneCurve::Jet& jet, double reach) const {
    const double slope = jet.slope();
    double dx = reach;
    if (slope > 0) {
      // Along the tangent, and sideways by the curvature: at a vertical tangent only that moves x.
      const double along = std::abs(jet.fy) / slope;
      dx = reach * along + 0.5 * jet.curvature() * reach * reach * (1 - along);
    }
    dx = std::clamp(dx, 1e-15, 0.5 * (end_[0] - here[0]));
    Point2 next = at(here[0] + dx);
    for (int attempt = 0; attempt < 60; ++attempt) {
      const double off = deviation(here, next);
      if (off <= tolerance_) {
        const double room = off > 0 ? std::sqrt(tolerance_ / off) : 4;
        // Well short of the tolerance: try once more, further on.
        if (attempt > 3 || room < 1.25 || next[0] >= 0.5 * (here[0] + end_[0])) break;
        const double further = std::min(dx * std::min(0.9 * room * room, 4.0), 0.5 * (end_[0] - here[0]));
        const Point2 candidate = at(here[0] + further);
        if (deviation(here, candidate) > tolerance_) break;
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
};

}  // namespace

core::Polyline place_vertices(const CurveArrangement& arrangement, int edge, const PlaneCurve& curve,
                              double tolerance) {
  const ArrangementEdge& e = arrangement.edges()[static_cast<std::size_t>(edge)];
  if (e.vertical) {
    return {arrangement.vertices()[static_cast<std::size_t>(e.from)].at,
            arrangement.vertices()[static_cast<std::size_t>(e.to)].at};
  }
  return Placement(arrangement, edge, curve, tolerance).run();
}

core::Polyline circle_arc(const Point2& centre, double radius, const Point2& start, const Point2& via,
                          const Point2& end, double tolerance) {
  const auto angle = [&](const Point2& p) { return std::atan2(p[1] - centre[1], p[0] - centre[0]); };
  const double turn = 2 * std::numbers::pi;
  const auto positive = [&](double a) { return a < 0 ? a + turn : a; };
  const bool closed = start == end;
  const double from = angle(start);
  const double to_via = positive(angle(via) - from);
  double sweep = closed ? turn : positive(angle(end) - from);
  if (!closed && to_via > sweep) sweep -= turn;  // clockwise
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
