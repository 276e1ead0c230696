// The unit cube cut into an octree until every cell is free of the surface or as small as the mesh asks for; smaller
// where two parts of the surface may pass through one cell. Neighbours, over corners too, differ by one level at most.
// Private to loci/surfaces.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "loci/surfaces/field.hpp"

namespace clearloci::loci::surface {

/// Units of the lattice on which corners, middles of faces and of cells lie.
inline constexpr int deepest = 11;
inline constexpr std::int32_t lattice = 1 << (deepest + 1);

using LatticePlace = std::array<std::int32_t, 3>;  ///< on the lattice

inline Point unit_of(const LatticePlace& place) {
  constexpr double step = 1.0 / lattice;
  return {place[0] * step, place[1] * step, place[2] * step};
}

/// The place below a point of the unit cube, in every coordinate.
inline LatticePlace place_below(const Point& unit) {
  LatticePlace place;
  for (std::size_t i = 0; i < 3; ++i)
    place[i] = std::clamp(static_cast<std::int32_t>(unit[i] * lattice), std::int32_t{0}, lattice - 1);
  return place;
}

struct OctreeCell {
  LatticePlace corner{};  ///< the lowest
  int level = 0;
  int children = -1;  ///< the first of eight; -1: a leaf
  Proof proof;

  std::int32_t size() const { return lattice >> level; }
  LatticePlace middle() const { return {corner[0] + size() / 2, corner[1] + size() / 2, corner[2] + size() / 2}; }
  Box box() const {
    constexpr double step = 1.0 / lattice;  // a power of two: exact
    Box result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = {corner[i] * step, (corner[i] + size()) * step};
    return result;
  }
  bool leaf() const { return children < 0; }
  /// The surface may pass through.
  bool active() const { return leaf() && !proof.outside && !proof.zero_free; }
};

struct CellLimits {
  int level = 4;                    ///< of cells that the surface passes through
  int finest = 7;                   ///< where it may do so more than once
  int most = 150000;                ///< cells examined before cells stay larger than `finest`
  std::function<bool()> stop = {};  ///< asked now and then; true: throws core::LimitReached
};

class Cells {
 public:
  Cells(Field& field, const CellLimits& limits);

  /// Cuts cells further, down to the given level, wherever the surface may pass.
  void look_closer(const std::vector<int>& cells, int finest);
  /// Cuts leaves once, those of them that are larger than the finest and that the surface may pass. False: there are
  /// none.
  bool halve(const std::vector<int>& leaves, int finest);

  const std::vector<OctreeCell>& cells() const { return cells_; }
  /// The smallest cell of at most the given level that holds a place of the lattice's interior; -1: outside the cube.
  int at(const LatticePlace& inner, int level) const;
  /// Whether the place lies inside a cell of the given level that is cut further.
  bool finer_at(const LatticePlace& inner, int level) const;
  /// The leaves of which a place is a point, each once.
  void each_leaf_at(const LatticePlace& place, const std::function<void(int)>& visit) const;
  /// The leaves that share a point with a leaf, itself among them, some more than once.
  void each_neighbour(int leaf, const std::function<void(int)>& visit) const;

 private:
  /// What the function's signs and gradients at some points of a cell speak for.
  enum class Look { flat, bent, unseen, several };

  void cut(std::vector<int> front, const std::function<bool(OctreeCell&)>& wanted);
  std::vector<Proof> examine(const std::vector<Box>& boxes);
  void split(int cell);
  void balance(int cell);
  bool worth_splitting(OctreeCell& cell);
  /// The places by which a cell is looked at: its middle, then its corners.
  static void add_places(const OctreeCell& cell, std::vector<LatticePlace>& places);
  Look look_at(const OctreeCell& cell);
  struct Seen {
    bool negative = false;
    Point gradient{};
  };
  /// Corners belong to many cells, and middles are corners of smaller ones: each is looked at once.
  std::vector<Seen> seen_at(const std::vector<LatticePlace>& places);

  Field* field_;
  CellLimits limits_;
  std::vector<OctreeCell> cells_;
  std::unordered_map<std::uint64_t, Seen> seen_;  ///< by place
  int examined_ = 0;
};

}  // namespace clearloci::loci::surface
