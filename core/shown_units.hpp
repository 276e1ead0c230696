// SI values as people read them: in the units of their mechanism file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "clearloci/units.hpp"

namespace clearloci::inline core {

/// The unit in which a quantity of SI units is shown, and how many of it one SI unit is: "mm/s", 1000 for "m/s".
struct ShownUnit {
  std::string name;
  double per_si = 1;
};
/// In the file's units where it declares them, else `si` itself. Of lengths, angles, forces, their rates and areas.
ShownUnit shown_unit(const std::string& si, const Units& units);

/// The same in a sentence or a table: angles are in degrees unless the file says otherwise.
ShownUnit told_unit(const std::string& si, const Units& units);

/// "60 mm": a value in SI units as it is told in a sentence.
std::string told(double value, const std::string& si, const Units& units, int digits = 6);

/// A sentence made where nothing is known of the file's units, with its SI quantities told in them: places "(0.25,
/// -0.7)" by the free coordinates, boxes "[0.1, 0.2] x [0.3, 0.4]" likewise, and numbers before m, m^2, rad or N.
std::string in_file_units(const std::string& sentence, const Units& units, const std::vector<bool>& angles);
std::vector<std::string> in_file_units(std::vector<std::string> sentences, const Units& units,
                                       const std::vector<bool>& angles);

}  // namespace clearloci::inline core
