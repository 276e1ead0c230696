// A mechanism's points and vectors as steps of a program over the pose (core/pose_program.hpp), in one working mode.
// Plane and space are one here: a planar mechanism lies in z = 0, and its dyads turn about z. Private to symbolic/.
//
//   dyad B on A, P about n with |AB| = a, |BP| = b:   w = P - A,  N = n . n,  h = n . w,
//       D = N w . w - h^2,  k = a^2 - b^2 + w . w,  s^2 = 4 a^2 D - N k^2
//       B = A + k / (2 D) (N w - h n) + s / (2 D) (n x w)
//   slider S on Q along u, |SC| = l:   r = C - Q,  S = Q + (u . r +- sqrt(l^2 - |u x r|^2)) u,  u of length one
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/pose_program.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::symbolic {

class PosePoints {
 public:
  using Vector = std::array<int, 3>;

  /// `sides`: one a point of mechanism::dyad_points. Both must outlive this.
  PosePoints(const mechanism::Mechanism& mechanism, const std::vector<int>& sides);

  core::PoseProgramBuilder& builder() { return builder_; }

  const Vector& point(mechanism::PointIndex index) const { return points_[static_cast<std::size_t>(index)]; }
  int expression(const core::Expression& expression);
  Vector components(const std::vector<core::Expression>& expressions);
  Vector vector(const mechanism::VectorExpression& vector);

  Vector plus(const Vector& a, const Vector& b);
  Vector minus(const Vector& a, const Vector& b);
  Vector times(int factor, const Vector& a);
  Vector cross(const Vector& a, const Vector& b);
  int dot(const Vector& a, const Vector& b);
  int length(const Vector& a) { return builder_.square_root(dot(a, a)); }
  Vector unit(const Vector& a) { return times(builder_.inverse(length(a)), a); }

 private:
  Vector place(mechanism::PointIndex index);
  Vector elbow(const mechanism::DyadPoint& form, int side);
  Vector slide(const mechanism::SliderPoint& form, int side);
  Vector beside(const mechanism::OffsetPoint& form);
  int exact(const core::Expression& expression, int step);
  int power(const core::Expression& base, const core::Expression& exponent);

  const mechanism::Mechanism& m_;
  std::map<mechanism::PointIndex, int> sides_;
  core::PoseProgramBuilder builder_;
  std::map<std::string, int> symbols_;
  std::vector<Vector> points_;
};

}  // namespace clearloci::symbolic
