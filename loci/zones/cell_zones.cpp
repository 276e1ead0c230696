#include "loci/zones/cell_zones.hpp"

#include <algorithm>
#include <map>

#include "core/parts.hpp"
#include "loci/zones/zone_cells.hpp"

namespace clearloci::loci::pose {
namespace {

using Kind = ZoneCell::Kind;

const HalfSpace& all_of_it() {
  static const HalfSpace all{{}, -1};
  return all;
}

/// Free cells and parts are numbered two a cell: 2 c, 2 c + 1.
class Zones {
 public:
  Zones(ZoneCells& tree, const CellZoneEffort& effort)
      : effort_(effort), tree_(tree), cells_(tree.cells()), groups_(2 * cells_.size()) {}

  CellZones collect() {
    join();
    number();
    add_parts();
    add_faces();
    tell_doubt();
    rasterise();
    result_.cells = tree_.looked_at();
    result_.out_of_time = tree_.out_of_time();
    return std::move(result_);
  }

 private:
  const HalfSpace* part(std::size_t cell, std::size_t side) const {
    const ZoneCell& zone_cell = cells_[cell];
    if (zone_cell.kind == Kind::free) return side == 0 ? &all_of_it() : nullptr;
    if (zone_cell.kind != Kind::in_doubt || !zone_cell.parts || (*zone_cell.parts)[side].empty()) return nullptr;
    if (zone_cell.beyond && side == 1) return nullptr;
    return &(*zone_cell.parts)[side];
  }
  static std::size_t number_of(std::size_t cell, std::size_t side) { return 2 * cell + side; }

  PoseBox common_face(std::size_t a, std::size_t b, std::size_t axis) const {
    PoseBox common = cells_[a].box;
    for (std::size_t c = 0; c < common.size(); ++c) {
      common[c][0] = std::max(common[c][0], cells_[b].box[c][0]);
      common[c][1] = std::min(common[c][1], cells_[b].box[c][1]);
    }
    common[axis] = {cells_[a].box[axis][1], cells_[a].box[axis][1]};
    return common;
  }

  /// Whether two parts of neighbours have a pose of their common face in common, for certain.
  bool meet(std::size_t a, const HalfSpace& of_a, std::size_t b, const HalfSpace& of_b, const PoseBox& face) const {
    if (&of_a == &all_of_it() && &of_b == &all_of_it()) return true;
    const double slack_a = height_slack(cells_[a].box), slack_b = height_slack(cells_[b].box);
    const Polygon in_a = clipped(corners_of(face), of_a, cells_[a].box, 2 * slack_a, true);
    return std::any_of(in_a.begin(), in_a.end(),
                       [&](const auto& at) { return height(of_b, cells_[b].box, at) > 2 * slack_b; });
  }

  void join() {
    tree_.faces([&](std::size_t a, std::size_t b, std::size_t axis) {
      const PoseBox face = common_face(a, b, axis);
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
          const HalfSpace *one = part(a, i), *two = part(b, j);
          if (one != nullptr && two != nullptr && meet(a, *one, b, *two, face))
            groups_.join(number_of(b, j), number_of(a, i));
        }
    });
  }

  /// Zones are groups that are large enough, largest first. What is left of free cells is in doubt: it may belong to
  /// any zone that it touches.
  void number() {
    std::map<std::size_t, double> sizes;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (std::size_t side = 0; side < 2; ++side)
        if (const HalfSpace* space = part(c, side))
          sizes[groups_.of(number_of(c, side))] += share_of(*space) * cells_[c].size();
    std::vector<std::pair<double, std::size_t>> large;
    for (const auto& [group, size] : sizes)
      if (size >= effort_.least_part * cells_.front().size()) large.emplace_back(size, group);
    std::stable_sort(large.begin(), large.end(), [](const auto& x, const auto& y) { return x.first > y.first; });
    result_.zones.resize(large.size());
    std::map<std::size_t, int> zone_of_group;
    for (std::size_t z = 0; z < large.size(); ++z) zone_of_group[large[z].second] = static_cast<int>(z);
    zone_.assign(2 * cells_.size(), -1);
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (std::size_t side = 0; side < 2; ++side)
        if (part(c, side) != nullptr)
          if (const auto found = zone_of_group.find(groups_.of(number_of(c, side))); found != zone_of_group.end())
            zone_[number_of(c, side)] = found->second;
  }

  /// The zone that a part belongs to; -1: none.
  int zone(std::size_t cell, std::size_t side) const { return zone_[number_of(cell, side)]; }

