#include "loci/curves/carried_loci.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "loci/curves/carried_sheet.hpp"

namespace clearloci::loci {

namespace {

using core::ArcEnd;
using core::LocusFactor;
using core::LocusKind;
using core::LocusProblem;
using core::Point2;
using Place = std::vector<double>;

/// As many vertices of a locus are asked which factor it belongs to.
constexpr std::size_t most_asked = 9;
/// Neighbours that moved apart by more than this many times their distance are on different branches.
constexpr double most_stretched = 20;
/// A chord that was shorter than this, in parts of the box, may grow to it.
constexpr double shortest_chord = 1e-2;

class Carrying {
 public:
  Carrying(const std::vector<const LocusProblem*>& problems, const core::LocusMap& last)
      : problems_(problems), last_(last) {
    for (std::size_t v = 0; v < last.lower.size(); ++v)
      sizes_.push_back(core::to_double(last.upper[v] - last.lower[v]));
  }

  core::LocusMap run() {
    core::LocusMap map;
    map.tower = last_.tower;
    map.angles = last_.angles;
    map.tolerance = last_.tolerance;
    map.complete = false;
    map.lower = last_.lower;
    map.upper = last_.upper;
    for (const core::LocusCurve& curve : last_.curves) map.curves.push_back(carried(curve));
    for (const core::LocusSurface& surface : last_.surfaces) map.surfaces.push_back(carried(surface));
    for (const core::IsolatedPoint& point : last_.isolated_points)
      if (auto point_now = carried(point)) map.isolated_points.push_back(std::move(*point_now));
    for (const core::WorkspaceRegion& region : last_.workspace) map.workspace.push_back(carried(region));
    return map;
  }

 private:
  /// Of a mode of the last map those of each problem: roots that a problem alone has are positive. What places a point
  /// may be called by another name where more roots come before it.
  std::vector<CarriedSheet*> sheets_of(const core::WorkingMode& mode) {
    auto [found, fresh] = sheets_.try_emplace(mode);
    if (fresh)
      for (const LocusProblem* const problem : problems_) {
        core::WorkingMode working_mode;
        for (const core::RootNames& root : core::names_of(problem->tower).roots) {
          const auto& names = last_.tower.roots;
          const auto same = std::find_if(names.begin(), names.end(), [&](const core::RootNames& one) {
            const bool named = one.name == root.name || root.role == core::RootRole::working_mode;
            return named && one.point == root.point && one.role == root.role;
          });
          const auto index = static_cast<std::size_t>(same - names.begin());
          working_mode.push_back(same != names.end() && index < mode.size() ? mode[index] : 1);
        }
        if (std::find(problem->modes.begin(), problem->modes.end(), working_mode) != problem->modes.end())
          found->second.push_back(std::make_unique<CarriedSheet>(*problem, std::move(working_mode)));
      }
    std::vector<CarriedSheet*> list;
    for (const auto& one : found->second) list.push_back(one.get());
    return list;
  }

  /// The sheets of a mode, each with the factor of a locus there.
  struct Target {
    CarriedSheet* sheet;
    int factor;
  };
  std::vector<Target> targets(const core::WorkingMode& mode, const LocusName& name, const std::vector<Place>& places) {
    std::vector<Target> list;
    for (CarriedSheet* const sheet : sheets_of(mode))
      if (const int factor = sheet->factor_of(name, places); factor >= 0) list.push_back({sheet, factor});
    return list;
  }

  static std::optional<Place> onto(const std::vector<Target>& targets, const Place& place) {
    for (const Target& target : targets)
      if (const auto inside = target.sheet->inside(place))
        if (const auto moved = target.sheet->moved(*inside, {target.factor})) return target.sheet->outside(*moved);
    return std::nullopt;
  }

  template <class Points>
  static std::vector<Place> some_of(const Points& points) {
    std::vector<Place> places;
    const std::size_t every = std::max<std::size_t>(1, points.size() / most_asked);
    for (std::size_t k = every / 2; k < points.size(); k += every)
      places.emplace_back(points[k].begin(), points[k].end());
    return places;
  }

  /// What is written about a locus holds for its design alone.
  template <class Locus>
  static void forget_design(Locus& locus, const std::vector<Target>& targets) {
    locus.certified = false;
    if (targets.empty()) return;
    const LocusFactor& factor =
        targets.front().sheet->problem().factors[static_cast<std::size_t>(targets.front().factor)];
    locus.factor = factor.expression;
    locus.cause = factor.cause;
  }

