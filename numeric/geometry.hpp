// Points, axes and vectors of a mechanism as registers of a tape (method.md section 1). A vector has three components,
// in the plane a third one that is the constant 0: constants fold while the tape is written, so that a planar
// mechanism's tape holds planar arithmetic alone. Private to numeric/.
#pragma once

#include <optional>
#include <vector>

#include "numeric/model.hpp"
#include "numeric/named_tape.hpp"

namespace clearloci::numeric {

class Geometry {
 public:
  /// Places every point and gives every joint its axes.
  explicit Geometry(const mechanism::Mechanism& mechanism);

  TapeBuilder& tape() { return tape_; }
  Register zero() const { return zero_; }
  Register one() const { return one_; }
  Register compile(const core::Expression& e) { return named_.compile(e); }

  const std::vector<Triple>& points() const { return points_; }
  const Triple& point(mechanism::PointIndex index) const { return points_[static_cast<std::size_t>(index)]; }
  const std::vector<GroupBlock>& groups() const { return groups_; }
  /// As NumericModel::axes and NumericModel::couple_axes.
  const std::vector<std::optional<Triple>>& axes() const { return axes_; }
  const std::vector<std::optional<Triple>>& couple_axes() const { return couple_axes_; }
  /// Of every joint with a written axis: a vector along the first one, of any length; zeros of others.
  const std::vector<Triple>& ways() const { return ways_; }

  /// Two or three expressions, or none: the zero vector.
  Triple components(const std::vector<core::Expression>& expressions);
  Triple vector(const mechanism::VectorExpression& v);
  /// Along +x, +y or +z: 0, 1, 2.
  Triple direction(std::size_t component) const;
  /// From the first point of a link to its second one; of the ground +x.
  Triple direction_of(mechanism::LinkIndex link);
  /// From the end effector's point.
  Triple arm(mechanism::PointIndex p) { return minus(point(p), point(m_.end_effector_point)); }

  Triple plus(const Triple& a, const Triple& b);
  Triple minus(const Triple& a, const Triple& b);
  Triple times(Register s, const Triple& a);
  Triple negative(const Triple& a);
  Triple cross(const Triple& a, const Triple& b);
  Register dot(const Triple& a, const Triple& b);
  Register length(const Triple& a);
  Triple unit(const Triple& a);

 private:
  Triple place(mechanism::PointIndex index);
  Triple offset(const mechanism::OffsetPoint& form);
  Triple dyad(const mechanism::DyadPoint& form, Register sign);
  Triple slider(const mechanism::SliderPoint& form, Register sign);
  Triple crossing(const mechanism::CrossingPoint& form);
  Triple unknown(const mechanism::GroupPoint& form);
  void close(const mechanism::Group& group, GroupBlock& block);
  void add_axes(const mechanism::Joint& joint);

  const mechanism::Mechanism& m_;
  NamedTape named_;
  TapeBuilder& tape_;
  Register zero_, one_;
  std::vector<GroupBlock> groups_;
  std::vector<Triple> points_, ways_;
  std::vector<std::optional<Triple>> axes_, couple_axes_;
};

}  // namespace clearloci::numeric
