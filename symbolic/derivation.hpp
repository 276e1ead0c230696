// What one locus problem is derived from, and what is derived so far. The stages in their order: the reactions (here),
// their factors (collect_factors.hpp), which of them are needed (factor_selection.hpp), and the factors of the problem
// (factor_emission.hpp). Private to symbolic/.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/angle_range.hpp"
#include "symbolic/causes.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/factor_text.hpp"
#include "symbolic/family.hpp"
#include "symbolic/guide_ends.hpp"
#include "symbolic/locus_problem.hpp"
#include "symbolic/preload_constraints.hpp"
#include "symbolic/reactions.hpp"
#include "symbolic/sheets.hpp"
#include "symbolic/straight_lines.hpp"

namespace clearloci::symbolic {

/// A natural factor that occurs in numerators, with what vanishes on it.
struct SharedFactor {
  Poly natural;
  std::vector<core::Vanishing> vanishing;
  bool wanted_curve = false;  ///< its curves are to be traced
  bool wanted_point = false;  ///< it takes part in an isolated contact loss
  bool wanted_order = false;  ///< its order tells what a reaction does where |A| vanishes too
};

/// A factor of |A| over the tower.
struct DeterminantPart {
  const PolyFactor* natural = nullptr;
  SheetFactor sheet;
  int multiplicity = 1;                    ///< in |A|
  bool alone = true;                       ///< the natural factor is this, once, but for denominators
  std::vector<core::Vanishing> cancelled;  ///< LocusFactor::cancelled
  bool may_be_idle = false;
  bool chosen = false;  ///< other efforts free, A is regular there
};

/// A sheet of which nothing is asked. `pieces`: of the ranges of the angles, in the order of the coordinates.
core::LocusProblem problem_without_modes(const Geometry& geometry, const std::vector<ChartRange>& pieces);

struct Derivation {
  /// `found`: of the sheet's geometry. `known`: of other sheets of the mechanism; may be null.
  Derivation(const mechanism::Mechanism& m, const Selection& asked, const std::vector<ChartRange>& pieces,
             FactoredDeterminants found, SheetGeometry sheet, KnownEliminations* known);
  Derivation(const Derivation&) = delete;
  Derivation& operator=(const Derivation&) = delete;

  bool wanted(core::Quantity quantity) const;
  bool selected(const std::string& joint) const;
  /// Wanted by itself or as a part of f.
  bool is_asked_for(const std::string& joint, core::Quantity quantity) const;
  bool is_always_zero(const std::string& joint, core::Quantity quantity) const;
  const std::string& point_name(mechanism::PointIndex point) const;
  /// Of |A| and of what is asked for; a certificate claims that they have no zeros, but for points. They alone of
  /// `rest` have sheets.
  void keep_without_curves(core::FactorRole role, const std::string& expression, const std::vector<Poly>& sheets);

  const mechanism::Mechanism& mechanism;
  const Selection& selection;
  std::vector<Sides> modes;
  Geometry geometry;
  FactoredDeterminants determinants;
  Elimination elimination;
  Causes causes;
  FactorText words;
  PreloadColumns preload;  ///< of free efforts without a value
  std::vector<Reaction> reactions;
  std::vector<Guide> guides;
  StraightLines lines;
  std::vector<SharedFactor> factors;                        ///< of the reactions
  std::vector<std::pair<Poly, core::Vanishing>> cancelled;  ///< natural factors of |A| and a numerator, and how often
  std::vector<DeterminantPart> determinant_parts;
  DerivedProblem result;

 private:
  core::WorkingMode mode_of(const Sides& sides) const;
  /// Of free efforts without a value what vanishes at all of them takes the place of what vanishes.
  void write_reactions();
  /// Of pins in space, where contact losses or what they are made of are asked for.
  void add_pressing_reactions();
};

}  // namespace clearloci::symbolic