  core::LocusCurve carried(const core::LocusCurve& last) {
    core::LocusCurve curve = last;
    std::vector<Place> asked;
    for (const core::Arc& arc : last.arcs)
      for (Place& place : some_of(arc.points)) asked.push_back(std::move(place));
    const std::vector<Target> renamed = targets(last.mode, {last.kind, last.vanishing, last.factor}, some_of(asked));
    forget_design(curve, renamed);
    curve.implicit = {};
    curve.closed_form = {};
    curve.variables.clear();
    curve.arcs.clear();
    for (const core::Arc& arc : last.arcs)
      for (core::Arc& part : carried(arc, last.kind, renamed)) curve.arcs.push_back(std::move(part));
    return curve;
  }

  using Moved = std::vector<std::optional<Point2>>;

  std::vector<core::Arc> carried(const core::Arc& arc, LocusKind kind, const std::vector<Target>& targets) {
    Moved moved;
    for (const Point2& at : arc.points) {
      const auto place = onto(targets, {at[0], at[1]});
      moved.push_back(place ? std::optional<Point2>({(*place)[0], (*place)[1]}) : std::nullopt);
    }
    std::array<bool, 2> ended{};
    if (!arc.closed && arc.points.size() > 1) {
      for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        if (arc.ends[side] == ArcEnd::none || arc.ends[side] == ArcEnd::crossing) continue;
        std::optional<Point2>& last = side == 0 ? moved.front() : moved.back();
        last = end_of(arc.ends[side], side == 0 ? arc.points.front() : arc.points.back(), targets);
        ended[side] = last.has_value();
      }
    }
    if (kind == LocusKind::workspace_boundary)
      for (std::size_t k = 0; k < moved.size(); ++k)
        if (moved[k]) on_boundary_.insert_or_assign(arc.points[k], *moved[k]);
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
      if (ended[side]) drop_beyond(moved, side == 1);
    return pieces(arc, moved, ended);
  }

  /// Vertices before an end that has moved inward.
  static void drop_beyond(Moved& moved, bool at_back) {
    if (at_back) std::reverse(moved.begin(), moved.end());
    const Point2 end = *moved.front();
    for (std::size_t k = 1; k + 1 < moved.size(); ++k) {
      if (!moved[k]) continue;
      const auto next = std::find_if(moved.begin() + static_cast<std::ptrdiff_t>(k) + 1, moved.end(),
                                     [](const auto& one) { return one.has_value(); });
      if (next == moved.end()) break;
      const Point2 from = *moved[k], to = **next;
      const double ahead = (from[0] - end[0]) * (to[0] - from[0]) + (from[1] - end[1]) * (to[1] - from[1]);
      if (ahead > 0) break;
      moved[k].reset();
    }
    // What was dropped is no gap.
    std::size_t first = 1;
    while (first < moved.size() && !moved[first]) ++first;
    moved.erase(moved.begin() + 1, moved.begin() + static_cast<std::ptrdiff_t>(std::min(first, moved.size())));
    if (at_back) std::reverse(moved.begin(), moved.end());
  }

  std::optional<Point2> end_of(ArcEnd end, const Point2& at, const std::vector<Target>& targets) {
    for (const Target& target : targets) {
      const auto inside = target.sheet->inside({at[0], at[1]});
      if (!inside) continue;
      std::vector<int> factors = {target.factor};
      std::vector<CarriedSheet::Held> held;
      if (end == ArcEnd::box) {
        held.push_back(target.sheet->side_near(*inside));
      } else if (end == ArcEnd::boundary) {
        const auto rim = target.sheet->rim_near(*inside, target.factor);
        if (!rim) continue;
        held.push_back(*rim);
      } else {
        const int singular = target.sheet->factor_of({LocusKind::direct_singularity, {}, no_factor_}, {{at[0], at[1]}});
        if (singular < 0) continue;
        factors.push_back(singular);
      }
      auto moved = target.sheet->moved(*inside, factors, held);
      if (!moved) moved = target.sheet->pole_near(*inside);
      if (!moved) continue;
      const Place place = target.sheet->outside(*moved);
      return Point2{place[0], place[1]};
    }
    return std::nullopt;
  }

