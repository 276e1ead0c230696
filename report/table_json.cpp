#include "report/table_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace clearloci::report {

using Json = nlohmann::ordered_json;

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json table_object(const core::Table& table) {
  Json object = Json::object();
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    Json& column = object[table.names[c]] = Json::array();
    for (const double value : table.columns[c]) column.push_back(number_json(value));
  }
  return object;
}

}  // namespace clearloci::report
