#include "core/root_tower.hpp"

#include <cstdint>

#include "core/errors.hpp"

namespace clearloci::core {

std::vector<WorkingMode> all_working_modes(const RootTower& tower, const WorkingMode& first) {
  ensure(first.size() == tower.roots.size(), "a working mode has one sign a root");
  std::vector<std::size_t> choices;
  for (std::size_t j = 0; j < tower.roots.size(); ++j)
    if (tower.roots[j].role == RootRole::working_mode) choices.push_back(j);
  ensure(choices.size() < 31, "the working modes can be listed");
  // Counting in binary over the signs that differ from `first`, the last root's fastest.
  std::vector<WorkingMode> modes;
  for (std::uint32_t count = 0; count < (std::uint32_t{1} << choices.size()); ++count) {
    WorkingMode mode = first;
    for (std::size_t k = 0; k < choices.size(); ++k)
      if ((count >> k) & 1U) mode[choices[choices.size() - 1 - k]] *= -1;
    modes.push_back(std::move(mode));
  }
  return modes;
}

}  // namespace clearloci::core
