// Mechanism files of 5R manipulators with given numbers, for laws that hold for every design.
#pragma once

#include <array>
#include <random>
#include <string>

namespace clearloci::test {

struct FiveBarDesign {
  std::array<std::string, 2> a1{"0", "0"}, a2{"1/2", "0"};
  std::string proximal1 = "1/2", distal1 = "1/2", proximal2 = "1/2", distal2 = "1/2";
  std::string side1 = "right", side2 = "left";
  std::array<std::string, 2> force{"0", "-100"};
  std::array<std::string, 2> gravity{};  ///< empty: weightless
  std::array<std::string, 4> box{"-3/2", "2", "-3/2", "3/2"};

  std::string text() const;
};

/// Half of them on the lattice of quarters, with equal lengths, loads along an axis and a box that is cut on purpose;
/// the others of rational numbers with small denominators: unequal lengths, inclined base and load, degenerate now and
/// then.
FiveBarDesign random_five_bar(std::mt19937& random, bool with_weights);

}  // namespace clearloci::test
