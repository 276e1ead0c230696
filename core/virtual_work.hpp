// What it means that a reaction vanishes, by virtual work: it can be said of any reaction of any mechanism.
#pragma once

#include <span>
#include <string>

#include "clearloci/loci.hpp"

namespace clearloci::inline core {

/// How the reasons of reactions begin.
inline constexpr const char* no_work_words = "the loads do no work in ";

/// A reaction times a displacement against it is minus the work of the loads in the motion which that displacement
/// leaves to the mechanism, all actuators but that one locked: it vanishes where they do none. "the loads do no work in
/// the motion that A1 alone drives"; of a direct singularity that there is such a motion with all of them locked.
std::string virtual_work_words(LocusKind kind, std::span<const Vanishing> vanishing);

}  // namespace clearloci::inline core
