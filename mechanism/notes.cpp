#include "mechanism/notes.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <set>
#include <utility>

#include "mechanism/evaluate.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::mechanism {
namespace {

/// No load, weight, spring or known effort: every reaction is zero.
bool is_without_loads(const Mechanism& mechanism) {
  return mechanism.loads.empty() && mechanism.gravity.empty() && mechanism.springs.empty() &&
         std::none_of(mechanism.joints.begin(), mechanism.joints.end(),
                      [](const Joint& joint) { return joint.effort || !traits(joint).bears; });
}

/// Two lengths of links that are meant to be equal, it seems, and are not: what vanishes together where they are is
/// told apart by as little.
std::optional<std::string> note_of_lengths(const Mechanism& mechanism) {
  const Rational alike(1, 1'000'000'000), rounding(1, core::Integer("10000000000000000000000000"));
  std::vector<std::pair<Rational, std::string>> lengths;
  for (const Point& point : mechanism.points) {
    const auto* dyad = std::get_if<DyadPoint>(&point.form);
    if (dyad == nullptr || dyad->right_angle) continue;
    for (const Expression* length : {&dyad->from_length, &dyad->to_length}) {
      const std::set<std::string> names = core::symbols(*length);
      if (std::none_of(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                       [&](const Coordinate& coordinate) { return names.contains(coordinate.name); }))
        lengths.emplace_back(value_of(*length, mechanism), point.name);
    }
  }
  std::sort(lengths.begin(), lengths.end());
  for (std::size_t i = 0; i + 1 < lengths.size(); ++i) {
    const auto& [shorter, first] = lengths[i];
    const auto& [longer, second] = lengths[i + 1];
    const Rational apart = longer - shorter;
    if (apart <= rounding * longer || apart >= alike * longer) continue;
    char part[32];
    std::snprintf(part, sizeof part, "%.1e", core::to_double(Rational(apart / longer)));
    return "lengths of links to " + first + " and " + second + " differ by " + part +
           " of their size: if they are meant to be equal, write one parameter for both, or places that make them "
           "exactly equal";
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> notes_of(const Mechanism& mechanism) {
  std::vector<std::string> notes = mechanism.notes;
  if (is_without_loads(mechanism))
    notes.emplace_back("the file has no loads, so every reaction is zero: add loads, gravity and masses, or springs");
  for (std::string& note : idle_notes(mechanism)) notes.push_back(std::move(note));
  if (std::optional<std::string> note = note_of_lengths(mechanism)) notes.push_back(std::move(*note));
  return notes;
}

}  // namespace clearloci::mechanism
