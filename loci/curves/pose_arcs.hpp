// Arcs of zeros of a field over two coordinates (pose_field.hpp): chains of segments, followed to the end of the
// workspace, and with as many vertices as their chords need. Private to curves/.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/locus_map.hpp"
#include "loci/curves/pose_field.hpp"

namespace clearloci::loci::pose {

/// Segments between vertices as chains of vertices, a closed one with its first repeated.
std::vector<std::vector<int>> chains_of(const std::vector<std::array<int, 2>>& segments, std::size_t vertices);

/// What an arc is the zero of; nothing: the end of what is reached.
using ArcQuantity = std::optional<FieldQuantity>;

class PoseArcs {
 public:
  /// `tolerance`: the largest distance of a chord from its arc, as a part of the box.
  PoseArcs(PoseField& field, Pose lower, Pose upper, double tolerance);

  /// With vertices between those of an arc. `nearby`: a sample at its first vertex or beside it.
  core::Polyline refined(const core::Polyline& arc, const ArcQuantity& quantity, const FieldSample& nearby);

  /// Poses beyond the last one of an arc, as far as `goes_on` and the box let it.
  template <class GoesOn>
  core::Polyline beyond(const core::Point2& before, const core::Point2& last, double step,
                        const FieldQuantity& quantity, FieldSample nearby, const GoesOn& goes_on) {
    core::Polyline found;
    core::Point2 from = unit(before), at = unit(last);
    for (int i = 0; i < most_steps && step > finest; ++i) {
      const auto next = stepped(from, at, step, quantity, nearby);
      if (!next) {
        step /= 2;
        continue;
      }
      const core::Point2 pose = placed(next->at);
      if (!goes_on(pose)) break;
      found.push_back(pose);
      from = at;
      at = next->at;
      nearby = next->sample;
      if (next->at_side) break;
    }
    return found;
  }

 private:
  static constexpr int most_steps = 200;
  static constexpr double finest = 1e-7;

  struct Next {
    core::Point2 at{};
    FieldSample sample;
    bool at_side = false;
  };
  core::Point2 unit(const core::Point2& pose) const;
  core::Point2 placed(const core::Point2& unit) const;
  Pose pose_at(const core::Point2& unit) const;
  std::optional<Next> stepped(const core::Point2& from, const core::Point2& at, double step,
                              const FieldQuantity& quantity, const FieldSample& nearby);
  /// A zero on the way across the middle of a chord.
  std::optional<core::Point2> across(const core::Point2& middle, const core::Point2& way, const ArcQuantity& quantity,
                                     const FieldSample& nearby);
  void refine(const core::Point2& p, const core::Point2& q, const ArcQuantity& quantity, FieldSample& nearby, int depth,
              core::Polyline& arc);

  PoseField& field_;
  Pose lower_, upper_;
  double tolerance_;
};

}  // namespace clearloci::loci::pose
