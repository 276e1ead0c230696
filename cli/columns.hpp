// Tables of numbers that are filled row by row, and the lines that charts draw of their columns.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::cli {

/// Columns of equal length; NaN where there is no value.
struct Columns {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  bool has(const std::string& name) const;
  /// Required: the column is there.
  const std::vector<double>& at(const std::string& name) const;
};

/// Fills a table row by row: the first row gives the names, the others put the same names in the same order.
class ColumnRows {
 public:
  explicit ColumnRows(Columns& table) : table_(table) {}
  void put(const std::string& name, double value);
  void end_row();

 private:
  Columns& table_;
  bool first_row_ = true;
  std::size_t next_ = 0;
};

/// {"time": [0.0, ...], ...}; null where there is no value.
nlohmann::ordered_json columns_json(const Columns& table);

/// null for infinities and NaN, which JSON does not have.
nlohmann::ordered_json number_json(double value);

/// y over x, broken where y is not a number; `factor` on y.
core::Polyline line(const std::vector<double>& x, const std::vector<double>& y, double factor = 1);

/// An angle in degrees, broken where it passes from 180 to -180.
core::Polyline angle_line(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace clearloci::cli
