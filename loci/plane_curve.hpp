// An implicit plane curve in doubles: value, slope and curvature, for placing vertices.
#pragma once

#include <array>
#include <vector>

#include "core/locus_map.hpp"
#include "core/polynomial.hpp"

namespace clearloci::loci {

class PlaneCurve {
 public:
  /// In (x, y).
  explicit PlaneCurve(const core::Polynomial& implicit);

  struct Jet {
    double f = 0, fx = 0, fy = 0, fxx = 0, fxy = 0, fyy = 0;

    double slope() const;      ///< |grad f|
    double curvature() const;  ///< of the level line through the point, 1/m, >= 0
    /// First-order distance of the point from the curve, m; negative where the gradient is too small to tell.
    double distance() const;
  };
  Jet jet(const core::Point2& at) const;

 private:
  struct Term {
    int i, j;
    double coefficient;
  };
  std::vector<Term> terms_;
  int degree_x_ = 0, degree_y_ = 0;
};

}  // namespace clearloci::loci
