// Whether the numbers of a request can be kept, and a task is one of this mechanism: asked once for every front end, at
// the public functions. The readers of files and of command lines say it before, in their words.
#pragma once

#include <string>

#include "clearloci/error.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/verify.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci {

/// What doubles can express in the box at least, m: vertices are placed within some spacings of doubles at its
/// coordinates, and a tolerance below that could never be kept.
double finest_tolerance(const mechanism::Mechanism& mechanism);

/// All throw core::InputError.
void check_request(const mechanism::Mechanism& mechanism, const LociRequest& request);
void check_request(const mechanism::Mechanism& mechanism, const ErrorRequest& request);
void check_task(const mechanism::Mechanism& mechanism, const core::Task& task);

/// A number above zero that occurs in mechanisms, as the readers of files and of command lines ask for it.
void check_positive(double value, const std::string& what, const std::string& unit);

/// What joints are to keep, N and N m, where it is given.
void check_least(const std::optional<Rational>& min_force, const std::optional<Rational>& min_couple);

/// Cells that zones by cells look at: one at least.
void check_cells(long cells);

/// Nodes of a grid along each coordinate: two at least, and together no more than memory holds.
void check_nodes(const std::vector<int>& nodes, int least);

}  // namespace clearloci
