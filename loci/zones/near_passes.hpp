// Where two polylines come near each other: what lies elsewhere cannot cross.
#pragma once

#include <optional>
#include <vector>

#include "core/locus_map.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {

/// A polyline with the boxes of its pieces, of halves of them, and so on.
class BoxedPolyline {
 public:
  explicit BoxedPolyline(const core::Polyline& points);

  /// Boxes that hold all places of either polyline within `reach` (along x and y) of the other one, apart from each
  /// other; nothing where there are more than is worth looking at one by one: the polylines run side by side.
  friend std::optional<std::vector<sheet::PlaneCell>> near_passes(const BoxedPolyline& a, const BoxedPolyline& b,
                                                                  double reach);

  /// Pieces (by their first vertices, ascending) whose boxes are within `reach` (along x and y) of a point: all that
  /// may be so near.
  std::vector<std::size_t> pieces_near(const core::Point2& at, double reach) const;

 private:
  struct Node {
    sheet::PlaneCell box;
    std::size_t piece = 0;
    int halves = -1;  ///< the first of two, the second stands right before this; -1: a piece
  };
  int build(const core::Polyline& points, std::size_t from, std::size_t to);

  std::vector<Node> nodes_;  ///< the last is that of the whole
};

}  // namespace clearloci::loci
