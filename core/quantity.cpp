#include "clearloci/quantity.hpp"

namespace clearloci::inline core {

std::string to_string(Quantity quantity) {
  switch (quantity) {
    case Quantity::f:
      return "f";
    case Quantity::M:
      return "M";
    case Quantity::F:
      return "F";
    case Quantity::N:
      return "N";
    case Quantity::T:
      return "T";
    case Quantity::fx:
      return "fx";
    case Quantity::fy:
      return "fy";
    case Quantity::fz:
      return "fz";
    case Quantity::mx:
      return "mx";
    case Quantity::my:
      return "my";
    case Quantity::mz:
      return "mz";
    case Quantity::f1:
      return "f1";
    case Quantity::f2:
      return "f2";
    case Quantity::m1:
      return "m1";
    case Quantity::m2:
      return "m2";
    case Quantity::end_ahead:
      return "end_ahead";
    case Quantity::end_behind:
      return "end_behind";
  }
  return {};
}

}  // namespace clearloci::inline core
