#include "loci/search/cell_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "loci/search/cut_angle.hpp"
#include "loci/search/second_look.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

namespace {

// Cuts stay near the middle but off it, since designs are symmetric and curves like to touch or cross middles.
constexpr double most_offset = 0.06;
// A cell is not made more slender than this. Enclosures over a long cell may be so wide, or infinite, that they vary
// most along the axis that was cut all the time.
constexpr double most_slender = 32;
// Below this size, relative to the patch, multi-precision is worth its price where rounding is what hides a sign, and
// so are plain enclosures where second-order ones tell nothing.
constexpr double worth_precision = 1e-4;
constexpr int cells_between_stops = 256;
// Enough that what is left of them after a first look fills batches again.
constexpr std::size_t cells_at_a_time = 64;
// Where cells cannot be decided, as along a double curve, halving all of them twice doubles their number. Where there
// are no more than this many for each that there was, enclosures have begun to tell, and the budget is so many times as
// large. Where it has run out once, what is left open stays so, and the rest is worth no more than the budget itself.
constexpr double growth_in_sight = 1.7;
constexpr int extended_budget = 12;

// Around places where a curve is hard to tell there are a few cells of every size. Thousands smaller than this,
// relative to the patch, are along a double curve, or what is one to rounding: they tell nothing more.
constexpr double tiny = 1e-7;
constexpr int most_tiny_cells = 4000;

/// A fixed sequence that looks random: in [-1, 1].
double scatter(unsigned index, unsigned attempt) {
  std::uint64_t z = (std::uint64_t{index} << 8 | attempt) + 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

/// The budget, while cells are examined generation by generation: the children of all cells that one of them left.
class Budget {
 public:
  explicit Budget(const TreeOptions& options)
      : most_cells_(static_cast<std::size_t>(options.most_cells)), may_extend_(options.extended) {}

  /// Before cell `next` is examined, of `all` that there are.
  void reach(std::size_t next, std::size_t all) {
    if (next < end_of_generation_) return;
    const std::size_t generation = all - next;
    in_sight_ = may_extend_ && static_cast<double>(generation) <= growth_in_sight * static_cast<double>(last_but_one_);
    last_but_one_ = last_;
    last_ = generation;
    end_of_generation_ = all;
  }
  bool allows(std::size_t all) {
    const bool allowed = all < (in_sight_ ? extended_budget : 1) * most_cells_;
    may_extend_ = may_extend_ && allowed;
    in_sight_ = in_sight_ && allowed;
    return allowed;
  }

 private:
  std::size_t most_cells_, end_of_generation_ = 0, last_ = 0, last_but_one_ = 0;
  bool may_extend_, in_sight_ = false;
};

struct Judgement {
  LeafKind kind = LeafKind::undecided;
  int along = 0;
  int cut_axis = 0;
  std::uint32_t rim = 0;  ///< bit j: Q_j = 0 may pass through the cell
};

/// Which axis makes the value vary more over the cell: cutting it gains most.
int steeper_axis(const SheetCell& cell) {
  double variation[2];
  for (const int v : {0, 1}) variation[v] = cell.slope(0, v).magnitude() * cell.local(v).width();
  for (std::size_t l = 0; l < cell.lifted().size(); ++l) {
    const int c = 2 + static_cast<int>(l);
    const double whole = cell.slope(0, c).magnitude() * cell.local(c).width();
    double share[2];
    for (const int v : {0, 1}) share[v] = cell.bond_slope(static_cast<int>(l), v).magnitude() * cell.local(v).width();
    const double sum = share[0] + share[1];
    for (const int v : {0, 1}) variation[v] += sum > 0 ? whole * share[v] / sum : 0;
  }
  return variation[0] >= variation[1] ? 0 : 1;
}

/// What second-order enclosures tell of a cell. False: plain ones may tell more. Near a rim they do on tiny cells: the
/// slopes of a root are steep there and cancel in the chain rule, which is applied once, but not step by step.
bool judge_smoothly(const SmoothCells& cells, std::size_t lane, bool is_tiny, Judgement& judgement) {
  if (cells.place(lane) == SmoothCell::Standing::outside || cells.excludes(lane, 0)) {
    judgement.kind = LeafKind::empty;
    return true;
  }
  if (cells.place(lane) == SmoothCell::Standing::unknown) return false;
  judgement.cut_axis = cells.slope(lane, 0).magnitude() >= cells.slope(lane, 1).magnitude() ? 0 : 1;
  double best = 0;
  for (const int along : {0, 1}) {
    const Interval& slope = cells.slope(lane, 1 - along);
    if (slope.sign() == 0 || slope.mignitude() / slope.magnitude() <= best) continue;
    best = slope.mignitude() / slope.magnitude();
    judgement.kind = LeafKind::graph;
    judgement.along = along;
  }
  return judgement.kind != LeafKind::undecided || (!is_tiny && cells.is_far_from_rims(lane));
}

/// Judges cells a group at a time, for which enclosures are computed side by side: what is told of one does not depend
/// on the others.
class Judge {
 public:
  Judge(const SheetProgram& program, const core::WorkingMode& mode, double patch_size)
      : program_(program), mode_(mode), side_by_side_(program, mode), patch_size_(patch_size) {
    if (!is_smooth_worthwhile(program)) return;
    smooth_.emplace(program, mode);
    rims_.emplace(program);
  }

  /// From now on with regard to where angles are cut.
  void look_beside_cuts() { cuts_ = cut_angles(program_, mode_); }

  /// From now on by second-order enclosures too.
  void look_closer() {
    if (!smooth_ && is_second_look_worthwhile(program_)) smooth_.emplace(program_, mode_);
  }

  std::vector<Judgement> operator()(const std::vector<PlaneCell>& cells) {
    cells_ = &cells;
    judgements_.assign(cells.size(), {});
    std::vector<std::size_t> all(cells.size()), rest;
    std::iota(all.begin(), all.end(), std::size_t{0});
    for_each_batch(all, [&](const std::vector<std::size_t>& batch) {
      std::vector<std::size_t> open;
      for (std::size_t lane = 0; lane < batch.size(); ++lane)
        if (!judge_by_value(lane, batch[lane])) open.push_back(batch[lane]);
      // A full batch goes on as it stands, others are filled first.
      if (open.size() == SheetCells::size && !smooth_)
        judge_by_slopes(open);
      else
        rest.insert(rest.end(), open.begin(), open.end());
    });
    if (smooth_) rest = left_by_smooth_judgement(rest);
    for_each_batch(rest, [&](const std::vector<std::size_t>& batch) { judge_by_slopes(batch); });
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (judgements_[i].kind == LeafKind::undecided && !cuts_.empty() && is_excluded_beside_cut(cells[i]))
        judgements_[i].kind = LeafKind::empty;
    return std::move(judgements_);
  }

 private:
  template <class Use>
  void for_each_batch(const std::vector<std::size_t>& cells, const Use& use) {
    std::array<SheetCells::Target, SheetCells::size> places;
    std::array<std::array<Interval, 2>, SheetCells::size> ranges;
    for (std::size_t first = 0; first < cells.size(); first += SheetCells::size) {
      const std::size_t count = std::min(SheetCells::size, cells.size() - first);
      for (std::size_t lane = 0; lane < count; ++lane) {
        const PlaneCell& cell = (*cells_)[cells[first + lane]];
        ranges[lane] = {cell.x, cell.y};
        places[lane] = {ranges[lane]};
      }
      side_by_side_.enter(places, count);
      use({cells.begin() + static_cast<std::ptrdiff_t>(first),
           cells.begin() + static_cast<std::ptrdiff_t>(first + count)});
    }
  }

  bool is_excluded_beside_cut(const PlaneCell& cell) {
    return std::any_of(cuts_.begin(), cuts_.end(), [&](CutAngle& cut) { return cut.excludes(cell); });
  }

  bool is_tiny(const PlaneCell& cell) const {
    return std::max(cell.x.width(), cell.y.width()) < worth_precision * patch_size_;
  }

  /// Those of which second-order enclosures do not tell all there is to tell.
  std::vector<std::size_t> left_by_smooth_judgement(const std::vector<std::size_t>& cells) {
    std::vector<std::size_t> left;
    std::array<std::array<Interval, 2>, SmoothCells::size> ranges;
    for (std::size_t first = 0; first < cells.size(); first += SmoothCells::size) {
      const std::size_t count = std::min(SmoothCells::size, cells.size() - first);
      for (std::size_t lane = 0; lane < count; ++lane) {
        const PlaneCell& cell = (*cells_)[cells[first + lane]];
        ranges[lane] = {cell.x, cell.y};
      }
      smooth_->enter(ranges, count);
      for (std::size_t lane = 0; lane < count; ++lane) {
        const std::size_t index = cells[first + lane];
        if (!judge_smoothly(*smooth_, lane, is_tiny((*cells_)[index]), judgements_[index])) left.push_back(index);
      }
    }
    return left;
  }

  /// By plain enclosures of values. False: others may tell more.
  bool judge_by_value(std::size_t lane, std::size_t index) {
    Judgement& judgement = judgements_[index];
    SheetCell& cell = side_by_side_[lane];
    if (!side_by_side_.inside(lane) || !cell.value(0).contains_zero()) {
      judgement.kind = LeafKind::empty;
      return true;
    }
    for (int j = 0; j < program_.roots(); ++j)
      if (cell.square(j).contains_zero()) judgement.rim |= 1u << j;
    return false;
  }

  /// Of the cells that side_by_side_ has entered.
  void judge_by_slopes(const std::vector<std::size_t>& batch) {
    side_by_side_.differentiate();
    std::array<const SheetCell*, RimCells::size> at_rims{};
    std::array<Judgement*, RimCells::size> open{};
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < batch.size(); ++lane) {
      Judgement& judgement = judgements_[batch[lane]];
      judge_by_slopes(side_by_side_[lane], is_tiny((*cells_)[batch[lane]]), judgement);
      if (judgement.kind != LeafKind::undecided || !rims_) continue;
      at_rims[count] = &side_by_side_[lane];
      open[count++] = &judgement;
    }
    if (count == 0) return;
    rims_->enter(at_rims, count);
    for (std::size_t lane = 0; lane < count; ++lane) judge_at_rim(lane, *open[lane]);
  }

  void judge_at_rim(std::size_t lane, Judgement& judgement) {
    const RimCells::Standing place = rims_->place(lane);
    if (place == RimCells::Standing::unknown) return;
    if (place == RimCells::Standing::outside || rims_->excludes(lane))
      judgement.kind = LeafKind::empty;
    else
      take_steadiest([&](int c) { return rims_->tangent(lane, c); }, {rims_->lifted(lane)}, judgement);
  }

  /// The coordinate along which the curve runs most steadily, if it is proven to run along any.
  template <class Tangent>
  static void take_steadiest(const Tangent& tangent_along, const std::vector<int>& lifted, Judgement& judgement) {
    double best = 0;
    for (int c = 0; c < 2 + static_cast<int>(lifted.size()); ++c) {
      const Interval tangent = tangent_along(c);
      if (tangent.sign() == 0) continue;
      const double steadiness = tangent.mignitude() / tangent.magnitude();
      if (steadiness <= best) continue;
      best = steadiness;
      judgement.kind = LeafKind::graph;
      judgement.along = c < 2 ? c : 2 + lifted[static_cast<std::size_t>(c - 2)];
    }
  }

  static void judge_by_slopes(SheetCell& cell, bool is_tiny, Judgement& judgement) {
    if (!cell.centred(0).contains_zero() || cell.is_beyond_a_rim()) {
      judgement.kind = LeafKind::empty;
      return;
    }
    take_steadiest([&](int c) { return cell.tangent(0, c); }, cell.lifted(), judgement);
    if (judgement.kind == LeafKind::undecided && is_tiny && cell.rounding_dominates(0)) {
      cell.sharpen_middle();
      if (!cell.centred(0).contains_zero()) {
        judgement.kind = LeafKind::empty;
        return;
      }
    }
    judgement.cut_axis = steeper_axis(cell);
  }

  const SheetProgram& program_;
  const core::WorkingMode& mode_;
  SheetCells side_by_side_;
  std::optional<SmoothCells> smooth_;
  std::optional<RimCells> rims_;
  std::deque<CutAngle> cuts_;
  double patch_size_;
  const std::vector<PlaneCell>* cells_ = nullptr;
  std::vector<Judgement> judgements_;
};

bool is_in_hole(const PlaneCell& cell, const TreeOptions& options) {
  return std::any_of(options.holes.begin(), options.holes.end(), [&](const auto& hole) {
    return hole[0] <= cell.x.lower() && cell.x.upper() <= hole[1] && hole[2] <= cell.y.lower() &&
           cell.y.upper() <= hole[3];
  });
}

}  // namespace

