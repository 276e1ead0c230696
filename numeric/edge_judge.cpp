#include "numeric/edge_judge.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::numeric {

namespace {

bool agrees(Parity change, int crossings) {
  return change != Parity::unknown && (change == Parity::odd) == (crossings % 2 != 0);
}

constexpr int coarse_samples = 16;  ///< of an edge, to find where it leaves the workspace
constexpr int dense_samples = 64;   ///< of an edge about to be disputed, to rule out a gap in the workspace

}  // namespace

EdgeJudge::EdgeJudge(LineWitness witness, const GridAxis& along, std::span<const Passage> passages,
                     std::span<const int> boundary, double reach)
    : witness_(std::move(witness)), along_(along), passages_(passages), boundary_(boundary), reach_(reach) {}

void EdgeJudge::turn_to(int edge) {
  if (edge == edge_) return;
  edge_ = edge;
  low_ = along_.at(edge);
  high_ = along_.at(edge + 1);
  stretches_ = {};
  near_.clear();
  for (const Passage& p : passages_) {
    if (p.low > high_ + along_.step) break;  // they are in ascending order of `low`
    if (p.high >= low_ - along_.step) near_.push_back(p);
  }
  meets_boundary_ = boundary_between(low_, high_);
}

int EdgeJudge::crossings_between(const LineReaction& reaction, double a, double b) const {
  int sum = 0;
  for (const Passage& p : near_) {
    if (p.crosses && a <= p.at && p.at < b) sum += reaction.weights[static_cast<std::size_t>(p.curve)];
  }
  return sum;
}

/// Crossings at which the reaction vanishes without changing its sign.
int EdgeJudge::touches_between(const LineReaction& reaction, double a, double b) {
  int sum = 0;
  for (const Passage& p : near_) {
    const int weight = reaction.weights[static_cast<std::size_t>(p.curve)];
    if (!p.crosses || p.at < a || b <= p.at || weight % 2 == 0) continue;
    if (witness_.touches_zero(reaction.columns, p.at, std::max(reach_, (p.high - p.low) / 2))) sum += weight;
  }
  return sum;
}

bool EdgeJudge::boundary_between(double a, double b) const {
  return std::any_of(near_.begin(), near_.end(), [&](const Passage& p) {
    return boundary_[static_cast<std::size_t>(p.curve)] != 0 && p.low <= b && p.high >= a;
  });
}

/// The nearest position in the given direction (+1, -1) that no passage of the reaction covers.
double EdgeJudge::leave_passages(const LineReaction& reaction, double from, int direction) const {
  for (bool moved = true; moved;) {
    moved = false;
    for (const Passage& p : near_) {
      if (reaction.weights[static_cast<std::size_t>(p.curve)] == 0 || from < p.low || from > p.high) continue;
      from = direction > 0 ? p.high + reach_ : p.low - reach_;
      moved = true;
    }
  }
  return from;
}

/// A position near `from`, no further than `within`, where no passage is and the numerator's sign is proven.
std::optional<double> EdgeJudge::clear_position(const LineReaction& reaction, double from,
                                                std::span<const int> directions, double within) {
  for (const int times : {0, 1, 3, 7, 15, 31, 63}) {
    const double shift = times * reach_;
    for (const int direction : directions) {
      const double position = leave_passages(reaction, from + direction * shift, direction);
      if (std::abs(position - from) <= within && witness_.decided(reaction.columns, position)) return position;
    }
  }
  return std::nullopt;
}

