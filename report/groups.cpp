#include "report/groups.hpp"

#include <algorithm>

#include "report/wording.hpp"

namespace clearloci::report {
namespace {

constexpr const auto& palette = light_theme.curves;

using Dashes = std::vector<std::vector<double>>;

/// Every kind has a family of its own, so that a print in grey still tells kinds, and within a kind groups, apart.
Stroke reaction_stroke(core::LocusKind kind, int within_kind, int number) {
  constexpr double dot = 0.01;  // Cairo draws a dash of length 0 only where it is the pattern's one dash
  static const Dashes contact_loss = {{}, {9, 2.5}, {14, 2.5, 3, 2.5}, {5, 2.2}, {14, 2.5, 3, 2.5, 3, 2.5}, {20, 3}};
  static const Dashes backlash = {{0, 4}, {4, 5}, {0, 7}, {4, 5, dot, 5}, {9, 5}, {9, 5, dot, 5}};
  static const Dashes component = {{0, 2.4}, {3, 2.4}, {0, 5}, {3, 2.4, dot, 2.4}};
  static const Dashes margin = {{4, 2.5}, {2, 2}, {7, 3}, {7, 2, 2, 2}};
  const auto pick = [&](const Dashes& dashes) { return dashes[static_cast<std::size_t>(within_kind) % dashes.size()]; };
  const Colour colour = palette_colour(number);
  switch (kind) {
    case core::LocusKind::contact_loss:
      return {colour, 2.2, pick(contact_loss), false};
    case core::LocusKind::backlash:
      return {colour, 2.6, pick(backlash), true};
    case core::LocusKind::component:
      return {colour, 1.2, pick(component), true};
    default:
      return {colour, 1.1, pick(margin), false};
  }
}

bool is_reaction(core::LocusKind kind) {
  return kind != core::LocusKind::direct_singularity && kind != core::LocusKind::workspace_boundary;
}

bool same_reactions(const std::vector<core::Vanishing>& a, const std::vector<core::Vanishing>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one.joint == other.joint && one.quantity == other.quantity;
  });
}

/// A factor of many terms is no reading for a legend.
std::string reason_of(const core::LocusCurve& curve) {
  constexpr int readable = 44;
  const bool short_factor = curve.cause.empty() && reads_well(curve.factor, readable);
  return reason_words(curve.kind, curve.vanishing, curve.factor, curve.cause, readable) + (short_factor ? " = 0" : "");
}

std::string what_words(const core::LocusCurve& curve) {
  const std::string what = printable(vanishing_words(curve.kind, curve.vanishing));
  if (!curve.excited) return kind_words(curve.kind) + ", not excited by this load";
  return what.empty() || !is_reaction(curve.kind) ? kind_words(curve.kind) : what;
}

void add_curve(Groups& groups, const core::LocusCurve& curve) {
  const bool reaction = is_reaction(curve.kind);
  const std::string reason = !reaction ? "" : curve.cause.empty() ? curve.factor : curve.cause;
  const auto same = [&](const CurveGroup& group) {
    return group.kind == curve.kind && group.excited == curve.excited &&
           (!reaction || (group.reason == reason && same_reactions(group.vanishing, curve.vanishing)));
  };
  auto group = std::find_if(groups.curves.begin(), groups.curves.end(), same);
  if (group == groups.curves.end()) {
    CurveGroup fresh;
    fresh.kind = curve.kind;
    fresh.excited = curve.excited;
    fresh.reason = reason;
    fresh.what = what_words(curve);
    if (reaction) {
      fresh.vanishing = curve.vanishing;
      fresh.why = reason_of(curve);
    }
    group = groups.curves.insert(groups.curves.end(), std::move(fresh));
  }
  group->curves.push_back(&curve);
}

void add_point(Groups& groups, const core::IsolatedPoint& point) {
  const auto same = [&](const PointGroup& group) {
    return group.kind == point.kind && same_reactions(group.vanishing, point.vanishing);
  };
  auto group = std::find_if(groups.points.begin(), groups.points.end(), same);
  if (group == groups.points.end()) {
    const std::string what = printable(vanishing_words(point.kind, point.vanishing));
    const auto index = groups.points.size();
    PointGroup fresh{.kind = point.kind,
                     .vanishing = point.vanishing,
                     .label = "isolated points — " + (what.empty() ? kind_words(point.kind) : what),
                     .marker = {static_cast<MarkerShape>(index % 4), palette[(index + 1) % palette.size()]},
                     .points = {}};
    group = groups.points.insert(groups.points.end(), std::move(fresh));
  }
  group->points.push_back(&point);
}

void choose_strokes(Groups& groups) {
  int number = 0, within_kind = 0;
  const CurveGroup* previous = nullptr;
  for (auto& group : groups.curves) {
    within_kind = previous != nullptr && previous->kind == group.kind ? within_kind + 1 : 0;
    previous = &group;
    if (group.kind == core::LocusKind::direct_singularity) {
      group.stroke = {light_theme.singularity, group.excited ? 1.3 : 0.7, {8, 2.5, 1.5, 2.5}, false};
    } else if (group.kind == core::LocusKind::workspace_boundary) {
      group.stroke = {light_theme.boundary, 0.9, {}, false};
    } else {
      group.number = number++;
      group.stroke = reaction_stroke(group.kind, within_kind, group.number);
    }
  }
}

}  // namespace

Colour palette_colour(int number) { return palette[static_cast<std::size_t>(number) % palette.size()]; }

Groups group_loci(const core::LocusMap& map) {
  Groups groups;
  for (const auto& curve : map.curves) add_curve(groups, curve);
  for (const auto& point : map.isolated_points) add_point(groups, point);
  std::stable_sort(groups.curves.begin(), groups.curves.end(),
                   [](const CurveGroup& a, const CurveGroup& b) { return a.kind < b.kind; });
  choose_strokes(groups);
  return groups;
}

Groups groups_of_mode(const Groups& groups, const core::WorkingMode& mode) {
  Groups chosen;
  for (CurveGroup group : groups.curves) {
    std::erase_if(group.curves, [&](const auto* curve) { return curve->mode != mode || curve->arcs.empty(); });
    if (!group.curves.empty()) chosen.curves.push_back(std::move(group));
  }
  for (PointGroup group : groups.points) {
    std::erase_if(group.points, [&](const auto* point) { return point->mode != mode; });
    if (!group.points.empty()) chosen.points.push_back(std::move(group));
  }
  return chosen;
}

}  // namespace clearloci::report