CellTree::CellTree(const SheetProgram& program, const core::WorkingMode& mode, const PlaneCell& domain,
                   TreeOptions options) {
  nodes_.push_back({domain});
  smallest_ = options.smallest * std::max(domain.x.width(), domain.y.width());
  build(program, mode, options);
}

void CellTree::build(const SheetProgram& program, const core::WorkingMode& mode, const TreeOptions& options) {
  const double size = std::max(domain().x.width(), domain().y.width());
  int tiny_cells = 0;
  Judge judge(program, mode, size);
  if (options.second_look) judge.look_beside_cuts();
  std::vector<Judgement> ahead;  // of the next cells that are to be judged, in reverse
  const auto judgement_of = [&](std::size_t index) {
    if (ahead.empty()) {
      if (options.second_look && nodes_.size() > many_cells) judge.look_closer();
      std::vector<PlaneCell> cells;
      for (std::size_t k = index; k < nodes_.size() && cells.size() < cells_at_a_time; ++k)
        if (Node node = nodes_[k]; !is_in_hole(node.cell, options) && !cut_at_hole(node, options))
          cells.push_back(node.cell);
      ahead = judge(cells);
      std::reverse(ahead.begin(), ahead.end());
    }
    const Judgement next = ahead.back();
    ahead.pop_back();
    return next;
  };
  bool stopped = false;
  Budget budget(options);
  // Breadth first: a budget that runs out leaves cells of one size undecided instead of one corner.
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Node node = nodes_[i];
    budget.reach(i, nodes_.size());
    if (options.stop && i % cells_between_stops == 0) stopped = stopped || options.stop();
    Leaf leaf{node.cell};
    bool split = false;
    if (is_in_hole(node.cell, options)) {
      leaf.kind = LeafKind::hole;
    } else if (cut_at_hole(node, options)) {
      split = true;
    } else {
      const Judgement judgement = judgement_of(i);
      leaf.kind = judgement.kind;
      leaf.along = judgement.along;
      const double widths[2] = {node.cell.x.width(), node.cell.y.width()};
      const bool divisible = judgement.kind == LeafKind::undecided && std::max(widths[0], widths[1]) > smallest_;
      if (std::max(widths[0], widths[1]) < tiny * size) ++tiny_cells;
      const bool may_split = divisible && !stopped && tiny_cells < most_tiny_cells && budget.allows(nodes_.size());
      cut_short_ = cut_short_ || (divisible && !may_split);
      if (may_split) {
        split = true;
        const int cut_axis = judgement.cut_axis, other = 1 - cut_axis;
        node.axis = widths[cut_axis] > smallest_ && most_slender * widths[cut_axis] > widths[other] ? cut_axis : other;
        const Interval& range = node.axis == 0 ? node.cell.x : node.cell.y;
        const double offset = most_offset * scatter(static_cast<unsigned>(i), options.attempt);
        node.cut = range.lower() + range.width() * (0.5 + offset);
      }
      if (!split && leaf.kind != LeafKind::empty) leaf.rim = judgement.rim;
    }
    if (split) {
      PlaneCell halves[2] = {node.cell, node.cell};
      if (node.axis == 0) {
        halves[0].x = {node.cell.x.lower(), node.cut};
        halves[1].x = {node.cut, node.cell.x.upper()};
      } else {
        halves[0].y = {node.cell.y.lower(), node.cut};
        halves[1].y = {node.cut, node.cell.y.upper()};
      }
      for (const int side : {0, 1}) {
        node.child[side] = static_cast<int>(nodes_.size());
        nodes_.push_back({halves[side]});
      }
    } else {
      node.leaf = static_cast<int>(leaves_.size());
      leaves_.push_back(leaf);
    }
    nodes_[i] = node;
  }
}

