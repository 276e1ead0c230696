#include <array>

#include "clearloci/pose_tasks.hpp"

namespace clearloci::inline core {

std::string kind_of(const PoseShape& shape) {
  constexpr std::array<const char*, 3> names = {"box", "ball", "path"};
  return names[shape.index()];
}

}  // namespace clearloci::inline core
