#include "loci/surfaces/tetrahedra.hpp"

namespace clearloci::loci::surface {
namespace {

class Cutter {
 public:
  Cutter(const Cells& cells, Tetrahedra& result) : cells_(cells), result_(result) {}

  void add(int cell) {
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) add_face(cells_.cells()[static_cast<std::size_t>(cell)], axis, side);
    result_.cell_of.resize(result_.tetrahedra.size(), cell);
  }

 private:
  int corner(const LatticePlace& place) {
    std::uint64_t key = 0;
    for (const std::int32_t coordinate : place) key = key << 20 | static_cast<std::uint64_t>(coordinate);
    const auto [found, fresh] = result_.corner_at.try_emplace(key, static_cast<int>(result_.corners.size()));
    if (fresh) result_.corners.push_back(place);
    return found->second;
  }

  static LatticePlace moved(LatticePlace place, int axis, std::int32_t by) {
    place[static_cast<std::size_t>(axis)] += by;
    return place;
  }

  /// `axis`: across the face.
  void add_face(const OctreeCell& cell, int axis, int side) {
    const std::int32_t half = cell.size() / 2;
    const LatticePlace middle = moved(cell.middle(), axis, side * half);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const LatticePlace beyond = moved(cell.middle(), axis, side * cell.size());
    if (!cells_.finer_at(beyond, cell.level)) return add_fan(cell, middle, axis, side, half);
    for (const int du : {-1, 1})
      for (const int dv : {-1, 1})
        add_fan(cell, moved(moved(middle, u, du * half / 2), v, dv * half / 2), axis, 0, half / 2);
  }

  /// A square of the face, `half` an edge round its middle. `side` 0: edges have no middles to heed.
  void add_fan(const OctreeCell& cell, const LatticePlace& middle, int axis, int side, std::int32_t half) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    constexpr std::array<std::array<int, 2>, 4> outward = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    std::vector<int> rim;
    for (std::size_t i = 0; i < 4; ++i) {
      // An edge's middle, then the corner behind it.
      const auto [du, dv] = outward[i];
      if (side != 0 && cut_beside(cell, axis, side, du != 0 ? u : v, du != 0 ? du : dv))
        rim.push_back(corner(moved(moved(middle, u, du * half), v, dv * half)));
      const auto [next_u, next_v] = outward[(i + 1) % 4];
      rim.push_back(corner(moved(moved(middle, u, (du + next_u) * half), v, (dv + next_v) * half)));
    }
    const int centre = corner(cell.middle()), top = corner(middle);
    for (std::size_t i = 0; i < rim.size(); ++i)
      result_.tetrahedra.push_back({centre, top, rim[i], rim[(i + 1) % rim.size()]});
  }

  /// Whether smaller cells meet an edge: the one between the face (axis, side) and the face (other, way).
  bool cut_beside(const OctreeCell& cell, int axis, int side, int other, int way) const {
    const LatticePlace beside = moved(cell.middle(), other, way * cell.size());
    return cells_.finer_at(beside, cell.level) || cells_.finer_at(moved(beside, axis, side * cell.size()), cell.level);
  }

  const Cells& cells_;
  Tetrahedra& result_;
};

}  // namespace

Tetrahedra tetrahedra_of(const Cells& cells) {
  std::vector<int> active;
  for (std::size_t i = 0; i < cells.cells().size(); ++i)
    if (cells.cells()[i].active()) active.push_back(static_cast<int>(i));
  Tetrahedra result;
  add_tetrahedra(cells, active, result);
  return result;
}

void add_tetrahedra(const Cells& cells, const std::vector<int>& leaves, Tetrahedra& all) {
  Cutter cutter(cells, all);
  for (const int leaf : leaves) cutter.add(leaf);
}

}  // namespace clearloci::loci::surface
