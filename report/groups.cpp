#include "report/groups.hpp"

#include <algorithm>
#include <cctype>

#include "core/virtual_work.hpp"
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
  static const Dashes preload = {{9, 2, 2, 2}, {5, 2, 2, 2}, {13, 2, 2, 2}, {9, 2, 2, 2, 2, 2}};
  const auto pick = [&](const Dashes& dashes) { return dashes[static_cast<std::size_t>(within_kind) % dashes.size()]; };
  const Colour colour = palette_colour(number);
  switch (kind) {
    case core::LocusKind::contact_loss:
      return {colour, 2.2, pick(contact_loss), false};
    case core::LocusKind::margin:
      return {light_theme.failed, 1.1, pick(margin), false};
    case core::LocusKind::preload:
      return {colour, 1.6, pick(preload), false};
    case core::LocusKind::backlash:
      return {colour, 2.6, pick(backlash), true};
    case core::LocusKind::component:
      return {colour, 1.2, pick(component), true};
    default:
      return {colour, 1.1, {}, false};
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
std::string reason_of(const core::LocusMap& map, const core::LocusCurve& curve) {
  const int readable = readable_factor(map, 44);
  const bool short_factor = curve.cause.empty() && reads_well(curve.factor, readable);
  return reason_words(curve.kind, curve.vanishing, curve.factor, curve.cause, readable) + (short_factor ? " = 0" : "");
}

std::string what_words(const core::LocusCurve& curve) {
  const std::string what = printable(vanishing_words(curve.kind, curve.vanishing));
  if (!curve.excited) return kind_words(curve.kind) + ", not excited by this load";
  return what.empty() || !is_reaction(curve.kind) ? kind_words(curve.kind) : what;
}

/// Curves of which the legend says the same are one group: those of one reason, or of reasons without a reading.
void add_curve(Groups& groups, const core::LocusMap& map, const core::LocusCurve& curve) {
  const bool reaction = is_reaction(curve.kind);
  const std::string what = what_words(curve), why = reaction ? reason_of(map, curve) : "";
  const auto same = [&](const CurveGroup& group) {
    return group.kind == curve.kind && group.excited == curve.excited &&
           (!reaction || (group.what == what && group.why == why && same_reactions(group.vanishing, curve.vanishing)));
  };
  auto group = std::find_if(groups.curves.begin(), groups.curves.end(), same);
  if (group == groups.curves.end()) {
    CurveGroup fresh;
    fresh.kind = curve.kind;
    fresh.excited = curve.excited;
    fresh.reason = !reaction ? "" : curve.cause.empty() ? curve.factor : curve.cause;
    fresh.what = what;
    fresh.why = why;
    if (reaction) fresh.vanishing = curve.vanishing;
    group = groups.curves.insert(groups.curves.end(), std::move(fresh));
  }
  group->curves.push_back(&curve);
}

void add_point(Groups& groups, const core::LocusMap& map, const core::IsolatedPoint& point) {
  const auto same = [&](const PointGroup& group) {
    return group.kind == point.kind && same_reactions(group.vanishing, point.vanishing);
  };
  auto group = std::find_if(groups.points.begin(), groups.points.end(), same);
  if (group == groups.points.end()) {
    const std::string what = printable(vanishing_words(point.kind, point.vanishing));
    const auto index = groups.points.size();
    // Over one coordinate all loci are points.
    const std::string isolated = map.tower.coordinates.size() > 1 ? "isolated points — " : "";
    PointGroup fresh{.kind = point.kind,
                     .vanishing = point.vanishing,
                     .label = isolated + (what.empty() ? kind_words(point.kind) : what),
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

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// The sentence with "the joint" in the place of the joint's name.
std::string of_the_joint(std::string sentence, const std::string& joint) {
  const std::string common = "the joint";
  for (std::size_t at = sentence.find(joint); !joint.empty() && at != std::string::npos;
       at = sentence.find(joint, at)) {
    const std::size_t end = at + joint.size();
    const bool word =
        (at == 0 || !is_letter(sentence[at - 1])) && (end == sentence.size() || !is_letter(sentence[end]));
    if (word) sentence.replace(at, joint.size(), common);
    at += word ? common.size() : joint.size();
  }
  return sentence;
}

/// The reason of a joint's locus as it is of any joint; empty where it does not name the joint, or is no sentence of
/// virtual work.
std::string without_joint(const std::string& why, const std::string& joint) {
  const std::string common = of_the_joint(why, joint);
  return common != why && common.starts_with(core::no_work_words) ? common : "";
}

/// What the reasons of several groups have in common, to be said once.
void find_shared_reasons(Groups& groups) {
  std::vector<std::pair<std::string, std::vector<CurveGroup*>>> sentences;
  for (CurveGroup& group : groups.curves)
    for (const core::Vanishing& one : group.vanishing) {
      const std::string common = without_joint(group.why, one.joint);
      if (common.empty()) continue;
      const auto found = std::find_if(sentences.begin(), sentences.end(),
                                      [&](const auto& sentence) { return sentence.first == common; });
      if (found == sentences.end())
        sentences.push_back({common, {&group}});
      else if (found->second.back() != &group)
        found->second.push_back(&group);
    }
  for (const auto& [common, members] : sentences) {
    if (members.size() < 2) continue;
    for (CurveGroup* const group : members) {
      group->why.clear();
      group->shared_why = common;
    }
  }
}

/// "c1, c2: the loads do no work in the motion that the joint alone drives".
void tell_shared_reasons(Groups& groups) {
  std::vector<std::pair<std::string, std::string>> remarks;
  for (const CurveGroup& group : groups.curves) {
    if (group.shared_why.empty()) continue;
    const auto found = std::find_if(remarks.begin(), remarks.end(),
                                    [&](const auto& remark) { return remark.first == group.shared_why; });
    if (found == remarks.end())
      remarks.emplace_back(group.shared_why, ids_of(group));
    else
      found->second += ", " + ids_of(group);
  }
  for (const auto& [sentence, ids] : remarks) groups.remarks.push_back(ids + ": " + sentence);
}

}  // namespace

Colour palette_colour(int number) { return palette[static_cast<std::size_t>(number) % palette.size()]; }

std::string reason_of_any_joint(const std::string& why, const std::vector<core::Vanishing>& vanishing) {
  for (const core::Vanishing& one : vanishing)
    if (std::string common = without_joint(why, one.joint); !common.empty()) return common;
  return "";
}

std::string ids_of(const CurveGroup& group) {
  constexpr std::size_t told = 4;
  const std::size_t count = group.curves.size();
  std::string words;
  for (std::size_t i = 0; i < count; ++i) {
    if (count > told && i > 1 && i + 1 < count) continue;
    words += (i == 0 ? "" : count > told && i + 1 == count ? ", …, " : ", ") + printable(group.curves[i]->id);
  }
  return words;
}

Groups group_loci(const core::LocusMap& map) {
  Groups groups;
  for (const auto& curve : map.curves) add_curve(groups, map, curve);
  for (const auto& point : map.isolated_points) add_point(groups, map, point);
  std::stable_sort(groups.curves.begin(), groups.curves.end(),
                   [](const CurveGroup& a, const CurveGroup& b) { return a.kind < b.kind; });
  choose_strokes(groups);
  find_shared_reasons(groups);
  tell_shared_reasons(groups);
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
  tell_shared_reasons(chosen);
  return chosen;
}

}  // namespace clearloci::report
