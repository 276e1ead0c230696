#include "loci/curves/arcs.hpp"

#include <algorithm>
#include <map>

namespace clearloci::loci {
namespace {

using core::ArcEnd;
using Step = EdgeWalk::Step;

class Joiner {
 public:
  Joiner(const CurveArrangement& arrangement, const std::vector<int>& edges) : arrangement_(arrangement) {
    for (const int e : edges) {
      used_[e] = false;
      at_[edge(e).from].push_back({e, false});
      at_[edge(e).to].push_back({e, true});
    }
  }

  const std::map<int, std::vector<Step>>& incident() const { return at_; }
  bool used(int e) const { return used_.at(e); }
  int head(const Step& step) const { return step.reversed ? edge(step.edge).from : edge(step.edge).to; }
  int tail(const Step& step) const { return step.reversed ? edge(step.edge).to : edge(step.edge).from; }

  /// Follows unused edges from `first` until `stops(vertex)` or nothing is left.
  template <typename Stop>
  std::vector<Step> follow(Step first, const Stop& stops) {
    std::vector<Step> steps{first};
    used_[first.edge] = true;
    for (int v = head(first); !stops(v); v = head(steps.back())) {
      const auto& options = at_.at(v);
      const auto next = std::find_if(options.begin(), options.end(), [&](const Step& s) { return !used_.at(s.edge); });
      if (next == options.end()) break;
      used_[next->edge] = true;
      steps.push_back(*next);
    }
    return steps;
  }

 private:
  const ArrangementEdge& edge(int e) const { return arrangement_.edges()[static_cast<std::size_t>(e)]; }

  const CurveArrangement& arrangement_;
  std::map<int, bool> used_;
  std::map<int, std::vector<Step>> at_;  ///< steps that leave a vertex
};

bool before(const core::Point2& a, const core::Point2& b) { return a < b; }

}  // namespace

std::vector<EdgeWalk> join_edges(const CurveArrangement& arrangement, const std::vector<int>& edges,
                                 const VertexMarks& marks, bool ends_on_singularities) {
  Joiner joiner(arrangement, edges);
  const auto marked = [](const std::vector<bool>& list, int v) { return list[static_cast<std::size_t>(v)]; };
  const auto is_end = [&](int v) {
    return joiner.incident().at(v).size() != 2 || (ends_on_singularities && marked(marks.direct_singularity, v));
  };
  const auto end_kind = [&](int v) {
    if (ends_on_singularities && marked(marks.direct_singularity, v)) return ArcEnd::direct_singularity;
    if (joiner.incident().at(v).size() > 2) return ArcEnd::crossing;
    if (marked(marks.boundary, v)) return ArcEnd::boundary;
    if (marked(marks.box, v)) return ArcEnd::box;
    return ArcEnd::crossing;
  };
  // Vertices in the order of their positions, so that the result does not depend on how the arrangement was built.
  std::vector<int> order;
  for (const auto& [v, steps] : joiner.incident()) order.push_back(v);
  const auto at = [&](int v) { return arrangement.at(v); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return before(at(a), at(b)); });

  std::vector<EdgeWalk> walks;
  for (const int v : order) {
    if (!is_end(v)) continue;
    for (const Step& step : joiner.incident().at(v)) {
      if (joiner.used(step.edge)) continue;
      EdgeWalk walk;
      walk.steps = joiner.follow(step, is_end);
      walk.ends = {end_kind(v), end_kind(joiner.head(walk.steps.back()))};
      walks.push_back(std::move(walk));
    }
  }
  for (const int v : order) {
    for (const Step& step : joiner.incident().at(v)) {
      if (joiner.used(step.edge)) continue;
      EdgeWalk walk;
      walk.steps = joiner.follow(step, [](int) { return false; });
      walk.closed = true;
      walks.push_back(std::move(walk));
    }
  }
  return walks;
}

std::vector<int> vertices_of(const CurveArrangement& arrangement, const EdgeWalk& walk) {
  std::vector<int> list;
  for (const Step& step : walk.steps) {
    const ArrangementEdge& e = arrangement.edges()[static_cast<std::size_t>(step.edge)];
    if (list.empty()) list.push_back(step.reversed ? e.to : e.from);
    list.push_back(step.reversed ? e.from : e.to);
  }
  return list;
}

std::vector<EdgeWalk> join_rings(const CurveArrangement& arrangement, const std::vector<int>& edges) {
  Joiner joiner(arrangement, edges);
  std::vector<EdgeWalk> rings;
  for (const auto& [v, steps] : joiner.incident()) {
    for (const Step& step : steps) {
      if (joiner.used(step.edge)) continue;
      const int start = v;
      EdgeWalk ring;
      ring.steps = joiner.follow(step, [start](int w) { return w == start; });
      ring.closed = joiner.head(ring.steps.back()) == start;
      if (ring.closed) rings.push_back(std::move(ring));
    }
  }
  return rings;
}

}  // namespace clearloci::loci