/// Sign changes against crossings between two clear positions a < b.
Finding EdgeJudge::compare(const LineReaction& reaction, double a, double b) {
  const Parity change = witness_.sign_changes(reaction.columns, a, b);
  const int crossings = crossings_between(reaction, a, b);
  const auto finding = [&](Outcome outcome) { return Finding{outcome, crossings, change == Parity::odd}; };
  if (agrees(change, crossings)) return finding(Outcome::held);
  if (change != Parity::unknown && witness_.cancels(reaction.columns, a, b)) return finding(Outcome::held);
  if (const int touches = touches_between(reaction, a, b); touches > 0 && agrees(change, crossings - touches))
    return finding(Outcome::held);
  const bool sure =
      change != Parity::unknown && !boundary_between(a, b) && witness_.reachable_between(a, b, dense_samples);
  return finding(sure ? Outcome::disputed : Outcome::undecided);
}

Finding EdgeJudge::refine(const LineReaction& reaction) {
  constexpr std::array leftward = {-1, 1}, rightward = {1, -1};  // out of the edge first, so that all of it is judged
  const auto a = clear_position(reaction, low_, leftward, along_.step / 2);
  const auto b = clear_position(reaction, high_, rightward, along_.step / 2);
  return a && b && *a < *b ? compare(reaction, *a, *b) : Finding{};
}

/// No node is reachable: arcs have no business here, unless a sliver of the workspace crosses the edge.
Finding EdgeJudge::judge_outside(const LineReaction& reaction) {
  const int crossings = crossings_between(reaction, low_, high_);
  bool arcs = false;
  for (const Passage& p : near_) {
    if (!p.crosses || p.at < low_ || p.at >= high_ || reaction.weights[static_cast<std::size_t>(p.curve)] == 0)
      continue;
    arcs = true;
    const double doubt = 2 * reach_;
    if (boundary_between(p.at - doubt, p.at + doubt) || witness_.reachable_around(p.at, doubt)) {
      return {Outcome::undecided, crossings, false};
    }
  }
  if (arcs) return {Outcome::disputed, crossings, false};
  return {meets_boundary_ ? Outcome::undecided : Outcome::outside, 0, false};
}

std::optional<EdgeJudge::Stretch> EdgeJudge::stretch_from(double node, double other) {
  double end = node;
  for (int k = 1; k <= coarse_samples; ++k) {
    const double position = node + (other - node) * k / coarse_samples;
    if (!witness_.reachable(position) || boundary_between(std::min(node, position), std::max(node, position))) break;
    end = position;
  }
  if (end == node) return std::nullopt;
  return Stretch{node, end};
}

/// The boundary meets the edge: what is inside the workspace can still be disputed, but the whole cannot be held.
Finding EdgeJudge::judge_boundary(const LineReaction& reaction, const EdgeNodes& nodes) {
  for (const bool from_low : {true, false}) {
    if (!(from_low ? nodes.first_reachable : nodes.second_reachable)) continue;
    auto& stretch = stretches_[from_low ? 0 : 1];
    if (!stretch) stretch = from_low ? stretch_from(low_, high_) : stretch_from(high_, low_);
    if (!*stretch) continue;
    const int inward = from_low ? 1 : -1;
    const double length = std::abs((*stretch)->to - (*stretch)->from);
    const auto a = clear_position(reaction, (*stretch)->from, std::array{inward}, length);
    const auto b = clear_position(reaction, (*stretch)->to, std::array{-inward}, length);
    if (!a || !b || (*b - *a) * inward <= 0) continue;
    const Finding part = compare(reaction, std::min(*a, *b), std::max(*a, *b));
    if (part.outcome == Outcome::disputed) return part;
  }
  return {};
}

Finding EdgeJudge::judge(int edge, const LineReaction& reaction, const EdgeNodes& nodes) {
  turn_to(edge);
  if (!nodes.first_reachable && !nodes.second_reachable) return judge_outside(reaction);
  if (!nodes.first_reachable || !nodes.second_reachable || meets_boundary_) return judge_boundary(reaction, nodes);
  const int crossings = crossings_between(reaction, low_, high_);
  if (agrees(nodes.change, crossings)) return {Outcome::held, crossings, nodes.change == Parity::odd};
  return refine(reaction);
}

}  // namespace clearloci::numeric
