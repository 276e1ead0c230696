#include "cli/memory_bound.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace clearloci::cli {

void require_memory(double bytes, const std::string& option, const std::string& words) {
  if (bytes <= most_memory) return;
  constexpr double gigabyte = 1024.0 * 1024 * 1024;
  throw core::InputError({.file = option},
                         fmt::format("{} would take about {:.0f} GB of memory, and a call may take {:.0f} GB", words,
                                     bytes / gigabyte, most_memory / gigabyte),
                         "choose fewer nodes or instants, or fewer working modes and formats at a time");
}

}  // namespace clearloci::cli
