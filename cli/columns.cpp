#include "cli/columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/errors.hpp"

namespace clearloci::cli {

using Json = nlohmann::ordered_json;

bool Columns::has(const std::string& name) const { return std::find(names.begin(), names.end(), name) != names.end(); }

const std::vector<double>& Columns::at(const std::string& name) const {
  for (std::size_t c = 0; c < names.size(); ++c)
    if (names[c] == name) return columns[c];
  core::ensure(false, "the column is there");
  return columns.front();
}

void ColumnRows::put(const std::string& name, double value) {
  if (first_row_) {
    table_.names.push_back(name);
    table_.columns.emplace_back();
  }
  table_.columns[next_++].push_back(value);
}

void ColumnRows::end_row() {
  first_row_ = false;
  next_ = 0;
}

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json columns_json(const Columns& table) {
  Json object = Json::object();
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    Json& column = object[table.names[c]] = Json::array();
    for (const double value : table.columns[c]) column.push_back(number_json(value));
  }
  return object;
}

core::Polyline line(const std::vector<double>& x, const std::vector<double>& y, double factor) {
  core::Polyline points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], factor * y[i]});
  return points;
}

core::Polyline angle_line(const std::vector<double>& x, const std::vector<double>& y) {
  constexpr double degrees = 180 / std::numbers::pi, nan = std::numeric_limits<double>::quiet_NaN();
  core::Polyline points;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i > 0 && std::abs(y[i] - y[i - 1]) > 1.5 * std::numbers::pi) points.push_back({nan, nan});
    points.push_back({x[i], degrees * y[i]});
  }
  return points;
}

}  // namespace clearloci::cli