  void add_parts() {
    std::vector<double> largest(result_.zones.size(), 0);
    doubt_.assign(cells_.size(), 0);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const ZoneCell& cell = cells_[c];
      if (cell.kind == Kind::cut) continue;
      const double size = cell.size();
      if (cell.kind == Kind::outside) {
        result_.outside += size;
        continue;
      }
      doubt_[c] = size;
      if (cell.beyond) {
        const double share = share_of((*cell.parts)[1]) * size;
        result_.outside += share;
        doubt_[c] = std::max(0.0, size - share);
      }
      for (std::size_t side = 0; side < 2; ++side) {
        const int z = zone(c, side);
        if (z < 0) continue;
        const HalfSpace& half = *part(c, side);
        const double share = share_of(half) * size;
        doubt_[c] = cell.kind == Kind::free ? 0 : std::max(0.0, doubt_[c] - share);
        add_part(result_.zones[static_cast<std::size_t>(z)], half, cell, share, largest[static_cast<std::size_t>(z)]);
      }
      result_.in_doubt += doubt_[c];
    }
  }

  void add_part(CellZone& zone, const HalfSpace& half, const ZoneCell& cell, double share, double& largest) {
    zone.at_least += share;
    const PoseBox around = box_around(half, cell.box);
    if (zone.lower.empty())
      for (const auto& [low, high] : around) {
        zone.lower.push_back(low);
        zone.upper.push_back(high);
      }
    for (std::size_t p = 0; p < around.size(); ++p) {
      zone.lower[p] = std::min(zone.lower[p], around[p][0]);
      zone.upper[p] = std::max(zone.upper[p], around[p][1]);
      for (std::size_t side = 0; side < 2; ++side) {
        if (around[p][side] != tree_.box()[p][side]) continue;
        zone.at_side = true;
        if (around.size() < 2) continue;
        PoseBox face = cell.box;
        face[p] = {around[p][side], around[p][side]};
        add_face(zone, clipped(corners_of(face), half, cell.box, 0, true), p, side == 1);
      }
    }
    if (cell.kind == Kind::in_doubt) {
      zone.bounds.insert(cell.open.begin(), cell.open.end());
      if (around.size() == 1) zone.at_ends[half.way[0] > 0 ? 0 : 1].insert(cell.open.begin(), cell.open.end());
      if (around.size() > 1)
        if (Polygon cut = cut_of(half, cell.box); !cut.empty()) zone.faces.push_back(std::move(cut));
    }
    if (share > largest) {
      largest = share;
      zone.sample = inner_pose(half, cell.box);
    }
  }

