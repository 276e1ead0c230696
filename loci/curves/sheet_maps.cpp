#include "loci/curves/sheet_maps.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "core/dense_terms.hpp"
#include "core/errors.hpp"
#include "core/fold.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusCurve;
using core::LocusFactor;
using core::LocusMap;
using core::LocusProblem;
using core::Root;

/// A sheet's own is what places no point: roots of folds and margins, and of lengths, such as those of springs, which
/// may be numbers on another sheet.
bool is_own(const core::RootNames& root) { return root.role != core::RootRole::working_mode; }

/// Whether a factor is of the f of a fold.
bool is_fold(const LocusFactor& factor, const LocusProblem& problem) {
  return std::any_of(problem.tower.roots.begin(), problem.tower.roots.end(), [&](const Root& root) {
    return root.name == core::fold_name && core::exact_quotient(root.square, factor.sheet).has_value();
  });
}

bool is_same(const LocusCurve& a, const LocusCurve& b) {
  return a.kind == b.kind && a.vanishing == b.vanishing && a.factor == b.factor && a.cause == b.cause &&
         a.mode == b.mode && a.implicit == b.implicit;
}

/// The sides of a fold may have other words for what happens on it.
bool is_same_on_fold(const LocusCurve& a, const LocusCurve& b) {
  return a.kind == b.kind && a.kind != core::LocusKind::margin && a.vanishing == b.vanishing && a.mode == b.mode &&
         a.implicit == b.implicit;
}

bool is_same(const core::IsolatedPoint& a, const core::IsolatedPoint& b, double near) {
  if (a.kind != b.kind || a.vanishing != b.vanishing || a.mode != b.mode) return false;
  for (std::size_t i = 0; i < a.at.size(); ++i)
    if (!(std::abs(a.at[i] - b.at[i]) <= near)) return false;
  return true;
}

double box_size(const LocusMap& map) {
  double size = 0;
  for (std::size_t i = 0; i < map.lower.size(); ++i)
    size = std::max(size, core::to_double(map.upper[i] - map.lower[i]));
  return size;
}

}  // namespace

bool may_be_on_fold(const LocusCurve& curve, const LocusProblem& problem) {
  return std::any_of(problem.factors.begin(), problem.factors.end(), [&](const LocusFactor& factor) {
    return factor.role == FactorRole::workspace_boundary && is_fold(factor, problem) &&
           std::find(factor.implicit.begin(), factor.implicit.end(), curve.implicit) != factor.implicit.end();
  });
}

bool is_on(const core::Arc& arc, const core::Arc& other, double near) {
  const core::Point2& at = arc.points[arc.points.size() / 2];
  for (std::size_t k = 1; k < other.points.size(); ++k) {
    const core::Point2 &a = other.points[k - 1], &b = other.points[k];
    const double ux = b[0] - a[0], uy = b[1] - a[1], wx = at[0] - a[0], wy = at[1] - a[1];
    const double square = ux * ux + uy * uy, along = ux * wx + uy * wy;
    if (square > 0 && along >= 0 && along <= square && std::abs(ux * wy - uy * wx) <= near * std::sqrt(square))
      return true;
  }
  return false;
}

void drop_own_roots(const core::TowerNames& tower, core::WorkingMode& mode) {
  core::WorkingMode kept;
  for (std::size_t j = 0; j < tower.roots.size() && j < mode.size(); ++j)
    if (!is_own(tower.roots[j])) kept.push_back(mode[j]);
  mode = std::move(kept);
}

void drop_own_roots(LocusMap& map) {
  const auto drop = [&](auto& list) {
    for (auto& one : list) drop_own_roots(map.tower, one.mode);
  };
  drop(map.curves);
  drop(map.surfaces);
  drop(map.space_curves);
  drop(map.isolated_points);
  drop(map.open);
  drop(map.workspace);
  drop(map.reachable);
  std::erase_if(map.tower.roots, is_own);
}

void append_sheets(LocusMap& joined, LocusMap map) {
  joined.complete = joined.complete && map.complete;
  joined.out_of_time = joined.out_of_time || map.out_of_time;
  joined.open.insert(joined.open.end(), map.open.begin(), map.open.end());
  for (const std::string& note : map.notes)
    if (std::find(joined.notes.begin(), joined.notes.end(), note) == joined.notes.end()) joined.notes.push_back(note);
  for (LocusCurve& curve : map.curves) joined.curves.push_back(std::move(curve));
  for (core::LocusSurface& surface : map.surfaces) joined.surfaces.push_back(std::move(surface));
  for (core::SpaceCurve& curve : map.space_curves) joined.space_curves.push_back(std::move(curve));
  // Both sides of a fold have found what is on it.
  const double near = 1e-12 * box_size(joined);
  for (core::IsolatedPoint& point : map.isolated_points)
    if (std::none_of(joined.isolated_points.begin(), joined.isolated_points.end(),
                     [&](const core::IsolatedPoint& other) { return is_same(other, point, near); }))
      joined.isolated_points.push_back(std::move(point));
  for (core::WorkspaceRegion& region : map.workspace) {
    auto found = std::find_if(joined.workspace.begin(), joined.workspace.end(),
                              [&](const core::WorkspaceRegion& other) { return other.mode == region.mode; });
    if (found == joined.workspace.end()) found = joined.workspace.insert(found, {region.mode, {}});
    found->rings.insert(found->rings.end(), region.rings.begin(), region.rings.end());
  }
  for (core::ReachableInterval& interval : map.reachable) joined.reachable.push_back(std::move(interval));
}

