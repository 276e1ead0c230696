// A task's shape over two lengths, in doubles: how far points, cells and arcs are from it.
#pragma once

#include "core/interval.hpp"
#include "core/task.hpp"

namespace clearloci::loci {

class TaskRegion {
 public:
  explicit TaskRegion(const core::TaskShape& shape);

  /// Of a point from the shape, m; negative: the depth inside it. A path has no inside.
  double signed_distance(const core::Point2& at) const;

  /// Not more than the least distance of a cell from the shape; 0 where they meet.
  double distance(const core::Interval& x, const core::Interval& y) const;

  struct Nearest {
    double distance = 0;
    core::Point2 at{};
  };
  /// Likewise of a convex polygon, given by its corners, and a point of it that is so far.
  Nearest nearest(const core::Polyline& polygon) const;

  /// The point of the shape nearest to a place; of a place inside the place itself.
  core::Point2 closest(const core::Point2& to) const;

  /// A way between two places in the shape, or no farther from it than `margin`, that stays there: straight, or along
  /// the outline.
  core::Polyline way(const core::Point2& from, const core::Point2& to, double margin) const;

  core::Point2 lower() const { return lower_; }
  core::Point2 upper() const { return upper_; }
  /// A few points of the shape, one in its middle first.
  core::Polyline samples() const;

 private:
  bool inside(const core::Point2& at) const;
  Nearest nearest_to_box(const core::Polyline& polygon) const;

  bool circle_ = false, box_ = false, filled_ = true;
  core::Polyline line_;  ///< the border, closed, of a circle by chords; or the path
  core::Circle round_;
  core::Point2 lower_{}, upper_{};
};

}  // namespace clearloci::loci
