#include "loci/tasks/task_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "loci/curves/curves.hpp"
#include "loci/search/search.hpp"

namespace clearloci::loci {
namespace {

using core::LocusMap;
using core::Point2;

Point2 between(const Point2& a, const Point2& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

/// The place on a segment with the least signed distance, if it is less than `best` by more than `gain`: the signed
/// distance changes no faster than the place, which bounds it on pieces.
void search_segment(const TaskRegion& region, const Point2& a, const Point2& b, double gain, double& best, Point2& at) {
  const Point2 middle = between(a, b, 0.5);
  const double half = std::hypot(b[0] - a[0], b[1] - a[1]) / 2;
  const double distance = region.signed_distance(middle);
  if (distance < best) {
    best = distance;
    at = middle;
  }
  if (distance - half >= best - gain || half < gain) return;
  search_segment(region, a, middle, gain, best, at);
  search_segment(region, middle, b, gain, best, at);
}

/// The same on the curve itself, near a place found on its polyline: golden sections along the tangent.
Point2 settled(const TaskRegion& region, const CurveProjection& curve, const Point2& start, double reach) {
  const auto [from, tangent] = curve(start);
  const auto place = [&, from = from, tangent = tangent](double s) {
    return curve({from[0] + s * tangent[0], from[1] + s * tangent[1]}).at;
  };
  if (tangent[0] == 0 && tangent[1] == 0) return start;
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double low = -reach, high = reach;
  double l = high - golden * (high - low), h = low + golden * (high - low);
  double at_l = region.signed_distance(place(l)), at_h = region.signed_distance(place(h));
  for (int i = 0; i < 50; ++i) {
    if (at_l < at_h) {
      high = h, h = l, at_h = at_l;
      l = high - golden * (high - low), at_l = region.signed_distance(place(l));
    } else {
      low = l, l = h, at_l = at_h;
      h = low + golden * (high - low), at_h = region.signed_distance(place(h));
    }
  }
  const Point2 end = place((low + high) / 2);
  return region.signed_distance(end) <= region.signed_distance(from) ? end : from;
}

}  // namespace

std::optional<NearestLocus> nearest_locus(const core::LocusProblem& problem, const LocusMap& map,
                                          const core::WorkingMode& mode, const TaskRegion& region) {
  NearestLocus best;
  best.distance = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < map.curves.size(); ++c) {
    const core::LocusCurve& curve = map.curves[c];
    if (curve.mode != mode || !cuts_workspace(curve.kind)) continue;
    for (const core::Arc& arc : curve.arcs)
      for (std::size_t i = 1; i < arc.points.size(); ++i) {
        const double before = best.distance;
        const double gain = std::max(map.tolerance, std::isfinite(before) ? 1e-3 * std::abs(before) : 0.0);
        search_segment(region, arc.points[i - 1], arc.points[i], gain, best.distance, best.at);
        if (best.distance < before) best.curve = static_cast<int>(c);
      }
  }
  if (best.curve >= 0) {
    CurveProjections projections(problem, map);
    // As far as a place may be from the nearest one and yet no further from the task than the search can tell.
    const double size = core::to_double(map.upper[0] - map.lower[0] + map.upper[1] - map.lower[1]);
    const double reach = std::sqrt(std::max(map.tolerance, 1e-3 * std::abs(best.distance)) * size);
    best.at = settled(region, projections.of(best.curve), best.at, reach);
    best.distance = region.signed_distance(best.at);
  }
  for (std::size_t i = 0; i < map.isolated_points.size(); ++i) {
    const core::IsolatedPoint& point = map.isolated_points[i];
    if (point.mode != mode || point.kind == core::LocusKind::component) continue;
    const Point2 at = {point.at[0], point.at[1]};
    const double distance = region.signed_distance(at);
    if (distance < best.distance) best = {distance, at, -1, static_cast<int>(i)};
  }
  if (best.curve < 0 && best.point < 0) return std::nullopt;
  return best;
}

namespace {

/// Places along the loci, dense enough that the nearest of them is nearest to `spacing`.
core::Polyline places_of(const std::vector<const LocusMap*>& maps, const core::WorkingMode& mode, double spacing) {
  core::Polyline places;
  for (const LocusMap* map : maps) {
    for (const core::LocusCurve& curve : map->curves) {
      if (curve.mode != mode || !cuts_workspace(curve.kind)) continue;
      for (const core::Arc& arc : curve.arcs) {
        if (!arc.points.empty()) places.push_back(arc.points.front());
        for (std::size_t i = 1; i < arc.points.size(); ++i) {
          const Point2 &a = arc.points[i - 1], &b = arc.points[i];
          const int pieces = std::max(1, static_cast<int>(std::ceil(std::hypot(b[0] - a[0], b[1] - a[1]) / spacing)));
          for (int k = 1; k <= pieces; ++k) places.push_back(between(a, b, static_cast<double>(k) / pieces));
        }
      }
    }
    for (const core::IsolatedPoint& point : map->isolated_points)
      if (point.mode == mode && point.kind != core::LocusKind::component) places.push_back({point.at[0], point.at[1]});
  }
  return places;
}

/// Signed clearance of the translated task. Negative: no translation by less than that much more is good enough, since
/// a locus is inside it, or a point of it lies where the mechanism is not as it should be, or two of its points lie in
/// different zones, each at least so far from the loci.
class Clearance {
 public:
  Clearance(core::Polyline places, const core::TaskShape& shape, const SignatureAt& signature)
      : places_(std::move(places)), region_(shape), signature_(signature) {
    const core::Polyline all = region_.samples();
    const std::size_t step = (all.size() + most_samples - 1) / most_samples;
    for (std::size_t i = 0; i < all.size(); i += step) samples_.push_back(all[i]);
  }

