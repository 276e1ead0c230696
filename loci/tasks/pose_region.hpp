// The poses of a task and of its margin, as pieces that are cut into cells. Distances are
//     |d|^2 = sum (weight_c d_c)^2
// over the coordinates that the margin grows in; the others stay those of the task.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "clearloci/verify.hpp"
#include "loci/sheet/sheet.hpp"
#include "loci/tasks/solid.hpp"
#include "loci/tasks/task_region.hpp"

namespace clearloci::loci::pose {

/// What a difference of each coordinate counts, m a unit, and whether the margin grows along it.
struct PoseMetric {
  std::vector<double> weights;
  std::vector<bool> grows;
};

/// Coordinates behind those of the shape, whatever its pose: designs and loads that a task is asked for at once. The
/// margin does not grow along them.
struct PoseBeside {
  Pose lower, upper;                       ///< a value each
  std::vector<core::LoadBall> balls = {};  ///< of some of them, about the middle of their ranges
};

/// A part of the task and its margin: parameters, poses over them, and how far from the task they are at least.
struct PosePiece {
  PoseChart chart;
  PoseBox box;
  int segment = -1;  ///< of a path: parameters are the way along it, then the way off it
};

class PoseRegion {
 public:
  /// `metric`: of all coordinates, those beside the shape among them.
  PoseRegion(const core::TaskShape& shape, PoseMetric metric, PoseBeside beside = {});

  /// Pieces that together hold every pose within `margin` of the task, and a hair more.
  std::vector<PosePiece> pieces(double margin) const;
  /// Not above the distance of any pose of a part of a piece from the task.
  double distance(const PosePiece& piece, const PoseBox& box) const;

  double distance(const Pose& pose) const;
  Pose closest(const Pose& pose) const;
  /// Its pose farthest along a coordinate (`way` 1) or against it (-1): of a box or a ball the one beside its middle.
  Pose farthest_along(std::size_t coordinate, double way) const;
  /// A way between two poses of the task or its margin that stays there; in a mesh one that looks like it, or none.
  std::vector<Pose> way(const Pose& from, const Pose& to) const;
  /// Whether the straight way between two poses of a way is certain to stay in the task and its margin.
  bool holds_way(const Pose& from, const Pose& to, double margin) const;
  /// Its middle or start, corners, ends, and some more.
  std::vector<Pose> samples() const;

  std::size_t coordinates() const { return metric_.weights.size(); }
  const PoseMetric& metric() const { return metric_; }
  /// Rounding of the task's own numbers.
  double hair() const { return hair_; }

 private:
  double apart(const Pose& a, const Pose& b) const;
  /// The nearest point of a path: on which segment, and how far along it.
  std::pair<std::size_t, double> foot(const Pose& pose) const;
  Pose on_segment(std::size_t segment, double t) const;

  bool is_held(std::size_t c) const { return c >= shaped_ || (!metric_.grows[c] && kind_ != Kind::ball); }
  /// Into the ranges beside the shape.
  void clamp_beside(Pose& pose) const;
  /// How far a box is from a ball beside the shape at most: whether it is beyond one.
  bool is_beyond_ball(const PoseBox& box, std::size_t offset) const;
  /// A pose of the shape with values beside it, the middle ones first.
  Pose with_beside(Pose pose, std::size_t number) const;
  core::Point2 in_plane(const Pose& pose) const { return {pose[across_[0]], pose[across_[1]]}; }
  std::vector<Pose> way_in_polygon(const Pose& from, const Pose& to) const;

  PoseMetric metric_;
  std::size_t shaped_ = 0;  ///< coordinates of the shape
  PoseBeside beside_;
  Pose nearest_in_solid(const Pose& pose) const;
  std::vector<Pose> way_in_solid(const Pose& from, const Pose& to) const;
  bool seems_inside(const Pose& from, const Pose& to) const;

  enum class Kind { box, ball, polygon, path, mesh } kind_ = Kind::box;
  Pose lower_, upper_;  ///< of a box; the box around anything
  Pose centre_;
  double radius_ = 0;
  std::vector<Pose> points_;            ///< of a path; of a polygon and a mesh those that samples() tells
  std::shared_ptr<const Solid> solid_;  ///< of a mesh
  std::optional<TaskRegion> plane_;     ///< of a polygon, across these two coordinates
  std::array<std::size_t, 2> across_{};
  double hair_ = 0;
};

}  // namespace clearloci::loci::pose
