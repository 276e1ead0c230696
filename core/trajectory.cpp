#include "clearloci/trajectory.hpp"

namespace clearloci::inline core {

std::string to_string(LossKind kind) {
  switch (kind) {
    case LossKind::zero:
      return "zero";
    case LossKind::minimum:
      return "minimum";
    case LossKind::jump:
      break;
  }
  return "jump";
}

}  // namespace clearloci::inline core
