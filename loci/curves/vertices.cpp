#include "loci/curves/vertices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace clearloci::loci::sheet {

namespace {

constexpr int most_trials = 14, most_halvings = 12;
// A step is long enough when its chord uses this share of the tolerance; aiming a little below it avoids rejections.
constexpr double enough = 0.55, aim = 0.85;
constexpr double most_growth = 3;
// Points that tell how near a chord is need not be vertices: relative to the region.
constexpr double to_measure = 1e-9;
constexpr std::array<double, 3> samples = {0.25, 0.5, 0.75};

double distance_to_chord(const core::Point2& p, const core::Point2& a, const core::Point2& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
  const double px = p[0] - a[0], py = p[1] - a[1];
  if (length == 0) return std::hypot(px, py);
  const double along = std::clamp((px * dx + py * dy) / length, 0.0, length);
  return std::hypot(px - along * dx / length, py - along * dy / length);
}

/// Places vertices along legs of one patch.
class Run {
 public:
  Run(const CurveGraph& graph, const core::WorkingMode& mode, int patch, double tolerance, double size)
      : mode_(mode),
        chart_(&graph.patches[patch].chart),
        tree_(graph.patches[patch].tree.get()),
        follower_(*graph.patches[patch].program, chart_->side == Chart::Side::plane ? size : 1.0),
        tolerance_(tolerance) {}

  /// Appends the vertices after the first leg's start.
  void follow(const std::vector<Leg>& legs, PlacedArc& arc) {
    ends_.clear();
    for (const Leg& leg : legs) {
      const StretchEnd& end = leg.stretch->ends[leg.forward ? 1 : 0];
      ends_.push_back(end.middle());
    }
    legs_ = &legs;
    LiftedPoint at = legs.front().stretch->ends[legs.front().forward ? 0 : 1].middle();
    std::size_t leg = 0;
    double step = 0.02 * std::sqrt(tolerance_ / 1e-5);
    while (leg < legs.size()) {
      Target target = next(at, leg, step);
      const core::Point2 from = plane(at), to = plane(target.point);
      const double chord = std::hypot(to[0] - from[0], to[1] - from[1]);
      // A shallow arc over a chord c with sagitta d is 8 d^2 / (3 c) longer than it.
      if (target.open) arc.open.push_back({hull(from[0], to[0]), hull(from[1], to[1])});
      // Over one that is shorter than the sagitta it is not shallow: there the bound of either way holds.
      if (chord > 0)
        arc.length += chord + std::min(8 * target.deviation * target.deviation / (3 * chord), 2 * target.deviation);
      arc.points.push_back(to);
      at = std::move(target.point);
      leg = target.leg;
      step = target.step;
    }
  }

 private:
  struct Target {
    LiftedPoint point;
    std::size_t leg = 0;   // where the next step starts
    double step = 0;       // length to try next
    double deviation = 0;  // of the chord, measured
    bool open = false;     // it was not
  };

  core::Point2 plane(const LiftedPoint& p) const { return chart_->to_plane(p[0], p[1]); }

  /// The point proven to be the one on the leg: a solution in its cell, on its sheet, between its ends.
  bool on_leg(const LiftedPoint& p, std::size_t leg) const {
    const Stretch& stretch = *(*legs_)[leg].stretch;
    if (stretch.leaf < 0) return false;
    const PlaneCell& cell = tree_->leaves()[stretch.leaf].cell;
    if (!cell.x.contains(p[0]) || !cell.y.contains(p[1])) return false;
    for (std::size_t j = 0; j < mode_.size(); ++j)
      if (mode_[j] * p[2 + j] <= 0) return false;
    const int v = stretch.along;
    return stretch.ends[0].enclosure[v].upper() < p[v] && p[v] < stretch.ends[1].enclosure[v].lower();
  }

