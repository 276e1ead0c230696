// Fills a table row by row: the first row gives names and units, the others put the same names in the same order.
// Private to analysis/.
#pragma once

#include <cstddef>
#include <string>

#include "clearloci/table.hpp"

namespace clearloci {

class TableRows {
 public:
  explicit TableRows(core::Table& table) : table_(table) {}

  void put(const std::string& name, const std::string& unit, double value) {
    if (first_row_) {
      table_.names.push_back(name);
      table_.units.push_back(unit);
      table_.columns.emplace_back();
    }
    table_.columns[next_++].push_back(value);
  }
  void end_row() {
    first_row_ = false;
    next_ = 0;
  }

 private:
  core::Table& table_;
  bool first_row_ = true;
  std::size_t next_ = 0;
};

}  // namespace clearloci
