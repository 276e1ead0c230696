#include "loci/workspace_rings.hpp"

#include <algorithm>
#include <cmath>

#include "loci/sheet/sheet_program.hpp"

namespace clearloci::loci {
namespace {

using core::Point2;
using core::Polyline;

// Ends of arcs this near to one another or to the box's side, relative to the box, are one point.
constexpr double same_point = 1e-7;

class Rings {
 public:
  Rings(const core::LocusProblem& problem, const core::WorkingMode& mode)
      : mode_(mode),
        program_(problem.tower, std::vector<core::Polynomial>{}),
        registers_(program_.registers<double>()) {
    for (std::size_t i = 0; i < 2; ++i) {
      lower_[i] = core::to_double(problem.lower[i]);
      upper_[i] = core::to_double(problem.upper[i]);
    }
    reach_ = same_point * std::max(upper_[0] - lower_[0], upper_[1] - lower_[1]);
  }

  std::vector<Polyline> run(const std::vector<const core::Arc*>& boundary) {
    std::vector<Polyline> rings;
    for (const core::Arc* arc : boundary) {
      if (arc->closed)
        rings.push_back(arc->points);
      else
        edges_.push_back(arc->points);
    }
    for (const std::size_t axis : {0u, 1u})
      for (const double at : {lower_[axis], upper_[axis]}) add_side(axis, at, boundary);
    join(rings);
    return rings;
  }

 private:
  bool inside(const Point2& p) {
    registers_.set(0, p[0]);
    registers_.set(1, p[1]);
    for (int j = 0; j < program_.roots(); ++j) {
      registers_.run_square(j);
      if (registers_.square(j) <= 0) return false;
      registers_.set(2 + j, mode_[static_cast<std::size_t>(j)] * std::sqrt(registers_.square(j)));
    }
    return true;
  }

  /// The parts of a side of the box between ends of arcs on it that lie in the workspace.
  void add_side(std::size_t axis, double at, const std::vector<const core::Arc*>& boundary) {
    const std::size_t along = 1 - axis;
    std::vector<Point2> stops(2);
    stops[0][axis] = stops[1][axis] = at;
    stops[0][along] = lower_[along];
    stops[1][along] = upper_[along];
    for (const core::Arc* arc : boundary) {
      if (arc->closed) continue;
      for (const Point2& end : {arc->points.front(), arc->points.back()})
        if (std::abs(end[axis] - at) <= reach_) stops.push_back(end);
    }
    std::sort(stops.begin(), stops.end(), [&](const Point2& a, const Point2& b) { return a[along] < b[along]; });
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const Point2 &a = stops[i], &b = stops[i + 1];
      if (b[along] - a[along] <= reach_) continue;
      Point2 middle{};
      middle[axis] = at;
      middle[along] = 0.5 * (a[along] + b[along]);
      if (inside(middle)) edges_.push_back({a, b});
    }
  }

  /// Walks from edge to edge until it is back; where several meet the first will do, the rule is even-odd.
  void join(std::vector<Polyline>& rings) {
    std::vector<bool> used(edges_.size(), false);
    const auto meet = [&](const Point2& a, const Point2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]) <= reach_; };
    for (std::size_t first = 0; first < edges_.size(); ++first) {
      if (used[first]) continue;
      used[first] = true;
      Polyline ring = edges_[first];
      for (bool found = true; found && !meet(ring.front(), ring.back());) {
        found = false;
        for (std::size_t e = 0; e < edges_.size() && !found; ++e) {
          if (used[e]) continue;
          Polyline edge = edges_[e];
          if (!meet(edge.front(), ring.back())) std::reverse(edge.begin(), edge.end());
          if (!meet(edge.front(), ring.back())) continue;
          found = used[e] = true;
          ring.insert(ring.end(), edge.begin() + 1, edge.end());
        }
      }
      if (!meet(ring.front(), ring.back())) continue;
      ring.back() = ring.front();
      rings.push_back(std::move(ring));
    }
  }

  core::WorkingMode mode_;
  sheet::SheetProgram program_;
  sheet::SheetProgram::Registers<double> registers_;
  Point2 lower_{}, upper_{};
  double reach_ = 0;
  std::vector<Polyline> edges_;
};

}  // namespace

core::WorkspaceRegion workspace_region(const core::LocusProblem& problem, const core::WorkingMode& mode,
                                       const core::LocusMap& map) {
  std::vector<const core::Arc*> boundary;
  std::vector<const core::Polynomial*> seen;
  for (const core::LocusCurve& curve : map.curves) {
    if (curve.mode != mode || curve.kind != core::LocusKind::workspace_boundary) continue;
    // Two dyads may have a boundary in common.
    if (std::any_of(seen.begin(), seen.end(), [&](const auto* p) { return *p == curve.implicit; })) continue;
    seen.push_back(&curve.implicit);
    for (const core::Arc& arc : curve.arcs) boundary.push_back(&arc);
  }
  return {mode, Rings(problem, mode).run(boundary)};
}

}  // namespace clearloci::loci