/// Chooses a cut along a hole's side that runs through the node, if there is one.
bool CellTree::cut_at_hole(Node& node, const TreeOptions& options) const {
  for (const auto& hole : options.holes) {
    const Interval x(hole[0], hole[1]), y(hole[2], hole[3]);
    const auto overlap = [](const Interval& a, const Interval& b) {
      return a.lower() < b.upper() && b.lower() < a.upper();
    };
    if (!overlap(x, node.cell.x) || !overlap(y, node.cell.y)) continue;
    for (int side = 0; side < 4; ++side) {
      const Interval& range = side < 2 ? node.cell.x : node.cell.y;
      if (range.lower() < hole[side] && hole[side] < range.upper()) {
        node.axis = side < 2 ? 0 : 1;
        node.cut = hole[side];
        return true;
      }
    }
  }
  return false;
}

std::vector<Seam> CellTree::seams() const {
  std::vector<Seam> result;
  seams_inside(0, result);
  return result;
}

void CellTree::seams_inside(int index, std::vector<Seam>& result) const {
  const Node& node = nodes_[index];
  if (node.axis < 0) return;
  seams_inside(node.child[0], result);
  seams_inside(node.child[1], result);
  seams_between(node.child[0], node.child[1], node.axis, node.cut, result);
}

void CellTree::seams_between(int lower, int upper, int axis, double at, std::vector<Seam>& result) const {
  const Node &a = nodes_[lower], &b = nodes_[upper];
  const auto across = [&](const Node& node) { return axis == 0 ? node.cell.y : node.cell.x; };
  if (across(a).upper() <= across(b).lower() || across(b).upper() <= across(a).lower()) return;
  if (a.axis >= 0) {
    if (a.axis == axis) return seams_between(a.child[1], upper, axis, at, result);
    seams_between(a.child[0], upper, axis, at, result);
    seams_between(a.child[1], upper, axis, at, result);
    return;
  }
  if (b.axis >= 0) {
    if (b.axis == axis) return seams_between(lower, b.child[0], axis, at, result);
    seams_between(lower, b.child[0], axis, at, result);
    seams_between(lower, b.child[1], axis, at, result);
    return;
  }
  const double from = std::max(across(a).lower(), across(b).lower());
  const double to = std::min(across(a).upper(), across(b).upper());
  result.push_back({a.leaf, b.leaf, axis, at, from, to});
}

