#include "analysis/singular_modes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mechanism/actions.hpp"
#include "mechanism/posture_sample.hpp"
#include "numeric/reactions.hpp"
#include "symbolic/singular_modes.hpp"

namespace clearloci {
namespace {

/// What |A| depends on: no springs, given efforts or limits, the bounds of given efforts among them.
mechanism::Mechanism bare(mechanism::Mechanism mechanism) {
  mechanism.springs.clear();
  mechanism.limits.clear();
  for (mechanism::Joint& joint : mechanism.joints) {
    joint.effort.reset();
    joint.free_effort.reset();
    joint.law_within.reset();
  }
  return mechanism;
}

std::optional<std::string> complaint(const mechanism::Mechanism& loaded, const DyadSides& sides) {
  constexpr std::size_t poses = 256;
  const mechanism::Mechanism mechanism = bare(loaded);
  const numeric::NumericModel model = numeric::compile(mechanism);
  std::optional<std::string> bent;
  bool reached = false;
  for (const std::vector<double>& pose : mechanism::spread_poses(mechanism, poses)) {
    const numeric::BoundedNumerators at = numeric::bounded_numerators(model, pose, sides);
    if (at.reachable && std::abs(at.determinant.value) > at.determinant.error) return std::nullopt;
    reached = reached || at.reachable;
    // Without limits what is broken is a link.
    if (const numeric::Posture posture = numeric::posture(model, pose, sides); posture.broken && !reached && !bent)
      bent = mechanism::words_of_end(mechanism, posture.broken->limit, posture.broken->upper);
  }
  if (bent && !reached)
    return "the working mode " + symbolic::mode_words(mechanism, sides) + " bends a link: the " + *bent +
           " is not held in any pose looked at";
  if (!mechanism.groups.empty()) return std::nullopt;  // no closed forms say why: proofs tell where
  const std::optional<std::string> why = symbolic::why_singular(mechanism, sides);
  if (!why) return std::nullopt;
  const std::string words = symbolic::mode_words(mechanism, sides);
  return (words.empty() ? "the mechanism" : "the working mode " + words) + " is singular in every pose: |A| = 0, for " +
         *why;
}

constexpr const char* other_mode =
    "choose another working mode, or change the lengths, the joints or which are actuated";

}  // namespace

void require_regular(const mechanism::Mechanism& mechanism, const DyadSides& sides) {
  if (const auto what = complaint(mechanism, sides)) throw core::InputError({mechanism.file}, *what, other_mode);
}

std::vector<DyadSides> regular_modes(const mechanism::Mechanism& mechanism, const std::vector<DyadSides>& modes,
                                     std::vector<std::string>& notes) {
  std::vector<DyadSides> regular;
  std::optional<std::string> last;
  for (const DyadSides& sides : modes) {
    const std::optional<std::string> what = complaint(mechanism, sides);
    if (!what) {
      regular.push_back(sides);
      continue;
    }
    last = what;
    const std::string note = *what + "; left out";
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  }
  if (regular.empty()) throw core::InputError({mechanism.file}, last.value_or("there is no working mode"), other_mode);
  return regular;
}

}  // namespace clearloci
