#include "loci/pose/pose_zones.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <queue>

#include "loci/work_queue.hpp"

namespace clearloci::loci::pose {
namespace {

/// Cells that are cut at once, and those of them that a thread takes at a time.
constexpr std::size_t at_once = 4096, at_a_time = 64;

struct Node {
  enum class Kind { in_doubt, free, outside, cut };
  Kind kind = Kind::in_doubt;
  PoseBox box;
  int axis = -1;
  std::array<std::size_t, 2> halves{};
  Doubt doubt = Doubt::none;
  int demand = -1;
  std::vector<int> signs;  ///< PoseCell::known_signs
};

class Zones {
 public:
  Zones(const core::PoseStatics& statics, const Pose& lower, const Pose& upper, const CellZoneEffort& effort)
      : effort_(effort), cells_([&statics] { return PoseCell(statics); }) {
    const std::size_t n = lower.size();
    chart_.base.assign(n, 0.0);
    Node whole;
    for (std::size_t c = 0; c < n; ++c) {
      Pose way(n, 0.0);
      way[c] = 1;
      chart_.ways.push_back(std::move(way));
      whole.box.push_back({lower[c], upper[c]});
    }
    box_ = whole.box;
    nodes_.push_back(std::move(whole));
  }

  CellZones find() {
    subdivide();
    join();
    return collect();
  }

 private:
  double size_of(std::size_t node) const {
    double size = 1;
    for (const auto& [low, high] : nodes_[node].box) size *= high - low;
    return size;
  }

  /// What a cell is, and along which coordinate it is cut best.
  struct Looked {
    Node::Kind kind = Node::Kind::in_doubt;
    int axis = -1;
    Doubt doubt = Doubt::none;
    int demand = -1;
    std::vector<int> signs = {};
  };
  Looked look(PoseCell& cell, const PoseBox& box) const {
    const PoseCell::State state = cell.enter(chart_, box);
    if (state == PoseCell::State::proven) return {Node::Kind::free};
    if (state == PoseCell::State::outside) return {Node::Kind::outside};
    Looked own{Node::Kind::in_doubt, -1, cell.doubt(), cell.demand(), cell.known_signs()};
    // Along what moves it most, but no cell gets thin: its size says where to cut next, and bounds the zones.
    constexpr double thin = 8;
    double total = 0, most = -1, widest = 0;
    for (const double spread : cell.spreads()) total += spread;
    const auto part = [&](std::size_t c) { return (box[c][1] - box[c][0]) / (box_[c][1] - box_[c][0]); };
    for (std::size_t c = 0; c < box.size(); ++c) widest = std::max(widest, part(c));
    for (std::size_t c = 0; c < box.size(); ++c) {
      if (part(c) <= effort_.finest || part(c) * thin < widest) continue;
      const double score = (total > 0 ? cell.spreads()[c] / total : 0) + 0.1 * part(c) / widest;
      if (score > most) {
        most = score;
        own.axis = static_cast<int>(c);
      }
    }
    return own;
  }

  /// Largest cells in doubt first, many at a time.
  void subdivide() {
    std::priority_queue<std::pair<double, std::size_t>> open;
    const auto enter = [&](const std::vector<std::size_t>& list) {
      std::vector<Looked> looked(list.size());
      run_in_order((list.size() + at_a_time - 1) / at_a_time, [&](std::size_t part) {
        PoseCell& cell = cells_.local();
        for (std::size_t i = part * at_a_time; i < std::min(list.size(), (part + 1) * at_a_time); ++i)
          looked[i] = look(cell, nodes_[list[i]].box);
      });
      looked_at_ += static_cast<long>(list.size());
      for (std::size_t i = 0; i < list.size(); ++i) {
        Node& node = nodes_[list[i]];
        node.kind = looked[i].kind;
        node.axis = looked[i].axis;
        node.doubt = looked[i].doubt;
        node.demand = looked[i].demand;
        node.signs = std::move(looked[i].signs);
        if (node.kind == Node::Kind::in_doubt && node.axis >= 0) open.emplace(size_of(list[i]), list[i]);
      }
    };
    enter({0});
    while (!open.empty() && looked_at_ < effort_.most_cells) {
      if (effort_.deadline && std::chrono::steady_clock::now() >= *effort_.deadline) {
        out_of_time_ = true;
        break;
      }
      std::vector<std::size_t> fresh;
      for (std::size_t k = 0; k < at_once && !open.empty(); ++k) {
        const std::size_t own = open.top().second;
        open.pop();
        const auto axis = static_cast<std::size_t>(nodes_[own].axis);
        for (std::size_t half = 0; half < 2; ++half) {
          Node child;
          child.box = nodes_[own].box;
          const double middle = 0.5 * (child.box[axis][0] + child.box[axis][1]);
          child.box[axis][half == 0 ? 1 : 0] = middle;
          nodes_[own].halves[half] = nodes_.size();
          fresh.push_back(nodes_.size());
          nodes_.push_back(std::move(child));
        }
        nodes_[own].kind = Node::Kind::cut;
      }
      enter(fresh);
    }
  }

