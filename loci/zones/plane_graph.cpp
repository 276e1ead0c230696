#include "loci/zones/plane_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "core/parts.hpp"

namespace clearloci::loci {
namespace {

std::size_t index_of(HalfEdge half) { return 2 * static_cast<std::size_t>(half.edge) + (half.reversed ? 1 : 0); }

HalfEdge twin(HalfEdge half) { return {half.edge, !half.reversed}; }

/// The next half-edge of the face on the left: at the head, the one clockwise from the way back.
HalfEdge next(const PlaneGraph& graph, HalfEdge half) {
  const auto& around = graph.around[static_cast<std::size_t>(head(graph, half))];
  const auto back = std::find(around.begin(), around.end(), twin(half));
  core::ensure(back != around.end(), "a node knows its edges");
  return back == around.begin() ? around.back() : *(back - 1);
}

/// Nodes that hang together.
std::vector<int> components(const PlaneGraph& graph) {
  core::Parts parts(graph.nodes.size());
  for (const GraphEdge& edge : graph.edges) parts.join(edge.to, edge.from);
  std::vector<int> result(graph.nodes.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = parts.of(static_cast<int>(i));
  return result;
}

double distance(const core::Point2& from, const core::Point2& a, const core::Point2& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((from[0] - a[0]) * dx + (from[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(a[0] + t * dx - from[0], a[1] + t * dy - from[1]);
}

/// A point of the walk that is far from a ring.
core::Point2 clearest_point(const core::Polyline& candidates, const core::Polyline& ring) {
  core::Point2 best = candidates.front();
  double most = -1;
  const std::size_t step = std::max<std::size_t>(1, candidates.size() / 16);
  for (std::size_t i = 0; i < candidates.size(); i += step) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < ring.size(); ++k)
      least = std::min(least, distance(candidates[i], ring[k - 1], ring[k]));
    if (least > most) {
      most = least;
      best = candidates[i];
    }
  }
  return best;
}

/// Every closed walk with a face on its left, of all components.
std::vector<std::vector<HalfEdge>> walks_of(const PlaneGraph& graph) {
  std::vector<bool> used(2 * graph.edges.size(), false);
  std::vector<std::vector<HalfEdge>> walks;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    for (const bool reversed : {false, true}) {
      const HalfEdge first{static_cast<int>(e), reversed};
      if (used[index_of(first)]) continue;
      std::vector<HalfEdge> walk;
      HalfEdge half = first;
      do {
        used[index_of(half)] = true;
        walk.push_back(half);
        half = next(graph, half);
      } while (!(half == first));
      walks.push_back(std::move(walk));
    }
  }
  return walks;
}

}  // namespace

PlaneGraph without_edges(const PlaneGraph& graph, const std::vector<bool>& marked) {
  PlaneGraph less{graph.nodes, {}, std::vector<std::vector<HalfEdge>>(graph.around.size())};
  std::vector<int> place(graph.edges.size(), -1);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    if (marked[e]) continue;
    place[e] = static_cast<int>(less.edges.size());
    less.edges.push_back(graph.edges[e]);
  }
  for (std::size_t n = 0; n < graph.around.size(); ++n)
    for (const HalfEdge half : graph.around[n])
      if (const int new_edge = place[static_cast<std::size_t>(half.edge)]; new_edge >= 0)
        less.around[n].push_back({new_edge, half.reversed});
  return less;
}

bool is_planar(const PlaneGraph& graph) {
  const std::vector<int> component = components(graph);
  std::vector<int> characteristic(graph.nodes.size(), 0);
  std::vector<bool> met(graph.nodes.size(), false);
  const auto of = [&](int node) -> int& {
    return characteristic[static_cast<std::size_t>(component[static_cast<std::size_t>(node)])];
  };
  const auto meet = [&](int node) {
    if (!met[static_cast<std::size_t>(node)]) ++of(node);
    met[static_cast<std::size_t>(node)] = true;
  };
  for (const GraphEdge& edge : graph.edges) {
    meet(edge.from);
    meet(edge.to);
    --of(edge.from);
  }
  for (const std::vector<HalfEdge>& walk : walks_of(graph)) ++of(tail(graph, walk.front()));
  for (const GraphEdge& edge : graph.edges)
    if (of(edge.from) != 2) return false;
  return true;
}

namespace {

/// A piece of a horizontal line inside a face.
struct Span {
  double from = 0, to = 0;
  double width() const { return to - from; }
};

std::vector<Span> spans_at(const std::vector<core::Polyline>& rings, double y) {
  std::vector<double> crossings;
  for (const core::Polyline& ring : rings)
    for (std::size_t i = 1; i < ring.size(); ++i) {
      const core::Point2 &a = ring[i - 1], &b = ring[i];
      if ((a[1] > y) != (b[1] > y)) crossings.push_back(a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]));
    }
  std::sort(crossings.begin(), crossings.end());
  std::vector<Span> spans;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) spans.push_back({crossings[i], crossings[i + 1]});
  return spans;
}

Span heights_of(const std::vector<core::Polyline>& rings) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const core::Polyline& ring : rings)
    for (const core::Point2& p : ring) low = std::min(low, p[1]), high = std::max(high, p[1]);
  return {low, high};
}

// Designs are symmetric, and what is special lies amid their faces and at round shares of them.
constexpr double off_middle = 0.0391;

}  // namespace