  LiftedPoint oriented_tangent(const LiftedPoint& at, std::size_t leg) {
    LiftedPoint t = follower_.tangent(at);
    const Leg& l = (*legs_)[leg];
    if (t.empty() || l.stretch->leaf < 0) return {};
    // The variable of the leg is monotone along it; where its share vanishes at the very end, the way to the end tells.
    double direction = t[l.stretch->along] * (l.forward ? 1 : -1);
    if (std::abs(t[l.stretch->along]) < 1e-6) {
      LiftedPoint way = ends_[leg];
      for (std::size_t i = 0; i < way.size(); ++i) way[i] -= at[i];
      direction = dot(way, t);
    }
    if (direction < 0)
      for (double& entry : t) entry = -entry;
    return t;
  }

  double ahead(const LiftedPoint& p, const LiftedPoint& at, const LiftedPoint& tangent) const {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += tangent[i] * (p[i] - at[i]);
    return sum;
  }

  /// The curve's point at distance `h` ahead of `at` along its tangent, if it is proven to lie on `leg`.
  bool point_ahead(const LiftedPoint& at, const LiftedPoint& tangent, double h, std::size_t leg, std::size_t first,
                   LiftedPoint& point) {
    // Start from the straight line between the leg's known ends: better than the tangent after a turn. A leg that
    // turns back, so that its end lies behind, is first left along the tangent.
    const LiftedPoint& start = leg == first ? at : ends_[leg - 1];
    const double from = ahead(start, at, tangent), to = ahead(ends_[leg], at, tangent);
    const double share = to > from ? std::clamp((h - from) / (to - from), 0.0, 1.0) : 0.5;
    const bool back = leg == first && to <= from;
    point = start;
    for (std::size_t i = 0; i < point.size(); ++i)
      point[i] += back ? h * tangent[i] : share * (ends_[leg][i] - start[i]);
    return follower_.correct(point, tangent, dot(tangent, at) + h) && on_leg(point, leg);
  }

  /// The point of a leg at a share of the way, told by its variable, from `start` to `end` on it. The leg is a graph
  /// over that variable: there is one such point. `tangent`: at the start; null where it is not known.
  bool point_between(const LiftedPoint& start, const LiftedPoint& end, double share, std::size_t leg,
                     LiftedPoint& point, double within = SheetFollower::accuracy,
                     const LiftedPoint* tangent = nullptr) {
    const int v = (*legs_)[leg].stretch->along;
    const double way = end[v] - start[v];
    // A parabola that starts along the tangent is near the curve; where the tangent is steep it leads away.
    constexpr double steepest = 4;
    const double length = tangent != nullptr ? way / (*tangent)[v] : 0;
    const bool bent = tangent != nullptr && std::abs((*tangent)[v]) * steepest > 1;
    point = start;
    for (std::size_t i = 0; i < point.size(); ++i) {
      const double chord = end[i] - start[i];
      point[i] += share * (bent ? share * chord + (1 - share) * length * (*tangent)[i] : chord);
    }
    point[v] = start[v] + share * way;
    LiftedPoint row(point.size(), 0.0);
    row[static_cast<std::size_t>(v)] = 1;
    const double value = point[static_cast<std::size_t>(v)];
    return follower_.correct(point, row, value, within) && on_leg(point, leg);
  }

  /// Largest distance from the chord a, b of the points between two of one leg; infinite where they are not found.
  double deviation_between(const LiftedPoint& start, const LiftedPoint& end, std::size_t leg, const core::Point2& a,
                           const core::Point2& b, const LiftedPoint* tangent = nullptr) {
    double largest = 0;
    LiftedPoint point;
    for (const double share : samples) {
      if (!point_between(start, end, share, leg, point, to_measure, tangent))
        return std::numeric_limits<double>::infinity();
      largest = std::max(largest, distance_to_chord(plane(point), a, b));
    }
    return largest;
  }

  /// One trial step: up to `h` ahead. Returns the target; `forced`: it could not go farther for other reasons than h.
  Target reach(const LiftedPoint& at, std::size_t first, const LiftedPoint& tangent, double h, bool& forced) {
    forced = true;
    Target target;
    double reached = 0;
    std::size_t leg = first;
    for (; leg < legs_->size(); ++leg) {
      if ((*legs_)[leg].stretch->leaf < 0) break;
      const double end = ahead(ends_[leg], at, tangent);
      const bool back = end <= reached;  // the curve turns back: a vertex before this leg, or inside it
      if (back && leg != first) break;
      if (back || end > h) {
        if (point_ahead(at, tangent, h, leg, first, target.point)) {
          forced = false;
          target.leg = leg;
          return target;
        }
        break;
      }
      reached = end;
    }
    // Nothing inside: the last known end that is ahead, at least the end of the first leg.
    target.leg = std::max(leg, first + 1);
    target.point = ends_[target.leg - 1];
    forced = leg == legs_->size() || leg == first;
    return target;
  }

