// What the two ends of a planar prismatic joint's contact bear (method.md section 5), at h to both sides of the joint's
// point, about which the couple T is:
//     ahead, at +h along the axis: (N + T/h)/2        behind, at -h: (N - T/h)/2
// An end lifts where its force vanishes: h N = -T, h N = T. The unknown of the equations is N over the length of the
// axis u. Private to symbolic/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/elimination.hpp"
#include "symbolic/reactions.hpp"

namespace clearloci::symbolic {

/// h (N, T) of one guide over |A|, in the equations' unknowns: common * (bears |u|, turns).
struct Guide {
  std::string joint;
  core::Rational half_length;
  FactoredPoly common;                   ///< what the numerators of N and T share
  Poly bears, turns;                     ///< the rest of h N / |u| and of T
  std::vector<Poly> axis;                ///< the components of u
  std::optional<core::Rational> length;  ///< |u| where it is constant, within 1e-30

  /// The ends' numerators are polynomials: |u| is constant, or but a factor as one of N and T is zero in every pose.
  bool is_polynomial() const { return length || bears.is_zero() || turns.is_zero(); }
};

/// Of the planar prismatic joints whose contact has a half length.
std::vector<Guide> guides(const Geometry& geometry, const Elimination& elimination,
                          const std::vector<Reaction>& reactions);

/// h |A| times the force of an end, but for a positive factor |u| where the length is not constant. Required:
/// is_polynomial().
Poly end_numerator(const Guide& guide, core::Quantity end);

/// Of both ends, what is known to be a factor of them: all, or where the axis changes its length what N and T share.
std::vector<Reaction> end_reactions(const Guide& guide, const FactoredPoly& determinant);

}  // namespace clearloci::symbolic