core::Polyline points_in_face(const std::vector<core::Polyline>& rings) {
  const Span heights = heights_of(rings);
  // Chords there and back along one line cross a horizontal one so far apart at most.
  double rounding = 0;
  for (const core::Polyline& ring : rings)
    for (const core::Point2& p : ring)
      rounding =
          std::max(rounding, 16 * std::numeric_limits<double>::epsilon() * std::max(std::abs(p[0]), std::abs(p[1])));
  constexpr std::array<double, 7> shares = {0.4713, 0.3271, 0.6397, 0.1709, 0.8233, 0.0617, 0.9361};
  std::vector<std::pair<double, core::Point2>> found;  // room, point
  for (const double share : shares) {
    const double y = heights.from + share * heights.width();
    Span widest;
    for (const Span& span : spans_at(rings, y))
      if (span.width() > widest.width()) widest = span;
    if (widest.width() > rounding)
      found.push_back({std::min(widest.width(), std::min(share, 1 - share) * heights.width()),
                       {widest.from + (0.5 + off_middle) * widest.width(), y}});
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  core::Polyline points;
  for (const auto& [room, point] : found) points.push_back(point);
  return points;
}

core::Polyline points_all_over_face(const std::vector<core::Polyline>& rings, double narrowest) {
  constexpr int lines = 32;
  const Span heights = heights_of(rings);
  core::Polyline points;
  for (int i = 0; i < lines; ++i) {
    const double y = heights.from + (i + 0.5 - off_middle) / lines * heights.width();
    for (const Span& span : spans_at(rings, y))
      if (span.width() > narrowest) points.push_back({span.from + (0.5 + off_middle) * span.width(), y});
  }
  return points;
}

core::Polyline clear_of(const std::vector<core::Polyline>& rings, core::Polyline points, double room) {
  std::erase_if(points, [&](const core::Point2& at) {
    return std::any_of(rings.begin(), rings.end(), [&](const core::Polyline& ring) {
      for (std::size_t i = 1; i < ring.size(); ++i)
        if (distance(at, ring[i - 1], ring[i]) <= room) return true;
      return false;
    });
  });
  return points;
}

int head(const PlaneGraph& graph, HalfEdge half) {
  const GraphEdge& edge = graph.edges[static_cast<std::size_t>(half.edge)];
  return half.reversed ? edge.from : edge.to;
}

int tail(const PlaneGraph& graph, HalfEdge half) { return head(graph, twin(half)); }

double signed_area(const core::Polyline& ring) {
  double twice = 0;
  // Relative to a point of the ring: small rings far from the origin lose no digits.
  const core::Point2 o = ring.front();
  for (std::size_t i = 1; i < ring.size(); ++i) {
    twice += (ring[i - 1][0] - o[0]) * (ring[i][1] - o[1]) - (ring[i][0] - o[0]) * (ring[i - 1][1] - o[1]);
  }
  return twice / 2;
}

bool inside_ring(const core::Polyline& ring, const core::Point2& at) {
  bool inside = false;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const core::Point2 &a = ring[i - 1], &b = ring[i];
    if ((a[1] > at[1]) == (b[1] > at[1])) continue;
    if (at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1])) inside = !inside;
  }
  return inside;
}

core::Polyline ring_of(const PlaneGraph& graph, const std::vector<HalfEdge>& walk) {
  core::Polyline ring;
  for (const HalfEdge half : walk) {
    core::Polyline piece = graph.edges[static_cast<std::size_t>(half.edge)].points;
    if (half.reversed) std::reverse(piece.begin(), piece.end());
    ring.insert(ring.end(), piece.begin() + (ring.empty() ? 0 : 1), piece.end());
  }
  return ring;
}

std::vector<GraphFace> faces_of(const PlaneGraph& graph) {
  struct Walk {
    std::vector<HalfEdge> halves;
    core::Polyline ring;
    double area = 0;
    int component = 0;
  };
  const std::vector<int> component = components(graph);
  std::vector<Walk> outer, inner;
  for (std::vector<HalfEdge>& halves : walks_of(graph)) {
    Walk walk;
    walk.ring = ring_of(graph, halves);
    walk.area = signed_area(walk.ring);
    walk.component = component[static_cast<std::size_t>(tail(graph, halves.front()))];
    walk.halves = std::move(halves);
    outer.push_back(std::move(walk));
  }
  // Every component has one walk around its outside: the one of least signed area.
  for (const Walk& walk : outer) {
    const auto found =
        std::find_if(inner.begin(), inner.end(), [&](const Walk& w) { return w.component == walk.component; });
    if (found == inner.end())
      inner.push_back(walk);
    else if (walk.area < found->area)
      *found = walk;
  }
  std::erase_if(outer, [&](const Walk& walk) {
    return std::any_of(inner.begin(), inner.end(), [&](const Walk& w) { return w.halves == walk.halves; });
  });

  std::vector<GraphFace> faces;
  for (const Walk& walk : outer) faces.push_back({walk.halves, {}});
  faces.emplace_back();
  for (const Walk& walk : inner) {
    std::size_t parent = faces.size() - 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < outer.size(); ++f) {
      if (outer[f].component == walk.component || outer[f].area >= least) continue;
      if (!inside_ring(outer[f].ring, clearest_point(walk.ring, outer[f].ring))) continue;
      parent = f;
      least = outer[f].area;
    }
    faces[parent].inner.push_back(walk.halves);
  }
  return faces;
}

}  // namespace clearloci::loci
