#include "loci/curves/chains.hpp"

#include <algorithm>
#include <map>

namespace clearloci::loci::sheet {

namespace {

struct Incidence {
  int stretch, end;
};

class Stringer {
 public:
  explicit Stringer(const CurveGraph& graph) : graph_(graph), meeting_(graph.crossings.size()) {
    for (std::size_t s = 0; s < graph.stretches.size(); ++s)
      for (const int end : {0, 1}) meeting_[junction(static_cast<int>(s), end)].push_back({static_cast<int>(s), end});
    used_.assign(graph.stretches.size(), false);
  }

  std::vector<Chain> run() {
    std::vector<Chain> result;
    for (const bool closed : {false, true})
      for (std::size_t s = 0; s < graph_.stretches.size(); ++s)
        for (const int end : {0, 1}) {
          const int stretch = static_cast<int>(s);
          if (used_[s] || (!closed && passes(junction(stretch, end)))) continue;
          result.push_back(follow(stretch, end));
        }
    return result;
  }

 private:
  /// The crossing at an end; all branches that reach one star meet in its first crossing.
  int junction(int stretch, int end) {
    const int crossing = graph_.stretches[stretch].ends[end].crossing;
    if (graph_.crossings[crossing].kind != Crossing::Kind::star) return crossing;
    return at_star_.try_emplace(graph_.crossings[crossing].star, crossing).first->second;
  }

  bool passes(int crossing) const {
    const Crossing::Kind kind = graph_.crossings[crossing].kind;
    return kind == Crossing::Kind::seam && meeting_[crossing].size() == 2;
  }

  /// Where the end may be joined to others; -1: it is an end whatever else is there.
  int open_junction(const Incidence& end) {
    const int at = junction(end.stretch, end.end);
    const Crossing::Kind kind = graph_.crossings[at].kind;
    const bool open = kind == Crossing::Kind::star || kind == Crossing::Kind::node || kind == Crossing::Kind::edge;
    return open && own_label(end) == core::ArcEnd::none ? at : -1;
  }

  core::ArcEnd own_label(const Incidence& end) const {
    return graph_.crossings[graph_.stretches[end.stretch].ends[end.end].crossing].label;
  }

  core::ArcEnd label(const Incidence& end) const {
    if (own_label(end) != core::ArcEnd::none) return own_label(end);
    switch (graph_.crossings[graph_.stretches[end.stretch].ends[end.end].crossing].kind) {
      case Crossing::Kind::box:
        return core::ArcEnd::box;
      case Crossing::Kind::rim:
        return core::ArcEnd::boundary;
      default:
        return core::ArcEnd::crossing;
    }
  }

  Chain follow(int stretch, int from) {
    Chain chain;
    const Incidence first = {stretch, from};
    const int start = junction(stretch, from);
    int at = start;
    while (true) {
      used_[stretch] = true;
      chain.legs.push_back({&graph_.stretches[stretch], from == 0});
      at = junction(stretch, 1 - from);
      if (!passes(at)) break;
      const std::vector<Incidence>& two = meeting_[at];
      const Incidence next = two[0].stretch == stretch && two[0].end == 1 - from ? two[1] : two[0];
      if (used_[next.stretch]) break;
      stretch = next.stretch;
      from = next.end;
    }
    chain.closed = at == start && passes(start);
    if (!chain.closed) {
      chain.ends = {label(first), label({stretch, 1 - from})};
      chain.junctions = {open_junction(first), open_junction({stretch, 1 - from})};
    }
    return chain;
  }

  const CurveGraph& graph_;
  std::map<int, int> at_star_;
  std::vector<std::vector<Incidence>> meeting_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<Chain> chains(const CurveGraph& graph) { return Stringer(graph).run(); }

namespace {

struct ChainEnd {
  int chain, end;
};

Chain reversed(Chain chain) {
  std::reverse(chain.legs.begin(), chain.legs.end());
  for (Leg& leg : chain.legs) leg.forward = !leg.forward;
  std::swap(chain.ends[0], chain.ends[1]);
  std::swap(chain.junctions[0], chain.junctions[1]);
  return chain;
}

}  // namespace

std::vector<Chain> join_at_junctions(const CurveGraph& graph, std::vector<Chain> parts) {
  std::map<std::pair<int, int>, std::vector<ChainEnd>> meeting;  // by junction and colour
  for (std::size_t c = 0; c < parts.size(); ++c)
    for (const int end : {0, 1})
      if (const int at = parts[c].junctions[end]; at >= 0)
        meeting[{at, parts[c].colour}].push_back({static_cast<int>(c), end});
  std::vector<std::array<ChainEnd, 2>> next(parts.size(), {ChainEnd{-1, 0}, ChainEnd{-1, 0}});
  for (const auto& [place, ends] : meeting) {
    if (ends.size() == 2) {
      next[ends[0].chain][ends[0].end] = ends[1];
      next[ends[1].chain][ends[1].end] = ends[0];
      continue;
    }
    const Crossing& junction = graph.crossings[place.first];
    core::ArcEnd label = core::ArcEnd::crossing;
    if (junction.kind == Crossing::Kind::edge) label = junction.alone;
    // Where the construction is undefined the sheet ends in a point.
    if (junction.kind == Crossing::Kind::star && ends.size() == 1) label = core::ArcEnd::boundary;
    for (const ChainEnd& end : ends) parts[end.chain].ends[end.end] = label;
  }
  std::vector<Chain> result;
  std::vector<bool> used(parts.size(), false);
  for (const bool closed : {false, true})
    for (std::size_t c = 0; c < parts.size(); ++c)
      for (const int start : {0, 1}) {
        if (used[c] || (!closed && next[c][start].chain >= 0)) continue;
        Chain whole;
        ChainEnd at = {static_cast<int>(c), start};
        while (at.chain >= 0 && !used[at.chain]) {
          used[at.chain] = true;
          const Chain piece = at.end == 0 ? parts[at.chain] : reversed(parts[at.chain]);
          if (whole.legs.empty())
            whole = piece;
          else
            whole.legs.insert(whole.legs.end(), piece.legs.begin(), piece.legs.end());
          whole.ends[1] = piece.ends[1];
          at = next[at.chain][1 - at.end];
        }
        whole.closed = whole.closed || at.chain >= 0;
        if (whole.closed) whole.ends = {core::ArcEnd::none, core::ArcEnd::none};
        result.push_back(std::move(whole));
      }
  return result;
}

}  // namespace clearloci::loci::sheet
