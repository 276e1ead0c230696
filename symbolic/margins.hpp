// Where a contact force or a couple is down to a given size (method.md section 5): |f_J|^2 = f_min^2 and
// M_J^2 = M_min^2, cleared of |A|^2. Private to symbolic/.
#pragma once

#include <optional>

#include "symbolic/elimination.hpp"
#include "symbolic/locus_problem.hpp"
#include "symbolic/reactions.hpp"

namespace clearloci::symbolic {

/// A force along a moving line is size w / |A| for a vector w, and of size f_min where size |w| = +-f_min |A|.
/// Squared, the two senses cross wherever size and |A| vanish together, at points that are no better known than the
/// curves; over |w| as another root of the tower they are two curves, smooth there.
struct TwoSenses {
  Poly size;
  std::vector<Poly> w;      ///< its components
  Poly bound;               ///< f_min |A|
  core::Rational over = 1;  ///< |w|^2 is their sum of squares over this number

  Poly square() const;  ///< |w|^2
};

/// A force whose components have nothing in common: |w|^2 = (f_min |A|)^2 is a quadratic form in them and in |A|.
struct SquaredForce {
  std::vector<FactoredPoly> components;  ///< of w
  FactoredPoly bound;                    ///< f_min |A|
};

/// A natural polynomial that vanishes where the reactions are as large as `bound`.
struct Margin {
  Poly natural;
  core::Rational bound;
  std::vector<core::Vanishing> reactions;  ///< of one chain: forces of the same size, or couples
  FactoredPoly below;                      ///< the divisor of |A| that was cleared, to `power`
  int power = 1;
  std::optional<TwoSenses> senses = {};
  std::optional<SquaredForce> force = {};
};

/// Of the named joints, in the mechanism's order. Of a pin or a sleeve in space it is the part of the force across its
/// axis that counts.
std::vector<Margin> margins(const Geometry& geometry, const Elimination& elimination, const FactoredPoly& determinant,
                            const std::vector<Reaction>& reactions, const Selection& selection,
                            const std::vector<std::string>& joints);

/// The root of a rational square; nothing of others.
std::optional<core::Rational> rational_root(const core::Rational& square);

}  // namespace clearloci::symbolic
