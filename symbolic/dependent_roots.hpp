// Roots that depend on earlier ones (method.md section 10): Q_j = c e^2 with a number c and an element e of the field
// of the roots before it, as of two equal legs on one base point (e = s_k) or of a parallelogram (e in the coordinates
// alone). A tower that took s_j for a new element would be no field. Private to symbolic/.
#pragma once

#include <optional>
#include <vector>

#include "symbolic/ring.hpp"

namespace clearloci::symbolic {

struct TowerRoot;

/// c e^2, with c a positive number that is 1 wherever it is the square of another.
struct SquareClass {
  core::Rational constant;
  Poly root;
};

/// What a polynomial over a tower, reduced in its roots, is the square of; nothing where it is none, and no number
/// times one. Decided exactly: residues modulo a prime tell most polynomials that are none, the algebra of conjugates
/// (a + b s is a square only where a^2 - b^2 Q is) all others. `open`: it may be the square of an element that is no
/// polynomial over the tower, which is left undecided.
///
/// `coordinates`: the ring's first variables. `roots`: those before, each known to be independent of its own.
struct SquareTest {
  std::optional<SquareClass> found;
  bool open = false;
};
SquareTest square_class(const Poly& p, int coordinates, const std::vector<TowerRoot>& roots);

/// p / divisor over a tower of such roots, both reduced; nothing where that is no polynomial over the tower.
std::optional<Poly> quotient_over_tower(const Poly& p, const Poly& divisor, const std::vector<TowerRoot>& roots);

/// +1 or -1 where a polynomial in the coordinates keeps that sign all over a box, as far as enclosures tell; 0 where it
/// is not known to.
int sign_over_box(const core::Polynomial& p, const std::vector<core::Rational>& lower,
                  const std::vector<core::Rational>& upper);

}  // namespace clearloci::symbolic
