// Laws of motion between two rests: the part of the distance covered, s(σ), as a function of the part of the time σ,
// s(0) = 0, s(1) = 1, s'(0) = s'(1) = 0.
//     cycloidal     s = σ - sin(2πσ)/(2π)
//     3-4-5         s = 10σ³ - 15σ⁴ + 6σ⁵
//     trapezoidal   speed up at a constant rate over a part a of the time, cruise, slow down as long
//     s-curve       the same with the acceleration ramped over a part q of a at either end: constant jerk
// and constant, s = σ, which never rests.
#pragma once

#include <vector>

#include "mechanism/trajectory.hpp"
#include "numeric/taylor.hpp"

namespace clearloci::numeric {

/// Everything that moves is a series in time to the third derivative: place, velocity, acceleration, jerk.
using Series = Taylor<3>;

/// From σ = `start` on: s = s0 + v (σ - start) + a (σ - start)²/2 + j (σ - start)³/6, or the closed form of its law.
struct LawPiece {
  double start = 0, end = 1;
  double s0 = 0, v = 0, a = 0, j = 0;
};

struct CompiledLaw {
  mechanism::LawKind kind = mechanism::LawKind::cycloidal;
  std::vector<LawPiece> pieces;  ///< smooth within, in order; one for the closed forms
};

CompiledLaw compile(const mechanism::MotionLaw& law);

/// The law's piece at σ, continued beyond its ends.
Series covered(const CompiledLaw& law, std::size_t piece, const Series& sigma);

/// σ at which the part s is covered, s in [0, 1].
double time_of(const CompiledLaw& law, double s);

}  // namespace clearloci::numeric
