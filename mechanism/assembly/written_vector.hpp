// Vectors and places as a mechanism file writes them: sums of amounts times functions of the coordinates, and ways
// between points. Private to mechanism/.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/assembly/amount.hpp"

namespace clearloci::mechanism {

/// An amount times what it multiplies: "cos(theta)", "x", or nothing.
struct Term {
  Amount amount;
  std::string factor;
};
using Terms = std::vector<Term>;

/// "3*cos(theta) + 5/2"; "0" of none.
std::string text_of(const Terms& terms);

struct WrittenVector {
  std::array<Terms, 3> components;
  Terms ways;  ///< factors such as "(Q - P)"

  bool is_constant() const;  ///< numbers and parameters alone
  bool is_zero() const;
  WrittenVector& operator+=(const WrittenVector& other);
};

WrittenVector constant_vector(const Amounts& amounts);
/// From one point to another.
WrittenVector way_between(const std::string& from, const std::string& to);
WrittenVector operator+(WrittenVector a, const WrittenVector& b);
WrittenVector operator*(const Amount& factor, WrittenVector vector);
/// Every amount times a function of the coordinates; required: no factors of functions yet.
WrittenVector times(const std::string& function, WrittenVector vector);
/// A quarter turn to the left in the plane; required: no ways.
WrittenVector left_of(const WrittenVector& vector);

/// A vector as the file writes it: "[1, 0]" or "2*(Q - P) + [0, 1]".
std::string text_of(const WrittenVector& vector, std::size_t dimension);

}  // namespace clearloci::mechanism
