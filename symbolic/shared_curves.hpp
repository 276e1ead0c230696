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
/// the prime, or one that falls into two over such a root, would have no point at all. A root that stands on others may
/// be in no such field: it is kept as what squares to its square, for both signs at once.
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
  /// Values of the ring's variables for one choice of signs of the roots that are in the field, and for both signs of
  /// the others.
  struct Point {
    Extension field;
    std::vector<Extension::Element> at;
  };
  /// All points above one point of a curve.
  using Fibre = std::vector<Point>;

  const Reduced& reduced(const Poly& p);
  static Extension::Element value(const Reduced& p, const Point& point);
  Residue value(const Poly& p, const std::vector<Residue>& at);
  /// Into the constructed points. False: a place divides by zero.
  bool place(Point& point);
  std::optional<Fibre> fibre(const Poly& curve, unsigned seed);
  const std::optional<Fibre>& fibre_of(const Poly& curve);

  const Geometry& geometry_;
  std::vector<Substitution> substitutions_;
  std::list<std::pair<Poly, Reduced>> known_;
  std::list<std::pair<Poly, std::optional<Fibre>>> fibres_;
};

}  // namespace clearloci::symbolic
