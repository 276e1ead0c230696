// Weighted designs of the plane, and least forces of theirs, for the laws of margin curves.
#pragma once

#include <string>

namespace clearloci::test {

struct MarginDesign {
  std::string family;  ///< "5R"
  std::string text;    ///< the mechanism file
  std::string min_force;
};

/// Half of them on a lattice. Families: 5R, PRRR-R (a leg on a rail), RRRPR (a telescopic leg), a 5R with a load on its
/// coupler and a spring.
MarginDesign random_margin_design(unsigned seed);

}  // namespace clearloci::test
