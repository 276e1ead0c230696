#include "loci/sheet/block_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <mutex>
#include <utility>

#include "core/errors.hpp"
#include "loci/sheet/pose_forms.hpp"

namespace clearloci::loci::pose {
namespace {

using core::BlockSheet;
using core::BlockUnknowns;

/// The steps up to the last block's.
core::PoseProgram blocks_alone(const core::PoseProgram& program) {
  core::PoseProgram pose_program = program;
  pose_program.steps.resize(static_cast<std::size_t>(program.blocks.back().end));
  return pose_program;
}

/// Halvings of the box along each of so many coordinates.
int deepest(std::size_t coordinates) {
  constexpr std::array<int, 4> of = {0, 44, 10, 6};
  return coordinates < of.size() ? of[coordinates] : 5;
}

/// Cells over the parameters of a chart.
template <class Form>
class Growth {
 public:
  Growth(const Growth&) = delete;
  Growth& operator=(const Growth&) = delete;
  Growth(const core::PoseProgram& program, PoseChart chart, PoseBox box, const BlockSheetEffort& effort)
      : program_(blocks_alone(program)),
        effort_(effort),
        chart_(std::move(chart)),
        box_(std::move(box)),
        forms_(program_),
        values_(program_) {
    nodes_.push_back({box_});
  }

  /// From a solution at parameters in the box. False where it lies at the sheet's end.
  bool grow(const std::vector<double>& at, const BlockUnknowns& unknowns) {
    const std::optional<BlockUnknowns> start = proven(at, unknowns);
    if (!start) return false;
    int leaf = leaf_at(at);
    while (!try_leaf(leaf, at, *start)) {
      if (!cut(leaf)) return false;
      leaf = leaf_at(at);
    }
    while (!queue_.empty()) {
      const int next = queue_.front();
      queue_.pop_front();
      // Cells that were not held against their neighbours cover nothing.
      if (is_over()) {
        nodes_[static_cast<std::size_t>(next)].state = State::refused;
        continue;
      }
      spread_from(next);
    }
    return true;
  }

  /// Nothing where the parameters lie in no cell.
  std::optional<BlockUnknowns> solution(const std::vector<double>& at) {
    const Node& leaf = nodes_[static_cast<std::size_t>(leaf_at(at))];
    return leaf.state == State::proven ? solution_in(leaf, at) : std::nullopt;
  }

  BlockSheet::Cover cover(std::span<const double> lower, std::span<const double> upper) const {
    using Cover = BlockSheet::Cover;
    bool any = false, all = true;
    for (std::size_t p = 0; p < box_.size(); ++p)
      if (!(lower[p] >= box_[p][0] && upper[p] <= box_[p][1])) return Cover::some;  // nothing is known beyond the box
    look(0, lower, upper, any, all);
    return all ? Cover::all : any || out_of_effort_ ? Cover::some : Cover::none;
  }

  bool complete() const {
    return std::all_of(nodes_.begin(), nodes_.end(),
                       [](const Node& node) { return node.axis >= 0 || node.state == State::proven; });
  }
  bool out_of_effort() const { return out_of_effort_; }
  bool differs() const { return differs_; }
  /// Over one coordinate: cells at the end of what is covered.
  std::vector<SheetEnd> ends() {
    std::vector<SheetEnd> all;
    for (const Node& node : nodes_)
      if (node.axis < 0 && node.state != State::open && node.state != State::proven &&
          node.box[0][1] - node.box[0][0] <= 2 * std::ldexp(box_[0][1] - box_[0][0], -deepest(1)))
        all.push_back({node.box[0][0], node.box[0][1], node.block, false});
    for (SheetEnd& end : all) end.proven = end.block == 0 && (turns_back(end, -1) || turns_back(end, 1));
    return all;
  }

 private:
  enum class State { open, tried, refused, proven };
  struct Node {
    PoseBox box;
    int axis = -1, low = -1, high = -1;
    State state = State::open;
    std::size_t block = 0;  ///< of a cell that was tried: the one that did not close
    std::vector<typename PoseForms<Form>::Unique> unique = {};
  };

