// Natural polynomials as straight-line programs over the tower, built the way the mechanism is. Private to symbolic/.
//
//   dyad B on A, P with |AB| = a, |BP| = b:   (u, v) = P - A,  D = u^2 + v^2,
//       Q = ((a + b)^2 - D) (D - (a - b)^2) = s^2,   lambda = 1/2 + (a^2 - b^2) / (2 D),   mu = s / (2 D),
//       B = A + lambda (u, v) + mu (-v, u)
//   in space, turning about n: w = P - A, N = n . n, h = n . w, D = N w . w - h^2, k = a^2 - b^2 + w . w,
//       s^2 = 4 a^2 D - N k^2,   E = (N (a^2 - b^2) + h^2) / D,   v = h / N n,
//       B = A + (E + 1) / 2 (w - v) + s / (2 D) (n x w) = P + (E - 1) / 2 (w - v) - v + s / (2 D) (n x w)
#pragma once

#include <map>

#include "core/straight_line.hpp"
#include "symbolic/cramer.hpp"
#include "symbolic/geometry.hpp"

namespace clearloci::symbolic {

class StraightLines {
 public:
  explicit StraightLines(const Geometry& geometry);

  /// From now on the values of these are computed as determinants.
  void know(const std::vector<DeterminantForm>& forms);

  /// The value of a natural polynomial; the roots are those of the tower.
  core::StraightLine of(const Poly& natural);

  /// The same with `above` over the squared distance of a dyad's ends in the place of the auxiliary variable.
  core::StraightLine of(const Poly& natural, mechanism::PointIndex dyad, const core::Rational& above);

  /// The value of a product, as it is.
  core::StraightLine of(const core::Rational& constant, const std::vector<PolyFactor>& factors);

  /// The value of a polynomial in the coordinates and the roots.
  core::StraightLine over_roots(const Poly& sheet);

  /// From now on a ring variable that occurs in no place stands for a further root over a divisor; `root` is the
  /// tower's variable.
  void let(int ring_variable, int root, const Poly& divisor);

  /// The square of such a root: constant |w|^2 divisor^2 of a vector w in natural coordinates, as it is.
  core::StraightLine square(const core::Rational& constant, const std::vector<Poly>& w, const Poly& divisor);

  /// The tower, with everything in it that is known as it is computed.
  core::RootTower tower();

  /// The square of a root of the tower; empty where no better form than its polynomial is known.
  core::StraightLine square(std::size_t root);

  /// (a + b)^2 - D and D - (a - b)^2 of a dyad, in this order; nothing where no better form is known.
  std::optional<std::array<core::StraightLine, 2>> rims(mechanism::PointIndex point);

  /// x and y of the way from one end of a dyad to the other; nothing where no better form is known.
  std::optional<std::array<core::StraightLine, 2>> way(mechanism::PointIndex point);

 private:
  using Place = std::array<int, 3>;  ///< z = 0 in the plane
  struct Dyad {
    Place way;            ///< P - A
    int distance2;        ///< |P - A|^2
    int scale;            ///< s of the tower = scale * the true root
    int sum, difference;  ///< a + b, a - b
    /// In space: n, N, h and D.
    struct Axis {
      Place n;
      int n2, h, d;
    };
    std::optional<Axis> axis = {};
  };

  /// A constructed point as seen from one of the dyad's ends: what stands for its ring variables then.
  struct Arm {
    std::array<Poly, 3> end;  ///< in natural coordinates
    Place step;               ///< from there to the point
  };
  struct ArmedPoint {
    std::array<int, 3> variables;  ///< of the ring; -1: none
    std::array<Arm, 2> arms;       ///< from either end
    /// In the plane, from either end: |arm|^2, and w . arm and w x arm for the way w to the other end.
    std::optional<std::array<std::array<int, 3>, 2>> lengths = {};
  };

  int value(const core::Polynomial& p);
  /// The same, by the ways from point to point where that takes fewer terms.
  int value_by_ways(const Poly& natural, const core::Rational& scale);
  /// The same of forces along ways, such as those of springs: by the parts of a way over its length, so that the
  /// direction is seen where the way has no length.
  std::optional<int> value_by_directions(const Poly& natural, const core::Rational& scale);
  /// Of what is written by arms: as it is, and where that is shorter by the lengths of dyads alone, which do not change
  /// when a dyad turns about its end.
  int value_of_arms(const Poly& p, const std::vector<std::size_t>& arms);
  std::optional<int> value_by_lengths(const Poly& p, const std::vector<std::size_t>& arms);
  std::array<std::array<int, 3>, 2> lengths_of(const Dyad& dyad, const TowerRoot& root);
  /// `scaled`: its multiple that is asked for.
  int scaled_value_by_ways(const Poly& natural, const core::Polynomial& scaled);
  const std::vector<ArmedPoint>& armed_points();
  int scaled_value(const Poly& natural, long exponent);
  int determinant(const DeterminantForm& form, const core::Rational& scale);
  int variable(int ring_variable);
  Place natural_place(mechanism::PointIndex point);
  Place way_between(mechanism::PointIndex from, mechanism::PointIndex to);
  std::optional<Dyad> dyad(mechanism::PointIndex point);
  Place constructed_place(const ConstructedPoint& point);
  /// From either end to the point.
  std::array<Place, 2> steps_to(const Dyad& dyad, const TowerRoot& root);
  std::array<Place, 2> steps_in_space(const Dyad& dyad, int s);
  Place over_tower(const TowerPoint& place);
  Place vector(const mechanism::VectorExpression& vector);
  void know(const std::array<int, 3>& ring_variables, const Place& place);
  int dot(const Place& a, const Place& b);
  core::StraightLine squared_length(const InverseLength& length);
  core::StraightLine shifted_angle(const TorsionAngle& angle);
  int inverse_of(const InverseLength& length);
  /// The scale of a root (TowerRoot), without the sums that its polynomials are.
  int scale(const TowerRoot& root);
  /// A quotient of products of what dyads divide by, by their factors; none where there are others.
  std::optional<int> positive_value(const Poly& p);
  std::optional<int> product_of_divisors(Poly p);
  /// Those of a dyad join what is known; of `distance2`, the squared length of its way.
  void know_divisors(const Geometry::Way& way, int distance2);
  int excess(const Dyad& dyad);

  const Geometry* geometry_;
  bool is_nested_ = false;  ///< a root stands on another
  core::StraightLineBuilder builder_;
  std::map<int, int> known_;  ///< ring variable to step
  std::vector<DeterminantForm> forms_;
  std::vector<std::pair<Poly, int>> divisors_;  ///< of dyads between points that are not fixed, and their values
  std::optional<std::vector<ArmedPoint>> armed_points_;  ///< those that stand on others last
};

}  // namespace clearloci::symbolic