  double operator()(const Point2& by) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Point2& p : places_) least = std::min(least, region_.signed_distance({p[0] - by[0], p[1] - by[1]}));
    return least < 0 ? least : std::min(least, -misplaced(by));
  }

 private:
  /// By how much points of the task are in the wrong places; 0 or less: not at all.
  double misplaced(const Point2& by) const {
    struct Seen {
      std::vector<int> signature;
      double distance = 0;
    };
    std::vector<Seen> seen;
    double most = -std::numeric_limits<double>::infinity();
    for (const Point2& sample : samples_) {
      const Point2 at = {sample[0] + by[0], sample[1] + by[1]};
      const auto signature = signature_(at);
      double squared = std::numeric_limits<double>::infinity();
      for (const Point2& p : places_) {
        const double dx = p[0] - at[0], dy = p[1] - at[1];
        squared = std::min(squared, dx * dx + dy * dy);
      }
      const double distance = std::sqrt(squared);
      if (!signature) {
        most = std::max(most, distance);
        continue;
      }
      for (const Seen& other : seen)
        if (other.signature != *signature) most = std::max(most, std::min(other.distance, distance));
      seen.push_back({*signature, distance});
    }
    return most;
  }

  static constexpr std::size_t most_samples = 10;

  core::Polyline places_;
  TaskRegion region_;
  core::Polyline samples_;
  const SignatureAt& signature_;
};

struct TranslationCell {
  Point2 middle{}, half{};
  double clearance = 0;  // at the middle
};

/// The same direction, less far: bisection between the fit and no move at all.
Fit shortened(Fit fit, const Clearance& clearance_at, double clearance, const std::function<bool(const Fit&)>& accept) {
  double good = 1, bad = 0;
  for (int i = 0; i < 14; ++i) {
    const double part = (good + bad) / 2;
    const Point2 by = {part * fit.by[0], part * fit.by[1]};
    (clearance_at(by) > clearance ? good : bad) = part;
  }
  // Now by the proof, from what the places along the loci promise.
  for (const double more : {1e-4, 1e-3, 1e-2}) {
    const double part = std::min(1.0, good + more);
    const Fit shorter = {{part * fit.by[0], part * fit.by[1]}, fit.clearance};
    if (part < 1 && accept(shorter)) return shorter;
  }
  return fit;
}

}  // namespace

