#include "loci/curves/pose_gaps.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "loci/search/search.hpp"

namespace clearloci::loci::pose {
namespace {

class PoseGaps {
 public:
  PoseGaps(const core::PoseStatics& statics, PoseContours& contours, const std::vector<PoseZeroPoint>& points,
           long most_proofs)
      : statics_(statics), contours_(contours), lattice_(contours.lattice()), most_proofs_(most_proofs) {
    mark_crossed(points);
  }

  std::vector<OpenPoses> find() {
    // Blocks of cells for the threads.
    const int cells = lattice_.cells(), parts = std::min(cells, lattice_.dimension() == 2 ? 12 : 6);
    std::vector<Block> blocks{{}};
    for (std::size_t c = 0; c < lattice_.dimension(); ++c) {
      std::vector<Block> more;
      for (const Block& block : blocks)
        for (int part = 0; part < parts; ++part) {
          more.push_back(block);
          more.back().lower[c] = 1 + part * cells / parts;
          more.back().upper[c] = 1 + (part + 1) * cells / parts;
        }
      blocks = std::move(more);
    }
    std::vector<std::vector<OpenPoses>> open(blocks.size());
    run_in_order(blocks.size(), [&](std::size_t b) {
      PoseCell cell(statics_);
      prove(cell, blocks[b], open[b]);
    });
    for (std::vector<OpenPoses>& region : open)
      for (OpenPoses& one : region) join(std::move(one));
    return std::move(open_);
  }

 private:
  /// Cells of the lattice by their lower and upper indices along each coordinate.
  struct Block {
    std::array<int, 3> lower{}, upper{};
  };

  /// Cells that something passes, or that are not reached all over.
  void mark_crossed(const std::vector<PoseZeroPoint>& points) {
    crossed_.assign(lattice_.nodes(), false);
    for (std::size_t node = 0; node < lattice_.nodes(); ++node)
      crossed_[node] = lattice_.has_cell(node) && (!contours_.is_reached(node) || contours_.is_crossed(node));
    for (const PoseZeroPoint& crossed : points) crossed_[lattice_.node_below({crossed.at[0], crossed.at[1]})] = true;
  }

  void prove(PoseCell& cell, const Block& block, std::vector<OpenPoses>& open) {
    bool any_crossed = false, all_crossed = true;
    std::array<int, 3> at = block.lower;
    for (bool more = true; more;) {
      const bool crossed = crossed_[lattice_.node_at(at)];
      any_crossed = any_crossed || crossed;
      all_crossed = all_crossed && crossed;
      more = false;
      for (std::size_t c = 0; c < lattice_.dimension() && !more; ++c) {
        more = ++at[c] < block.upper[c];
        if (!more) at[c] = block.lower[c];
      }
    }
    if (all_crossed) return;
    PoseBox box;
    for (std::size_t c = 0; c < lattice_.dimension(); ++c)
      box.push_back({lattice_.place(c, block.lower[c]), lattice_.place(c, block.upper[c])});
    std::size_t longest = 0;
    for (std::size_t c = 1; c < lattice_.dimension(); ++c)
      if (block.upper[c] - block.lower[c] > block.upper[longest] - block.lower[longest]) longest = c;
    const int cells = block.upper[longest] - block.lower[longest];
    constexpr int small_enough = 4;
    if (!any_crossed && cells <= small_enough && is_free(cell, box)) return;
    if (cells == 1) {
      constexpr int halvings = 4;
      prove_finely(cell, box, halvings, open);
      return;
    }
    std::array<Block, 2> halves = {block, block};
    halves[0].upper[longest] = halves[1].lower[longest] = block.lower[longest] + cells / 2;
    for (const Block& half : halves) prove(cell, half, open);
  }

  bool is_free(PoseCell& cell, const PoseBox& box) {
    ++proofs_;
    return cell.enter(chart_, box) != CellAnswers::State::in_doubt;
  }

  void prove_finely(PoseCell& cell, const PoseBox& box, int halvings, std::vector<OpenPoses>& open) {
    const bool on_time = !contours_.late() && proofs_ < most_proofs_;
    if (on_time && is_free(cell, box)) return;
    if (halvings == 0 || !on_time) {
      OpenPoses poses;
      poses.zero = on_time ? PoseZero{cell.doubt(), cell.demand(), false} : PoseZero{};
      for (const auto& [low, high] : box) {
        poses.lower.push_back(low);
        poses.upper.push_back(high);
      }
      open.push_back(std::move(poses));
      return;
    }
    const auto axis = static_cast<std::size_t>(halvings) % box.size();
    std::array<PoseBox, 2> halves = {box, box};
    halves[0][axis][1] = halves[1][axis][0] = 0.5 * (box[axis][0] + box[axis][1]);
    for (const PoseBox& half : halves) prove_finely(cell, half, halvings - 1, open);
  }

  /// Joined with what it touches, of the same.
  void join(OpenPoses one) {
    for (OpenPoses& region : open_) {
      bool touches = region.zero == one.zero;
      for (std::size_t c = 0; c < one.lower.size(); ++c)
        touches = touches && one.lower[c] <= region.upper[c] && one.upper[c] >= region.lower[c];
      if (!touches) continue;
      for (std::size_t c = 0; c < one.lower.size(); ++c) {
        region.lower[c] = std::min(region.lower[c], one.lower[c]);
        region.upper[c] = std::max(region.upper[c], one.upper[c]);
      }
      return;
    }
    open_.push_back(std::move(one));
  }

  static PoseChart straight(std::size_t dimension) {
    PoseChart chart{Pose(dimension, 0.0), {}};
    for (std::size_t c = 0; c < dimension; ++c) {
      chart.ways.emplace_back(dimension, 0.0);
      chart.ways.back()[c] = 1;
    }
    return chart;
  }

  const core::PoseStatics& statics_;
  PoseContours& contours_;
  const PoseLattice& lattice_;
  long most_proofs_;
  std::vector<bool> crossed_;  ///< by the node below the cell
  PoseChart chart_ = straight(lattice_.dimension());
  std::atomic<long> proofs_ = 0;
  std::vector<OpenPoses> open_;
};

}  // namespace

std::vector<OpenPoses> open_poses(const core::PoseStatics& statics, PoseContours& contours,
                                  const std::vector<PoseZeroPoint>& points, long most_proofs) {
  return PoseGaps(statics, contours, points, most_proofs).find();
}

}  // namespace clearloci::loci::pose
