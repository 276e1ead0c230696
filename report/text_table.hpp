// Tables of a text: columns as wide as their cells need, below a rule.
// Private to report/.
#pragma once

#include <string>
#include <vector>

namespace clearloci::report {

enum class Alignment {
  left,
  right,
  point,  ///< numbers, by their decimal points
};

struct Column {
  std::string heading;
  int widest = 0;  ///< cells are wrapped to this; 0: never
  Alignment alignment = Alignment::left;
};

using Row = std::vector<std::string>;

/// Two spaces between columns. A line break in a cell begins a new line of it.
std::string format_rows(const std::vector<Column>& heading, const std::vector<Row>& rows);

/// The same without the columns whose cells are all empty.
std::string format_filled_columns(const std::vector<Column>& heading, const std::vector<Row>& rows);

}  // namespace clearloci::report
