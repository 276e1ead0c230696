// What is compiled into the program: the page, and the examples with their tasks and trajectories.
#pragma once

#include <span>
#include <string_view>

namespace clearloci::workbench {

struct Asset {
  std::string_view path;  ///< "index.html"; of examples below examples/: "tasks/pick_and_place.yaml"
  std::string_view bytes;
};

std::span<const Asset> page_assets();
std::span<const Asset> example_assets();

}  // namespace clearloci::workbench
