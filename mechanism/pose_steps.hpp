// A mechanism's points and vectors as steps of a program over the pose (core/pose_program.hpp), in one working mode.
// Groups are blocks of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/pose_program.hpp"
#include "mechanism/placement.hpp"

namespace clearloci::mechanism {

/// Expressions of a mechanism file as steps: an algebra of core/interpret.hpp and of mechanism/placement.hpp.
class PoseSteps {
 public:
  using Value = int;

  /// The mechanism must outlive this.
  explicit PoseSteps(const Mechanism& mechanism);

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
  int unknown(std::size_t group, std::size_t k) { return builder_.unknown(group, k); }
  void close(std::size_t group, const std::vector<int>& equations);

 private:
  int exact(const core::Expression& expression, int step);

  const Mechanism& m_;
  core::PoseProgramBuilder builder_;
  std::map<std::string, int> symbols_;
};

/// The steps of a program that results need, with the pose of the groups' postures.
core::PoseProgram program_of(const Mechanism& mechanism, const core::PoseProgramBuilder& builder,
                             const std::vector<int*>& results);

using PosePoints = Placement<PoseSteps>;

}  // namespace clearloci::mechanism
