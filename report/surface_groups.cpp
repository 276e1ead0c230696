#include "report/surface_groups.hpp"

#include <algorithm>
#include <map>

#include "report/wording.hpp"

namespace clearloci::report {
namespace {

bool is_reaction(core::LocusKind kind) {
  return kind != core::LocusKind::direct_singularity && kind != core::LocusKind::workspace_boundary;
}

std::string reason_words(const core::LocusSurface& surface) {
  if (!surface.cause.empty()) return printable(surface.cause);
  constexpr int readable = 44;
  if (!surface.factor.empty() && columns(surface.factor) <= readable) return printable(surface.factor) + " = 0";
  const std::string words = report::reason_words(surface.kind, surface.vanishing, surface.factor, "", 0);
  const int degree = core::total_degree(surface.implicit);
  return words + (degree > 0 ? ", on a surface of degree " + std::to_string(degree) : "");
}

void choose_colours(std::vector<SurfaceGroup>& groups) {
  int number = 0;
  for (SurfaceGroup& group : groups) {
    if (group.kind == core::LocusKind::direct_singularity) {
      group.colour = {0.5, 0.5, 0.53};
      group.opacity = 0.62;
    } else if (group.kind == core::LocusKind::workspace_boundary) {
      group.colour = {0.72, 0.74, 0.76};
      group.opacity = 0.22;
    } else {
      group.colour = palette_colour(number++);
      group.opacity = group.on_boundary ? 0.34 : 0.62;  // what it encloses is to be seen
    }
  }
}

bool is_on_boundary(const core::LocusMap& map, const core::LocusSurface& surface) {
  return std::any_of(map.surfaces.begin(), map.surfaces.end(), [&](const core::LocusSurface& other) {
    return other.kind == core::LocusKind::workspace_boundary && other.mode == surface.mode &&
           other.triangles.size() == surface.triangles.size() && other.vertices == surface.vertices;
  });
}

}  // namespace

std::vector<SurfaceGroup> group_surfaces(const core::LocusMap& map) {
  std::vector<SurfaceGroup> groups;
  for (const core::LocusSurface& surface : map.surfaces) {
    const bool reaction = is_reaction(surface.kind);
    const std::string reason = !reaction ? "" : surface.cause.empty() ? surface.factor : surface.cause;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const SurfaceGroup& one) {
      return one.kind == surface.kind && (!reaction || (one.reason == reason && one.vanishing == surface.vanishing));
    });
    if (group == groups.end()) {
      SurfaceGroup fresh;
      fresh.kind = surface.kind;
      fresh.reason = reason;
      fresh.what = kind_words(surface.kind);
      if (reaction) {
        fresh.vanishing = surface.vanishing;
        fresh.what = printable(vanishing_words(surface.kind, surface.vanishing));
        fresh.why = reason_words(surface);
      }
      fresh.on_boundary = reaction;
      group = groups.insert(groups.end(), std::move(fresh));
    }
    group->on_boundary = group->on_boundary && is_on_boundary(map, surface);
    group->surfaces.push_back(&surface);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const SurfaceGroup& a, const SurfaceGroup& b) { return a.kind < b.kind; });
  choose_colours(groups);
  return groups;
}

std::vector<SurfaceGroup> groups_of_mode(const std::vector<SurfaceGroup>& groups, const core::WorkingMode& mode) {
  std::vector<SurfaceGroup> chosen;
  for (SurfaceGroup group : groups) {
    std::erase_if(group.surfaces, [&](const auto* surface) { return surface->mode != mode; });
    if (!group.surfaces.empty()) chosen.push_back(std::move(group));
  }
  return chosen;
}

std::string ids_of(const SurfaceGroup& group) {
  std::string ids;
  for (const core::LocusSurface* surface : group.surfaces) ids += (ids.empty() ? "" : ", ") + printable(surface->id);
  return ids;
}

std::vector<std::string> tell_shared_reasons(std::vector<SurfaceGroup>& groups) {
  std::map<std::string, std::vector<SurfaceGroup*>> shared;
  for (SurfaceGroup& group : groups)
    if (const std::string reason = reason_of_any_joint(group.why, group.vanishing); !reason.empty())
      shared[reason].push_back(&group);
  std::vector<std::string> remarks;
  for (const auto& [reason, same_reason] : shared) {
    if (same_reason.size() < 2) continue;
    std::string ids;
    for (SurfaceGroup* const group : same_reason) {
      ids += (ids.empty() ? "" : ", ") + ids_of(*group);
      group->why.clear();
    }
    remarks.push_back(ids + ": " + reason);
  }
  return remarks;
}

std::vector<LineGroup> group_lines(const core::LocusMap& map, const std::vector<SurfaceGroup>& surfaces) {
  std::vector<LineGroup> groups;
  const auto of = [&](core::LocusKind kind, const std::vector<core::Vanishing>& vanishing) -> LineGroup& {
    const auto found = std::find_if(groups.begin(), groups.end(),
                                    [&](const LineGroup& group) { return group.vanishing == vanishing; });
    if (found != groups.end()) return *found;
    groups.push_back({kind, vanishing, printable(vanishing_words(kind, vanishing)), 0, {}, {}, {}});
    return groups.back();
  };
  for (const core::SpaceCurve& curve : map.space_curves) of(curve.kind, curve.vanishing).curves.push_back(&curve);
  for (const core::IsolatedPoint& point : map.isolated_points) of(point.kind, point.vanishing).points.push_back(&point);
  auto number = static_cast<int>(std::count_if(surfaces.begin(), surfaces.end(), [](const SurfaceGroup& group) {
    return group.kind != core::LocusKind::direct_singularity && group.kind != core::LocusKind::workspace_boundary;
  }));
  for (LineGroup& group : groups) {
    group.number = number++;
    group.colour = palette_colour(group.number);
  }
  return groups;
}

}  // namespace clearloci::report
