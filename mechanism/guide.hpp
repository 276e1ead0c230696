// The contact of a planar prismatic joint: it touches its guide at two ends, `half_length` to both sides of its point.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// Planar, prismatic, and its clearance says how long the contact is.
bool has_guide_ends(const Mechanism& mechanism, const Joint& joint);

/// The ends, and the sign of T/h in what each bears, (N +- T/h)/2 (core/quantity.hpp).
inline constexpr std::array<std::pair<core::Quantity, int>, 2> guide_end_signs = {
    std::pair{core::Quantity::end_ahead, 1}, std::pair{core::Quantity::end_behind, -1}};

/// What vanishes together where the joint loses its contact: the components of a pin's force; of a guide whose ends are
/// not known all that it bears. None of a guide with ends, which are lost one at a time.
std::vector<core::Quantity> contact_components(const Mechanism& mechanism, const Joint& joint);

/// False of a sleeve whose clearance is along its axis or about it alone: no contact is lost across the axis.
bool plays_across(const Mechanism& mechanism, const Joint& joint);

/// A rational within 1e-30 of the root of a rational, relative to it; exact where the root is rational. Required: not
/// negative. What stands for the length of an axis that is constant, as rationals do for irrational numbers.
Rational near_root(const Rational& square);

}  // namespace clearloci::mechanism
