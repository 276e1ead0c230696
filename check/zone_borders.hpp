// The borders of all zones of a mode together: each side of each piece belongs to one zone. Private to check/.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "check/certificate.hpp"

namespace clearloci::check {

/// The outside and the holes of a zone.
std::vector<const core::Polyline*> rings_of(const ZoneClaim& zone);

/// Rings of zones that meet have their vertices in common.
class ZoneBorders {
 public:
  /// From a vertex to the next one, with the zone on its left.
  using Piece = std::pair<core::Point2, core::Point2>;

  /// Throws FalseClaim where a side of a piece belongs to two zones, or where one zone is on both sides of what divides
  /// it.
  explicit ZoneBorders(const std::vector<const ZoneClaim*>& zones);

  bool has_vertex(const core::Point2& at) const { return numbers_.contains(at); }
  /// With a zone on one side only.
  std::vector<Piece> one_sided() const;

 private:
  std::map<Piece, const ZoneClaim*> left_;
  std::map<core::Point2, int> numbers_;
};

}  // namespace clearloci::check
