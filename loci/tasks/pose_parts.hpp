// Parts of the pieces that cover a task of poses, as searches over them cut them.
// Private to loci/tasks/.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "loci/tasks/pose_proof.hpp"
#include "loci/tasks/pose_region.hpp"

namespace clearloci::loci::pose {

/// The finest cells, as a part of the piece: some thousand spacings of doubles.
inline constexpr double finest = 1e-11;
struct PieceBox {
  const PosePiece* piece = nullptr;
  PoseBox box;
};

inline Pose pose_of(const PieceBox& part) { return part.piece->chart.at(middle_of(part.box)); }

/// The box around the poses of a part.
inline PoseBox poses_of(const PieceBox& part) {
  const PoseChart& chart = part.piece->chart;
  PoseBox poses;
  for (std::size_t c = 0; c < chart.base.size(); ++c) {
    auto& [low, high] = poses.emplace_back();
    low = high = chart.base[c];
    for (std::size_t p = 0; p < part.box.size(); ++p) {
      const double a = chart.ways[p][c] * part.box[p][0], b = chart.ways[p][c] * part.box[p][1];
      low += std::min(a, b);
      high += std::max(a, b);
    }
  }
  return poses;
}

/// The parameter along which a cut helps most; -1: all are too fine. One that is left far behind the others is cut
/// sometimes, since what is in doubt may depend on it in another cell.
template <class Cell>
int chosen(const Cell& cell, const PieceBox& part) {
  constexpr double share_of_width = 1e-3;
  int best = -1;
  double most = -1, total = 0;
  for (const double weighted : cell.spreads()) total += weighted;
  if (!(total > 0)) total = 1;
  for (std::size_t p = 0; p < part.box.size(); ++p) {
    const auto& whole = part.piece->box[p];
    const double width = part.box[p][1] - part.box[p][0], all = whole[1] - whole[0];
    if (!(width > finest * all) || !(width > 0x1p-50 * std::max(std::abs(whole[0]), std::abs(whole[1])))) continue;
    const double weighted = cell.spreads()[p] + share_of_width * total * width / all;
    if (weighted > most) {
      most = weighted;
      best = static_cast<int>(p);
    }
  }
  return best;
}

using loci::halves_of;
inline std::array<PieceBox, 2> halves_of(const PieceBox& part, std::size_t along) {
  auto [low, high] = halves_of(part.box, along);
  return {{{part.piece, std::move(low)}, {part.piece, std::move(high)}}};
}

/// Whether products of coordinates pay: where every coordinate has them. Of six they are but a few, take as many cells
/// and half as long again.
inline bool with_products(const PoseRegion& region) { return region.coordinates() <= Affine::curved; }

}  // namespace clearloci::loci::pose