int CellTree::locate(const Interval& x, const Interval& y) const {
  int index = 0;
  while (nodes_[index].axis >= 0) {
    const Node& node = nodes_[index];
    const Interval& place = node.axis == 0 ? x : y;
    if (place.upper() < node.cut)
      index = node.child[0];
    else if (node.cut < place.lower())
      index = node.child[1];
    else
      return -1;
  }
  return nodes_[index].leaf;
}

int CellTree::locate_at(int axis, double at, int side, const Interval& other) const {
  int index = 0;
  while (nodes_[index].axis >= 0) {
    const Node& node = nodes_[index];
    if (node.axis == axis) {
      index = node.child[side < 0 ? (at <= node.cut ? 0 : 1) : (at >= node.cut ? 1 : 0)];
    } else {
      if (other.upper() < node.cut)
        index = node.child[0];
      else if (node.cut < other.lower())
        index = node.child[1];
      else
        return -1;
    }
  }
  return nodes_[index].leaf;
}

std::vector<core::CellNode> CellTree::preorder(const std::vector<int>& ends) const {
  using Kind = core::CellNode::Kind;
  std::vector<core::CellNode> result;
  std::vector<int> next = {0};
  while (!next.empty()) {
    const Node& node = nodes_[next.back()];
    next.pop_back();
    if (node.axis >= 0) {
      result.push_back({Kind::cut, node.axis, node.cut, 0});
      next.push_back(node.child[1]);
      next.push_back(node.child[0]);
      continue;
    }
    const Leaf& leaf = leaves_[node.leaf];
    if (leaf.kind == LeafKind::graph)
      result.push_back({Kind::graph, leaf.along, 0, ends[node.leaf]});
    else
      result.push_back({leaf.kind == LeafKind::empty ? Kind::free : Kind::open, 0, 0, 0});
  }
  return result;
}

}  // namespace clearloci::loci::sheet
