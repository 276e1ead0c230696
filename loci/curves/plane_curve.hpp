// An implicit plane curve in doubles: value, slope and curvature for placing vertices, and a proof by intervals that
// two of them are joined by the curve.
#pragma once

#include <array>
#include <vector>

#include "core/interval.hpp"
#include "core/locus_map.hpp"
#include "core/polynomial.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {

class PlaneCurve {
 public:
  /// In (x, y).
  explicit PlaneCurve(const core::Polynomial& implicit);

  template <typename Number>
  struct Derivatives {
    Number f{0.0}, fx{0.0}, fy{0.0}, fxx{0.0}, fxy{0.0}, fyy{0.0};
  };
  struct Jet : Derivatives<double> {
    double slope() const;      ///< |grad f|
    double curvature() const;  ///< of the level line through the point, 1/m, >= 0
    /// First-order distance of the point from the curve, m; negative where the gradient is too small to tell.
    double distance() const;
  };
  /// In twice the digits of doubles where terms that cancel leave too few.
  Jet jet(const core::Point2& at) const;

  /// The point of the curve nearest to `near` by Newton along the gradient; `near` itself where that leads nowhere.
  /// On the curve to rounding of the coordinates, however small the gradient is beside the terms of the polynomial.
  core::Point2 project(core::Point2 near) const;

  /// Proves that the branch through `a` reaches `b` without leaving their neighbourhood, so that both lie on one
  /// smooth piece. Required: both on the curve to rounding. `off`: about how far the branch strays from the chord, with
  /// which a branch is told from another one that touches it nearby. False: not proven.
  bool joined(const core::Point2& a, const core::Point2& b, double off) const;

 private:
  using Interval = core::Interval;

  template <typename Number>
  Derivatives<Number> derivatives(const Number& x, const Number& y) const;

  bool joined_within(const core::Point2& a, const core::Point2& b, double margin) const;
  /// The same over a parallelogram along the chord, f in powers of the distances from its middle: dearer, but it loses
  /// nothing to terms that cancel there, nor to the chord's own rise.
  /// The powers are taken in `Number`, an interval or what is finer than one.
  template <typename Number>
  bool joined_closely(const core::Point2& a, const core::Point2& b, double margin) const;

  /// f in powers of the coordinate along a chord and of what the other one is off it.
  struct Sheared {
    int along, across;  ///< degrees
    std::vector<Interval> coefficients;
    std::size_t place(int i, int j) const {
      return static_cast<std::size_t>(i) * static_cast<std::size_t>(across + 1) + static_cast<std::size_t>(j);
    }
    const Interval& at(int i, int j) const { return coefficients[place(i, j)]; }
  };
  template <typename Number>
  Sheared along_chord(const core::Point2& middle, std::size_t along, double rise) const;

  /// About how far rounding takes f in doubles from its value.
  double rounding(const core::Point2& at) const;
  /// f at the point with twice the digits of a double.
  double precise_value(const core::Point2& at) const;

  struct Term {
    int i, j;
    double coefficient, rest;  ///< their sum is the coefficient to twice the digits of a double
    Interval enclosure;
    sheet::DoubleDouble precise;

    template <typename Number>
    Number as() const;
  };
  std::vector<Term> terms_;
  int degree_x_ = 0, degree_y_ = 0;
};

/// The curve of a list that a point lies on, to first order and in exact arithmetic: near a point in which many
/// branches of both meet doubles do not tell, nor twice their digits.
int curve_through(const std::vector<core::Polynomial>& curves, const core::Point2& at);

}  // namespace clearloci::loci