  /// A polygon across an axis, over two coordinates a segment; `up`: the zone is below.
  void add_face(CellZone& zone, Polygon polygon, std::size_t axis, bool up) const {
    const bool flat = tree_.box().size() == 2;
    if (polygon.size() < 2) return;
    if (flat) {
      polygon.resize(2);
      if (polygon[0] != polygon[1]) zone.faces.push_back(std::move(polygon));
      return;
    }
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    double area = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      area += (a[u] - polygon[0][u]) * (b[v] - polygon[0][v]) - (a[v] - polygon[0][v]) * (b[u] - polygon[0][u]);
    }
    if (area == 0) return;
    if ((area > 0) != up) std::reverse(polygon.begin(), polygon.end());
    zone.faces.push_back(std::move(polygon));
  }

  /// What of a face of a zone's part the neighbour does not go on with; and what bounds the zone there.
  void add_faces() {
    tree_.faces([&](std::size_t a, std::size_t b, std::size_t axis) {
      const std::array<std::size_t, 2> both = {a, b};
      for (std::size_t first = 0; first < 2; ++first)
        for (std::size_t i = 0; i < 2; ++i) {
          const std::size_t cell = both[first], other = both[1 - first];
          const int z = zone(cell, i);
          if (z < 0) continue;
          CellZone& zone_here = result_.zones[static_cast<std::size_t>(z)];
          if (cells_[other].kind == Kind::in_doubt && cells_[cell].kind == Kind::free)
            zone_here.bounds.insert(cells_[other].open.begin(), cells_[other].open.end());
          if (cells_[a].box.size() == 1 && cells_[other].kind == Kind::in_doubt && zone(other, 0) != z &&
              zone(other, 1) != z)
            zone_here.at_ends[first == 0 ? 1 : 0].insert(cells_[other].open.begin(), cells_[other].open.end());
          if (cells_[a].box.size() < 2) continue;
          if (cells_[cell].kind == Kind::free && cells_[other].kind == Kind::free && zone(other, 0) == z) continue;
          const PoseBox common = common_face(a, b, axis);
          Polygon left = clipped(corners_of(common), *part(cell, i), cells_[cell].box, 0, true);
          for (std::size_t j = 0; j < 2 && !left.empty(); ++j)
            if (zone(other, j) == z) left = clipped(left, *part(other, j), cells_[other].box, 0, false);
          add_face(zone_here, std::move(left), axis, first == 0);
        }
    });
  }

  static bool may_have(const PoseCell::Signs& signs, const PoseCell::Signs& of_zone) {
    for (std::size_t d = 0; d < signs.size() && d < of_zone.size(); ++d)
      if (signs[d] != 0 && of_zone[d] != 0 && signs[d] != of_zone[d]) return false;
    return true;
  }

  /// For every combination of signs that zones have: what is in doubt and may have it, as it hangs together.
  void tell_doubt() {
    const auto none = static_cast<std::size_t>(-1);
    std::vector<std::pair<std::size_t, std::size_t>> doubts;        // neighbours, both with something in doubt
    std::vector<std::pair<std::size_t, std::size_t>> zones_beside;  // cell with something in doubt, zone
    const auto beside = [&](std::size_t cell, std::size_t of) {
      for (std::size_t i = 0; i < 2; ++i)
        if (const int z = zone(of, i); z >= 0) zones_beside.emplace_back(cell, static_cast<std::size_t>(z));
    };
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (doubt_[c] > 0) beside(c, c);
    tree_.faces([&](std::size_t a, std::size_t b, std::size_t) {
      if (doubt_[a] > 0 && doubt_[b] > 0) doubts.emplace_back(a, b);
      if (doubt_[a] > 0 && cells_[b].kind == Kind::free) beside(a, b);
      if (doubt_[b] > 0 && cells_[a].kind == Kind::free) beside(b, a);
    });
    std::map<PoseCell::Signs, std::vector<std::size_t>> by_signs;
    for (std::size_t z = 0; z < result_.zones.size(); ++z)
      by_signs[tree_.signs_at(result_.zones[z].sample)].push_back(z);
    for (const auto& [signs, zones] : by_signs) {
      std::vector<bool> may(cells_.size(), false);
      for (std::size_t c = 0; c < cells_.size(); ++c) may[c] = doubt_[c] > 0 && may_have(cells_[c].signs, signs);
      core::Parts<std::size_t> groups(cells_.size());
      for (const auto& [a, b] : doubts)
        if (may[a] && may[b]) groups.join(b, a);
      std::map<std::size_t, double> sizes;
      for (std::size_t c = 0; c < cells_.size(); ++c)
        if (may[c]) sizes[groups.of(c)] += doubt_[c];
      std::map<std::size_t, std::set<std::size_t>> touching;  // zones of these signs, by group
      std::vector<std::size_t> place(result_.zones.size(), none);
      for (const std::size_t z : zones) place[z] = z;
      for (const auto& [cell, z] : zones_beside)
        if (may[cell] && place[z] != none) touching[groups.of(cell)].insert(z);
      for (const std::size_t z : zones) result_.zones[z].at_most = result_.zones[z].at_least;
      for (const auto& [group, zones_beside_group] : touching)
        for (const std::size_t z : zones_beside_group) {
          result_.zones[z].at_most += sizes[group];
          for (const std::size_t other : zones_beside_group)
            if (other != z) result_.zones[z].perhaps.insert(other);
        }
    }
  }

  void rasterise() {
    const std::vector<int>& n = effort_.raster;
    if (n.size() != tree_.box().size()) return;
    std::vector<int> at(n.size(), 0);
    const auto next = [&] {
      for (std::size_t c = 0; c < n.size(); ++c) {
        if (++at[c] < n[c]) return true;
        at[c] = 0;
      }
      return false;
    };
    do {
      Pose pose;
      std::array<double, 3> place{};
      for (std::size_t c = 0; c < n.size(); ++c) {
        const auto& [low, high] = tree_.box()[c];
        place[c] = low + (at[c] + 0.5) / n[c] * (high - low);
        pose.push_back(place[c]);
      }
      const std::size_t leaf = tree_.leaf_at(pose);
      const bool beyond = cells_[leaf].beyond && height((*cells_[leaf].parts)[1], cells_[leaf].box, place) > 0;
      int label = beyond || cells_[leaf].kind == Kind::outside ? -1 : 0;
      for (std::size_t side = 0; side < 2; ++side)
        if (const int z = zone(leaf, side); z >= 0 && height(*part(leaf, side), cells_[leaf].box, place) > 0)
          label = z + 1;
      result_.raster.push_back(label);
    } while (next());
  }

  const CellZoneEffort& effort_;
  ZoneCells& tree_;
  const std::vector<ZoneCell>& cells_;
  core::Parts<std::size_t> groups_;
  std::vector<int> zone_;  ///< of parts, by their numbers
  std::vector<double> doubt_;
  CellZones result_;
};

}  // namespace

CellZones cell_zones(const core::PoseStatics& statics, const Pose& lower, const Pose& upper,
                     const CellZoneEffort& effort) {
  ZoneCells tree(statics, lower, upper, effort);
  tree.subdivide();
  return Zones(tree, effort).collect();
}

}  // namespace clearloci::loci::pose
