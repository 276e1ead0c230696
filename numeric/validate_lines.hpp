// The witness along the lines of a grid over one coordinate or three (validate.hpp).
// Private to numeric/.
#pragma once

#include "numeric/model.hpp"
#include "numeric/validate.hpp"

namespace clearloci::numeric {

ValidationReport validate_lines(const NumericModel& model, const core::LocusMap& map, const GridSpec& spec,
                                const std::vector<TracedReaction>& traced);

}  // namespace clearloci::numeric
