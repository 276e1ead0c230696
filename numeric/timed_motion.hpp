// Coordinates that are given in time: expressions in t, or natural cubic splines through the rows of a table, which are
// smooth to the acceleration and at rest with it (no bending) at both ends of the table.
#pragma once

#include <vector>

#include "mechanism/trajectory.hpp"
#include "numeric/motion_law.hpp"
#include "numeric/tape.hpp"

namespace clearloci::numeric {

/// From knots[i] to knots[i + 1]: values and bendings (second derivatives) at the knots.
struct CompiledSpline {
  std::vector<double> values, bendings;
};

struct CompiledTimed {
  double start = 0, duration = 1;       ///< s
  std::vector<Tape> tapes;              ///< of the coordinates, their one input the time; or
  std::vector<Register> results;        ///< of each tape
  std::vector<double> knots;            ///< s, of the splines
  std::vector<CompiledSpline> splines;  ///< of the coordinates
};

CompiledTimed compile(const mechanism::TimedMotion& timed, const mechanism::Mechanism& mechanism, double period);

/// The free coordinates at a part of the duration, in the piece between two knots. Rates are by that part.
std::vector<Series> place_at(const CompiledTimed& timed, std::size_t piece, double tau);

}  // namespace clearloci::numeric
