#include "clearloci/table.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace clearloci::inline core {

std::string unit_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::M:
    case Quantity::T:
    case Quantity::mx:
    case Quantity::my:
    case Quantity::mz:
    case Quantity::m1:
    case Quantity::m2:
      return "N m";
    default:
      return "N";
  }
}

bool Table::has(const std::string& name) const { return std::find(names.begin(), names.end(), name) != names.end(); }

const std::vector<double>& Table::at(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw std::out_of_range("no column '" + name + "'");
  return columns[static_cast<std::size_t>(found - names.begin())];
}

}  // namespace clearloci::inline core