LocusMap join_sheets(const std::vector<const LocusProblem*>& problems, std::vector<LocusMap> maps,
                     const std::vector<core::WorkingMode>& modes) {
  core::ensure(!maps.empty() && problems.size() == maps.size(), "a map for each sheet");
  if (maps.size() == 1) return std::move(maps.front());
  LocusMap joined;
  for (std::size_t m = 0; m < maps.size(); ++m) {
    drop_own_roots(maps[m]);
    std::vector<LocusCurve> curves = std::exchange(maps[m].curves, {});
    if (m == 0)
      joined = std::move(maps[m]);
    else
      append_sheets(joined, std::move(maps[m]));
    for (LocusCurve& curve : curves) {
      const bool twice = may_be_on_fold(curve, *problems[m]);
      auto found = std::find_if(joined.curves.begin(), joined.curves.end(),
                                [&](const LocusCurve& other) { return is_same(other, curve); });
      if (found == joined.curves.end() && twice && m > 0)
        found = std::find_if(joined.curves.begin(), joined.curves.end(),
                             [&](const LocusCurve& other) { return is_same_on_fold(other, curve); });
      if (found == joined.curves.end()) {
        joined.curves.push_back(std::move(curve));
        continue;
      }
      found->certified = found->certified && curve.certified;
      const auto before = static_cast<std::ptrdiff_t>(found->arcs.size());
      for (core::Arc& arc : curve.arcs) {
        if (twice && std::any_of(found->arcs.begin(), found->arcs.begin() + before,
                                 [&](const core::Arc& other) { return is_on(arc, other, 4 * joined.tolerance); }))
          continue;
        found->arcs.push_back(std::move(arc));
      }
    }
  }
  std::vector<core::WorkingMode> order = modes;
  for (core::WorkingMode& mode : order) drop_own_roots(names_of(problems.front()->tower), mode);
  std::stable_sort(joined.workspace.begin(), joined.workspace.end(), [&](const auto& a, const auto& b) {
    return std::find(order.begin(), order.end(), a.mode) < std::find(order.begin(), order.end(), b.mode);
  });
  sort_and_name(joined, order);
  return joined;
}

std::string name_in(const LocusMap& joined, const LocusCurve& curve) {
  auto found = std::find_if(joined.curves.begin(), joined.curves.end(),
                            [&](const LocusCurve& other) { return is_same(other, curve); });
  if (found == joined.curves.end())
    found = std::find_if(joined.curves.begin(), joined.curves.end(),
                         [&](const LocusCurve& other) { return is_same_on_fold(other, curve); });
  return found == joined.curves.end() ? curve.id : found->id;
}

int place_in(const LocusMap& joined, const core::IsolatedPoint& point) {
  const double near = 1e-12 * box_size(joined);
  const auto found = std::find_if(joined.isolated_points.begin(), joined.isolated_points.end(),
                                  [&](const core::IsolatedPoint& other) { return is_same(other, point, near); });
  return found == joined.isolated_points.end() ? -1 : static_cast<int>(found - joined.isolated_points.begin());
}

bool is_on_sheet(const core::RootTower& tower, const core::WorkingMode& mode, const core::Point2& at) {
  std::vector<double> values(static_cast<std::size_t>(tower.variables()), 0.0);
  values[0] = at[0];
  values[1] = at[1];
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    const std::optional<double> root = core::root_value(tower.roots[j], mode[j], values);
    if (!root) return false;
    values[2 + j] = *root;
  }
  return true;
}

void sort_and_name(LocusMap& map, const std::vector<core::WorkingMode>& modes) {
  const auto mode_index = [&](const core::WorkingMode& mode) {
    return std::find(modes.begin(), modes.end(), mode) - modes.begin();
  };
  const auto key = [&](const LocusCurve& curve) {
    return std::tuple(mode_index(curve.mode), curve.kind, core::total_degree(curve.implicit), curve.factor,
                      core::to_string(curve.implicit, map.tower.coordinates));
  };
  std::stable_sort(map.curves.begin(), map.curves.end(),
                   [&](const LocusCurve& a, const LocusCurve& b) { return key(a) < key(b); });
  number_curves(map.curves);
}

void number_curves(std::vector<LocusCurve>& curves) {
  int number = 0, margins = 0;
  for (LocusCurve& curve : curves)
    curve.id = curve.kind == core::LocusKind::margin ? "m" + std::to_string(++margins) : "c" + std::to_string(++number);
}

}  // namespace clearloci::loci
