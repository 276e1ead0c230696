// A mechanism's points and vectors as steps of a program over the pose (core/pose_program.hpp), in one working mode.
// Private to symbolic/.
#pragma once

#include <map>
#include <string>

#include "core/pose_program.hpp"
#include "mechanism/placement.hpp"

namespace clearloci::symbolic {

/// Expressions of a mechanism file as steps: an algebra of core/interpret.hpp and of mechanism/placement.hpp.
class PoseSteps {
 public:
  using Value = int;

  /// The mechanism must outlive this.
  explicit PoseSteps(const mechanism::Mechanism& mechanism);

  core::PoseProgramBuilder& builder() { return builder_; }

  int number(const core::Rational& value) { return builder_.constant(value); }
  int symbol(const std::string& name);
  int pi() { return builder_.pi(); }
  int negate(int a) { return builder_.negate(a); }
  int add(int a, int b) { return builder_.add(a, b); }
  int subtract(int a, int b) { return builder_.subtract(a, b); }
  int multiply(int a, int b) { return builder_.multiply(a, b); }
  int square(int a) { return builder_.square(a); }
  int inverse(int a) { return builder_.inverse(a); }
  int square_root(int a) { return builder_.square_root(a); }
  int divide(int a, int b, const core::Expression&) { return builder_.divide(a, b); }
  int power(int base, const core::Expression& whole);
  int sqrt(int a, const core::Expression& whole) { return exact(whole, builder_.square_root(a)); }
  int cos(int a, const core::Expression& whole) { return exact(whole, builder_.cosine(a)); }
  int sin(int a, const core::Expression& whole) { return exact(whole, builder_.sine(a)); }
  int atan(int a, const core::Expression&) { return builder_.angle(a, builder_.one()); }

 private:
  int exact(const core::Expression& expression, int step);

  const mechanism::Mechanism& m_;
  core::PoseProgramBuilder builder_;
  std::map<std::string, int> symbols_;
};

using PosePoints = mechanism::Placement<PoseSteps>;

}  // namespace clearloci::symbolic
