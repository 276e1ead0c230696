#include "analysis/side_names.hpp"

#include "core/errors.hpp"

namespace clearloci {

std::vector<std::pair<std::string, std::string>> side_names(const mechanism::Mechanism& mechanism,
                                                            const DyadSides& sides) {
  const std::vector<mechanism::PointIndex> dyads = mechanism::dyad_points(mechanism);
  if (sides.size() != dyads.size())
    throw core::InputError(
        {.file = "--working-mode"},
        "the working mode has " + std::to_string(sides.size()) + " sides, and the mechanism another number of dyads",
        "give one side for each dyad");
  std::vector<std::pair<std::string, std::string>> names;
  for (std::size_t i = 0; i < dyads.size(); ++i)
    names.emplace_back(mechanism.points[static_cast<std::size_t>(dyads[i])].name,
                       mechanism::side_name(mechanism, dyads[i], sides[i]));
  return names;
}

}  // namespace clearloci
