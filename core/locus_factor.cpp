#include "core/locus_factor.hpp"

namespace clearloci::core {

std::string to_string(Quantity quantity) {
  switch (quantity) {
    case Quantity::f:
      return "f";
    case Quantity::M:
      return "M";
    case Quantity::fx:
      return "fx";
    case Quantity::fy:
      return "fy";
  }
  return {};
}

}  // namespace clearloci::core