  bool is_over() {
    if (cells_ > effort_.most_cells) out_of_effort_ = true;
    if (effort_.deadline && cells_ % 64 == 0 && std::chrono::steady_clock::now() >= *effort_.deadline)
      out_of_effort_ = true;
    return out_of_effort_;
  }

  int leaf_at(const std::vector<double>& at) const {
    int leaf = 0;
    while (nodes_[static_cast<std::size_t>(leaf)].axis >= 0) {
      const Node& node = nodes_[static_cast<std::size_t>(leaf)];
      const auto axis = static_cast<std::size_t>(node.axis);
      leaf = at[axis] < nodes_[static_cast<std::size_t>(node.low)].box[axis][1] ? node.low : node.high;
    }
    return leaf;
  }

  void look(int index, std::span<const double> lower, std::span<const double> upper, bool& any, bool& all) const {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    for (std::size_t p = 0; p < node.box.size(); ++p) {
      const auto& [low, high] = node.box[p];
      if (upper[p] < low || lower[p] > high) return;
      // Cells that share a face with the box alone have none of its poses but there.
      if (lower[p] < upper[p] && (upper[p] <= low || lower[p] >= high)) return;
    }
    if (node.axis >= 0) {
      look(node.low, lower, upper, any, all);
      look(node.high, lower, upper, any, all);
      return;
    }
    any = any || node.state != State::open;
    all = all && node.state == State::proven;
  }

  /// A solution at single parameters, with a proof that it is one.
  std::optional<BlockUnknowns> proven(const std::vector<double>& at, BlockUnknowns unknowns) {
    const Pose pose = chart_.at(at);
    if (!values_.close(pose, unknowns)) return std::nullopt;
    if (forms_.run({pose, {}}, {}, unknowns) != PoseForms<Form>::Outcome::complete) return std::nullopt;
    const double size = core::size_of(program_, unknowns);
    std::size_t k = 0;
    for (const core::PoseProgram::Block& block : program_.blocks)
      for (const int step : block.unknowns) {
        const Form& form = forms_[step];
        if (!(std::abs(form.c - unknowns[k++]) + form.radius() < BlockSheet::accuracy * size)) return std::nullopt;
      }
    return unknowns;
  }

  /// Whether a proven solution at parameters of a cell is the only one that it has there.
  bool holds(const Node& cell, const std::vector<double>& at, const BlockUnknowns& unknowns) const {
    const double size = core::size_of(program_, unknowns);
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const auto& [middle, radius] = cell.unique[k];
      if (!(std::abs(value(middle, cell.box, at) - unknowns[k]) + 2 * BlockSheet::accuracy * size < radius))
        return false;
    }
    return true;
  }

  /// Of c + a e + b e e, to some roundings.
  static double value(const Form& form, const PoseBox& box, const std::vector<double>& at) {
    std::array<double, Form::noises> e{};
    for (std::size_t p = 0; p < box.size(); ++p) {
      const double middle = box[p][0] + 0.5 * (box[p][1] - box[p][0]), half = 0.5 * (box[p][1] - box[p][0]);
      e[p] = half > 0 ? std::clamp((at[p] - middle) / half, -1.0, 1.0) : 0;
    }
    double sum = form.c;
    for (std::size_t p = 0; p < Form::noises; ++p) sum += form.a[p] * e[p];
    if constexpr (Form::products > 0) {
      for (std::size_t p = 0; p < 3; ++p) sum += form.b[p] * e[p] * e[p];
      sum += form.b[3] * e[0] * e[1] + form.b[4] * e[0] * e[2] + form.b[5] * e[1] * e[2];
    }
    return sum;
  }

  std::optional<BlockUnknowns> solution_in(const Node& cell, const std::vector<double>& at) {
    BlockUnknowns guess;
    for (const auto& side : cell.unique) guess.push_back(value(side.middle, cell.box, at));
    std::optional<BlockUnknowns> found = proven(at, std::move(guess));
    return found && holds(cell, at, *found) ? found : std::nullopt;
  }

