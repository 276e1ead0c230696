#include "mechanism/notes.hpp"

#include <algorithm>

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

}  // namespace

std::vector<std::string> notes_of(const Mechanism& mechanism) {
  std::vector<std::string> notes = mechanism.notes;
  if (is_without_loads(mechanism))
    notes.emplace_back("the file has no loads, so every reaction is zero: add loads, gravity and masses, or springs");
  for (std::string& note : idle_notes(mechanism)) notes.push_back(std::move(note));
  return notes;
}

}  // namespace clearloci::mechanism
