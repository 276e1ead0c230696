// How the links of a drawing in space are turned: as their guide, by the angle about an axis, by the axis and a point,
// by three points, or by the angles of a frame. Private to mechanism/.
#pragma once

#include "mechanism/assembly/part_by_part.hpp"

namespace clearloci::mechanism {

/// Of vectors' lengths: what a drawing means to be parallel or square.
bool is_parallel(const Amounts& a, const Amounts& b);
bool is_square(const Amounts& a, const Amounts& b);

/// The part of a way along an axis; zero where decimals that stand for irrational places mean none.
Amounts part_along(const Amounts& way, const Amounts& axis);

/// Three vectors that turn with a link, as drawn and as written; any other is a sum of them.
struct Triad {
  std::array<Amounts, 3> drawn;
  std::array<WrittenVector, 3> written;
};

/// The orientation of a link: a triad, or the points of a frame of the file.
struct Attitude {
  std::optional<Triad> triad;  ///< none: not turned from the drawing, or by a frame
  std::string frame;           ///< of the file; else empty
  int origin = -1;             ///< handle of the frame's
  bool by_shape = false;       ///< the triad is of the link's shape alone
};

class SpatialTurning : public PartByPart {
 public:
  explicit SpatialTurning(const Drawing& drawing);

 protected:
  bool is_turned(LinkIndex link) const override;
  bool turn(LinkIndex link) override;
  /// Where the attitude is of the link's shape, of a vector of that.
  WrittenVector image(LinkIndex link, const Amounts& v) override;
  /// Required: a link whose attitude is known.
  const Attitude& attitude(LinkIndex link) const { return *attitudes_[static_cast<std::size_t>(link)]; }

  /// A vector as an axis: components, a sum of ways, or else the way to a point that is put at it.
  std::string direction_text(LinkIndex link, const Amounts& v);
  Node frame_form(const Attitude& attitude, const Amounts& way) const;
  /// The revolute joint by which a link turns about a known one.
  std::optional<JointIndex> hinge_of(LinkIndex link) const;
  /// What is left of the length between two points beside its part along an axis.
  Amount beside(LinkIndex link, PointIndex from, PointIndex to, const Amounts& along);

 private:
  /// A point of the frame at a way from its origin.
  std::string in_frame(const Attitude& attitude, const Amounts& way);
  /// A cross product of two ways is a length more than a way: over one, in the file's units.
  Amount per_length() const { return Amount(1 / d_.unit); }

  void set(LinkIndex link, Attitude attitude) { attitudes_[static_cast<std::size_t>(link)] = std::move(attitude); }
  bool turn_by_frame(LinkIndex link);
  bool turn_by_guide(LinkIndex link);
  bool turn_by_angle(LinkIndex link);
  bool turn_by_points(LinkIndex link);
  bool turn_by_axis(LinkIndex link);

  std::vector<std::optional<Attitude>> attitudes_;
};

}  // namespace clearloci::mechanism