  /// Calls `meet(a, b, axis)` for leaves that share a part of a face, `a` below `b` along the axis.
  template <class Meet>
  void faces(const Meet& meet) const {
    for (const Node& node : nodes_)
      if (node.kind == Node::Kind::cut) face(node.halves[0], node.halves[1], static_cast<std::size_t>(node.axis), meet);
  }
  template <class Meet>
  void face(std::size_t a, std::size_t b, std::size_t axis, const Meet& meet) const {
    const Node &one = nodes_[a], &two = nodes_[b];
    for (std::size_t c = 0; c < one.box.size(); ++c)
      if (c != axis && (one.box[c][1] <= two.box[c][0] || two.box[c][1] <= one.box[c][0])) return;
    const bool first = one.kind == Node::Kind::cut;
    if (!first && two.kind != Node::Kind::cut) return meet(a, b, axis);
    const Node& cut = first ? one : two;
    const bool along = static_cast<std::size_t>(cut.axis) == axis;
    for (std::size_t half = 0; half < 2; ++half) {
      // Of the lower cell only its upper half touches the face, and the other way round.
      if (along && half != (first ? 1U : 0U)) continue;
      if (first)
        face(cut.halves[half], b, axis, meet);
      else
        face(a, cut.halves[half], axis, meet);
    }
  }

  std::size_t root(std::size_t node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }

  void join_alike(const std::vector<bool>& taken, bool free) {
    faces([&](std::size_t a, std::size_t b, std::size_t) {
      const auto is = [&](std::size_t node) {
        return free ? nodes_[node].kind == Node::Kind::free : nodes_[node].kind != Node::Kind::outside && !taken[node];
      };
      if (is(a) && is(b)) parent_[root(a)] = root(b);
    });
  }

  void join() {
    parent_.resize(nodes_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    join_alike({}, true);
    std::map<std::size_t, double> sizes;
    double whole = size_of(0);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (nodes_[i].kind == Node::Kind::free) sizes[root(i)] += size_of(i);
    taken_.assign(nodes_.size(), false);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      taken_[i] = nodes_[i].kind == Node::Kind::free && sizes[root(i)] >= effort_.least_part * whole;
    // What is left of free cells is in doubt: it may belong to any zone that it touches.
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (!taken_[i]) parent_[i] = i;
    join_alike(taken_, false);
  }

  CellZones collect() {
    CellZones result;
    result.cells = looked_at_;
    result.out_of_time = out_of_time_;
    std::map<std::size_t, std::size_t> zone_of;  // by root
    std::vector<double> largest;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (nodes_[i].kind == Node::Kind::cut) continue;
      const double size = size_of(i);
      if (nodes_[i].kind == Node::Kind::outside) {
        result.outside += size;
      } else if (!taken_[i]) {
        result.in_doubt += size;
        doubtful_[root(i)].push_back(i);
      } else {
        const auto [place, fresh] = zone_of.try_emplace(root(i), result.zones.size());
        if (fresh) {
          result.zones.emplace_back();
          largest.push_back(0);
        }
        add_cell(result.zones[place->second], nodes_[i].box, size, largest[place->second]);
      }
    }
    std::vector<std::set<std::size_t>> touched(result.zones.size());  // roots of what is in doubt
    faces([&](std::size_t a, std::size_t b, std::size_t axis) {
      const std::size_t none = result.zones.size();
      const std::size_t own = taken_[a] ? zone_of.at(root(a)) : none, other = taken_[b] ? zone_of.at(root(b)) : none;
      if (own == other) return;
      if (own != none) add_face(result.zones[own], a, b, axis, true);
      if (other != none) add_face(result.zones[other], a, b, axis, false);
      for (const auto& [zone, beside] : {std::pair(own, b), std::pair(other, a)}) {
        if (zone == none || nodes_[beside].kind == Node::Kind::outside || taken_[beside]) continue;
        touched[zone].insert(root(beside));
        if (nodes_[beside].kind == Node::Kind::in_doubt)
          result.zones[zone].bounds.insert({nodes_[beside].doubt, nodes_[beside].demand});
      }
    });
    for (std::size_t z = 0; z < result.zones.size(); ++z) {
      CellZone& zone = result.zones[z];
      zone.at_most = zone.at_least;
      const std::vector<int> signs = signs_at(zone.sample);
      for (const std::size_t own : touched[z])
        for (const std::size_t cell : doubtful_.at(own))
          if (may_have(nodes_[cell].signs, signs)) zone.at_most += size_of(cell);
      for (std::size_t y = 0; y < result.zones.size(); ++y)
        if (y != z &&
            std::any_of(touched[z].begin(), touched[z].end(), [&](std::size_t r) { return touched[y].contains(r); }))
          zone.beside.insert(y);
    }
    order(result.zones);
    return result;
  }

