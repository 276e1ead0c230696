// Cramer determinants by sparse exact elimination (paper (28), (29); method.md section 3):
//     w_k = |A_k| / |A|,   A_k: A with column k replaced by the right-hand side.
// Private to symbolic/.
#pragma once

#include <optional>
#include <vector>

#include "symbolic/factored_poly.hpp"

namespace clearloci::symbolic {

/// value = constant · |rows|.
struct DeterminantForm {
  Poly value;
  core::Rational constant;
  std::vector<std::vector<Poly>> rows;
};

struct CramerDeterminants {
  FactoredPoly determinant;              ///< |A|
  std::vector<FactoredPoly> numerators;  ///< |A_k|, one a column; empty where |A| = 0
  std::vector<DeterminantForm> forms;    ///< of the factors that are computed sooner so than term by term
};

/// Constant pivots of rows without loads are eliminated first, which raises no degree; then short polynomial ones, each
/// row divided by its content so that degrees stay small (the legs of a platform fold up one by one), and rows with
/// loads. What is left is solved by the blocks of its triangular form. |A| is the product of the pivots over what the
/// rows were multiplied by, and the w_k are found backwards in lowest terms: nothing is ever multiplied out that is a
/// product. One elimination serves every column.
CramerDeterminants cramer_determinants(const Ring& ring, const std::vector<std::vector<Poly>>& matrix,
                                       const std::vector<Poly>& right_hand_side);

/// The same as long as no product on the way may have more than `most_terms` terms; nothing else.
std::optional<CramerDeterminants> cramer_determinants_within(std::size_t most_terms, const Ring& ring,
                                                             const std::vector<std::vector<Poly>>& matrix,
                                                             const std::vector<Poly>& right_hand_side);

}  // namespace clearloci::symbolic
