// From a factor in natural coordinates to implicit curves (method.md section 4): the constructed points are put in
// over the tower, then every root is eliminated by the product of conjugates, N = a + b s  ->  a^2 - b^2 Q.
// Private to symbolic/.
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "symbolic/geometry.hpp"
#include "symbolic/known_eliminations.hpp"
#include "symbolic/line_image.hpp"

namespace clearloci::symbolic {

/// A factor of a natural factor over the tower, with what its zeros look like in the plane.
struct SheetFactor {
  Poly sheet;  ///< in the coordinates and roots, reduced, primitive
  int multiplicity = 1;
  std::vector<Poly> implicit;  ///< irreducible, primitive, distinct; together they contain its zeros in every mode
  bool too_heavy = false;      ///< `implicit` was wanted but would be too large to be of use
  bool of_divided = false;     ///< the variable of one of Elimination::divided_roots, without `implicit`
};

/// A root of a dyad or slider along whose zeros a way has no length that something is divided by: the axis of a guide
/// from a foot to the pin, or a spring whose ends meet there. What is divided out of polynomials is divided out of the
/// root's square, too, and their factors do not tell what vanishes there: Elimination::order_along does.
struct DividedRoot {
  std::size_t root = 0;  ///< by its place in Geometry::roots
  Poly divisor;          ///< an irreducible factor of its square
  int multiplicity = 1;  ///< there; odd
};

class Elimination {
 public:
  /// `known`: of other sheets of the mechanism; may be null.
  explicit Elimination(const Geometry& geometry, KnownEliminations* known = nullptr);

  /// Constructed points replaced by their tower form, cleared of denominators, reduced. Zero where the natural
  /// polynomial vanishes in every pose.
  const Poly& over_tower(const Poly& natural) const;

  /// Whether a natural polynomial is zero in every pose. One pose tells most that are not.
  bool vanishes_everywhere(const Poly& natural) const;

  /// The value of a natural polynomial that is the same number in every pose, such as |B1 - P|^2; empty for others.
  std::optional<core::Rational> constant_over_tower(const Poly& natural) const;

  /// Whether two natural polynomials are, but for constant factors, the components of a link's length between two
  /// points of which one is a dyad's: then their squares add up to a positive number in every pose. Only of the plane;
  /// false says nothing.
  bool are_components_of_link(const Poly& a, const Poly& b) const;

  /// The factors of a non-zero sheet polynomial that can vanish inside the workspace: constants and squared distances
  /// are dropped. `implicit` is left empty unless wanted; where it is, factors without curves in any mode are dropped
  /// too, into `without_curves` where that is given.
  std::vector<SheetFactor> sheet_factors(const Poly& sheet, bool with_implicit,
                                         std::vector<Poly>* without_curves = nullptr) const;

  /// The same of the square of a root that ends the workspace where it is zero; with those that other things are
  /// divided by, where nothing else is left: the axis of a guide that is as long as the root.
  std::vector<SheetFactor> boundary_factors(const Poly& square) const;

  const std::vector<DividedRoot>& divided_roots() const { return divided_roots_; }
  /// How often the square root of such a divisor divides a natural polynomial that is not zero in every pose, as a
  /// function of the pose; less than 0 where that grows without bound.
  int order_along(const Poly& natural, const DividedRoot& divided) const;

  /// The same of a natural polynomial that is not zero in every pose. What it holds of the elements of folds is divided
  /// out of it before it is put over the tower, where it has many more terms.
  std::vector<SheetFactor> natural_factors(const Poly& natural, bool with_implicit,
                                           std::vector<Poly>* without_curves = nullptr) const;

  /// Of a fold where a dyad X on V, W closes a loop with a point C (Geometry::Closing), (V - C) x (W - C) in natural
  /// coordinates: a number times Fold::where over the tower. None where no such loop is known.
  const std::optional<Poly>& fold_element(std::size_t fold) const;

  /// The irreducible polynomials in the free coordinates that contain the zeros of a sheet polynomial.
  std::vector<Poly> implicit_factors(const Poly& sheet) const;
  /// The same of a factor that the places of points are divided by.
  std::vector<Poly> implicit_of_divisor(const Poly& divisor) const;

  /// Whether implicit_factors would take long and come to more than anyone can use. Traced on the sheets such factors
  /// are as well off without.
  bool is_too_heavy(const Poly& sheet) const;
  /// The same of a natural polynomial, without putting it over the tower.
  bool is_too_heavy_over_tower(const Poly& natural) const;
  /// Whether an angle is among its roots: then no polynomial has its zeros.
  bool has_angle_over_tower(const Poly& natural) const;

