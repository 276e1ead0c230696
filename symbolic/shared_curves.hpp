// Whether two factors can vanish together along a curve of one of them, told at a point of the curve modulo a prime.
// Private to symbolic/.
#pragma once

#include <list>
#include <optional>
#include <vector>

#include "symbolic/geometry.hpp"
#include "symbolic/residue.hpp"

namespace clearloci::symbolic {

/// A polynomial that vanishes all along a component of the curve vanishes at all of its points modulo a prime too, over
/// whichever signs of the roots: one point at which it does not, for any signs, is a proof that there is no such
/// component. Nothing is expanded for it. Points are taken in the quadratic extension of the field of the prime, where
/// every number of the field has a root: else a curve along which a product of roots is rational and no square modulo
/// the prime, or one that falls into two over such a root, would have no point at all.
class SharedCurves {
 public:
  explicit SharedCurves(const Geometry& geometry);

  /// Whether a natural polynomial may vanish along a curve of `curves` (irreducible, in the free coordinates) on sheets
  /// where `sheet` vanishes. False is certain.
  bool may_vanish_along(const std::vector<Poly>& curves, const Poly& sheet, const Poly& natural);

  /// Whether a natural polynomial may be the same number in every pose. False is certain.
  bool may_be_constant(const Poly& natural);

 private:
  /// A polynomial modulo the prime.
  struct Reduced {
    std::vector<unsigned long> coefficients;
    std::vector<std::vector<std::pair<int, int>>> monomials;  ///< ring variable, power
  };
  /// All points above one point of a curve: values of the ring's variables, one set for each choice of signs.
  using Fibre = std::vector<std::vector<Residue>>;

  const Reduced& reduced(const Poly& p);
  Residue value(const Reduced& p, const std::vector<Residue>& at) const;
  std::optional<Fibre> fibre(const Poly& curve, unsigned seed);
  const std::optional<Fibre>& fibre_of(const Poly& curve);

  const Geometry& geometry_;
  std::list<std::pair<Poly, Reduced>> known_;
  std::list<std::pair<Poly, std::optional<Fibre>>> fibres_;
};

}  // namespace clearloci::symbolic
