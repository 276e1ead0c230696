// Scalar fields over the plane of two free coordinates, sampled in the middle of the cells of a grid: what numeric/
// computes and report/ draws and writes.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::inline core {

struct Field {
  std::string name;            ///< "dx": of files
  std::string label;           ///< "error in x": of legends
  std::string unit;            ///< "m" or "rad"
  bool is_signed = false;      ///< else a magnitude
  std::vector<double> values;  ///< row after row from the lowest second coordinate; NaN where there is none
};

struct FieldMap {
  std::string mechanism;
  std::array<std::string, 2> coordinates;
  std::array<double, 2> lower{}, upper{};  ///< of the grid's outer edges
  int nx = 0, ny = 0;                      ///< cells
  std::vector<Field> fields;

  double x(int i) const { return lower[0] + (i + 0.5) * (upper[0] - lower[0]) / nx; }
  double y(int j) const { return lower[1] + (j + 0.5) * (upper[1] - lower[1]) / ny; }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i);
  }
};

}  // namespace clearloci::inline core
