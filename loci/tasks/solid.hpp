// The solid within a closed mesh over three lengths: all that its surface winds around, and the surface. Where doubles
// do not tell, a place counts as one of the solid.
//
// A box that no triangle meets lies on one side of the surface as a whole, and a ray from any of its points tells on
// which: it crosses triangles from behind as often as from the front exactly where the winding number is 0.
// A triangle and a box are apart by more than g where along one of 13 directions their shadows are (Akenine-Möller,
// Fast 3D triangle-box overlap testing, 2001).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "clearloci/verify.hpp"

namespace clearloci::loci::pose {

class Solid {
 public:
  using Point = std::array<double, 3>;
  struct Box {
    Point lower, upper;
  };

  /// Required: a triangle at least.
  explicit Solid(const core::TaskMesh& mesh);

  const Box& bounds() const { return nodes_.front().box; }
  const std::vector<Point>& corners() const { return corners_; }

  /// Not above the distance of any point of the box from the solid; 0 where they may meet.
  double distance(const Box& box) const;
  /// To rounding.
  bool holds(const Point& point) const;
  Point nearest_of_surface(const Point& point) const;

 private:
  struct Triangle {
    std::array<Point, 3> corners;
  };
  struct Node {
    Box box;
    std::size_t first = 0, count = 0;    ///< triangles of a leaf
    std::array<std::size_t, 2> below{};  ///< where it is none
  };
  std::size_t grow(std::size_t first, std::size_t last);
  /// How often the surface winds around a point off it; nothing where the ray passes too near to an edge.
  std::optional<int> winding(const Point& from) const;
  bool encloses(const Box& box) const;

  std::vector<Point> corners_;
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  double slack_ = 0;  ///< roundings of the mesh's own numbers
};

}  // namespace clearloci::loci::pose
