// A box cut into cells until little is in doubt: each cell is proven free of loci, proven out of reach, or in doubt but
// for the parts on both sides of what may vanish in it (pose_cell.hpp, half_space.hpp).
// Private to loci/zones.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <memory>
#include <vector>

#include "loci/search/search.hpp"
#include "loci/zones/cell_zones.hpp"

namespace clearloci::loci::pose {

struct ZoneCell {
  enum class Kind { in_doubt, free, outside, cut };
  Kind kind = Kind::in_doubt;
  PoseBox box;
  int axis = -1;  ///< along which it is cut, or would be
  std::array<std::size_t, 2> halves{};
  PoseCell::Signs signs;
  std::vector<std::pair<Doubt, int>> open;             ///< what may vanish in it
  std::unique_ptr<std::array<HalfSpace, 2>> parts;     ///< of a cell in doubt that has any
  std::unique_ptr<std::array<PoseCell::Signs, 2>> of;  ///< their signs
  bool beyond = false;                                 ///< the second part is out of reach

  double size() const;
  /// What is in doubt.
  double doubt() const;
};

class ZoneCells {
 public:
  ZoneCells(const core::PoseStatics& statics, const Pose& lower, const Pose& upper, const CellZoneEffort& effort);

  /// Largest doubts first, many at a time.
  void subdivide();

  const std::vector<ZoneCell>& cells() const { return cells_; }
  const PoseBox& box() const { return box_; }
  long looked_at() const { return looked_at_; }
  bool out_of_time() const { return out_of_time_; }
  /// The leaf that holds a pose of the box.
  std::size_t leaf_at(const Pose& pose) const;
  /// Of every demand of one component and of |A| at a pose; none where there is no posture.
  PoseCell::Signs signs_at(const Pose& pose);

  /// Calls `meet(a, b, axis)` for leaves that share a part of a face, `a` below `b` along the axis.
  template <class Meet>
  void faces(const Meet& meet) const {
    for (const ZoneCell& cell : cells_)
      if (cell.kind == ZoneCell::Kind::cut)
        face(cell.halves[0], cell.halves[1], static_cast<std::size_t>(cell.axis), meet);
  }

 private:
  ZoneCell looked(PoseCell& cell, PoseBox box) const;
  void enter(const std::vector<std::size_t>& list);
  bool cut(std::size_t index, std::vector<std::size_t>& fresh);

  template <class Meet>
  void face(std::size_t a, std::size_t b, std::size_t axis, const Meet& meet) const {
    const ZoneCell &one = cells_[a], &two = cells_[b];
    for (std::size_t c = 0; c < one.box.size(); ++c)
      if (c != axis && (one.box[c][1] <= two.box[c][0] || two.box[c][1] <= one.box[c][0])) return;
    const bool first = one.kind == ZoneCell::Kind::cut;
    if (!first && two.kind != ZoneCell::Kind::cut) return meet(a, b, axis);
    const ZoneCell& cell = first ? one : two;
    const bool along = static_cast<std::size_t>(cell.axis) == axis;
    for (std::size_t half = 0; half < 2; ++half) {
      // Of the lower cell only its upper half touches the face, and the other way round.
      if (along && half != (first ? 1U : 0U)) continue;
      if (first)
        face(cell.halves[half], b, axis, meet);
      else
        face(a, cell.halves[half], axis, meet);
    }
  }

  CellZoneEffort effort_;
  mutable tbb::enumerable_thread_specific<PoseCell> workers_;
  PoseChart chart_;
  PoseBox box_;
  std::vector<ZoneCell> cells_;
  /// Cells in doubt, the largest doubt first; of equal ones the last.
  BoxSearch<std::size_t, std::pair<double, long>> open_{SearchOrder::least_key_first};
  double in_doubt_ = 0;
  long looked_at_ = 0;
  bool out_of_time_ = false;
};

}  // namespace clearloci::loci::pose
