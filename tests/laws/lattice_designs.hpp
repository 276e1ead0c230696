// Mechanism files on a lattice: coordinates, lengths, loads and sides of the box are multiples of 1/4, legs are often
// equal, the box is often cut at centres, tangents and crossings of curves. Engineers write such numbers, and every
// coincidence that an algorithm may be asked to survive is common among them.
#pragma once

#include <random>
#include <string>

namespace clearloci::test {

enum class Family { five_bar, coupler, prrrp, prrr_r, rprpr, three_rpr };

std::string to_string(Family family);

/// `weights`: links have masses and there is gravity.
std::string lattice_design(std::mt19937& random, Family family, bool weights);

}  // namespace clearloci::test
