// Clearances from fits of ISO 286: holes D to H with shafts d to h, standard tolerance grades IT5 to IT11, nominal
// sizes up to 500 mm. The values are those of the standard's tables, which are rounded, not of the formulas behind
// them: ISO 286-1:2010, table 1 (standard tolerances) and tables 2 and 4 (fundamental deviations).
#pragma once

#include <string>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

struct Value;  // mechanism/yaml_input.hpp

/// Least and largest difference of the diameters, µm.
struct DiametralClearance {
  int least = 0, largest = 0;
};

/// `fit`: "H7/g6"; `diameter` in m, above 0 and up to 0.5. Throws core::InputError at `where`.
DiametralClearance diametral_clearance(const std::string& fit, const Rational& diameter,
                                       const core::SourcePosition& where);

/// {fit: H7/g6, diameter: 12 mm} as a clearance: half of it is the difference of the radii.
Fit read_fit(const Mechanism& mechanism, const Value& fit, const Value& diameter);

/// For every joint with a fit what its clearance stands for: a sentence each.
std::vector<std::string> fit_notes(const Mechanism& mechanism);

}  // namespace clearloci::mechanism
