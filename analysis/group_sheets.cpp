#include "analysis/group_sheets.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/errors.hpp"

namespace clearloci {
std::string names_of_groups(const mechanism::Mechanism& mechanism) {
  std::string names;
  for (const mechanism::Group& group : mechanism.groups) names += (names.empty() ? "" : ", ") + group.name;
  return (mechanism.groups.size() > 1 ? "groups " : "group ") + names;
}

bool is_full_turn(double lower, double upper) {
  constexpr double of_turn = 1e-12;
  return std::abs(upper - lower - 2 * std::numbers::pi) <= of_turn;
}

std::optional<loci::pose::CoveredBox> cover_groups(const mechanism::Mechanism& mechanism,
                                                   const std::vector<double>& lower, const std::vector<double>& upper,
                                                   const std::optional<std::chrono::steady_clock::time_point>& deadline,
                                                   core::PoseStatics& statics, std::vector<std::string>& notes) {
  if (mechanism.groups.empty()) return std::nullopt;
  loci::pose::BlockSheetEffort effort{.deadline = deadline};
  for (std::size_t c = 0; c < lower.size(); ++c)
    effort.turns.push_back(mechanism.coordinates[c].angle && is_full_turn(lower[c], upper[c]));
  loci::pose::CoveredBox found = loci::pose::cover_box(statics.program, lower, upper, effort);
  const std::string names = names_of_groups(mechanism);
  if (!found.starts)
    throw core::InputError({mechanism.file, mechanism.groups.front().where.line, mechanism.groups.front().where.column},
                           "no straight way leads from the posture of " + names +
                               " into the box without a dead centre, in this working mode",
                           "give a posture at a pose of the box, with the sides of the working mode");
  statics.sheet = found.sheet;
  if (found.differs) notes.push_back("two layers of " + names + " meet in the box: nothing is proven where they do");
  if (found.out_of_effort)
    notes.push_back("the sheet of " + names + " was not followed to its end: poses beyond are in doubt");
  if (!found.complete && !found.out_of_effort && lower.size() > 1) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1g", found.finest);
    notes.push_back("the sheet of " + names + " ends in the box, at dead centres; what it reaches through passages " +
                    "narrower than " + text + " of the box is not told, and poses beside a dead centre may count as " +
                    "out of reach");
  }
  return found;
}

}  // namespace clearloci
