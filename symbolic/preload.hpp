// Where the choice of preloads changes (method.md section 15). With r efforts free every reaction is, over |A|, a row
//     |A| w_i = N_i + sum_j lambda_j N_ij,
// and r + 1 of them vanish at one lambda where the determinant of their rows (N_i, N_i1 ... N_ir) does: |A|^r times
// that of A with -w_e and the columns of the r efforts in the place of r + 1 of its columns. Private to symbolic/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/reactions.hpp"

namespace clearloci::symbolic {

/// Without what all of its entries share.
struct PreloadRow {
  FactoredPoly load;
  std::vector<FactoredPoly> efforts;
  FactoredPoly content;  ///< that; zero for a row of zeros
};

/// `columns`: of one reaction under the loads, then under one unit of each effort alone.
PreloadRow preload_row(const std::vector<const FactoredPoly*>& columns);

/// Rows that vanish together: a demanded reaction with all of its components, an effort at a bound, or, with
/// `infinite`, an effort without bound.
struct PreloadConstraint {
  std::vector<PreloadRow> rows;
  std::vector<core::Vanishing> vanishing;
  std::string words = {};  ///< of a bound: "B2 at 30 N m"; of a reaction at its least size: "M_A1 at -2 N m"
  bool infinite = false;
  std::optional<core::Vanishing> bounded = {};  ///< of a bound: which effort; two bounds of one do not hold together
};

/// Of a number of rows, as of constraints: an effort without bound, one at a bound, one that has backlash itself.
PreloadRow infinite_row(std::size_t efforts, const FactoredPoly& determinant);
PreloadRow bound_row(std::size_t efforts, std::size_t effort, const core::Rational& bound,
                     const FactoredPoly& determinant);

/// What of an effort's choice ends where a factor vanishes.
struct PreloadEvent {
  std::vector<core::Vanishing> vanishing;
  std::vector<std::string> words;  ///< PreloadConstraint::words of those that have some
  bool infinite = false;
  bool alone = false;                         ///< of reactions whose components are the same, with nothing else
  std::vector<core::Vanishing> bounded = {};  ///< efforts that are at a bound
};

struct PreloadFactor {
  Poly natural;
  std::vector<PreloadEvent> events;
};

/// The determinant of r + 1 rows over |A|^r, and without their contents; whose they are.
struct PreloadDeterminant {
  PreloadEvent event;
  FactoredPoly value;
};

struct PreloadDeterminants {
  std::vector<PreloadDeterminant> all;
  std::vector<PreloadFactor> factors;  ///< of all of them, each once
  std::vector<std::string> left_out;   ///< names of constraints whose determinant is too long to be had
};

/// Of all constraints that have r + 1 rows together; those that have the same rows, but for constants, are one. A
/// factor with which the efforts' columns of the rows lose rank gives no equilibrium and is left out.
PreloadDeterminants preload_determinants(const Ring& ring, const FactoredPoly& determinant, std::size_t efforts,
                                         const std::vector<PreloadConstraint>& constraints);

/// "M_A1 and M_A3 can only vanish together". `motors`: "B2".
std::string words_of(const PreloadEvent& event, const std::string& motors, std::size_t efforts);

}  // namespace clearloci::symbolic
