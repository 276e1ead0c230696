#include "loci/zones/near_passes.hpp"

#include <algorithm>
#include <utility>

#include "loci/search/search.hpp"

namespace clearloci::loci {
namespace {

using core::Interval;
using sheet::PlaneCell;

/// Pairs of pieces near each other. Two arcs that cross have a few.
constexpr std::size_t most_pairs = 512;

PlaneCell widened(const PlaneCell& cell, double reach) {
  return {{cell.x.lower() - reach, cell.x.upper() + reach}, {cell.y.lower() - reach, cell.y.upper() + reach}};
}

double size(const PlaneCell& cell) { return std::max(cell.x.width(), cell.y.width()); }

}  // namespace

BoxedPolyline::BoxedPolyline(const core::Polyline& points) {
  if (points.size() < 2) return;
  nodes_.reserve(2 * points.size());
  build(points, 0, points.size() - 1);
}

/// Of the pieces from one vertex to another.
int BoxedPolyline::build(const core::Polyline& points, std::size_t from, std::size_t to) {
  Node node;
  if (to == from + 1) {
    const auto range = [&](std::size_t c) {
      return Interval(std::min(points[from][c], points[to][c]), std::max(points[from][c], points[to][c]));
    };
    node.box = {range(0), range(1)};
    node.piece = from;
  } else {
    const std::size_t middle = from + (to - from) / 2;
    const int first = build(points, from, middle), second = build(points, middle, to);
    const PlaneCell &a = nodes_[static_cast<std::size_t>(first)].box, &b = nodes_[static_cast<std::size_t>(second)].box;
    node.box = {hull(a.x, b.x), hull(a.y, b.y)};
    node.halves = first;  // the second stands right before the whole
  }
  nodes_.push_back(node);
  return static_cast<int>(nodes_.size()) - 1;
}

std::vector<std::size_t> BoxedPolyline::pieces_near(const core::Point2& at, double reach) const {
  std::vector<std::size_t> pieces;
  if (nodes_.empty()) return pieces;
  const PlaneCell near = widened({at[0], at[1]}, reach);
  std::vector<int> pending = {static_cast<int>(nodes_.size()) - 1};
  while (!pending.empty()) {
    const int i = pending.back();
    pending.pop_back();
    const Node& node = nodes_[static_cast<std::size_t>(i)];
    if (disjoint(near.x, node.box.x) || disjoint(near.y, node.box.y)) continue;
    if (node.halves < 0) {
      pieces.push_back(node.piece);
    } else {
      pending.push_back(i - 1);
      pending.push_back(node.halves);
    }
  }
  return pieces;
}

std::optional<std::vector<PlaneCell>> near_passes(const BoxedPolyline& a, const BoxedPolyline& b, double reach) {
  std::vector<PlaneCell> places;
  if (a.nodes_.empty() || b.nodes_.empty()) return places;
  std::vector<std::pair<int, int>> pending = {
      {static_cast<int>(a.nodes_.size()) - 1, static_cast<int>(b.nodes_.size()) - 1}};
  while (!pending.empty()) {
    const auto [i, k] = pending.back();
    pending.pop_back();
    const BoxedPolyline::Node &node = a.nodes_[static_cast<std::size_t>(i)],
                              &other = b.nodes_[static_cast<std::size_t>(k)];
    const PlaneCell near = widened(node.box, reach);
    if (disjoint(near.x, other.box.x) || disjoint(near.y, other.box.y)) continue;
    if (node.halves < 0 && other.halves < 0) {
      if (places.size() == most_pairs) return std::nullopt;
      const PlaneCell there = widened(other.box, reach);
      places.push_back({meet(near.x, there.x), meet(near.y, there.y)});
    } else if (other.halves < 0 || (node.halves >= 0 && size(node.box) >= size(other.box))) {
      pending.emplace_back(node.halves, k);
      pending.emplace_back(i - 1, k);
    } else {
      pending.emplace_back(i, other.halves);
      pending.emplace_back(i, k - 1);
    }
  }
  return sheet::clusters(std::move(places));
}

}  // namespace clearloci::loci
