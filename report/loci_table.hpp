// The table `clearloci loci` prints.
#pragma once

#include <string>

#include "core/locus_map.hpp"

namespace clearloci::report {

/// For each working mode, a row a curve: id, kind, what vanishes, where (cause and factor), degree, closed form, number
/// of arcs, length; then its isolated points; at the end the notes. UTF-8, at most 120 columns wide: longer cells
/// are wrapped. Ends with a newline. In the units of the map's file; angles in degrees. `exact`: closed forms as
/// closed_form_words.
std::string loci_table(const core::LocusMap& map, bool exact = false);

}  // namespace clearloci::report
