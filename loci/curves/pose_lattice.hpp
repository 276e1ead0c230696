// A lattice of poses over a box of two or three coordinates, cut into triangles or tetrahedra (Kuhn's): each cell's
// simplices go from its lowest corner to its highest one, along its edges in any order. One layer of nodes around the
// box, which count as out of reach, closes the outline of what is reached.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::pose {

class PoseLattice {
 public:
  PoseLattice(Pose lower, Pose upper, int cells);

  std::size_t dimension() const { return lower_.size(); }
  int cells() const { return cells_; }
  std::size_t nodes() const;
  /// Nodes along each axis.
  std::size_t along() const { return along_; }
  std::size_t node_at(const std::array<int, 3>& index) const;
  /// The one below a pose of the box along every axis.
  std::size_t node_below(const Pose& pose) const;
  /// Along an axis: 0 and cells() + 2 are outside of the box.
  int index(std::size_t node, std::size_t axis) const;
  bool outside(std::size_t node) const;
  /// Of nodes outside, the nearest one of the box.
  Pose at(std::size_t node) const;
  double place(std::size_t axis, int index) const;

  /// Edges lead from a node to its sum with a set of axes: bits, none of them empty.
  unsigned directions() const { return 1U << dimension(); }
  /// Whether the edge's end is a node.
  bool has(std::size_t node, unsigned direction) const;
  std::size_t end(std::size_t node, unsigned direction) const;
  std::size_t edge(std::size_t node, unsigned direction) const { return node * directions() + direction; }

  /// The corners of the simplices of the cell above a node, as directions from it; the first is 0.
  const std::vector<std::vector<unsigned>>& simplices() const { return simplices_; }
  bool has_cell(std::size_t node) const { return has(node, directions() - 1); }
  /// Above a node; of a cell of the box.
  PoseBox box(std::size_t node) const;

 private:
  Pose lower_, upper_;
  int cells_;
  std::size_t along_;
  std::array<std::size_t, 3> stride_{};
  std::vector<std::vector<unsigned>> simplices_;
};

}  // namespace clearloci::loci::pose