  /// The runs of vertices that have a place, cut where the curve was lost between two of them.
  std::vector<core::Arc> pieces(const core::Arc& arc, const Moved& moved, const std::array<bool, 2>& ended) const {
    double longest = 0;
    for (std::size_t k = 1; k < arc.points.size(); ++k)
      longest = std::max(longest, chord(arc.points[k - 1], arc.points[k]));
    const double most = most_stretched * std::max(longest, shortest_chord);
    std::vector<core::Arc> list;
    core::Arc run;
    const auto finish = [&](bool at_end) {
      if (run.points.size() > 1) {
        run.ends[1] = at_end && ended[1] ? arc.ends[1] : ArcEnd::none;
        for (std::size_t k = 1; k < run.points.size(); ++k)
          run.length += std::hypot(run.points[k][0] - run.points[k - 1][0], run.points[k][1] - run.points[k - 1][1]);
        list.push_back(std::move(run));
      }
      run = {};
    };
    for (std::size_t k = 0; k < moved.size(); ++k) {
      if (!moved[k] || (!run.points.empty() && chord(run.points.back(), *moved[k]) > most)) finish(false);
      if (!moved[k]) continue;
      if (run.points.empty()) run.ends[0] = k == 0 && ended[0] ? arc.ends[0] : ArcEnd::none;
      run.points.push_back(*moved[k]);
    }
    const bool whole = list.empty() && run.points.size() == moved.size();
    run.closed = arc.closed && whole && run.points.size() > 2;
    finish(true);
    return list;
  }

  /// In parts of the box.
  double chord(const Point2& a, const Point2& b) const {
    double sum = 0;
    for (std::size_t v = 0; v < 2; ++v) sum += std::pow((b[v] - a[v]) / sizes_[v], 2);
    return std::sqrt(sum);
  }

  core::LocusSurface carried(const core::LocusSurface& last) {
    core::LocusSurface surface = last;
    const std::vector<Target> renamed =
        targets(last.mode, {last.kind, last.vanishing, last.factor}, some_of(last.vertices));
    forget_design(surface, renamed);
    surface.implicit = {};
    surface.variables.clear();
    surface.within_resolution = false;
    surface.open.clear();
    std::vector<bool> kept(last.vertices.size(), false);
    for (std::size_t k = 0; k < last.vertices.size(); ++k) {
      const auto place = onto(renamed, Place(last.vertices[k].begin(), last.vertices[k].end()));
      if (!place) continue;
      kept[k] = true;
      std::copy_n(place->begin(), 3, surface.vertices[k].begin());
    }
    std::erase_if(surface.triangles, [&](const std::array<int, 3>& triangle) {
      return std::any_of(triangle.begin(), triangle.end(), [&](int k) { return !kept[static_cast<std::size_t>(k)]; });
    });
    return surface;
  }

  /// Over one coordinate where a factor vanishes, over two where components of one joint's force do; of others nothing.
  std::optional<core::IsolatedPoint> carried(const core::IsolatedPoint& last) {
    for (CarriedSheet* const sheet : sheets_of(last.mode)) {
      const auto inside = sheet->inside(last.at);
      if (!inside) continue;
      std::vector<int> factors;
      if (last.at.size() == 1) {
        factors.push_back(sheet->factor_of({last.kind, last.vanishing, last.factor}, {last.at}));
      } else if (last.at.size() == 2 && !last.vanishing.empty()) {
        const std::string& joint = last.vanishing.front().joint;
        for (const core::Quantity part : core::force_components(sheet->problem(), joint))
          factors.push_back(sheet->factor_of({last.kind, {{joint, part, 1}}, no_factor_}, {last.at}));
      }
      if (factors.size() != last.at.size() || std::count(factors.begin(), factors.end(), -1) > 0) continue;
      const auto moved = sheet->moved(*inside, factors);
      if (!moved) continue;
      core::IsolatedPoint point = last;
      point.at = sheet->outside(*moved);
      point.certified = false;
      return point;
    }
    return std::nullopt;
  }

  /// Its rings along the curves that bound it.
  core::WorkspaceRegion carried(const core::WorkspaceRegion& last) {
    core::WorkspaceRegion region = last;
    for (core::Polyline& ring : region.rings)
      for (Point2& at : ring)
        if (const auto found = on_boundary_.find(at); found != on_boundary_.end()) at = found->second;
    return region;
  }

  const std::vector<const LocusProblem*>& problems_;
  const core::LocusMap& last_;
  std::vector<double> sizes_;  ///< of the box
  std::map<core::WorkingMode, std::vector<std::unique_ptr<CarriedSheet>>> sheets_;
  std::map<Point2, Point2> on_boundary_;  ///< vertices of boundary curves, and where they went
  const std::string no_factor_;
};

}  // namespace

core::LocusMap carried_loci(const std::vector<const LocusProblem*>& problems, const core::LocusMap& last) {
  return Carrying(problems, last).run();
}

}  // namespace clearloci::loci
