#include "report/text_table.hpp"

#include <algorithm>

#include "report/wording.hpp"
#include "report/wrap.hpp"

namespace clearloci::report {
namespace {

std::string spaces(int count) { return std::string(static_cast<std::size_t>(std::max(0, count)), ' '); }

std::string padded(const std::string& text, int width, bool right) {
  const std::string space = spaces(width - columns(text));
  return right ? space + text : text + space;
}

/// The lines of a cell, each wrapped to `width` where that is not 0.
std::vector<std::string> wrapped(const std::string& cell, int width) {
  const auto measure = [](std::string_view text) { return static_cast<double>(columns(text)); };
  std::vector<std::string> lines;
  for (std::size_t start = 0; start <= cell.size();) {
    const std::size_t end = std::min(cell.find('\n', start), cell.size());
    const std::string line = cell.substr(start, end - start);
    if (width == 0) lines.push_back(line);
    if (width != 0)
      for (auto& part : wrap(line, width, measure)) lines.push_back(std::move(part));
    start = end + 1;
  }
  return lines;
}

/// Columns of a number before its point, and from there on.
int before_point(const std::string& number) {
  return static_cast<int>(std::min({number.find('.'), number.find('e'), number.size()}));
}

/// Cells of one column, so that their points are one above the other. What is no number stays as it is.
void align_points(std::vector<Row>& rows, std::size_t column) {
  const auto is_number = [](const std::string& cell) {
    return !cell.empty() && cell.find_first_not_of("0123456789+-.e") == std::string::npos;
  };
  int before = 0, after = 0;
  for (const Row& row : rows) {
    if (!is_number(row[column])) continue;
    before = std::max(before, before_point(row[column]));
    after = std::max(after, columns(row[column]) - before_point(row[column]));
  }
  for (Row& row : rows) {
    std::string& cell = row[column];
    if (!is_number(cell)) continue;
    const int point = before_point(cell);
    cell = spaces(before - point) + cell + spaces(after - (columns(cell) - point));
  }
}

}  // namespace

std::string format_rows(const std::vector<Column>& heading, const std::vector<Row>& given) {
  std::vector<Row> rows = given;
  for (std::size_t c = 0; c < heading.size(); ++c)
    if (heading[c].alignment == Alignment::point) align_points(rows, c);
  std::vector<int> widths;
  std::vector<std::vector<std::vector<std::string>>> cells(rows.size());
  for (std::size_t c = 0; c < heading.size(); ++c) {
    int width = columns(heading[c].heading);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      cells[r].push_back(wrapped(rows[r][c], heading[c].widest));
      for (const auto& line : cells[r].back()) width = std::max(width, columns(line));
    }
    widths.push_back(width);
  }
  std::string out;
  const auto add_line = [&](const auto& text_of) {
    std::string line;
    for (std::size_t c = 0; c < heading.size(); ++c)
      line += (c == 0 ? "" : "  ") + padded(text_of(c), widths[c], heading[c].alignment != Alignment::left);
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  };
  add_line([&](std::size_t c) { return heading[c].heading; });
  add_line([&](std::size_t c) {
    std::string rule;
    for (int i = 0; i < widths[c]; ++i) rule += "─";
    return rule;
  });
  for (const auto& row : cells) {
    std::size_t height = 0;
    for (const auto& cell : row) height = std::max(height, cell.size());
    for (std::size_t i = 0; i < height; ++i)
      add_line([&](std::size_t c) { return i < row[c].size() ? row[c][i] : std::string(); });
  }
  return out;
}

std::string format_filled_columns(const std::vector<Column>& heading, const std::vector<Row>& rows) {
  std::vector<Column> filled;
  std::vector<Row> cells(rows.size());
  for (std::size_t c = 0; c < heading.size(); ++c) {
    if (std::all_of(rows.begin(), rows.end(), [&](const Row& row) { return row[c].empty(); })) continue;
    filled.push_back(heading[c]);
    for (std::size_t r = 0; r < rows.size(); ++r) cells[r].push_back(rows[r][c]);
  }
  return format_rows(filled, cells);
}

}  // namespace clearloci::report