  /// Largest distance of known points of the curve between `at` and the target from the chord.
  double deviation(const LiftedPoint& at, std::size_t first, const LiftedPoint& tangent, const Target& target) {
    const core::Point2 a = plane(at), b = plane(target.point);
    double largest = 0;
    // In a leg that makes up much of the step its own variable tells the points in between, whichever way it bends.
    constexpr double much = 0.25;
    bool sampled = false;
    for (std::size_t leg = first; leg < ends_.size() && leg <= target.leg; ++leg) {
      const LiftedPoint& start = leg == first ? at : ends_[leg - 1];
      const bool partly = leg == target.leg;
      if (partly && start == target.point) break;
      const LiftedPoint& end = partly ? target.point : ends_[leg];
      if (!partly) largest = std::max(largest, distance_to_chord(plane(end), a, b));
      const core::Point2 from = plane(start), to = plane(end);
      const double part = std::hypot(to[0] - from[0], to[1] - from[1]);
      if ((*legs_)[leg].stretch->leaf < 0 || part < much * std::hypot(b[0] - a[0], b[1] - a[1])) continue;
      sampled = true;
      largest = std::max(largest, deviation_between(start, end, leg, a, b, leg == first ? &tangent : nullptr));
    }
    if (sampled) return largest;
    const double h = ahead(target.point, at, tangent);
    if (h <= 0) return largest;
    LiftedPoint point;
    for (const double share : samples) {
      std::size_t leg = first;
      while (leg + 1 < ends_.size() && leg < target.leg && ahead(ends_[leg], at, tangent) < share * h) ++leg;
      if ((*legs_)[leg].stretch->leaf < 0 || !point_ahead(at, tangent, share * h, leg, first, point)) continue;
      largest = std::max(largest, distance_to_chord(plane(point), a, b));
    }
    return largest;
  }

  Target next(const LiftedPoint& at, std::size_t leg, double step) {
    const LiftedPoint tangent = oriented_tangent(at, leg);
    Target best;
    bool have_best = false;
    if (tangent.empty()) return along(at, leg, step);
    double h = step;
    for (int trial = 0; trial < most_trials; ++trial) {
      bool forced = false;
      Target target = reach(at, leg, tangent, h, forced);
      target.deviation = deviation(at, leg, tangent, target);
      const double reached = ahead(target.point, at, tangent);
      const double length = reached > 0 ? std::min(reached, h) : h;
      const double ratio = target.deviation > 0 ? std::sqrt(aim * tolerance_ / target.deviation) : most_growth;
      if (target.deviation <= tolerance_) {
        const bool longer = !have_best || target.leg > best.leg || reached > ahead(best.point, at, tangent);
        target.step = length * std::clamp(ratio, 0.2, most_growth);
        if (longer) best = target, have_best = true;
        if (forced || target.deviation >= enough * tolerance_ || !longer) break;
        h = std::max(h, length) * std::clamp(ratio, 1.1, most_growth);
      } else {
        if (have_best) break;
        h = length * std::clamp(ratio, 0.1, 0.9);
      }
    }
    // A step that hardly moves is none: the hyperplanes across the tangent do not meet the curve ahead.
    const int v = (*legs_)[leg].stretch->along;
    constexpr double least_share = 1e-4;
    const bool moves = have_best && (best.leg > leg ||
                                     std::abs(best.point[v] - at[v]) > least_share * std::abs(ends_[leg][v] - at[v]));
    return moves ? best : along(at, leg, step);
  }

