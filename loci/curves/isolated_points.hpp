// Points where something vanishes without a curve of it: isolated contact losses (f_J = 0 is two equations, method.md
// section 5) and isolated real points of a single factor.
#pragma once

#include <functional>

#include "core/locus_map.hpp"
#include "loci/curves/curve_arrangement.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {

/// Whether where a factor vanishes the components of a joint's force may do so though the force does not.
inline bool is_undirected_pin(const core::LocusFactor& factor, const std::string& joint) {
  return factor.role == core::FactorRole::construction && !factor.vanishing.empty() &&
         factor.vanishing.front().joint == joint;
}

/// Isolated contact-loss points of one mode: the common zeros of a force's components (force_zeros.hpp) that lie on no
/// contact-loss curve of the map. Appended to the map; what stays undecided is left open, with a point that is not
/// certified where one is found.
/// `stop`: asked now and then, may be empty; true: what is found by then is added and the map marked incomplete.
/// `most_cells`: live ones at a time (sheet::ZeroOptions). `searches`: as there.
void add_contact_loss_points(const core::LocusProblem& problem, const core::WorkingMode& mode, core::LocusMap& map,
                             const std::function<bool()>& stop, int most_cells, sheet::KnownSearches* searches);

/// The points at which |A| vanishes though no curve of the map with |A| = 0 arrives in this mode: where workspace
/// boundaries touch, for both legs are in line with each other there, and where a telescopic leg has no length.
void add_singular_points(const core::LocusProblem& problem, const core::WorkingMode& mode, core::LocusMap& map);

/// Leaves out points at which nothing vanishes but what does along a curve of the map that passes through them, as at a
/// star that a factor reaches along one of its curves and that another of them is: they are none of their own.
void drop_points_on_curves(core::LocusMap& map);

/// A branch of the factor's zeros on the mode's sheet reaches the star.
bool reaches(const core::LocusProblem& problem, const core::WorkingMode& mode, const core::LocusFactor& factor,
             const sheet::Star& star);

/// The isolated real points of the arrangement's curves that lie on the mode's sheet. At a star, where a construction
/// is undefined, numerators vanish whatever the reaction does: there those count that vanish in a direction from it.
void add_isolated_curve_points(const core::LocusProblem& problem, const core::WorkingMode& mode,
                               const CurveArrangement& arrangement,
                               const std::vector<std::vector<int>>& curves_of_factor,
                               const std::vector<sheet::Star>& stars, core::LocusMap& map);

}  // namespace clearloci::loci
