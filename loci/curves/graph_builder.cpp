#include "loci/curves/graph_builder.hpp"

#include <algorithm>
#include <map>

#include "core/parts.hpp"

namespace clearloci::loci::sheet {
namespace {

// Where one patch has spent its budget the curve is not proven whatever the others tell: they get this part of theirs.
constexpr int share_of_spent_budget = 8;

// Of the box: what is this near to a star counts as the star where there is no posture, as what is to a touch does.
constexpr double one_place = 1e-10;

}  // namespace

GraphBuilder::GraphBuilder(const core::RootTower& tower, const SheetFunction& curve, const core::WorkingMode& mode,
                           const Partition& parts, const TreeOptions& options, bool last_attempt)
    : tower_(tower), curve_(curve), mode_(mode), parts_(parts), options_(options), last_attempt_(last_attempt) {
  graph_.patches = make_patches(tower, curve, parts);
}

std::optional<CurveGraph> GraphBuilder::run() {
  for (Patch& patch : graph_.patches) {
    TreeOptions options = options_;
    if (graph_.stopped) options.most_cells /= share_of_spent_budget;
    if (patch.chart.side == Side::plane) options.holes = parts_.holes;
    patch.tree = std::make_shared<const CellTree>(*patch.program, mode_, patch.domain, std::move(options));
    // Other cuts do not help where the budget is what runs out.
    graph_.stopped = graph_.stopped || patch.tree->cut_short();
    const std::vector<Leaf>& leaves = patch.tree->leaves();
    // Nor where the curve is open in cells that are too small to be cut.
    const int index = static_cast<int>(at_leaf_.size());
    if (std::any_of(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
          return leaf.kind == LeafKind::undecided && !is_at_undefined(index, leaf.cell);
        }))
      leave_open_for_good();
    if (graph_.stopped && options_.whole_or_nothing) return leave_open(patch);
    at_leaf_.emplace_back(patch.tree->leaves().size());
    open_.emplace_back(patch.tree->leaves().size());
  }
  for (std::size_t p = 0; p < graph_.patches.size() && lucky(); ++p) meet_seams(static_cast<int>(p));
  for (std::size_t p = 0; p < graph_.patches.size() && lucky(); ++p) meet_border(static_cast<int>(p));
  for (std::size_t p = 0; p < graph_.patches.size() && lucky(); ++p) meet_rims(static_cast<int>(p));
  graph_.stopped = graph_.stopped || (options_.stop && options_.stop());
  for (std::size_t p = 0; p < graph_.patches.size() && lucky(); ++p) pair_in_leaves(static_cast<int>(p));
  for (std::size_t p = 0; p < graph_.patches.size() && lucky(); ++p) join_clusters(static_cast<int>(p));
  if (!lucky()) return std::nullopt;
  settle_places();
  graph_.open_at_corner = open_at_corner_ && !open_for_good_;
  return std::move(graph_);
}

CurveGraph GraphBuilder::leave_open(const Patch& patch) {
  for (const Leaf& leaf : patch.tree->leaves())
    if (leaf.kind == LeafKind::undecided) graph_.undecided.push_back(patch.chart.to_plane(leaf.cell));
  settle_places();
  return std::move(graph_);
}

void GraphBuilder::settle_places() {
  const auto& d = parts_.domain;
  graph_.undecided = open_places(graph_.undecided, std::max(d[1] - d[0], d[3] - d[2]));
}

bool GraphBuilder::has_curve(int patch, int index) const {
  const LeafKind kind = leaf(patch, index).kind;
  return kind == LeafKind::graph || kind == LeafKind::undecided;
}

bool GraphBuilder::is_at_undefined(int patch, const PlaneCell& place) const {
  const Chart& chart = graph_.patches[patch].chart;
  if (chart.side == Side::plane) return false;
  const Star& star = parts_.stars[static_cast<std::size_t>(chart.star)];
  const auto& d = parts_.domain;
  const PlaneCell cell = chart.to_plane(place);
  return star.is_undefined() && star.is_near(cell.x, cell.y, one_place * std::max(d[1] - d[0], d[3] - d[2]));
}

void GraphBuilder::give_up_on(int patch, int index) {
  unlucky_ = true;
  if (index >= 0) open_[patch][index] = true;
}