  /// A step told by the leg's own variable, halved until the chord is near enough.
  Target along(const LiftedPoint& at, std::size_t leg, double step) {
    Target end;
    end.point = ends_[leg];
    end.leg = leg + 1;
    end.step = step;
    const core::Point2 from = plane(at), to = plane(end.point);
    const bool short_one = std::hypot(to[0] - from[0], to[1] - from[1]) <= tolerance_;
    if (short_one || (*legs_)[leg].stretch->leaf < 0) return end;
    end.deviation = deviation_between(at, end.point, leg, plane(at), plane(end.point));
    if (end.deviation <= tolerance_) return end;
    Target part = end;
    part.leg = leg;
    for (int halvings = 1; halvings <= most_halvings; ++halvings) {
      if (!point_between(at, ends_[leg], std::ldexp(1.0, -halvings), leg, part.point)) continue;
      part.deviation = deviation_between(at, part.point, leg, plane(at), plane(part.point));
      if (part.deviation <= tolerance_) return part;
    }
    // No point between is found: how near the chord is is not known.
    end.deviation = 0;
    end.open = true;
    return end;
  }

  core::WorkingMode mode_;
  const Chart* chart_;
  const CellTree* tree_;
  SheetFollower follower_;
  double tolerance_;
  const std::vector<Leg>* legs_ = nullptr;
  std::vector<LiftedPoint> ends_;  // where each leg ends
};

/// Half of the way: where a curve is hard to tell there are many legs, of no length.
const Stretch& middle_of(const CurveGraph& graph, const std::vector<Leg>& legs) {
  std::vector<double> way = {0};
  for (const Leg& leg : legs) {
    const core::Point2 &a = graph.crossings[leg.stretch->ends[0].crossing].at,
                       &b = graph.crossings[leg.stretch->ends[1].crossing].at;
    way.push_back(way.back() + std::hypot(b[0] - a[0], b[1] - a[1]));
  }
  if (way.back() == 0) return *legs[legs.size() / 2].stretch;
  const auto half = std::upper_bound(way.begin(), way.end() - 1, way.back() / 2);
  return *legs[static_cast<std::size_t>(half - way.begin()) - 1].stretch;
}

}  // namespace

core::Point2 point_inside(const CurveGraph& graph, const std::vector<Leg>& legs, double size) {
  const Stretch& stretch = middle_of(graph, legs);
  const Patch& patch = graph.patches[stretch.patch];
  LiftedPoint point = stretch.ends[0].middle();
  const LiftedPoint other = stretch.ends[1].middle();
  for (std::size_t i = 0; i < point.size(); ++i) point[i] = 0.5 * (point[i] + other[i]);
  if (stretch.leaf >= 0) {
    LiftedPoint row(point.size(), 0.0);
    row[stretch.along] = 1;
    LiftedPoint moved = point;
    SheetFollower follower(*patch.program, patch.chart.side == Chart::Side::plane ? size : 1.0);
    if (follower.correct(moved, row, point[stretch.along])) return patch.chart.to_plane(moved[0], moved[1]);
  }
  return graph.crossings[stretch.ends[0].crossing].at;
}

PlacedArc place_vertices(const CurveGraph& graph, const core::WorkingMode& mode, const std::vector<Leg>& legs,
                         double tolerance, double size) {
  PlacedArc arc;
  const auto crossing = [&](const Leg& leg, bool start) -> const Crossing& {
    return graph.crossings[leg.stretch->ends[leg.forward == start ? 0 : 1].crossing];
  };
  arc.points.push_back(crossing(legs.front(), true).at);
  for (std::size_t begin = 0; begin < legs.size();) {
    // Through a star a curve goes on in another direction: in the chart's coordinates, at another place.
    std::size_t end = begin + 1;
    while (end < legs.size() && legs[end].stretch->patch == legs[begin].stretch->patch &&
           crossing(legs[end], true).kind != Crossing::Kind::star)
      ++end;
    Run run(graph, mode, legs[begin].stretch->patch, tolerance, size);
    run.follow({legs.begin() + static_cast<std::ptrdiff_t>(begin), legs.begin() + static_cast<std::ptrdiff_t>(end)},
               arc);
    begin = end;
  }
  arc.points.back() = crossing(legs.back(), false).at;
  return arc;
}

}  // namespace clearloci::loci::sheet