std::optional<Fit> fit_task(const std::vector<const LocusMap*>& maps, const core::WorkingMode& mode,
                            const core::TaskShape& shape, double clearance, core::TaskFit goal,
                            const SignatureAt& signature, const std::function<bool(const Fit&)>& accept,
                            const std::function<void()>& pulse) {
  constexpr double resolution = 2e-4;  // of the box
  const auto [low, high] = core::bounds(shape);
  TranslationCell all;
  double size = 0;
  for (std::size_t c = 0; c < 2; ++c) {
    const double least = core::to_double(maps.front()->lower[c] - low[c]);
    const double most = core::to_double(maps.front()->upper[c] - high[c]);
    all.middle[c] = (least + most) / 2;
    all.half[c] = (most - least) / 2;
    size = std::max(size, core::to_double(maps.front()->upper[c] - maps.front()->lower[c]));
  }
  const double spacing = size / 1000, tolerance = maps.front()->tolerance;
  // The nearest place of a locus may lie half a spacing beside the nearest one that is looked at.
  const auto slack = [&](double at) {
    return tolerance + (at > spacing / 2 ? at - std::sqrt(at * at - spacing * spacing / 4) : spacing / 2);
  };
  const Clearance clearance_at(places_of(maps, mode, spacing), shape, signature);
  // The best place has its clearance within the box: what lies outside is not known.
  const auto to_box = [&](const Point2& by) {
    return std::min({all.half[0] - std::abs(by[0] - all.middle[0]), all.half[1] - std::abs(by[1] - all.middle[1])});
  };
  // By the best that a cell can hold.
  BoxSearch<TranslationCell> left(SearchOrder::least_key_first);
  const auto push = [&](TranslationCell cell) {
    cell.clearance = clearance_at(cell.middle);
    if (goal == core::TaskFit::best) cell.clearance = std::min(cell.clearance, to_box(cell.middle));
    const double reach = std::hypot(cell.half[0], cell.half[1]);
    const double shortest = std::hypot(std::max(0.0, std::abs(cell.middle[0]) - cell.half[0]),
                                       std::max(0.0, std::abs(cell.middle[1]) - cell.half[1]));
    if (cell.clearance + reach >= clearance)
      left.push(cell, goal == core::TaskFit::nearest ? shortest : -(cell.clearance + reach));
  };
  push(all);
  const double finest = resolution * size;
  // What the search has seen to be good enough, best first; asked when no open cell can hold better.
  BoxSearch<TranslationCell> found(SearchOrder::least_key_first);
  while (!left.empty() || !found.empty()) {
    pulse();
    if (!found.empty() && (left.empty() || found.next().key <= left.next().key)) {
      const TranslationCell best = found.take();
      // The nearest point of a cell that is good enough all over; else the half widths are 0.
      Fit fit = {best.middle, best.clearance};
      for (std::size_t c = 0; c < 2; ++c)
        if (best.half[c] > 0) fit.by[c] = std::clamp(0.0, best.middle[c] - best.half[c], best.middle[c] + best.half[c]);
      if (!accept(fit)) continue;
      return goal == core::TaskFit::nearest ? shortened(fit, clearance_at, clearance, accept) : fit;
    }
    const double key = left.next().key;
    const TranslationCell cell = left.take();
    const double reach = std::hypot(cell.half[0], cell.half[1]);
    if (goal == core::TaskFit::nearest && cell.clearance - slack(cell.clearance) - reach > clearance) {
      found.push(cell, key);
      continue;
    }
    // The largest clearance is often had along a whole line: it is not worth telling apart its last fifth of a percent.
    if (reach <= std::max(finest, goal == core::TaskFit::best ? 2e-3 * cell.clearance : 0.0)) {
      if (cell.clearance - slack(cell.clearance) <= clearance) continue;
      TranslationCell place = cell;
      place.half = {0, 0};
      found.push(place, goal == core::TaskFit::nearest ? std::hypot(cell.middle[0], cell.middle[1]) : -cell.clearance);
      continue;
    }
    const std::size_t along = cell.half[0] >= cell.half[1] ? 0 : 1;
    for (const double side : {-0.5, 0.5}) {
      TranslationCell part = cell;
      part.half[along] /= 2;
      part.middle[along] += side * cell.half[along];
      push(part);
    }
  }
  return std::nullopt;
}

}  // namespace clearloci::loci
