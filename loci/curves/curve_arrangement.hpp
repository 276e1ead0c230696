// The exact rung: the arrangement of irreducible plane curves by CGAL's algebraic kernel (arrangements of algebraic
// curves, Eigenwillig and Kerber 2008). Plain data outside; CGAL stays inside the one translation unit that needs it.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/locus_map.hpp"
#include "core/polynomial.hpp"

namespace clearloci::loci {

/// A box that encloses one point of the plane.
struct PointEnclosure {
  std::array<core::Rational, 2> lower, upper;
};

/// A smooth, x-monotone (or vertical) piece of one curve between two vertices, meeting no other curve inside.
struct ArrangementEdge {
  int curve = 0;
  int from = 0, to = 0;  ///< vertices, left to right (vertical: upwards)
  bool vertical = false;
};

/// An isolated real point of one curve.
struct ArrangementPoint {
  int curve = 0;
  core::Point2 at{};
  PointEnclosure enclosure;
};

/// The part inside the box of the arrangement of distinct irreducible curves and the box's four sides.
class CurveArrangement {
 public:
  /// `curves`: irreducible over Q, distinct, in (x, y). `interrupted` is asked between the long steps; once it says
  /// true the work ends with core::LimitReached.
  CurveArrangement(std::vector<core::Polynomial> curves, const std::array<core::Rational, 2>& lower,
                   const std::array<core::Rational, 2>& upper, const std::function<bool()>& interrupted = {});
  ~CurveArrangement();
  CurveArrangement(const CurveArrangement&) = delete;
  CurveArrangement& operator=(const CurveArrangement&) = delete;

  /// The given curves, then those of the box's sides that were not among them.
  const std::vector<core::Polynomial>& curves() const;
  std::size_t vertices() const;
  const std::vector<ArrangementEdge>& edges() const;
  const std::vector<ArrangementPoint>& isolated_points() const;
  /// Vertices on a side of the box that a curve touches from outside, so that no edge of it ends there, each with that
  /// curve.
  std::vector<std::pair<int, int>> passed_outside() const;

  /// Where a vertex is, within 1e-15, absolutely. It is worked out when it is asked for: a millisecond where curves of
  /// high degree cross.
  core::Point2 at(int vertex) const;
  /// Whether a vertex is nearer than `distance` to a point.
  bool is_near(int vertex, const core::Point2& point, double distance) const;

  /// A point in the interior of an edge; other attempts give other points, the first ones with more and more digits.
  PointEnclosure sample(int edge, int attempt) const;

  /// The y of a non-vertical edge at an x strictly between its ends' (correctly to 1e-16 of the box).
  double y_at(int edge, double x) const;

  /// Whether curve `divisor` is a factor of p: then p vanishes all along it.
  bool divides(int divisor, const core::Polynomial& p) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace clearloci::loci
