#include "core/root_tower.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/append_roots.hpp"
#include "core/errors.hpp"

namespace clearloci::inline core {

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

void append_roots(RootTower& tower, const std::vector<Root>& roots) {
  tower.roots.insert(tower.roots.end(), roots.begin(), roots.end());
  const auto wider = [&](const Polynomial& p) { return with_variables(p, tower.variables()); };
  for (Root& root : tower.roots) rewrite(root, wider);
  for (Polynomial& denominator : tower.denominators) denominator = wider(denominator);
  for (DyadBase& base : tower.bases) {
    base.x = wider(base.x);
    base.y = wider(base.y);
  }
}

std::optional<double> root_value(const Root& root, int sign, std::span<const double> at) {
  if (root.is_angle())
    return angle_shift + std::atan2(evaluate(root.cosine_and_sine[1], at), evaluate(root.cosine_and_sine[0], at));
  const double square = evaluate(root.square, at);
  if (!(square >= 0)) return std::nullopt;
  return sign * std::sqrt(square);
}

std::vector<std::size_t> roots_under(const Polynomial& p, const RootTower& tower) {
  const auto has_root = [&](const Polynomial& element, std::size_t j) {
    return depends_on(element, static_cast<int>(tower.coordinates.size() + j));
  };
  return roots_under(
      tower.roots.size(), [&](std::size_t j) { return has_root(p, j); },
      [&](std::size_t k, std::size_t j) { return has_root(tower.roots[k].square, j); });
}

StraightLine line_of_angle(const StraightLine& sine, const StraightLine& cosine) {
  StraightLineBuilder builder;
  const int y = builder.append(sine), x = builder.append(cosine);
  return builder.line(builder.power(builder.add(builder.constant(angle_shift), builder.angle(y, x)), 2));
}

bool has_angles(const RootTower& tower) {
  return std::any_of(tower.roots.begin(), tower.roots.end(), [](const Root& root) { return root.is_angle(); });
}

TowerNames names_of(const RootTower& tower) {
  TowerNames names{tower.coordinates, {}};
  for (const Root& root : tower.roots) names.roots.push_back({root.name, root.point, root.role, root.sides});
  return names;
}

std::vector<std::pair<std::string, std::string>> describe_mode(const TowerNames& tower, const WorkingMode& mode) {
  ensure(mode.size() == tower.roots.size(), "a working mode has one sign a root");
  std::vector<std::pair<std::string, std::string>> described;
  for (std::size_t j = 0; j < mode.size(); ++j)
    if (tower.roots[j].role == RootRole::working_mode)
      described.emplace_back(tower.roots[j].point, tower.roots[j].sides[mode[j] > 0 ? 0 : 1]);
  return described;
}

}  // namespace clearloci::inline core
