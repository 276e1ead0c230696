// Where the chords of polylines cross, by a sweep along x.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::loci {

/// A chord of the line that is told by `of`.
struct Segment {
  core::Point2 a, b;
  int of;
};

inline void add_segments(const core::Polyline& points, int of, std::vector<Segment>& segments) {
  for (std::size_t i = 1; i < points.size(); ++i) segments.push_back({points[i - 1], points[i], of});
}

/// Twice the area of a triangle, positive where it turns left.
inline double turn(const core::Point2& a, const core::Point2& b, const core::Point2& p) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/// Visits the pairs of segments of different lines that cross.
template <typename Visit>
void each_crossing(std::vector<Segment> segments, const Visit& visit) {
  const auto low = [](const Segment& s) { return std::min(s.a[0], s.b[0]); };
  std::sort(segments.begin(), segments.end(), [&](const Segment& s, const Segment& t) { return low(s) < low(t); });
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    const double end = std::max(s.a[0], s.b[0]);
    for (std::size_t k = i + 1; k < segments.size() && low(segments[k]) <= end; ++k) {
      const Segment& t = segments[k];
      if (s.of != t.of && turn(s.a, s.b, t.a) * turn(s.a, s.b, t.b) < 0 &&
          turn(t.a, t.b, s.a) * turn(t.a, t.b, s.b) < 0)
        visit(s, t);
    }
  }
}

}  // namespace clearloci::loci
