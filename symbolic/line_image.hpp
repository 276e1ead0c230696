// A tower and all that is written over it on one arbitrary line through the workspace and modulo a prime: what divides
// or shares a curve does so there too, and coefficients there have one word each. A "no" is wrong only where the prime
// divides a number that it has no reason to, such as a leading coefficient: with a chance below 1e-15.
// Private to symbolic/.
#pragma once

#include <vector>

#include "symbolic/geometry.hpp"
#include "symbolic/residue_poly.hpp"

namespace clearloci::symbolic {

class LineImage {
 public:
  /// `divisors`: over the tower, divided out of what is put over it. `denominators`: irreducible, in the free
  /// coordinates, divided out of norms. `independent`: the roots whose conjugates a quotient takes.
  LineImage(const Geometry& geometry, const std::vector<Poly>& divisors, const std::vector<Poly>& denominators,
            const std::vector<TowerRoot>& independent);

  /// Of an element over the tower.
  ResiduePoly of(const Poly& p) const;
  /// Of a natural polynomial, put over the tower.
  ResiduePoly over_tower(const Poly& natural) const;
  /// The product of an element's conjugates: in the last coordinate alone.
  ResiduePoly norm(ResiduePoly element) const;
  /// False: `divisor` does not divide in the tower what has this image.
  bool may_divide(const Poly& divisor, const ResiduePoly& image) const;

 private:
  struct Root {
    int variable;
    bool angle;
    ResiduePoly square;
    bool is_angle() const { return angle; }
  };
  struct Place {
    ResiduePoly x, y, z, w;
  };
  struct PlacedAt {
    int x, y, z;
    Place place;
  };
  Root image(const TowerRoot& root) const { return {root.variable, root.is_angle(), of(root.square)}; }

  ResidueRing ring_;
  int last_;                        ///< the coordinate that stays
  std::vector<ResiduePoly> along_;  ///< the other coordinates, x_i = p_i + q_i x_last
  std::vector<Root> roots_, independent_;
  std::vector<PlacedAt> places_;
  std::vector<ResiduePoly> divisors_, denominators_;
};

}  // namespace clearloci::symbolic
