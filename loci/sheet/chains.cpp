#include "loci/sheet/chains.hpp"

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
    if ((kind != Crossing::Kind::seam && kind != Crossing::Kind::star) || meeting_[crossing].size() != 2) return false;
    return own_label(meeting_[crossing][0]) == core::ArcEnd::none &&
           own_label(meeting_[crossing][1]) == core::ArcEnd::none;
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
    if (!chain.closed) chain.ends = {label(first), label({stretch, 1 - from})};
    return chain;
  }

  const CurveGraph& graph_;
  std::map<int, int> at_star_;
  std::vector<std::vector<Incidence>> meeting_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<Chain> chains(const CurveGraph& graph) { return Stringer(graph).run(); }

}  // namespace clearloci::loci::sheet