int GraphBuilder::add_crossing(int patch, const std::vector<Interval>& enclosure, Crossing::Kind kind) {
  Crossing crossing;
  crossing.kind = kind;
  crossing.at = graph_.patches[patch].chart.to_plane(enclosure[0].middle(), enclosure[1].middle());
  crossing.star = kind == Crossing::Kind::star ? graph_.patches[patch].chart.star : -1;
  graph_.crossings.push_back(crossing);
  return static_cast<int>(graph_.crossings.size()) - 1;
}

void GraphBuilder::pair_in_leaves(int patch) {
  for (std::size_t l = 0; l < at_leaf_[patch].size(); ++l) {
    const int index = static_cast<int>(l);
    const Leaf& leaf_data = leaf(patch, index);
    std::vector<LeafCrossing>& seen = at_leaf_[patch][index];
    if (leaf_data.kind != LeafKind::graph) continue;
    const int v = leaf_data.along;
    std::sort(seen.begin(), seen.end(), [&](const LeafCrossing& a, const LeafCrossing& b) {
      return a.enclosure[v].middle() < b.enclosure[v].middle();
    });
    bool clear = seen.size() % 2 == 0 && !open_[patch][index];
    for (std::size_t i = 0; i + 1 < seen.size(); ++i)
      clear = clear && (seen[i].enclosure[v].upper() < seen[i + 1].enclosure[v].lower() ||
                        (i % 2 != 0 && seen[i].crossing == seen[i + 1].crossing));
    if (!clear) {
      unlucky_ = true;
      graph_.undecided.push_back(graph_.patches[patch].chart.to_plane(leaf_data.cell));
    }
    for (std::size_t i = 0; i + 1 < seen.size(); i += 2)
      graph_.stretches.push_back(
          {patch, index, v, {{seen[i].crossing, seen[i].enclosure}, {seen[i + 1].crossing, seen[i + 1].enclosure}}});
  }
}

void GraphBuilder::join_clusters(int patch) {
  const std::vector<Leaf>& leaves = graph_.patches[patch].tree->leaves();
  core::Parts parts(leaves.size());
  for (const auto& [p, a, b] : touching_)
    if (p == patch) parts.join(std::min(parts.of(a), parts.of(b)), std::max(parts.of(a), parts.of(b)));
  const Chart& chart = graph_.patches[patch].chart;
  std::map<int, std::vector<int>> members;
  for (std::size_t l = 0; l < leaves.size(); ++l)
    if (leaves[l].kind == LeafKind::undecided) members[parts.of(static_cast<int>(l))].push_back(static_cast<int>(l));
  for (const auto& [root, cells] : members) {
    std::vector<LeafCrossing> branches;
    PlaneCell place = leaves[root].cell;
    for (const int l : cells) {
      branches.insert(branches.end(), at_leaf_[patch][l].begin(), at_leaf_[patch][l].end());
      place = {hull(place.x, leaves[l].cell.x), hull(place.y, leaves[l].cell.y)};
    }
    if (is_at_undefined(patch, place)) {
      if (branches.empty()) continue;
      std::vector<Interval> star = branches.front().enclosure;
      star[0] = 0.0;
      star[1] = place.y.middle();
      const int crossing = add_crossing(patch, star, Crossing::Kind::star);
      for (const LeafCrossing& branch : branches)
        graph_.stretches.push_back({patch, -1, 0, {{branch.crossing, branch.enclosure}, {crossing, star}}});
      continue;
    }
    for (const int l : cells) graph_.undecided.push_back(chart.to_plane(leaves[l].cell));
    graph_.clusters.push_back({patch, place, -1, branches.empty()});
    const PlaneCell& domain = graph_.patches[patch].domain;
    if (std::max(place.x.width(), place.y.width()) > widest_place * std::max(domain.x.width(), domain.y.width()))
      continue;
    if (branches.size() == 2) {
      graph_.stretches.push_back(
          {patch,
           -1,
           0,
           {{branches[0].crossing, branches[0].enclosure}, {branches[1].crossing, branches[1].enclosure}}});
    } else if (!branches.empty()) {
      std::vector<Interval> node = branches.front().enclosure;
      node[0] = place.x.middle();
      node[1] = place.y.middle();
      const int crossing = add_crossing(patch, node, Crossing::Kind::node);
      graph_.clusters.back().node = crossing;
      for (const LeafCrossing& branch : branches)
        graph_.stretches.push_back({patch, -1, 0, {{branch.crossing, branch.enclosure}, {crossing, node}}});
    }
  }
}

}  // namespace clearloci::loci::sheet
