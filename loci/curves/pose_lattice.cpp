#include "loci/curves/pose_lattice.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace clearloci::loci::pose {

PoseLattice::PoseLattice(Pose lower, Pose upper, int cells)
    : lower_(std::move(lower)), upper_(std::move(upper)), cells_(cells), along_(static_cast<std::size_t>(cells) + 3) {
  stride_ = {1, along_, along_ * along_};
  std::vector<std::size_t> order(dimension());
  std::iota(order.begin(), order.end(), std::size_t{0});
  do {
    std::vector<unsigned> corners{0};
    for (const std::size_t axis : order) corners.push_back(corners.back() | 1U << axis);
    simplices_.push_back(std::move(corners));
  } while (std::next_permutation(order.begin(), order.end()));
}

std::size_t PoseLattice::nodes() const { return dimension() == 2 ? along_ * along_ : along_ * along_ * along_; }

std::size_t PoseLattice::node_at(const std::array<int, 3>& index) const {
  std::size_t node = 0;
  for (std::size_t axis = 0; axis < dimension(); ++axis) node += stride_[axis] * static_cast<std::size_t>(index[axis]);
  return node;
}

std::size_t PoseLattice::node_below(const Pose& pose) const {
  std::array<int, 3> index{};
  for (std::size_t axis = 0; axis < dimension(); ++axis) {
    index[axis] = 1;
    while (index[axis] < cells_ && place(axis, index[axis] + 1) <= pose[axis]) ++index[axis];
  }
  return node_at(index);
}

int PoseLattice::index(std::size_t node, std::size_t axis) const {
  return static_cast<int>(node / stride_[axis] % along_);
}

bool PoseLattice::outside(std::size_t node) const {
  for (std::size_t axis = 0; axis < dimension(); ++axis)
    if (const int position = index(node, axis); position == 0 || position == cells_ + 2) return true;
  return false;
}

double PoseLattice::place(std::size_t axis, int index) const {
  const int step = std::clamp(index - 1, 0, cells_);
  if (step == 0) return lower_[axis];
  if (step == cells_) return upper_[axis];
  // Off the places at which designs are symmetric.
  constexpr std::array<double, 3> off = {0.1378, -0.2113, 0.1729};
  return lower_[axis] + (upper_[axis] - lower_[axis]) * (step + off[axis]) / cells_;
}

Pose PoseLattice::at(std::size_t node) const {
  Pose pose;
  for (std::size_t axis = 0; axis < dimension(); ++axis) pose.push_back(place(axis, index(node, axis)));
  return pose;
}

bool PoseLattice::has(std::size_t node, unsigned direction) const {
  for (std::size_t axis = 0; axis < dimension(); ++axis)
    if ((direction >> axis & 1U) != 0 && index(node, axis) == cells_ + 2) return false;
  return true;
}

std::size_t PoseLattice::end(std::size_t node, unsigned direction) const {
  for (std::size_t axis = 0; axis < dimension(); ++axis)
    if ((direction >> axis & 1U) != 0) node += stride_[axis];
  return node;
}

PoseBox PoseLattice::box(std::size_t node) const {
  PoseBox box;
  for (std::size_t axis = 0; axis < dimension(); ++axis)
    box.push_back({place(axis, index(node, axis)), place(axis, index(node, axis) + 1)});
  return box;
}

}  // namespace clearloci::loci::pose