  /// The irreducible factors of the squared distances that the closure divides by.
  const std::vector<Poly>& denominator_factors() const { return denominator_factors_; }

  /// Whether two natural polynomials can share a curve, from their norms on one arbitrary line, where a common curve
  /// shows as a common factor (line_image.hpp).
  static bool may_share_curve(const ResiduePoly& norm_a, const ResiduePoly& norm_b);
  ResiduePoly norm_on_line(const Poly& natural) const;

 private:
  template <class P>
  bool has_angle(const P& sheet) const;
  /// A bound on the degree that the product of all conjugates may have, before anything is divided out.
  template <class P>
  double norm_degree(const P& sheet) const;
  /// With numbers for the coordinates: in roots alone.
  Poly at_one_pose(Poly p) const;
  Poly over_tower_at_one_pose(const Poly& natural) const;
  const LineImage& line_image() const;
  const ResiduePoly& over_tower_on_line(const Poly& natural) const;
  bool is_beyond_use(double norm_degree) const;
  void eliminate(Poly p, std::vector<Poly>& found, bool keeps_divisors = false) const;
  /// The factors of a sheet polynomial. Over a tower elements have no unique factors, but where a root depends on
  /// earlier ones numerators and |A| share the element in whose sign it differs, and where a dyad is stretched the root
  /// that is zero there: those are divided out as often as it goes.
  std::vector<PolyFactor> factors_over_tower(const Poly& sheet) const;
  std::vector<SheetFactor> described(const std::vector<PolyFactor>& factors, bool with_implicit,
                                     std::vector<Poly>* without_curves) const;
  std::optional<Poly> found_element(const Fold& fold) const;
  /// With the closing points written by others. Denominators stay.
  Poly with_closings(Poly natural) const;
  /// The element of a fold that has one, so written.
  const Poly& fold_divisor(std::size_t fold) const;
  /// From one of the substitutions on.
  Poly put_in(Poly natural, std::size_t first) const;
  std::vector<PolyFactor> found_factors(Poly sheet) const;
  /// A sheet polynomial a + b s divided by s, where it holds s at all and s^2 divides a.
  static std::optional<Poly> without_root(const Poly& sheet, const TowerRoot& root);
  bool is_denominator(const Poly& irreducible) const;
  void find_divided_roots();
  int order_over_tower(const Poly& sheet, const DividedRoot& divided) const;
  bool has_free_coordinate(const Poly& p) const;
  Poly strip_denominators(Poly p) const;

  /// Of a dyad on others: (P - A) x (B - A) = s / 2, which need not be multiplied out to be known.
  struct Stretched {
    Poly natural, root;
  };
  void know_stretched();
  /// On what all results depend but the places of points.
  KnownEliminations::Sources common_sources() const;
  /// A natural polynomial and the places that are put in.
  KnownEliminations::Sources sources_over_tower(const Poly& natural) const;
  const Stretched* stretched(const Poly& natural) const;
  /// Of every ring variable: what it counts in a degree over the tower, a root half of its square's.
  const std::vector<double>& degree_weights() const;

  const Geometry* geometry_;
  std::vector<Substitution> substitutions_;
  mutable std::vector<Substitution> at_one_pose_;        // the same at one pose, once it is asked for
  KnownEliminations* known_ = nullptr;                   ///< null where there are none for this geometry
  mutable std::unique_ptr<LineImage> line_image_;        ///< made where it is asked for
  mutable std::vector<double> degree_weights_;           ///< likewise
  mutable std::list<std::pair<Poly, Poly>> over_tower_;  ///< what has been asked for: many numerators share factors
  mutable std::list<std::pair<Poly, bool>> vanishing_;   ///< likewise
  mutable std::list<std::pair<Poly, ResiduePoly>> over_tower_on_line_;
  mutable std::vector<std::optional<std::optional<Poly>>> elements_;  ///< by fold, once they are asked for
  mutable std::vector<std::optional<Poly>> divisors_;                 ///< likewise
  std::vector<Stretched> stretched_;
  std::vector<TowerRoot> independent_roots_;
  std::vector<Poly> known_denominators_;   ///< over the tower
  std::vector<Poly> denominator_factors_;  ///< irreducible, in the free coordinates
  std::vector<DividedRoot> divided_roots_;
  std::vector<Poly> stripped_;  ///< of these, or their squares, so that what is left keeps its sign
};

}  // namespace clearloci::symbolic
