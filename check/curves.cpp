#include "check/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace clearloci::check {
namespace {

using core::ArcEnd;
using core::CellNode;
using core::Point2;

// All relative to the box. Vertices are on the curve to rounding; ends are where two curves cross, to rounding.
constexpr double on_curve = 1e-11, same_place = 1e-8;
// Curves that touch meet in cells of this size at most, which count as one point.
constexpr double widest_touch = 1e-9;
// A cell is cut so often before its claim counts as not shown.
constexpr int most_cuts = 14;
constexpr std::size_t most_cells_of_pair = 400'000;

struct Leaf {
  Rectangle cell;
  CellNode claim;
  int origin = 0;  ///< the cell of the certificate that it is, or a part of
};

struct Node {
  Rectangle cell;
  int axis = -1;
  double at = 0;
  int child[2] = {-1, -1};
  int leaf = -1;
};

/// Where pieces begin and end.
struct Junction {
  /// `side`: of the domain, outside of the box. `edge`: of the box or of another root's workspace, where the curve is
  /// cut unless it is wanted on both sides.
  enum class Kind { seam, side, rim, cut, edge, open };
  Kind kind = Kind::seam;
  Place place;
  int root = -1;    ///< of a rim: its root is 0 there
  int region = -1;  ///< of an open cell
  ArcEnd label = ArcEnd::none;
  bool inside = false;  ///< a seam between parts of one cell of the certificate