  /// Whether a leaf has one solution everywhere, that of a neighbour's at parameters of both.
  bool try_leaf(int index, const std::vector<double>& at, const BlockUnknowns& unknowns) {
    ++cells_;
    Node& leaf = nodes_[static_cast<std::size_t>(index)];
    BlockUnknowns start = unknowns;
    const std::vector<double> middle = middle_of(leaf.box);
    if (!values_.close(chart_.at(middle), start)) return false;
    if (forms_.run(chart_, leaf.box, start) != PoseForms<Form>::Outcome::complete) {
      std::size_t closed = forms_.unique().size();
      for (leaf.block = 0; leaf.block + 1 < program_.blocks.size(); ++leaf.block) {
        if (closed < program_.blocks[leaf.block].unknowns.size()) break;
        closed -= program_.blocks[leaf.block].unknowns.size();
      }
      return false;
    }
    leaf.unique = forms_.unique();
    if (!holds(leaf, at, unknowns)) {
      leaf.unique.clear();
      return false;
    }
    leaf.state = State::proven;
    queue_.push_back(index);
    return true;
  }

  /// Whether the sheet, which covers what lies before a cell (`side` -1) or behind it, goes on there as a curve in q
  /// and u on which det J has another sign a little farther on: then it vanishes between the two, at a dead centre.
  bool turns_back(SheetEnd& end, int side) {
    const core::PoseProgram::Block& block = program_.blocks.front();
    if (block.rates.empty()) return false;
    const double width = end.upper - end.lower, edge = side < 0 ? end.lower : end.upper;
    const auto at = [&](double apart) { return solution({edge + side * apart}); };
    // Next to the end itself rounding leaves no proof of a solution.
    std::optional<BlockUnknowns> last;
    constexpr double nearby = 1e-6;
    for (double apart = width; !last && apart < nearby * (box_[0][1] - box_[0][0]); apart *= 8) last = at(apart);
    if (!last) return false;
    const std::size_t n = block.unknowns.size();
    for (const double part : {1e-8, 1e-7, 1e-6, 1e-4}) {
      const double apart = part * (box_[0][1] - box_[0][0]);
      const std::optional<BlockUnknowns> first = at(apart);
      if (!first) continue;
      std::size_t k = 0;
      for (std::size_t j = 0; j < n; ++j)
        if (std::abs((*last)[j] - (*first)[j]) > std::abs((*last)[k] - (*first)[k])) k = j;
      const double half = std::abs((*last)[k] - (*first)[k]);
      if (!(half > 0) || !is_curve_with_two_signs(edge, edge + side * apart, *first, *last, k, half)) continue;
      (side < 0 ? end.upper : end.lower) =
          side < 0 ? std::max(end.upper, farthest_[1]) : std::min(end.lower, farthest_[0]);
      return true;
    }
    return false;
  }

  bool is_curve_with_two_signs(double q, double q_first, const BlockUnknowns& first, const BlockUnknowns& last,
                               std::size_t k, double half) {
    const std::size_t n = program_.blocks.front().unknowns.size();
    const std::span<const double> start(last.data(), n);
    if (!forms_.turn(q, start, k, half)) return false;
    const std::vector<typename PoseForms<Form>::Unique> curve = forms_.turned();
    farthest_ = {forms_.turned_coordinate().lower(), forms_.turned_coordinate().upper()};
    const double way = first[k] < last[k] ? -1 : 1;
    // Where the first solution is on the curve, and what lies as far on the other side.
    BlockUnknowns other(n);
    double q_other = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const auto& [middle, radius] = curve[j];
      const double here = middle.c + way * middle.a[0] + (Form::products > 0 ? middle.b[0] : 0),
                   there = middle.c - way * middle.a[0] + (Form::products > 0 ? middle.b[0] : 0);
      const double slope = j == k ? q_first : first[j];
      if (!(std::abs(here - slope) + 0.1 * radius < radius)) return false;
      (j == k ? q_other : other[j]) = there;
    }
    other[k] = last[k] - way * half;
    if (!forms_.turn(q_other, other, k, 0)) return false;
    for (std::size_t j = 0; j < n; ++j) {
      const Form& form = forms_.turned()[j].middle;
      const double there =
          curve[j].middle.c - way * curve[j].middle.a[0] + (Form::products > 0 ? curve[j].middle.b[0] : 0);
      if (!(std::abs(form.c - there) + 0.1 * curve[j].radius < curve[j].radius)) return false;
    }
    const int beyond = forms_.orientation();
    if (forms_.run({{q_first}, {}}, {}, first) != PoseForms<Form>::Outcome::complete) return false;
    return beyond * forms_.orientation() < 0;
  }

