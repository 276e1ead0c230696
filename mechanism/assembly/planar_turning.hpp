// How the links of a planar drawing are turned: by a coordinate, by two points, as their guide is.
// Private to mechanism/.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/assembly/part_by_part.hpp"

namespace clearloci::mechanism {

/// Coordinates, each times a number.
using SumOfAngles = std::vector<std::pair<std::string, Rational>>;

/// How a link is turned: where a vector of the drawing is in a pose.
struct Orientation {
  enum class Means {
    vectors,  ///< by the images of the reference's direction and of its left
    points,   ///< two points of a link, a constant distance apart
    way       ///< two points whose distance varies
  };
  Means means = Means::vectors;
  /// The same direction in the link's shape and in the drawing.
  Amounts reference = {Amount(core::Rational(1)), {}, {}}, drawn = reference;
  WrittenVector first, second;  ///< unit vectors, of `vectors`
  int from = -1, to = -1;       ///< handles, of `points` and `way`
  /// Of coordinates, where `first` is (cos, sin) of their sum, each times its number.
  std::optional<SumOfAngles> angle = {};
};

class PlanarTurning : public PartByPart {
 public:
  explicit PlanarTurning(const Drawing& drawing);

 protected:
  using Means = Orientation::Means;

  bool is_turned(LinkIndex link) const override { return orientation(link) != nullptr; }
  bool turn(LinkIndex link) override;
  bool turn_by_way(LinkIndex link) override;
  WrittenVector image(LinkIndex link, const Amounts& drawn) override;
  /// Where a vector of a link's shape is.
  WrittenVector image_of_shape(LinkIndex link, const Amounts& v);

  /// Null where it is not known.
  const Orientation* orientation(LinkIndex link) const;
  /// In a guide, with which it turns.
  bool slides(const Joint& joint, LinkIndex link) const;
  void set_turned(LinkIndex link, Orientation orientation);
  /// Wheels that turn by the same angle: pulleys of one size, a wheel in a ring.
  static bool turn_alike(const DrawnMesh& mesh);
  static Amounts left(const Amounts& v) { return {-v[1], v[0], {}}; }
  /// v by its parts along a reference and to its left, each over `length` of the reference where `over_square`.
  static std::array<Amount, 2> parts(const Amounts& v, const Amounts& reference, bool over_square);

 private:
  WrittenVector image(const Orientation& orientation, const Amounts& v, const Amounts& reference);
  std::string extra(const Orientation& orientation, const std::string& suffix, std::size_t which);
  std::optional<Amounts> pointer(LinkIndex link) const;
  Amounts drawn_pointer(LinkIndex link) const;
  bool orient_by_angle(LinkIndex link, const DrawnCoordinate& c);
  bool orient_by_points(LinkIndex link);
  bool orient_by_guide(LinkIndex link);
  std::optional<Orientation> by_way(LinkIndex link, JointIndex index);
  Orientation beside_way(const Orientation& along, const Joint& joint, const Amounts& axis);
  bool orient_as(LinkIndex link, LinkIndex guide);
  bool orient_by_wheels(LinkIndex link);
  bool orient_by_teeth(LinkIndex link, const DrawnMesh& mesh);
  void refuse_part_of_angle(LinkIndex link) const;

  Orientation ground_;
  std::vector<std::optional<Orientation>> orientations_;
};

}  // namespace clearloci::mechanism
