// Numbers in columns that say their unit: samples of what answers follow over a range, a path or a sweep.
#pragma once

#include <string>
#include <vector>

#include "clearloci/quantity.hpp"

namespace clearloci::inline core {

/// "N" of a force, "N m" of a couple.
std::string unit_of(Quantity quantity);

/// Columns of equal length; NaN where there is no value.
struct Table {
  std::vector<std::string> names;            ///< "fA1x", "dx": each once
  std::vector<std::string> units;            ///< of each column: "m", "rad/s"; empty of a pure number
  std::vector<std::vector<double>> columns;  ///< one a name

  bool has(const std::string& name) const;
  /// Throws std::out_of_range where there is no column of that name.
  const std::vector<double>& at(const std::string& name) const;
};

}  // namespace clearloci::inline core
