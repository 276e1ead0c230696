// Points of the plane at which a sheet is not smooth in (x, y) and its roots, and how it shrinks towards them.
//
// Around a star at A, with (X, Y) = P - A, the sheet and the curves on it are quasi-homogeneous: with weights (v, w)
//     X = u^v X',  Y = u^w Y',  s_j = u^k sigma_j
// sigma_j^2 = Q_j / u^2k is smooth, and so is the function divided by its power of u; its zeros at u = 0 are the
// directions in which branches reach the star.
//     cone    (1, 1)  a dyad's ends meet and its lengths are equal: Q = 4 a^2 D - k^2 has a factor D = |P - A|^2;
//                     or the function has a node there, and no root vanishes
//     touch   (1, 2)  two workspace boundaries touch: X along the common tangent, Y off it, both roots vanish as u;
//                     or the function has a node on one boundary, and its branches leave along the tangent
//     corner  (2, 2)  two boundaries cross where the curve passes, both roots vanish as u; or one runs through a cone
//     bend    (2, 4)  the same where the curve touches the second boundary, whose root vanishes as u^2: X along it;
//                     or where the second one is that of a dyad, and the first one that of a dyad on it
// Where a boundary runs through a cone, both are needed: a corner's weights in all directions but the boundary's, a
// touch's along that.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/root_tower.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/sheet/boundary_curves.hpp"
#include "loci/sheet/subtower.hpp"

namespace clearloci::loci::sheet {

/// A point whose coordinates are algebraic numbers.
struct AlgebraicPoint {
  NumberField field;
  NumberField::Element x, y;
};

/// What is known of a star with irrational coordinates: an enclosure.
struct Apex {
  core::Rational radius;            ///< of x and y around those of the star
  core::Rational slope_radius = 0;  ///< of a touch: of its slope around that of the star
  struct Value {
    core::Rational middle, radius;
    bool known = false;
  };
  std::vector<Value> roots;  ///< of the tower's roots there; 0 where they vanish
  /// Functions that are known to vanish there: of a cone x and y of the way from end to end (core::DyadBase), of a
  /// node the parts of the function (core::NodeForm).
  std::vector<core::StraightLine> vanishing = {};
  /// Where the coordinates are known as algebraic numbers: what vanishes there is told by the polynomials, as at a
  /// rational point, and nothing by `roots` and `vanishing`.
  std::shared_ptr<const AlgebraicPoint> exact = {};
};

struct Star {
  enum class Shape { cone, touch, corner, bend };

  core::Rational x, y;
  /// Those that vanish there, once for every power of the distance: a root of a dyad on a dyad carries the squared
  /// distance of the one below as a factor.
  std::vector<int> roots;
  Shape shape = Shape::cone;
  /// Where it is sheared: whether the tangent is nearer to the y axis, and its rise per unit of the nearer axis, at
  /// most 1.
  bool along_y = false;
  core::Rational slope;
  /// Of a touch or a corner: a branch of a direct singularity reaches it on the working mode's sheet.
  bool singular = false;
  std::optional<Apex> apex = {};  ///< of a cone at no rational point, or of a touch that is a node
  /// A telescopic leg has no length there, and no direction, whether or not a root of the tower vanishes with it:
  /// numerators and |A| vanish since the equations hold the leg's way as it is.
  bool no_length = false;
  /// A rectangle around it reaches no farther: of a node, so that no workspace boundary passes through.
  double room = std::numeric_limits<double>::infinity();
  /// Of a corner through which a workspace boundary runs: the same point with the weights of a touch, along the
  /// boundary's tangent. In that direction a curve may leave with the boundary: what of it is off the tangent then
  /// shrinks with the square of what is along it, and the boundary's root with the distance. At most one.
  std::vector<Star> tangential = {};

  /// One coordinate is counted off a tangent.
  bool is_sheared() const { return shape == Shape::touch || shape == Shape::bend; }
  /// Weights are even: coordinates go with the squares of the roots.
  bool is_doubled() const { return shape == Shape::corner || shape == Shape::bend; }
  bool at_same_place(const Star& other) const { return x == other.x && y == other.y; }
  /// There is no posture, for the direction from end to end of a leg is undefined: roots vanish, of a cone that a
  /// boundary runs through with the second power at least. At nodes of a function alone none do.
  bool is_undefined() const;
  /// Whether all of a place is so near.
  bool is_near(const Interval& at_x, const Interval& at_y, double reach) const;
  /// Powers of u of the first and the second coordinate.
  std::array<int, 2> weights() const;
  /// The power of u with which a root vanishes.
  int power_of_root(int root) const;
};

/// The double zeros of root squares at rational points of the plane where a denominator of the tower vanishes.
std::vector<Star> cones(const core::RootTower& tower);

/// Finds the roots that vanish at a star without length, and its shape where a workspace boundary passes through.
/// False: none of its directions belongs to the workspace.
bool settle_roots(Star& star, const core::RootTower& tower);

/// Whether nothing is gained by writing a function around a star: it holds no root that vanishes there, and has terms
/// of the first order, so that it has a gradient there unless these cancel.
bool is_smooth_at(const Star& star, const core::Polynomial& function);

/// The points at which the boundary curves (boundary_curves.hpp) of two roots touch.
std::vector<Star> touches(const core::RootTower& tower);

/// The rational points at which the boundary curves of two roots cross and the function vanishes with both roots,
/// whatever the other roots are there.
/// `nested`: what nested_meetings() finds in the tower, where the boundaries may touch too.
std::vector<Star> corners_on(const core::RootTower& tower, const core::Polynomial& function,
                             const std::vector<NestedMeeting>& nested);

/// Stars of a whole tower for a part of it, and for the tower without one root.
std::vector<Star> narrowed(std::vector<Star> stars, const Subtower& part);
std::vector<Star> on_rim(std::vector<Star> stars, int root);

/// c ((x - a)^2 + (y - b)^2): the point (a, b), if the polynomial is such.
std::optional<std::array<core::Rational, 2>> double_point(const core::Polynomial& p);

/// A polynomial in (x, y, roots...) written in the star's coordinates (X, Y, roots...): moved, and sheared where it is,
/// so that one coordinate is the distance off the tangent along an axis. Of an algebraic point in (X, Y, roots...,
/// alpha).
core::Polynomial around(const Star& star, const core::Polynomial& p);

/// The lowest power of u in such a polynomial.
int order_at(const Star& star, const core::Polynomial& around_star);

/// Whether all terms of the lowest power of u hold a root that no other one stands on: without that power the function
/// is the root times a function free of it at the star. Required: at most the first power of the root.
bool vanishes_with(const Star& star, const core::RootTower& tower, const core::Polynomial& around_star, int root);

/// Such a polynomial as a straight line in (u, X', Y', roots...), the star's roots divided by their powers of u,
/// without `order` powers of u.
core::StraightLine polar_line(const Star& star, const core::Polynomial& around_star, int order);

/// Between the tangent of the boundary that runs through a corner and other directions: with the weights of both,
///     X = rho^v u^v' X',  Y = rho^w u^w' Y',  s_j = rho^k u^k' sigma_j
/// v, w, k being those of the corner and v', w', k' those along the tangent. In (u, X', Y', rho, roots...), without
/// `orders` powers of u and rho; the polynomial is written around `star.tangential`.
core::StraightLine wing_line(const Star& star, const core::Polynomial& around_tangent,
                             const std::array<int, 2>& orders);

}  // namespace clearloci::loci::sheet