  /// Of demands of one component at a pose, 0 of others.
  std::vector<int> signs_at(const Pose& pose) {
    std::vector<int> signs;
    const auto at = cells_.local().at(pose);
    if (!at) return signs;
    for (const auto& own : at->components) signs.push_back(own.front().size() != 1 ? 0 : own.front()[0] > 0 ? 1 : -1);
    return signs;
  }

  /// Whether a cell in doubt may hold poses with all signs of a zone: none that is known there differs.
  static bool may_have(const std::vector<int>& known, const std::vector<int>& of_zone) {
    for (std::size_t d = 0; d < known.size() && d < of_zone.size(); ++d)
      if (known[d] * of_zone[d] < 0) return false;
    return true;
  }

  void add_cell(CellZone& zone, const PoseBox& box, double size, double& largest) {
    zone.at_least += size;
    std::array<Pose, 2> corners;
    if (zone.lower.empty()) {
      for (const auto& [low, high] : box) {
        zone.lower.push_back(low);
        zone.upper.push_back(high);
      }
    }
    for (std::size_t c = 0; c < box.size(); ++c) {
      corners[0].push_back(box[c][0]);
      corners[1].push_back(box[c][1]);
      zone.lower[c] = std::min(zone.lower[c], box[c][0]);
      zone.upper[c] = std::max(zone.upper[c], box[c][1]);
      for (std::size_t side = 0; side < 2; ++side) {
        if (box[c][side] != box_[c][side]) continue;
        zone.at_side = true;
        if (box.size() == 3) add_rectangle(zone, box, c, box[c][side], side == 1);
      }
    }
    zone.cells.push_back(std::move(corners));
    if (size > largest) {
      largest = size;
      zone.sample = middle_of(box);
    }
  }

  /// The common part of the faces of two cells. `up`: the zone is below.
  void add_face(CellZone& zone, std::size_t a, std::size_t b, std::size_t axis, bool up) const {
    PoseBox common = nodes_[a].box;
    if (common.size() != 3) return;
    for (std::size_t c = 0; c < 3; ++c) {
      common[c][0] = std::max(common[c][0], nodes_[b].box[c][0]);
      common[c][1] = std::min(common[c][1], nodes_[b].box[c][1]);
    }
    add_rectangle(zone, common, axis, nodes_[a].box[axis][1], up);
  }

  static void add_rectangle(CellZone& zone, const PoseBox& box, std::size_t axis, double level, bool up) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    constexpr std::array<std::array<std::size_t, 2>, 4> round = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    auto& corners = zone.faces.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& [i, j] = round[up ? k : 3 - k];
      corners[k][axis] = level;
      corners[k][u] = box[u][i];
      corners[k][v] = box[v][j];
    }
  }

  static void order(std::vector<CellZone>& zones) {
    std::vector<std::size_t> by_size(zones.size());
    std::iota(by_size.begin(), by_size.end(), std::size_t{0});
    std::stable_sort(by_size.begin(), by_size.end(),
                     [&](std::size_t a, std::size_t b) { return zones[a].at_least > zones[b].at_least; });
    std::vector<std::size_t> place(zones.size());
    for (std::size_t i = 0; i < by_size.size(); ++i) place[by_size[i]] = i;
    std::vector<CellZone> sorted;
    for (const std::size_t own : by_size) {
      std::set<std::size_t> beside;
      for (const std::size_t other : zones[own].beside) beside.insert(place[other]);
      sorted.push_back(std::move(zones[own]));
      sorted.back().beside = std::move(beside);
    }
    zones = std::move(sorted);
  }

  CellZoneEffort effort_;
  tbb::enumerable_thread_specific<PoseCell> cells_;
  PoseChart chart_;
  PoseBox box_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> parent_;
  std::vector<bool> taken_;
  std::map<std::size_t, std::vector<std::size_t>> doubtful_;  ///< cells in doubt that hang together, by root
  long looked_at_ = 0;
  bool out_of_time_ = false;
};

}  // namespace

CellZones cell_zones(const core::PoseStatics& statics, const Pose& lower, const Pose& upper,
                     const CellZoneEffort& effort) {
  return Zones(statics, lower, upper, effort).find();
}

}  // namespace clearloci::loci::pose
