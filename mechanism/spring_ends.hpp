// Springs whose ends meet along a curve, or at a pose of one coordinate: the force of a spring with a free length, or
// of constant size, turns round there, and reactions jump. As where the couple of a torsion spring jumps, the workspace
// ends a little before, as at a limit (method.md section 11). Ends that meet at single poses of several coordinates
// leave no such curve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// Adds a limit of the distance of the ends of every such spring, told from sampled poses of the file's working mode.
void limit_spring_ends(Mechanism& mechanism);

/// "spring S1, whose ends H1 and H2 meet" of a limit that was added; nothing of the file's own.
std::optional<std::string> words_of_spring_ends(const Mechanism& mechanism, const Limit& limit);

/// What they are, a line each.
std::vector<std::string> notes_of_spring_ends(const Mechanism& mechanism);

}  // namespace clearloci::mechanism