  Point2 at() const { return {place.x.middle(), place.y.middle()}; }
};

struct End {
  int junction = 0;
  Interval key;  ///< the value of the cell's variable
};

/// One graph, or a part of it between cuts.
struct Piece {
  int leaf = 0;
  End ends[2];
};

struct Step {
  int piece = 0;
  bool forward = true;
};

struct Path {
  std::vector<Step> steps;
  bool closed = false;
  int first = 0, last = 0;  ///< junctions
};

/// A place on a path: 2.5 is the middle of its third piece.
struct Spot {
  int path = 0;
  double along = 0;
};

double distance(const Point2& a, const Point2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

bool kind_fits(core::LocusKind kind, core::FactorRole role) {
  switch (role) {
    case core::FactorRole::reaction:
      return kind <= core::LocusKind::component;
    case core::FactorRole::margin:
      return kind == core::LocusKind::margin;
    case core::FactorRole::direct_singularity:
      return kind == core::LocusKind::direct_singularity;
    case core::FactorRole::workspace_boundary:
      return kind == core::LocusKind::workspace_boundary;
    case core::FactorRole::construction:
      break;
  }
  return false;
}

class SheetCheck {
 public:
  SheetCheck(const CertificateFile& c, int number, const std::vector<int>& singular, Tally& tally)
      : c_(c),
        number_(number),
        claim_(c.sheets.at(static_cast<std::size_t>(number))),
        program_(&c.functions[static_cast<std::size_t>(claim_.function)].program),
        sheet_(parts_of(c, claim_.mode, claim_.at_zero), {program_}),
        singular_(singular),
        tally_(tally) {
    for (std::size_t i = 0; i < 4; ++i) box_[i] = c.box[i].get_d();
    size_ = std::max(box_[1] - box_[0], box_[3] - box_[2]);
    variables_ = {0, 1};
    for (int j = 0; j < static_cast<int>(c.squares.size()); ++j)
      if (sheet_.uses(j)) variables_.push_back(2 + j);
  }

  std::vector<Chain> run(std::vector<KnownArc>& arcs) {
    plant();
    for (const Leaf& leaf : leaves_) origins_.push_back(leaf);
    const std::size_t planted = nodes_.size();
    for (std::size_t n = 0; n < planted; ++n)
      if (nodes_[n].leaf >= 0) check_leaf(n);
    join_open_leaves();
    ends_.resize(leaves_.size());
    meet_seams(0);
    meet_sides();
    meet_rims();
    pair();
    cut_pieces();
    wanted_.assign(pieces_.size(), false);
    string_together();
    drop_outside();
    string_together();
    kept_.clear();
    for (const Path& path : paths_) {
      const auto first = static_cast<std::size_t>(path.steps.front().piece);
      kept_.push_back(wanted_[first]);
      inner_.push_back(inner_of_piece_[first]);
    }
    for (const Junction& junction : junctions_)
      if (junction.kind != Junction::Kind::seam) ++tally_.crossings;
    for (KnownArc& arc : arcs)
      if (arc.curve->mode == claim_.mode && kind_fits(arc.curve->kind, claim_.role) && is_mine(*arc.arc)) {
        match(*arc.arc);
        arc.sheet = number_;
      }
    std::vector<Chain> result;
    for (std::size_t p = 0; p < paths_.size(); ++p)
      if (kept_[p]) result.push_back({inner_[p], visits_[p] > 0});
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw FalseClaim(fmt::format("{} in mode {}: {}", c_.functions[static_cast<std::size_t>(claim_.function)].name,
                                 claim_.mode + 1, what));
  }

  /// The tree of cells over the domain.
  void plant() {
    const auto& d = claim_.domain;
    const Rectangle domain{d[0], d[1], d[2], d[3]};
    if (!(d[0] < d[1] && d[2] < d[3]) || core::Rational(d[0]) > c_.box[0] || core::Rational(d[1]) < c_.box[1] ||
        core::Rational(d[2]) > c_.box[2] || core::Rational(d[3]) < c_.box[3])
      fail("its cells do not cover the box");
    std::vector<std::pair<int, int>> open = {{-1, 0}};  // parent, child still to be made
    std::size_t next = 0;
    while (!open.empty()) {
      const auto [parent, side] = open.back();
      open.pop_back();
      Node node{domain};
      if (parent >= 0) {
        const Node& above = nodes_[static_cast<std::size_t>(parent)];
        node.cell = above.cell;
        (above.axis == 0 ? (side == 0 ? node.cell.x1 : node.cell.x0) : (side == 0 ? node.cell.y1 : node.cell.y0)) =
            above.at;
      }
      const CellNode& claim = claim_.cells.at(next++);
      const int index = static_cast<int>(nodes_.size());
      if (claim.kind == CellNode::Kind::cut) {
        node.axis = claim.axis;
        node.at = claim.at;
        const Rectangle& cell = node.cell;
        if (!(claim.axis == 0 ? cell.x0 < claim.at && claim.at < cell.x1 : cell.y0 < claim.at && claim.at < cell.y1))
          fail("a cut lies outside of its " + describe(cell));
        open.emplace_back(index, 1);
        open.emplace_back(index, 0);
      } else {
        node.leaf = static_cast<int>(leaves_.size());
        leaves_.push_back({node.cell, claim, node.leaf});
      }
      nodes_.push_back(node);
      if (parent >= 0) nodes_[static_cast<std::size_t>(parent)].child[side] = index;
    }
  }

  static Interval range(double a, double b) { return {a, b, cell_bits}; }

  /// Over a cell or a part of it.
  bool is_free(const Rectangle& cell, int cuts) {
    if (!sheet_.enter(range(cell.x0, cell.x1), range(cell.y0, cell.y1)) || !sheet_.value(0).contains_zero())
      return true;
    sheet_.differentiate();
    if (!sheet_.centred(0).contains_zero()) return true;
    if (cuts == 0) return false;
    for (const Rectangle& half : halves(cell))
      if (!is_free(half, cuts - 1)) return false;
    return true;
  }

  bool is_graph(const Leaf& leaf) {
    const Rectangle& cell = leaf.cell;
    const int variable = leaf.claim.axis;
    const int root = variable - 2;
    if (root >= 0 && !sheet_.uses(root)) return false;
    if (!sheet_.enter(range(cell.x0, cell.x1), range(cell.y0, cell.y1), root)) return true;
    sheet_.differentiate();
    int c = variable;
    for (std::size_t l = 0; l < sheet_.lifted().size(); ++l)
      if (sheet_.lifted()[l] == root) c = 2 + static_cast<int>(l);
    return sheet_.tangent(0, c).sign() != 0;
  }

  /// A cell that is shown to be free or one graph over some variable, which may be another than was said.
  bool is_some_graph(Leaf& leaf) {
    if (is_free(leaf.cell, 0)) {
      leaf.claim.kind = CellNode::Kind::free;
      return true;
    }
    for (const int variable : variables_) {
      leaf.claim.axis = variable;
      if (is_graph(leaf)) return true;
    }
    return false;
  }

  /// Looks at a leaf; one that is not shown to be what it claims is cut, and its parts are looked at in its stead.
  void check_leaf(std::size_t node) {
    const int index = nodes_[node].leaf;
    const Leaf leaf = leaves_[static_cast<std::size_t>(index)];
    const double area = (leaf.cell.x1 - leaf.cell.x0) * (leaf.cell.y1 - leaf.cell.y0);
    tally_.area += area;
    switch (leaf.claim.kind) {
      case CellNode::Kind::free:
        if (!is_free(leaf.cell, most_cuts))
          fail("it may be zero in " + describe(leaf.cell) + ", said to be free of zeros");
        ++tally_.cells;
        break;
      case CellNode::Kind::graph:
        if (leaf.claim.axis >= 2 && !sheet_.uses(leaf.claim.axis - 2))
          fail("its cells name a root that it does not hold");
        if (!is_graph(leaf)) cut_leaf(node, most_cuts);
        ++tally_.cells;
        ++tally_.graphs;
        break;
      default:
        tally_.open_area += area;
    }
  }

  void cut_leaf(std::size_t node, int cuts) {
    const int index = nodes_[node].leaf;
    const Leaf whole = leaves_[static_cast<std::size_t>(index)];
    if (cuts == 0)
      fail("it is not shown to be one graph in " + describe(origins_[static_cast<std::size_t>(whole.origin)].cell));
    // Off the middle, since curves of symmetric designs like to cross it.
    const Rectangle& cell = whole.cell;
    const int axis = cell.x1 - cell.x0 >= cell.y1 - cell.y0 ? 0 : 1;
    const double at = axis == 0 ? cell.x0 + 0.47 * (cell.x1 - cell.x0) : cell.y0 + 0.47 * (cell.y1 - cell.y0);
    for (const int side : {0, 1}) {
      Leaf part = whole;
      (axis == 0 ? (side == 0 ? part.cell.x1 : part.cell.x0) : (side == 0 ? part.cell.y1 : part.cell.y0)) = at;
      const bool shown = is_some_graph(part);
      Node child{part.cell};
      // The lower half takes the leaf's place in the list.
      child.leaf = side == 0 ? index : static_cast<int>(leaves_.size());
      if (side == 0)
        leaves_[static_cast<std::size_t>(index)] = part;
      else
        leaves_.push_back(part);
      const int made = static_cast<int>(nodes_.size());
      nodes_.push_back(child);
      nodes_[node].child[side] = made;
      if (!shown) cut_leaf(static_cast<std::size_t>(made), cuts - 1);
    }
    nodes_[node].axis = axis;
    nodes_[node].at = at;
    nodes_[node].leaf = -1;
  }

  CellNode::Kind kind(int leaf) const { return leaves_[static_cast<std::size_t>(leaf)].claim.kind; }

  // Open leaves that touch are one region.
  int region(int leaf) {
    while (parent_[static_cast<std::size_t>(leaf)] != leaf) leaf = parent_[static_cast<std::size_t>(leaf)];
    return leaf;
  }
  void join_open_leaves() {
    parent_.resize(leaves_.size());
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int add_junction(Junction junction) {
    junctions_.push_back(std::move(junction));
    return static_cast<int>(junctions_.size()) - 1;
  }

  void meet_seams(int index) {
    const Node node = nodes_[static_cast<std::size_t>(index)];
    if (node.axis < 0) return;
    meet_seams(node.child[0]);
    meet_seams(node.child[1]);
    meet_along(node.child[0], node.child[1], node.axis, node.at);
  }

  /// Every common side of leaves below `a` and `b`.
  void meet_along(int a_index, int b_index, int axis, double at) {
    const Node &a = nodes_[static_cast<std::size_t>(a_index)], &b = nodes_[static_cast<std::size_t>(b_index)];
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
    if (kind(a.leaf) == Kind::free || kind(b.leaf) == Kind::free) return;
    if (kind(a.leaf) == Kind::open && kind(b.leaf) == Kind::open) {
      parent_[static_cast<std::size_t>(region(b.leaf))] = region(a.leaf);
      return;
    }
    for (const Place& place : zeros(axis, at, from, to)) {
      Junction junction{Junction::Kind::seam, place};
      for (const int leaf : {a.leaf, b.leaf})
        if (kind(leaf) == Kind::open) junction = {Junction::Kind::open, place, -1, leaf};
      junction.inside =
          leaves_[static_cast<std::size_t>(a.leaf)].origin == leaves_[static_cast<std::size_t>(b.leaf)].origin;
      const int number = add_junction(junction);
      for (const int leaf : {a.leaf, b.leaf})
        if (kind(leaf) == Kind::graph) attach(leaf, number);
    }
  }

  std::vector<Place> zeros(int axis, double at, double from, double to) {
    auto found = zeros_on_segment(sheet_, axis, at, from, to);
    if (!found)
      fail(fmt::format("its zeros are not told apart on {} = {} from {} to {}", axis == 0 ? 'x' : 'y', at, from, to));
    return std::move(*found);
  }

  void meet_sides() {
    const auto& d = claim_.domain;
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
      const Leaf& leaf = leaves_[l];
      if (leaf.claim.kind != CellNode::Kind::graph) continue;
      const Rectangle& cell = leaf.cell;
      const auto side = [&](bool on, int axis, double at, double from, double to) {
        if (!on) return;
        for (const Place& place : zeros(axis, at, from, to))
          attach(static_cast<int>(l), add_junction({Junction::Kind::side, place, -1, -1, ArcEnd::none}));
      };
      side(cell.x0 == d[0], 0, cell.x0, cell.y0, cell.y1);
      side(cell.x1 == d[1], 0, cell.x1, cell.y0, cell.y1);
      side(cell.y0 == d[2], 1, cell.y0, cell.x0, cell.x1);
      side(cell.y1 == d[3], 1, cell.y1, cell.x0, cell.x1);
    }
  }

  std::vector<Rectangle> graph_cells(int near_root) {
    std::vector<Rectangle> cells;
    for (const Leaf& leaf : leaves_) {
      if (leaf.claim.kind != CellNode::Kind::graph) continue;
      const Rectangle& cell = leaf.cell;
      if (near_root >= 0 &&
          (!sheet_.enter(range(cell.x0, cell.x1), range(cell.y0, cell.y1)) || sheet_.square(near_root).sign() != 0))
        continue;
      cells.push_back(cell);
    }
    return cells;
  }

  /// Where the curve meets Q_j = 0 its sheet ends.
  void meet_rims() {
    for (int j = 0; j < static_cast<int>(c_.squares.size()); ++j) {
      if (!sheet_.uses(j)) continue;
      const std::vector<Rectangle> cells = graph_cells(j);
      if (cells.empty()) continue;
      std::vector<int> at_zero = claim_.at_zero;
      at_zero.push_back(j);
      Sheet rim(parts_of(c_, claim_.mode, at_zero), {program_, &c_.squares[static_cast<std::size_t>(j)]});
      const CommonZeros found = common_zeros(rim, cells, size_, most_cells_of_pair);
      if (!found.complete) fail("how it meets the workspace's boundary takes too many cells");
      for (const Rectangle& cell : found.undecided)
        if (std::any_of(leaves_.begin(), leaves_.end(), [&](const Leaf& leaf) {
              return leaf.claim.kind == CellNode::Kind::graph && leaf.cell.x0 <= cell.x0 && cell.x1 <= leaf.cell.x1 &&
                     leaf.cell.y0 <= cell.y0 && cell.y1 <= leaf.cell.y1;
            }))
          fail("how it meets the workspace's boundary is not shown in " + describe(cell));
      for (const Place& place : found.zeros) {
        const int leaf = leaf_at(place);
        if (leaf == outside) continue;
        if (leaf < 0) fail("it meets the workspace's boundary on a side of cells");
        if (kind(leaf) != CellNode::Kind::graph) continue;
        attach(leaf, add_junction({Junction::Kind::rim, place, j, -1, ArcEnd::boundary}));
      }
    }
  }

  static constexpr int outside = -2;

  /// The leaf that holds the place in its interior; -1: none for certain.
  int leaf_at(const Place& place) const {
    if (place.x.upper() < claim_.domain[0] || claim_.domain[1] < place.x.lower() ||
        place.y.upper() < claim_.domain[2] || claim_.domain[3] < place.y.lower())
      return outside;
    std::size_t index = 0;
    while (nodes_[index].axis >= 0) {
      const Interval& own = nodes_[index].axis == 0 ? place.x : place.y;
      if (own.lower() <= nodes_[index].at && nodes_[index].at <= own.upper()) return -1;
      index = static_cast<std::size_t>(nodes_[index].child[own.upper() < nodes_[index].at ? 0 : 1]);
    }
    return nodes_[index].leaf;
  }

  /// The value of a leaf's variable at a place on the curve.
  Interval key(int leaf, const Place& place, int zero_root = -1) {
    const int variable = leaves_[static_cast<std::size_t>(leaf)].claim.axis;
    if (variable < 2) return variable == 0 ? place.x : place.y;
    if (variable - 2 == zero_root || !sheet_.enter(place.x, place.y)) return Interval(0.0, cell_bits);
    return sheet_.root(variable - 2);
  }

  void attach(int leaf, int junction) {
    const Junction& own = junctions_[static_cast<std::size_t>(junction)];
    ends_[static_cast<std::size_t>(leaf)].push_back({junction, key(leaf, own.place, own.root)});
  }

  void pair() {
    std::vector<int> counted(origins_.size(), 0);
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
      const Leaf& leaf = leaves_[l];
      std::vector<End>& ends = ends_[l];
      if (leaf.claim.kind != CellNode::Kind::graph) continue;
      for (const End& end : ends)
        if (!junctions_[static_cast<std::size_t>(end.junction)].inside)
          ++counted[static_cast<std::size_t>(leaf.origin)];
      std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.key.middle() < b.key.middle(); });
      if (ends.size() % 2 != 0) fail("it has an odd number of ends in " + describe(leaf.cell));
      for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        if (!(ends[i].key.upper() < ends[i + 1].key.lower()))
          fail("two of its ends are too close in " + describe(leaf.cell));
      for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
        pieces_.push_back({static_cast<int>(l), {ends[i], ends[i + 1]}});
    }
    for (std::size_t o = 0; o < origins_.size(); ++o)
      if (origins_[o].claim.kind == CellNode::Kind::graph && counted[o] != origins_[o].claim.ends)
        fail(fmt::format("it has {} ends in {}, said to be {}", counted[o], describe(origins_[o].cell),
                         origins_[o].claim.ends));
  }

  bool near_end(const Point2& at) const {
    return std::any_of(junctions_.begin(), junctions_.end(), [&](const Junction& junction) {
      return junction.kind != Junction::Kind::seam && distance(junction.at(), at) < same_place * size_;
    });
  }

  /// Pieces end where |A| does too, where that matters, and where another root's workspace ends.
  void cut_pieces() {
    if (pieces_.empty()) return;
    const bool by_singularity = claim_.role == core::FactorRole::reaction || claim_.role == core::FactorRole::margin;
    if (by_singularity)
      for (const int f : singular_)
        cut_by(c_.functions[static_cast<std::size_t>(f)].program, Junction::Kind::cut, ArcEnd::direct_singularity,
               graph_cells(-1));
    for (int k = 0; k < static_cast<int>(c_.squares.size()); ++k)
      if (is_foreign(k))
        cut_by(c_.squares[static_cast<std::size_t>(k)], Junction::Kind::edge, ArcEnd::boundary, graph_cells(-1));
    for (int side = 0; side < 4; ++side) {
      along_[static_cast<std::size_t>(side)] = runs_along(side);
      cut_by(side_line(side), Junction::Kind::edge, ArcEnd::box, cells_at_side(side));
    }
  }

  /// Positive inside.
  core::StraightLine side_line(int side) const {
    core::StraightLineBuilder builder;
    const int variable = builder.variable(side / 2), at = builder.constant(c_.box[static_cast<std::size_t>(side)]);
    return builder.line(side % 2 == 0 ? builder.subtract(variable, at) : builder.subtract(at, variable));
  }

  /// The function vanishes all along a side of the box: at places on it that were not chosen for that.
  bool runs_along(int side) {
    Sheet precise(parts_of(c_, claim_.mode, claim_.at_zero), {program_}, identity_bits);
    const auto s = static_cast<std::size_t>(side), o = side < 2 ? std::size_t{2} : std::size_t{0};
    const Interval at(c_.box[s], identity_bits);
    int zero = 0;
    for (const long part : {137, 311, 498, 673, 891}) {
      const Interval other(core::Rational(c_.box[o] + (c_.box[o + 1] - c_.box[o]) * core::Rational(part, 1009)),
                           identity_bits);
      if (!(side < 2 ? precise.enter(at, other) : precise.enter(other, at))) continue;
      if (!precise.value(0).contains_zero()) return false;
      ++zero;
    }
    return zero > 0;
  }

  /// Of those that hold a part of the side, without those in which the curve runs along it.
  std::vector<Rectangle> cells_at_side(int side) {
    const double at = box_[static_cast<std::size_t>(side)];
    std::vector<Rectangle> cells;
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
      const Rectangle& cell = leaves_[l].cell;
      if (leaves_[l].claim.kind != CellNode::Kind::graph) continue;
      if (side < 2 ? at < cell.x0 || cell.x1 < at : at < cell.y0 || cell.y1 < at) continue;
      if (along_[static_cast<std::size_t>(side)] &&
          std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
            return piece.leaf == static_cast<int>(l) && lies_along(junction_at(piece.ends[0]), side) &&
                   lies_along(junction_at(piece.ends[1]), side);
          }))
        continue;
      cells.push_back(cell);
    }
    return cells;
  }

  Point2 junction_at(const End& end) const { return junctions_[static_cast<std::size_t>(end.junction)].at(); }

  bool lies_along(const Point2& at, int side) const {
    return along_[static_cast<std::size_t>(side)] &&
           std::abs(at[static_cast<std::size_t>(side / 2)] - box_[static_cast<std::size_t>(side)]) <= on_curve * size_;
  }

  bool is_foreign(int root) const {
    return !sheet_.uses(root) && std::find(claim_.at_zero.begin(), claim_.at_zero.end(), root) == claim_.at_zero.end();
  }

  void cut_by(const core::StraightLine& other, Junction::Kind kind_of_cut, ArcEnd label,
              const std::vector<Rectangle>& cells) {
    if (cells.empty()) return;
    Sheet both(parts_of(c_, claim_.mode, claim_.at_zero), {program_, &other});
    CommonZeros found = common_zeros(both, cells, size_, most_cells_of_pair);
    if (!found.complete) fail("where another curve cuts it takes too many cells");
    // At an edge double zeros count as one point: what the curve does there is seen from the pieces on either side.
    for (const Rectangle& cell : joined(std::move(found.undecided))) {
      const Point2 at = {0.5 * (cell.x0 + cell.x1), 0.5 * (cell.y0 + cell.y1)};
      if (near_end(at)) continue;
      if (kind_of_cut != Junction::Kind::edge || cell.size() > widest_touch * size_)
        fail("where it is cut by another curve is not shown in " + describe(cell));
      found.zeros.push_back({range(cell.x0, cell.x1), range(cell.y0, cell.y1)});
    }
    for (const Place& place : found.zeros) {
      const int leaf = leaf_at(place);
      if (leaf == outside || near_end({place.x.middle(), place.y.middle()})) continue;
      if (leaf < 0) fail("another curve cuts it on a side of cells");
      if (kind(leaf) != CellNode::Kind::graph) continue;
      const Interval own = key(leaf, place);
      const auto piece = std::find_if(pieces_.begin(), pieces_.end(), [&](const Piece& p) {
        return p.leaf == leaf && p.ends[0].key.upper() < own.lower() && own.upper() < p.ends[1].key.lower();
      });
      if (piece == pieces_.end()) {
        if (place.x.width() + place.y.width() < 1e-3 * widest_touch * size_)
          fail("another curve cuts it where it is not");
        continue;  // two that pass very near each other
      }
      const int junction = add_junction({kind_of_cut, place, -1, -1, label});
      Piece rest = *piece;
      piece->ends[1] = rest.ends[0] = {junction, own};
      pieces_.push_back(rest);
    }
  }

  /// Cells that touch, as one.
  static std::vector<Rectangle> joined(std::vector<Rectangle> cells) {
    for (bool again = true; again;) {
      again = false;
      for (std::size_t i = 0; i < cells.size(); ++i)
        for (std::size_t k = i + 1; k < cells.size(); ++k) {
          Rectangle &a = cells[i], &b = cells[k];
          if (a.x1 < b.x0 || b.x1 < a.x0 || a.y1 < b.y0 || b.y1 < a.y0) continue;
          a = {std::min(a.x0, b.x0), std::max(a.x1, b.x1), std::min(a.y0, b.y0), std::max(a.y1, b.y1)};
          b = cells.back();
          cells.pop_back();
          again = true;
          --k;
        }
    }
    return cells;
  }

  void string_together() {
    std::vector<std::vector<std::pair<int, int>>> meeting(junctions_.size());
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (const int end : {0, 1})
        meeting[static_cast<std::size_t>(pieces_[p].ends[end].junction)].push_back({static_cast<int>(p), end});
    // Through an edge where both of its pieces are wanted.
    const auto passes = [&](int junction) {
      const Junction::Kind own = junctions_[static_cast<std::size_t>(junction)].kind;
      const auto& here = meeting[static_cast<std::size_t>(junction)];
      return own == Junction::Kind::seam ||
             (own == Junction::Kind::edge && here.size() == 2 && wanted_[static_cast<std::size_t>(here[0].first)] &&
              wanted_[static_cast<std::size_t>(here[1].first)]);
    };
    paths_.clear();
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
            const auto next = two[0].first == piece && two[0].second == 1 - from ? two[1] : two[0];
            piece = next.first;
            from = next.second;
          }
          paths_.push_back(std::move(path));
        }
    visits_.assign(paths_.size(), 0);
  }

  /// A point between the ends of a piece.
  std::optional<Place> inside_piece(const Piece& piece) {
    const Rectangle& cell = leaves_[static_cast<std::size_t>(piece.leaf)].cell;
    const Point2 a = junctions_[static_cast<std::size_t>(piece.ends[0].junction)].at();
    const Point2 b = junctions_[static_cast<std::size_t>(piece.ends[1].junction)].at();
    for (const double part : {0.5, 0.35, 0.7})
      for (const int axis : {0, 1}) {
        const auto i = static_cast<std::size_t>(axis);
        const double at = a[i] + part * (b[i] - a[i]);
        const auto found = axis == 0 ? zeros_on_segment(sheet_, 0, at, cell.y0, cell.y1)
                                     : zeros_on_segment(sheet_, 1, at, cell.x0, cell.x1);
        if (!found) continue;
        for (const Place& place : *found) {
          const Interval own = key(piece.leaf, place);
          if (piece.ends[0].key.upper() < own.lower() && own.upper() < piece.ends[1].key.lower()) return place;
        }
      }
    return std::nullopt;
  }

  /// Which pieces lie in the box and where every root that the curve does not hold is real.
  void drop_outside() {
    std::vector<core::StraightLine> edges;
    for (int k = 0; k < static_cast<int>(c_.squares.size()); ++k)
      if (is_foreign(k)) edges.push_back(c_.squares[static_cast<std::size_t>(k)]);
    const std::size_t roots = edges.size();
    for (int side = 0; side < 4; ++side) edges.push_back(side_line(side));
    std::vector<const core::StraightLine*> functions;
    for (const core::StraightLine& edge : edges) functions.push_back(&edge);
    Sheet all(parts_of(c_, claim_.mode, claim_.at_zero), functions);
    inner_of_piece_.assign(pieces_.size(), {});
    for (const Path& path : paths_) {
      // From the longest piece on.
      std::vector<int> order;
      for (const Step& step : path.steps) order.push_back(step.piece);
      const auto length = [&](int piece) {
        const Piece& own = pieces_[static_cast<std::size_t>(piece)];
        return distance(junction_at(own.ends[0]), junction_at(own.ends[1]));
      };
      std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return length(a) > length(b); });
      bool known = false, out = false;
      Point2 inner{};
      for (std::size_t i = 0; i < std::min<std::size_t>(order.size(), 5) && !known; ++i) {
        const std::optional<Place> place = inside_piece(pieces_[static_cast<std::size_t>(order[i])]);
        if (!place) continue;
        inner = {place->x.middle(), place->y.middle()};
        known = true;
        out = !all.enter(place->x, place->y);
        for (std::size_t k = 0; k < edges.size() && !out; ++k) {
          if (k >= roots && lies_along(inner, static_cast<int>(k - roots))) continue;
          const int sign = all.value(static_cast<int>(k)).sign();
          known = known && sign != 0;
          out = sign < 0;
        }
        known = known || out;
      }
      if (!known && !tiny(path)) fail("whether a piece of it lies in the workspace is not shown");
      for (const int piece : order) {
        wanted_[static_cast<std::size_t>(piece)] = !out && known;
        inner_of_piece_[static_cast<std::size_t>(piece)] = inner;
      }
    }
    inner_.clear();
  }

  /// Between two places that are one to rounding.
  bool tiny(const Path& path) const {
    return path.steps.size() == 1 &&
           distance(junctions_[static_cast<std::size_t>(path.first)].at(),
                    junctions_[static_cast<std::size_t>(path.last)].at()) < widest_touch * size_;
  }

  // --- arcs ---------------------------------------------------------------------------------------------------------

  /// The function's enclosure over a box around a point holds 0, to first order.
  bool holds_zero(const Point2& at, double reach) {
    if (!sheet_.enter(range(at[0] - reach, at[0] + reach), range(at[1] - reach, at[1] + reach))) return false;
    if (!sheet_.value(0).contains_zero()) return false;
    sheet_.differentiate();
    return sheet_.centred(0).contains_zero();
  }

  double vertex_reach(const Point2& at) const {
    return on_curve * size_ + 8 * 0x1p-52 * std::max(std::abs(at[0]), std::abs(at[1]));
  }

  /// Points of an arc that are on its curve to rounding, but for its ends: those may have been moved to the box.
  std::vector<Point2> samples(const core::Arc& arc) const {
    if (arc.points.size() > 2) return {arc.points.begin() + 1, arc.points.end() - 1};
    return {{0.5 * (arc.points[0][0] + arc.points[1][0]), 0.5 * (arc.points[0][1] + arc.points[1][1])}};
  }

  /// The arc claims to be one of this function: most of some vertices lie on it.
  bool is_mine(const core::Arc& arc) {
    const std::vector<Point2> points = samples(arc);
    const bool chord = arc.points.size() == 2;
    int on = 0;
    for (const std::size_t i : {points.size() / 4, points.size() / 2, 3 * points.size() / 4})
      on += holds_zero(points[i], chord ? 1.5 * c_.tolerance : 10 * vertex_reach(points[i])) ? 1 : 0;
    return on >= 2;
  }

  /// Spots of a point on the paths; an open region's number besides, or -1.
  std::vector<Spot> spots(const Point2& at, double reach, int& open) {
    std::vector<Spot> result;
    open = -1;
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
      if (kind(node.leaf) == CellNode::Kind::open) open = region(node.leaf);
      const auto found = places_of_.find(node.leaf);
      if (found == places_of_.end()) continue;
      const Interval own = key(node.leaf, {range(at[0] - reach, at[0] + reach), range(at[1] - reach, at[1] + reach)});
      for (const auto& [path, step] : found->second) {
        const Step& here = paths_[static_cast<std::size_t>(path)].steps[static_cast<std::size_t>(step)];
        const Piece& piece = pieces_[static_cast<std::size_t>(here.piece)];
        const double from = piece.ends[0].key.middle(), to = piece.ends[1].key.middle();
        if (own.upper() < from || to < own.lower()) continue;
        const double part = std::clamp((own.middle() - from) / (to - from), 0.0, 1.0);
        result.push_back({path, step + (here.forward ? part : 1 - part)});
      }
    }
    return result;
  }

  void index_paths() {
    if (!places_of_.empty()) return;
    for (std::size_t p = 0; p < paths_.size(); ++p)
      for (std::size_t s = 0; s < paths_[p].steps.size(); ++s)
        places_of_[pieces_[static_cast<std::size_t>(paths_[p].steps[s].piece)].leaf].push_back(
            {static_cast<int>(p), static_cast<int>(s)});
  }

  /// An arc's run along one path.
  struct Run {
    int path = 0;
    double first = 0, last = 0;  ///< where it was met first and last
    double gone = 0;             ///< signed, along the path
    double back = 0;             ///< largest step against the way, signed both ways
    double ahead = 0;
  };

  /// The vertices run along paths of this sheet one after another, each from end to end, through open cells between.
  void match(const core::Arc& arc) {
    index_paths();
    const std::vector<Point2> points = samples(arc);
    const bool chord = arc.points.size() == 2;
    std::vector<Run> runs;
    for (const Point2& at : points) {
      const double reach = chord ? 1.5 * c_.tolerance : vertex_reach(at);
      int open = -1;
      const std::vector<Spot> here = spots(at, reach, open);
      if (here.empty()) {
        if (open >= 0) continue;
        fail(fmt::format("an arc's vertex ({}, {}) is not on the curve that the cells prove", at[0], at[1]));
      }
      if (open < 0 && !holds_zero(at, reach))
        fail(fmt::format("an arc's vertex ({}, {}) is not on the curve", at[0], at[1]));
      follow(runs, here);
    }
    for (std::size_t i = 1; i < arc.points.size(); ++i) check_chord(arc.points[i - 1], arc.points[i]);
    if (runs.empty()) {
      if (!in_open(arc)) fail("an arc runs along no curve that the cells prove");
      return;
    }
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const bool only = runs.size() == 1;
      check_run(runs[i], arc, only);
      // A closed arc that begins within a path comes back to it in the end.
      const bool again = i + 1 == runs.size() && !only && arc.closed && runs[i].path == runs[0].path;
      if (!again && ++visits_[static_cast<std::size_t>(runs[i].path)] > 1)
        fail(fmt::format("two arcs run along one piece of curve near ({}, {})",
                         inner_[static_cast<std::size_t>(runs[i].path)][0],
                         inner_[static_cast<std::size_t>(runs[i].path)][1]));
      if (i > 0) check_passage(runs[i - 1], runs[i]);
      if (!kept_[static_cast<std::size_t>(runs[i].path)]) fail("an arc lies outside the workspace");
    }
    check_ends(arc, runs);
  }

  void follow(std::vector<Run>& runs, const std::vector<Spot>& here) const {
    const Spot* best = nullptr;
    double step = 0;
    for (const Spot& spot : here) {
      if (runs.empty() || spot.path != runs.back().path) continue;
      const Path& path = paths_[static_cast<std::size_t>(spot.path)];
      double own = spot.along - runs.back().last;
      if (path.closed)
        own -= static_cast<double>(path.steps.size()) * std::nearbyint(own / static_cast<double>(path.steps.size()));
      if (best != nullptr && std::abs(own) >= std::abs(step)) continue;
      best = &spot;
      step = own;
    }
    if (best == nullptr) {
      runs.push_back({here.front().path, here.front().along, here.front().along, 0, 0, 0});
      return;
    }
    Run& run = runs.back();
    run.last = best->along;
    run.gone += step;
    run.back = std::min(run.back, step);
    run.ahead = std::max(run.ahead, step);
  }

  void check_run(const Run& run, const core::Arc& arc, bool only) const {
    constexpr double jitter = 1e-3;
    if (run.gone >= 0 ? run.back < -jitter : run.ahead > jitter) fail("an arc runs back and forth");
    const Path& path = paths_[static_cast<std::size_t>(run.path)];
    if (path.closed && only && !arc.closed) fail("an arc is open, its curve is closed");
    if (!path.closed && only && arc.closed && !in_open_ends(path)) fail("an arc is closed, its curve is open");
    if (path.closed && std::abs(run.gone) > static_cast<double>(path.steps.size()) + jitter)
      fail("an arc runs round its curve more than once");
  }

  bool is_open(int junction) const {
    return junctions_[static_cast<std::size_t>(junction)].kind == Junction::Kind::open;
  }
  bool in_open_ends(const Path& path) const { return is_open(path.first) && is_open(path.last); }

  /// Every vertex is in an open cell, or the arc is too short to have any inside a cell.
  bool in_open(const core::Arc& arc) {
    for (const Point2& at : arc.points) {
      int open = -1;
      (void)spots(at, vertex_reach(at), open);
      if (open < 0) return false;
    }
    return true;
  }

  /// From one path to the next only through an open region.
  void check_passage(const Run& from, const Run& to) {
    const Path &a = paths_[static_cast<std::size_t>(from.path)], &b = paths_[static_cast<std::size_t>(to.path)];
    for (const int leaving : {a.first, a.last})
      for (const int entering : {b.first, b.last})
        if (is_open(leaving) && is_open(entering) &&
            region(junctions_[static_cast<std::size_t>(leaving)].region) ==
                region(junctions_[static_cast<std::size_t>(entering)].region))
          return;
    fail("an arc jumps from one piece of curve to another");
  }

  /// The arc's ends are those of its first and last path.
  void check_ends(const core::Arc& arc, const std::vector<Run>& runs) {
    const Path& path = paths_[static_cast<std::size_t>(runs.front().path)];
    if (path.closed) {
      if (arc.points.front() != arc.points.back()) fail("a closed arc does not close");
      const double n = static_cast<double>(path.steps.size());
      // What the vertices next to the first one leave is a small part of the way round.
      if (arc.points.size() > 8 && std::abs(runs.front().gone) < 0.5 * n) fail("an arc does not run round its curve");
      return;
    }
    if (arc.closed) return;
    const std::array<const Path*, 2> last = {&path, &paths_[static_cast<std::size_t>(runs.back().path)]};
    for (const std::size_t end : {0u, 1u}) {
      const Point2& at = end == 0 ? arc.points.front() : arc.points.back();
      int open = -1;
      (void)spots(at, vertex_reach(at), open);
      if (open >= 0) continue;
      bool found = false;
      for (const int junction : {last[end]->first, last[end]->last}) {
        const Junction& own = junctions_[static_cast<std::size_t>(junction)];
        const double reach = 10 * same_place * size_;
        const bool there = own.kind == Junction::Kind::open || distance(own.at(), at) <= reach;
        const bool said = own.label == ArcEnd::none || own.label == arc.ends[end] || arc.ends[end] == ArcEnd::crossing;
        found =
            found || (there && (said || near_end_of_kind(at, arc.ends[end]) || is_singular_end(own, arc.ends[end])));
      }
      if (!found) fail(fmt::format("an arc ends at ({}, {}), its curve does not, or not like that", at[0], at[1]));
    }
    if (runs.size() == 1 && !in_open_ends(path) && arc.points.size() > 2 &&
        distance(arc.points.front(), arc.points.back()) < same_place * size_ &&
        distance(junctions_[static_cast<std::size_t>(path.first)].at(),
                 junctions_[static_cast<std::size_t>(path.last)].at()) > 100 * same_place * size_)
      fail("an arc's two ends are one");
  }

  /// |A| may vanish where a curve ends on the boundary, and then gives the end its name.
  bool is_singular_end(const Junction& end, ArcEnd label) const {
    if (label != ArcEnd::direct_singularity) return false;
    return std::any_of(singular_.begin(), singular_.end(), [&](int f) {
      Sheet sheet(parts_of(c_, claim_.mode, claim_.at_zero), {&c_.functions[static_cast<std::size_t>(f)].program});
      return !sheet.enter(end.place.x, end.place.y) || sheet.value(0).contains_zero();
    });
  }

  /// Ends of several kinds may lie in one place.
  bool near_end_of_kind(const Point2& at, ArcEnd label) const {
    return std::any_of(junctions_.begin(), junctions_.end(), [&](const Junction& own) {
      return own.label == label && distance(own.at(), at) <= 10 * same_place * size_;
    });
  }

  /// Middles of chords are within the tolerance of the curve.
  void check_chord(const Point2& a, const Point2& b) {
    const Point2 middle = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
    const double reach = 1.5 * c_.tolerance + vertex_reach(middle);
    int open = -1;
    const std::vector<Spot> here = spots(middle, reach, open);
    if (open >= 0) return;
    if (here.empty() || !holds_zero(middle, reach))
      fail(fmt::format("a chord leaves the curve near ({}, {})", middle[0], middle[1]));
  }

  const CertificateFile& c_;
  int number_;
  const SheetCells& claim_;
  const core::StraightLine* program_;
  Sheet sheet_;
  const std::vector<int>& singular_;
  Tally& tally_;
  std::array<double, 4> box_{};
  double size_ = 0;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<Leaf> origins_;   // as the certificate has them
  std::vector<int> variables_;  // 0, 1 and those of the function's roots
  std::vector<int> parent_;
  std::vector<Junction> junctions_;
  std::vector<std::vector<End>> ends_;
  std::vector<Piece> pieces_;
  std::vector<Path> paths_;
  std::array<bool, 4> along_{};      // of the box's sides: the curve runs along it
  std::vector<bool> wanted_, kept_;  // of pieces, of paths
  std::vector<Point2> inner_of_piece_, inner_;
  std::vector<int> visits_;
  std::map<int, std::vector<std::pair<int, int>>> places_of_;  // leaf: path, step
};

}  // namespace

std::string describe(const Rectangle& cell) {
  return fmt::format("cell [{}, {}] x [{}, {}]", cell.x0, cell.x1, cell.y0, cell.y1);
}

std::vector<Chain> check_sheet(const CertificateFile& certificate, int sheet, const std::vector<int>& singular,
                               std::vector<KnownArc>& arcs, Tally& tally) {
  return SheetCheck(certificate, sheet, singular, tally).run(arcs);
}

}  // namespace clearloci::check