  bool cut(int index) {
    const PoseBox box = nodes_[static_cast<std::size_t>(index)].box;
    std::size_t axis = 0;
    double widest = -1;
    for (std::size_t p = 0; p < box.size(); ++p) {
      const double whole = box_[p][1] - box_[p][0], part = whole > 0 ? (box[p][1] - box[p][0]) / whole : 0;
      if (part > widest) widest = part, axis = p;
    }
    const double middle = 0.5 * (box[axis][0] + box[axis][1]);
    if (!(widest > std::ldexp(1.0, -deepest(box.size()))) || !(box[axis][0] < middle && middle < box[axis][1]))
      return false;
    Node low{box}, high{box};
    low.box[axis][1] = high.box[axis][0] = middle;
    Node& node = nodes_[static_cast<std::size_t>(index)];
    node.axis = static_cast<int>(axis);
    node.low = static_cast<int>(nodes_.size());
    node.high = node.low + 1;
    nodes_.push_back(std::move(low));
    nodes_.push_back(std::move(high));
    return true;
  }

  /// Over every face of a proven cell.
  void spread_from(int index) {
    for (std::size_t p = 0; p < box_.size(); ++p)
      for (const std::size_t side : {0U, 1U}) {
        if (nodes_[static_cast<std::size_t>(index)].state != State::proven) return;
        PoseBox face = nodes_[static_cast<std::size_t>(index)].box;
        const double at = face[p][side];
        face[p] = {at, at};
        if (at > box_[p][0] && at < box_[p][1]) {
          meet(0, index, {face, p, side});
        } else if (p < effort_.turns.size() && effort_.turns[p]) {
          const double turned = box_[p][1 - side];
          face[p] = {turned, turned};
          meet(0, index, {face, p, side, turned - at});
        }
      }
  }

  /// Of a cell's box, across an axis.
  struct Face {
    PoseBox box;
    std::size_t axis = 0, side = 0;
    double turned = 0;  ///< at the box's end: how far the face lies from the cell's own, a turn before or behind it
  };

  /// A cell's solution at a face beyond which the sheet may go on.
  std::optional<BlockUnknowns> solution_at(int cell, const Face& face, std::vector<double> at) {
    const std::vector<double> there = at;
    at[face.axis] -= face.turned;
    std::optional<BlockUnknowns> found = solution_in(nodes_[static_cast<std::size_t>(cell)], at);
    return found && face.turned != 0 ? proven(there, std::move(*found)) : found;
  }

  /// The leaves beyond a face.
  void meet(int index, int from, const Face& beyond) {
    const auto& [face, axis, side, turned] = beyond;
    const PoseBox box = nodes_[static_cast<std::size_t>(index)].box;
    PoseBox common = face;
    for (std::size_t p = 0; p < box.size(); ++p) {
      common[p] = {std::max(face[p][0], box[p][0]), std::min(face[p][1], box[p][1])};
      if (p == axis ? common[p][0] > common[p][1] : !(common[p][0] < common[p][1]) && face[p][0] < face[p][1]) return;
      if (common[p][0] > common[p][1]) return;
    }
    const double at = face[axis][0];
    if (side == 1 ? box[axis][1] <= at : box[axis][0] >= at) return;
    if (nodes_[static_cast<std::size_t>(index)].axis >= 0) {
      const int low = nodes_[static_cast<std::size_t>(index)].low, high = nodes_[static_cast<std::size_t>(index)].high;
      meet(low, from, beyond);
      meet(high, from, beyond);
      return;
    }
    if (side == 1 ? box[axis][0] < at : box[axis][1] > at) return;  // the cell itself
    if (nodes_[static_cast<std::size_t>(index)].state == State::refused) return;
    const std::vector<double> middle = middle_of(common);
    const std::optional<BlockUnknowns> start = solution_at(from, beyond, middle);
    if (nodes_[static_cast<std::size_t>(index)].state == State::proven) {
      if (start && holds(nodes_[static_cast<std::size_t>(index)], middle, *start)) return;
      // Two layers, or not told: neither covers what it may not.
      differs_ = true;
      for (const int step : {index, from}) nodes_[static_cast<std::size_t>(step)].state = State::refused;
      return;
    }
    if (start && try_leaf(index, middle, *start)) return;
    if (cut(index)) return meet(index, from, beyond);
    // Of the finest cells those that two neighbours could not enter are not tried again.
    State& state = nodes_[static_cast<std::size_t>(index)].state;
    state = state == State::tried ? State::refused : State::tried;
  }

