// What loci/ hands to report/ and to the user (clearloci/loci.hpp), and how closed forms are recognised.
#pragma once

#include "clearloci/loci.hpp"
#include "core/locus_factor.hpp"

namespace clearloci::inline core {

/// The closed form of an irreducible polynomial in (x, y), if it is a line, a conic with real points, or a pair of
/// conjugate circles, both with real points.
ClosedForm recognise_closed_form(const Polynomial& implicit);

/// The circles of a closed form, rounded: one, two of a pair, or none.
std::vector<Circle> circles_of(const ClosedForm& form);

/// The one on which all the points lie, to 1e-9 of its radius.
std::optional<Circle> circle_through(const ClosedForm& form, const Polyline& points);

}  // namespace clearloci::inline core
