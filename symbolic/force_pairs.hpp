// Lower pairs of polynomials in the place of two that are to vanish together, such as the components of a force.
// Private to symbolic/.
//
// Every step keeps the common zeros, as it keeps the ideal of the pair but for factors:
//     p linear in v:  (p, q) -> (p, q with v from p = 0), whose second part often falls into factors. Under vertical
//                     loads x_A - x_B is such a p, of the link AB along the load: then fy of its joint, of degree 24,
//                     is (y_A - y_B) times what else divides fx.
//     f p divides fx, q is fy, (f, g) is the way along a link:  f q - g p (fx / f p) = (moment of the force about its
//                     other end) / f, which holds factors of |A|. If nothing of any degree is left beside these,
//                     (p, q) -> (p, each of them).
//     two ways a, b with a x b = c D, D a factor of |A|:  a x (p, q) = D g, b x (p, q) = D h with moments g, h, so that
//                     c (p, q) = g b - h a. Away from D = 0 this is zero where g = h = 0; on D = 0, where b is
//                     a (a . b) / |a|^2, where k = (a . b) g - |a|^2 h is: (p, q) -> (g, h), (D, k). There the force
//                     is along a besides: where p is zero and a_x is not, q is zero. (D, p) stands in the place of
//                     (D, k) where k is long.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "symbolic/elimination.hpp"
#include "symbolic/factored_poly.hpp"

namespace clearloci::symbolic {

using PolyPair = std::array<Poly, 2>;

/// Two polynomials that vanish together. With a normal the second one is a component of the force, and the other one
/// has to vanish, too: it does where the normal, that component of the way along which the force is, does not.
struct LowerPair {
  struct Normal {
    Poly way;
    core::Quantity component;  ///< fx or fy
  };
  Poly first, second;
  std::optional<Normal> normal = {};
};

class PairReduction {
 public:
  PairReduction(const Geometry& geometry, const Elimination& elimination, const FactoredPoly& determinant)
      : geometry_(&geometry), elimination_(&elimination), determinant_(&determinant) {}

  /// Irreducible pairs in the place of two factors, one of each component of a force in the plane; none where no lower
  /// ones are known. `components`: the numerators.
  std::optional<std::vector<LowerPair>> lowered(const Poly& x, const Poly& y,
                                                const std::array<FactoredPoly, 2>& components);

 private:
  using Way = std::array<Poly, 2>;

  /// Required: p is linear.
  std::optional<std::vector<LowerPair>> lowered_by(const Poly& p, const Poly& q) const;
  /// Of p times `beside_p` and q times a number: the components without what they share.
  std::optional<std::vector<LowerPair>> lowered_by_moment(const Poly& p, const Poly& q, const FactoredPoly& beside_p,
                                                          const core::Rational& beside_q, bool p_is_x);
  /// Required: x and y are numerators without what they share.
  std::optional<std::vector<LowerPair>> lowered_by_two_moments(const Poly& x, const Poly& y);

  /// The moments of a force about the ends of a link, the other one of which is the joint's: both over a factor of |A|.
  struct Moment {
    const Way* way;
    const Poly* divisor;
    Poly value;  ///< over the divisor
  };
  std::vector<Moment> moments(const Poly& x, const Poly& y);
  /// The pairs (g, h); none where these share a factor.
  std::optional<std::vector<LowerPair>> regular_pairs(const Poly& g, const Poly& h) const;
  /// k where it is short, up to multiples of D; else none.
  std::optional<Poly> short_work(const Moment& a, const Moment& b);

  /// The first polynomial asked for that is the same where the divisor vanishes. What all forces are made of there, the
  /// work of the loads in the motion that is free, is searched once.
  Poly known_on(const Poly& divisor, Poly p);
  /// Along the links, in natural coordinates.
  const std::vector<Way>& ways();

  const Geometry* geometry_;
  const Elimination* elimination_;
  const FactoredPoly* determinant_;
  std::optional<std::vector<Way>> ways_;  ///< once they are asked for
  std::vector<PolyPair> known_;           ///< divisors, polynomials
};

}  // namespace clearloci::symbolic
