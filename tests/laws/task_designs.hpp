// Random mechanisms of many kinds and tasks for them, as texts: half of them from the lattice of quarters, where legs
// are equal, bases coincide and sides of tasks run through centres, tangents and crossings.
#pragma once

#include <optional>
#include <random>
#include <string>

#include "core/task.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::test {

inline constexpr int task_design_kinds = 7;  ///< 5R, its coupler, PRRRP, PRRR-R, RRRPR, RPRPR, 3-RPR

/// `lattice`: numbers are multiples of a quarter.
std::string random_design(std::mt19937& random, int kind, bool lattice);

/// The shape of a task about a pose that the mechanism reaches, with a margin in one of two; nothing where it was not
/// found to reach any.
std::optional<std::string> random_shape(std::mt19937& random, const mechanism::Mechanism& mechanism, bool lattice);

/// Lines of a task file: a least force or couple about as large as what the mechanism bears at the shape, a range of
/// loads.
std::string random_wishes(std::mt19937& random, const mechanism::Mechanism& mechanism, const core::TaskShape& shape,
                          bool lattice);

}  // namespace clearloci::test