  core::PoseProgram program_;
  BlockSheetEffort effort_;
  PoseChart chart_;
  PoseBox box_;
  PoseForms<Form> forms_;
  core::PoseValues values_;
  std::vector<Node> nodes_;
  std::deque<int> queue_;
  long cells_ = 0;
  bool out_of_effort_ = false, differs_ = false;
  std::array<double, 2> farthest_{};  ///< that the curve looked at last leads along q
};

/// The solution at the other end of the straight way between two poses, on which J is regular.
std::optional<BlockUnknowns> led_along(const core::PoseProgram& program, const Pose& from,
                                       const BlockUnknowns& unknowns, const Pose& to, const BlockSheetEffort& effort) {
  Pose way = to;
  for (std::size_t c = 0; c < way.size(); ++c) way[c] -= from[c];
  Growth<Affine> along(program, {from, {way}}, {{0, 1}}, effort);
  if (!along.grow({0}, unknowns)) return std::nullopt;
  return along.solution({1});
}

template <class Form>
CoveredBox covered(const core::PoseProgram& program, const Pose& lower, const Pose& upper,
                   const BlockSheetEffort& effort) {
  CoveredBox result;
  const std::size_t n = lower.size();
  PoseChart chart{Pose(n, 0.0), {}};
  PoseBox box;
  Pose start = program.near;
  for (std::size_t c = 0; c < n; ++c) {
    Pose way(n, 0.0);
    way[c] = 1;
    chart.ways.push_back(way);
    box.push_back({lower[c], upper[c]});
    start[c] = std::clamp(start[c], lower[c], upper[c]);
  }
  result.finest = std::ldexp(1.0, -deepest(n));
  std::optional<BlockUnknowns> unknowns = BlockUnknowns{};
  for (const core::PoseProgram::Block& block : program.blocks)
    unknowns->insert(unknowns->end(), block.near.begin(), block.near.end());
  if (start != program.near) unknowns = led_along(program, program.near, *unknowns, start, effort);
  struct Shared {
    Shared(const core::PoseProgram& pose_program, const PoseChart& over, const PoseBox& within,
           const BlockSheetEffort& most)
        : growth(pose_program, over, within, most) {}
    std::mutex mutex;
    Growth<Form> growth;
  };
  auto shared = std::make_shared<Shared>(program, chart, box, effort);
  result.starts = unknowns && shared->growth.grow(start, *unknowns);
  result.complete = result.starts && shared->growth.complete();
  result.out_of_effort = shared->growth.out_of_effort();
  result.differs = shared->growth.differs();
  if (n == 1) result.ends = shared->growth.ends();
  result.sheet.start = [shared](std::span<const double> pose) -> std::optional<BlockUnknowns> {
    const std::lock_guard lock(shared->mutex);
    return shared->growth.solution({pose.begin(), pose.end()});
  };
  result.sheet.cover = [shared](std::span<const double> from, std::span<const double> to) {
    return shared->growth.cover(from, to);
  };
  return result;
}

}  // namespace

CoveredBox cover_box(const core::PoseProgram& program, const Pose& lower, const Pose& upper,
                     const BlockSheetEffort& effort) {
  core::ensure(!program.blocks.empty() && program.near.size() == lower.size(), "a program with blocks, over its pose");
  return lower.size() <= Affine::curved ? covered<Affine>(program, lower, upper, effort)
                                        : covered<FlatAffine>(program, lower, upper, effort);
}

}  // namespace clearloci::loci::pose
