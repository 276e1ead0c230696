#include "check/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "check/identity.hpp"

namespace clearloci::check {
namespace {

using core::CellNode;
using core::Point2;

// A cell is cut so often before its claim counts as not shown.
constexpr int most_cuts = 26;
// Cells of which nothing was claimed are cut down to this part of the box, and into so many.
constexpr double smallest_open = 1e-6;
constexpr std::size_t most_own_cells = 6'000;
constexpr std::size_t most_cells_of_side = 4'000, most_cells_of_rim = 30'000;

Interval range(double a, double b) { return {a, b, cell_bits}; }

double area_of(const Rectangle& cell) { return (cell.x1 - cell.x0) * (cell.y1 - cell.y0); }

}  // namespace

std::string describe(const Rectangle& cell) {
  return fmt::format("cell [{}, {}] x [{}, {}]", cell.x0, cell.x1, cell.y0, cell.y1);
}

Curve::Curve(const CertificateFile& certificate, const SheetCells& sheet_cells)
    : c(certificate),
      claim(sheet_cells),
      program(certificate.functions[static_cast<std::size_t>(sheet_cells.function)].program),
      sheet(parts_of(certificate, sheet_cells.mode, sheet_cells.at_zero), {&program}) {
  size = std::max(core::Rational(c.box[1] - c.box[0]).get_d(), core::Rational(c.box[3] - c.box[2]).get_d());
  variables_ = {0, 1};
  for (int j = 0; j < static_cast<int>(c.squares.size()); ++j)
    if (sheet.uses(j)) variables_.push_back(2 + j);
  plant();
  origins_ = leaves_;
  std::vector<std::size_t> open;
  for (std::size_t n = 0, planted = nodes_.size(); n < planted; ++n) {
    if (nodes_[n].leaf < 0) continue;
    if (kind(nodes_[n].leaf) == CellNode::Kind::open) open.push_back(n);
    check_leaf(n);
  }
  cut_open(std::move(open));
  // Cells whose ends cannot be told stay open after all.
  do {
    find_ends();
  } while (!pair());
  count_ends();
  string_together();
  for (const Leaf& leaf : leaves_)
    if (leaf.claim.kind == CellNode::Kind::open) open_area += area_of(leaf.cell);
  for (const Junction& junction : junctions_) ends += junction.kind != Junction::Kind::seam ? 1 : 0;
}

void Curve::fail(const std::string& what) const {
  throw FalseClaim(fmt::format("{} in mode {}: {}", c.functions[static_cast<std::size_t>(claim.function)].name,
                               claim.mode + 1, what));
}

// --- cells ------------------------------------------------------------------------------------------------------

/// The tree of cells over the domain.
void Curve::plant() {
  const auto& d = claim.domain;
  if (!(d[0] < d[1] && d[2] < d[3]) || core::Rational(d[0]) > c.box[0] || core::Rational(d[1]) < c.box[1] ||
      core::Rational(d[2]) > c.box[2] || core::Rational(d[3]) < c.box[3])
    fail("its cells do not cover the box");
  area = area_of({d[0], d[1], d[2], d[3]});
  std::vector<std::pair<int, int>> missing = {{-1, 0}};  // parent, child still to be made
  for (const CellNode& cell_node : claim.cells) {
    const auto [parent, side] = missing.back();
    missing.pop_back();
    Node node{{d[0], d[1], d[2], d[3]}};
    const int index = static_cast<int>(nodes_.size());
    if (parent >= 0) {
      Node& above = nodes_[static_cast<std::size_t>(parent)];
      above.child[side] = index;
      node.cell = above.cell;
      (above.axis == 0 ? (side == 0 ? node.cell.x1 : node.cell.x0) : (side == 0 ? node.cell.y1 : node.cell.y0)) =
          above.at;
    }
    if (cell_node.kind == CellNode::Kind::cut) {
      node.axis = cell_node.axis;
      node.at = cell_node.at;
      const Rectangle& cell = node.cell;
      if (!(cell_node.axis == 0 ? cell.x0 < cell_node.at && cell_node.at < cell.x1
                                : cell.y0 < cell_node.at && cell_node.at < cell.y1))
        fail("a cut lies outside of its " + describe(cell));
      missing.emplace_back(index, 1);
      missing.emplace_back(index, 0);
    } else {
      node.leaf = static_cast<int>(leaves_.size());
      leaves_.push_back({node.cell, cell_node, node.leaf, cell_node.kind == CellNode::Kind::open});
    }
    nodes_.push_back(node);
  }
}

/// Over a cell or parts of it.
bool Curve::is_free(const Rectangle& cell, int cuts) {
  if (!sheet.enter(range(cell.x0, cell.x1), range(cell.y0, cell.y1)) || sheet.is_free(0)) return true;
  if (cuts == 0) return false;
  for (const Rectangle& half : halves(cell))
    if (!is_free(half, cuts - 1)) return false;
  return true;
}

/// Over the cell that the sheet has entered; its slopes are known.
bool Curve::is_graph_here(int variable) const {
  int axis = variable < 2 ? variable : -1;
  for (std::size_t l = 0; l < sheet.lifted().size(); ++l)
    if (sheet.lifted()[l] == variable - 2) axis = 2 + static_cast<int>(l);
  return axis >= 0 && sheet.tangent(0, axis).sign() != 0;
}

bool Curve::is_graph(const Rectangle& cell, int variable) {
  const auto is_graph_with = [&](int lift) {
    if (!sheet.enter(range(cell.x0, cell.x1), range(cell.y0, cell.y1), lift)) return true;
    sheet.differentiate();
    return is_graph_here(variable);
  };
  if (is_graph_with(variable - 2)) return true;
  // Slopes by a small root are none through it: where others stand on it, they tell more.
  return variable < 2 && std::any_of(variables_.begin() + 2, variables_.end(),
                                     [&](int candidate) { return is_graph_with(candidate - 2); });
}

/// Looks at a leaf; one that is not shown to be the graph it claims to be is cut into parts that are, or are free.
void Curve::check_leaf(std::size_t node) {
  const Leaf leaf = leaves_[static_cast<std::size_t>(nodes_[node].leaf)];
  if (leaf.claim.kind == CellNode::Kind::open) return;
  ++cells;
  if (leaf.claim.kind == CellNode::Kind::free) {
    if (!is_free(leaf.cell, most_cuts)) fail("it may be zero in " + describe(leaf.cell) + ", said to be free of zeros");
    return;
  }
  ++graphs;
  if (leaf.claim.axis >= 2 && !sheet.uses(leaf.claim.axis - 2)) fail("its cells name a root that it does not hold");
  if (!is_graph(leaf.cell, leaf.claim.axis)) cut_leaf(node, most_cuts);
}

/// Off the middle, since curves of symmetric designs like to cross it.
std::array<std::size_t, 2> Curve::cut(std::size_t node) {
  const int index = nodes_[node].leaf;
  const Leaf whole = leaves_[static_cast<std::size_t>(index)];
  const Rectangle& cell = whole.cell;
  const int axis = cell.x1 - cell.x0 >= cell.y1 - cell.y0 ? 0 : 1;
  const double at = axis == 0 ? cell.x0 + 0.47 * (cell.x1 - cell.x0) : cell.y0 + 0.47 * (cell.y1 - cell.y0);
  std::array<std::size_t, 2> made{};
  for (const int side : {0, 1}) {
    Leaf part = whole;
    (axis == 0 ? (side == 0 ? part.cell.x1 : part.cell.x0) : (side == 0 ? part.cell.y1 : part.cell.y0)) = at;
    Node child{part.cell};
    // The lower half takes the leaf's place in the list.
    child.leaf = side == 0 ? index : static_cast<int>(leaves_.size());
    if (side == 0)
      leaves_[static_cast<std::size_t>(index)] = part;
    else
      leaves_.push_back(part);
    made[static_cast<std::size_t>(side)] = nodes_.size();
    nodes_[node].child[side] = static_cast<int>(nodes_.size());
    nodes_.push_back(child);
  }
  nodes_[node].axis = axis;
  nodes_[node].at = at;
  nodes_[node].leaf = -1;
  return made;
}

void Curve::cut_leaf(std::size_t node, int cuts) {
  if (cuts == 0)
    fail(
        "it is not shown to be one graph in " +
        describe(origins_[static_cast<std::size_t>(leaves_[static_cast<std::size_t>(nodes_[node].leaf)].origin)].cell));
  for (const std::size_t part : cut(node)) {
    Leaf& leaf = leaves_[static_cast<std::size_t>(nodes_[part].leaf)];
    if (is_free(leaf.cell, 0))
      leaf.claim.kind = CellNode::Kind::free;
    else if (!is_graph(leaf.cell, leaf.claim.axis))
      cut_leaf(part, cuts - 1);
  }
}

/// The largest first.
void Curve::cut_open(std::vector<std::size_t> nodes) {
  std::priority_queue<std::pair<double, std::size_t>> open;
  const auto look = [&](std::size_t node) {
    Leaf& leaf = leaves_[static_cast<std::size_t>(nodes_[node].leaf)];
    leaf.claim = {CellNode::Kind::free, 0, 0, 0};
    if (is_free(leaf.cell, 0)) return;
    leaf.claim.kind = CellNode::Kind::graph;
    for (const int variable : variables_) {
      leaf.claim.axis = variable;
      if (is_graph_here(variable)) return;
    }
    leaf.claim = {CellNode::Kind::open, 0, 0, 0};
    if (leaf.cell.size() > smallest_open * size) open.emplace(leaf.cell.size(), node);
  };
  for (const std::size_t node : nodes) look(node);
  for (std::size_t count = 0; !open.empty() && count < most_own_cells; ++count) {
    const std::size_t node = open.top().second;
    open.pop();
    for (const std::size_t part : cut(node)) look(part);
  }
}

// --- ends -------------------------------------------------------------------------------------------------------

void Curve::find_ends() {
  opened_ = false;
  junctions_.clear();
  pieces_.clear();
  ends_.assign(leaves_.size(), {});
  region_.resize(leaves_.size());
  std::iota(region_.begin(), region_.end(), 0);
  meet_seams(0);
  meet_sides();
  meet_rims();
}

/// Open leaves that touch are one region.
int Curve::region(int leaf) const {
  while (region_[static_cast<std::size_t>(leaf)] != leaf) leaf = region_[static_cast<std::size_t>(leaf)];
  return leaf;
}

Rectangle Curve::region_at(int j) const {
  const int region_behind = region(junction(j).beyond);
  Rectangle hull = leaves_[static_cast<std::size_t>(region_behind)].cell;
  for (std::size_t l = 0; l < leaves_.size(); ++l) {
    const Rectangle& cell = leaves_[l].cell;
    if (leaves_[l].claim.kind != CellNode::Kind::open || region(static_cast<int>(l)) != region_behind) continue;
    hull = {std::min(hull.x0, cell.x0), std::max(hull.x1, cell.x1), std::min(hull.y0, cell.y0),
            std::max(hull.y1, cell.y1)};
  }
  return hull;
}

void Curve::meet_seams(int index) {
  const Node node = nodes_[static_cast<std::size_t>(index)];
  if (node.axis < 0) return;
  meet_seams(node.child[0]);
  meet_seams(node.child[1]);
  meet_along(node.child[0], node.child[1], node.axis, node.at);
}

/// Every common side of leaves below `a` and `b`.
void Curve::meet_along(int a_index, int b_index, int axis, double at) {
  const Node a = nodes_[static_cast<std::size_t>(a_index)], b = nodes_[static_cast<std::size_t>(b_index)];
  const double from = axis == 0 ? std::max(a.cell.y0, b.cell.y0) : std::max(a.cell.x0, b.cell.x0);
  const double to = axis == 0 ? std::min(a.cell.y1, b.cell.y1) : std::min(a.cell.x1, b.cell.x1);
  if (!(from < to)) return;
  if (a.axis >= 0) {
    if (a.axis != axis) meet_along(a.child[0], b_index, axis, at);
    return meet_along(a.child[1], b_index, axis, at);
  }
  if (b.axis >= 0) {
    meet_along(a_index, b.child[0], axis, at);
    if (b.axis != axis) meet_along(a_index, b.child[1], axis, at);
    return;
  }
  using Kind = CellNode::Kind;
  const Kind of_a = kind(a.leaf), of_b = kind(b.leaf);
  if (of_a == Kind::open && of_b == Kind::open) region_[static_cast<std::size_t>(region(b.leaf))] = region(a.leaf);
  if (of_a == Kind::free || of_b == Kind::free || (of_a == Kind::open && of_b == Kind::open)) return;
  // A leaf of the checker's own comes first: it may be opened.
  const bool a_first =
      of_b == Kind::open || (of_a == Kind::graph && leaves_[static_cast<std::size_t>(a.leaf)].unclaimed);
  const int one = a_first ? a.leaf : b.leaf, other = a_first ? b.leaf : a.leaf;
  meet_side(one, other, axis, at, from, to, of_a == of_b ? Junction::Kind::seam : Junction::Kind::open);
}

/// The zeros on a part of a leaf's side, as ends there, and of the leaf beyond if there is one.
void Curve::meet_side(int leaf, int beyond, int axis, double at, double from, double to, Junction::Kind kind_of_end) {
  const auto [entry, fresh] = known_.try_emplace({static_cast<double>(axis), at, from, to});
  if (fresh)
    entry->second = common_zeros(sheet, {axis == 0 ? Rectangle{at, at, from, to} : Rectangle{from, to, at, at}}, size,
                                 most_cells_of_side);
  const CommonZeros& found = entry->second;
  if (!found.complete || !found.undecided.empty()) return open(leaf);
  for (const Place& place : found.zeros) {
    const Interval& interval = axis == 0 ? place.y : place.x;
    if (interval.upper() < from || to < interval.lower()) continue;
    junctions_.push_back({kind_of_end, place, -1, false});
    const int junction = static_cast<int>(junctions_.size()) - 1;
    attach(leaf, junction);
    junctions_.back().beyond = beyond;
    if (kind_of_end != Junction::Kind::seam) continue;
    junctions_.back().inside =
        leaves_[static_cast<std::size_t>(leaf)].origin == leaves_[static_cast<std::size_t>(beyond)].origin;
    attach(beyond, junction);
  }
}

/// Claims nothing of a leaf whose ends cannot be told.
void Curve::open(int leaf) {
  leaves_[static_cast<std::size_t>(leaf)].claim.kind = CellNode::Kind::open;
  opened_ = true;
}

void Curve::meet_sides() {
  const auto& d = claim.domain;
  for (std::size_t l = 0; l < leaves_.size(); ++l) {
    if (leaves_[l].claim.kind != CellNode::Kind::graph) continue;
    const Rectangle cell = leaves_[l].cell;
    const int leaf = static_cast<int>(l);
    if (cell.x0 == d[0]) meet_side(leaf, -1, 0, cell.x0, cell.y0, cell.y1, Junction::Kind::side);
    if (cell.x1 == d[1]) meet_side(leaf, -1, 0, cell.x1, cell.y0, cell.y1, Junction::Kind::side);
    if (cell.y0 == d[2]) meet_side(leaf, -1, 1, cell.y0, cell.x0, cell.x1, Junction::Kind::side);
    if (cell.y1 == d[3]) meet_side(leaf, -1, 1, cell.y1, cell.x0, cell.x1, Junction::Kind::side);
  }
}

/// Where the curve meets Q_j = 0 its sheet ends.
void Curve::meet_rims() {
  for (int j = 0; j < static_cast<int>(c.squares.size()); ++j) {
    if (!sheet.uses(j)) continue;
    std::vector<Rectangle> near;
    for (const Leaf& leaf : leaves_)
      if (leaf.claim.kind == CellNode::Kind::graph &&
          sheet.enter(range(leaf.cell.x0, leaf.cell.x1), range(leaf.cell.y0, leaf.cell.y1)) &&
          sheet.square(j).contains_zero())
        near.push_back(leaf.cell);
    std::vector<int> at_zero = claim.at_zero;
    at_zero.push_back(j);
    Sheet rim(parts_of(c, claim.mode, at_zero), {&program, &c.squares[static_cast<std::size_t>(j)]});
    const CommonZeros found = common_zeros(rim, near, size, most_cells_of_rim);
    const auto give_up = [&](const Rectangle& cell) {
      for (std::size_t l = 0; l < leaves_.size(); ++l) {
        const Leaf& leaf = leaves_[l];
        if (leaf.claim.kind == CellNode::Kind::graph && leaf.cell.x0 <= cell.x1 && cell.x0 <= leaf.cell.x1 &&
            leaf.cell.y0 <= cell.y1 && cell.y0 <= leaf.cell.y1)
          open(static_cast<int>(l));
      }
    };
    for (const Rectangle& cell : found.complete ? found.undecided : near) give_up(cell);
    for (const Place& place : found.zeros) {
      const int leaf = leaf_at(place);
      if (leaf == -1) give_up({place.x.lower(), place.x.upper(), place.y.lower(), place.y.upper()});
      if (leaf < 0 || kind(leaf) != CellNode::Kind::graph) continue;
      junctions_.push_back({Junction::Kind::rim, place, -1, false});
      junctions_.back().place.roots.emplace_back(j, Interval(0.0, cell_bits));
      attach(leaf, static_cast<int>(junctions_.size()) - 1);
    }
  }
}

/// The leaf that holds the place in its interior; -1: none for certain, -2: it is outside of the domain.
int Curve::leaf_at(const Place& place) const {
  const auto& d = claim.domain;
  if (place.x.upper() < d[0] || d[1] < place.x.lower() || place.y.upper() < d[2] || d[3] < place.y.lower()) return -2;
  std::size_t index = 0;
  while (nodes_[index].axis >= 0) {
    const Interval& interval = nodes_[index].axis == 0 ? place.x : place.y;
    if (interval.lower() <= nodes_[index].at && nodes_[index].at <= interval.upper()) return -1;
    index = static_cast<std::size_t>(nodes_[index].child[interval.upper() < nodes_[index].at ? 0 : 1]);
  }
  return nodes_[index].leaf;
}

/// The value of a leaf's variable at a place on the curve.
Interval Curve::key(int leaf, const Place& place) {
  const int variable = leaves_[static_cast<std::size_t>(leaf)].claim.axis;
  if (variable < 2) return variable == 0 ? place.x : place.y;
  for (const auto& [root, value] : place.roots)
    if (root == variable - 2) return value;
  return sheet.enter(place.x, place.y) ? sheet.root(variable - 2) : Interval(0.0, cell_bits);
}

void Curve::attach(int leaf, int junction) {
  ends_[static_cast<std::size_t>(leaf)].push_back(
      {junction, key(leaf, junctions_[static_cast<std::size_t>(junction)].place)});
}

// --- graphs -----------------------------------------------------------------------------------------------------

/// False: some leaf was opened, and the ends are to be found again.
bool Curve::pair() {
  if (opened_) return false;
  std::string why;
  for (std::size_t l = 0; l < leaves_.size(); ++l) {
    std::vector<End>& end = ends_[l];
    std::sort(end.begin(), end.end(), [](const End& a, const End& b) { return a.key.middle() < b.key.middle(); });
    bool apart = true;
    for (std::size_t i = 0; i + 1 < end.size(); ++i) apart = apart && end[i].key.upper() < end[i + 1].key.lower();
    if (end.size() % 2 == 0 && apart)
      for (std::size_t i = 0; i + 1 < end.size(); i += 2)
        pieces_.push_back({static_cast<int>(l), {end[i], end[i + 1]}});
    else if (leaves_[l].unclaimed || !apart)
      open(static_cast<int>(l));
    else
      why = "it has an odd number of ends in " + describe(leaves_[l].cell);
  }
  if (!opened_ && !why.empty()) fail(why);
  return !opened_;
}

void Curve::count_ends() const {
  std::vector<int> counted(origins_.size(), 0);
  std::vector<bool> told(origins_.size(), true);
  for (std::size_t l = 0; l < leaves_.size(); ++l) {
    const auto origin = static_cast<std::size_t>(leaves_[l].origin);
    if (leaves_[l].claim.kind == CellNode::Kind::open) told[origin] = false;
    for (const End& end : ends_[l]) counted[origin] += junction(end.junction).inside ? 0 : 1;
  }
  for (std::size_t o = 0; o < origins_.size(); ++o)
    if (told[o] && origins_[o].claim.kind == CellNode::Kind::graph && counted[o] != origins_[o].claim.ends)
      fail(fmt::format("it has {} ends in {}, said to be {}", counted[o], describe(origins_[o].cell),
                       origins_[o].claim.ends));
}

void Curve::string_together() {
  std::vector<std::vector<std::pair<int, int>>> meeting(junctions_.size());
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    for (const int end : {0, 1})
      meeting[static_cast<std::size_t>(pieces_[p].ends[end].junction)].push_back({static_cast<int>(p), end});
  const auto passes = [&](int j) { return junction(j).kind == Junction::Kind::seam; };
  std::vector<bool> used(pieces_.size(), false);
  for (const bool closed : {false, true})
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (const int start : {0, 1}) {
        if (used[p] || (!closed && passes(pieces_[p].ends[start].junction))) continue;
        Path path{{}, closed, pieces_[p].ends[start].junction, 0};
        int piece = static_cast<int>(p), from = start;
        while (!used[static_cast<std::size_t>(piece)]) {
          used[static_cast<std::size_t>(piece)] = true;
          path.steps.push_back({piece, from == 0});
          path.last = pieces_[static_cast<std::size_t>(piece)].ends[1 - from].junction;
          if (!passes(path.last)) break;
          const auto& two = meeting[static_cast<std::size_t>(path.last)];
          if (two.size() != 2) fail("it ends on a side of cells");
          std::tie(piece, from) = two[0].first == piece && two[0].second == 1 - from ? two[1] : two[0];
        }
        for (std::size_t s = 0; s < path.steps.size(); ++s)
          places_of_[pieces_[static_cast<std::size_t>(path.steps[s].piece)].leaf].push_back(
              {static_cast<int>(paths.size()), static_cast<int>(s)});
        paths.push_back(std::move(path));
      }
}

std::vector<Spot> Curve::spots(const Point2& at, double reach, bool& open) {
  std::vector<Spot> result;
  open = false;
  std::vector<int> next = {0};
  while (!next.empty()) {
    const Node& node = nodes_[static_cast<std::size_t>(next.back())];
    next.pop_back();
    if (node.cell.x1 < at[0] - reach || at[0] + reach < node.cell.x0 || node.cell.y1 < at[1] - reach ||
        at[1] + reach < node.cell.y0)
      continue;
    if (node.axis >= 0) {
      next.insert(next.end(), {node.child[0], node.child[1]});
      continue;
    }
    open = open || kind(node.leaf) == CellNode::Kind::open;
    const auto found = places_of_.find(node.leaf);
    if (found == places_of_.end()) continue;
    const Interval interval =
        key(node.leaf, {range(at[0] - reach, at[0] + reach), range(at[1] - reach, at[1] + reach), {}});
    for (const auto& [path, step] : found->second) {
      const Step& here = paths[static_cast<std::size_t>(path)].steps[static_cast<std::size_t>(step)];
      const double from = piece(here).ends[0].key.middle(), to = piece(here).ends[1].key.middle();
      if (interval.upper() < from || to < interval.lower()) continue;
      double part = std::clamp((interval.middle() - from) / (to - from), 0.0, 1.0);
      // Next to the boundary a root tells little of how far along a place is.
      for (const int end : {0, 1}) {
        const Junction& rim = junction(piece(here).ends[end].junction);
        const Point2 there = rim.place.at();
        if (rim.kind == Junction::Kind::rim && std::hypot(there[0] - at[0], there[1] - at[1]) <= reach) part = end;
      }
      result.push_back({path, step + (here.forward ? part : 1 - part)});
    }
  }
  return result;
}

std::optional<Place> Curve::place_on(const Piece& on, const Rectangle& near) {
  const Rectangle& cell = leaf(on).cell;
  const Point2 middle = {0.5 * (near.x0 + near.x1), 0.5 * (near.y0 + near.y1)};
  const int variable = leaf(on).claim.axis;
  for (const int axis : {variable == 1 ? 1 : 0, variable == 1 ? 0 : 1}) {
    const double at = middle[static_cast<std::size_t>(axis)];
    const CommonZeros found =
        common_zeros(sheet, {axis == 0 ? Rectangle{at, at, cell.y0, cell.y1} : Rectangle{cell.x0, cell.x1, at, at}},
                     size, most_cells_of_side);
    for (const Place& place : found.zeros) {
      const Interval interval = key(on.leaf, place);
      if (std::hypot(place.at()[0] - middle[0], place.at()[1] - middle[1]) < 10 * near.size() &&
          on.ends[0].key.upper() < interval.lower() && interval.upper() < on.ends[1].key.lower())
        return place;
    }
  }
  return std::nullopt;
}

}  // namespace clearloci::check
