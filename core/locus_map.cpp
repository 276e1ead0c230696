#include "core/locus_map.hpp"

#include "core/errors.hpp"

namespace clearloci::core {

std::string to_string(LocusKind kind) {
  switch (kind) {
    case LocusKind::contact_loss:
      return "contact-loss";
    case LocusKind::backlash:
      return "backlash";
    case LocusKind::component:
      return "component";
    case LocusKind::margin:
      return "margin";
    case LocusKind::direct_singularity:
      return "direct-singularity";
    case LocusKind::workspace_boundary:
      return "workspace-boundary";
    case LocusKind::no_limit:
      return "no-limit";
  }
  return {};
}

std::string to_string(ArcEnd end) {
  switch (end) {
    case ArcEnd::none:
      return "none";
    case ArcEnd::boundary:
      return "boundary";
    case ArcEnd::direct_singularity:
      return "direct-singularity";
    case ArcEnd::box:
      return "box";
    case ArcEnd::crossing:
      return "crossing";
  }
  return {};
}

std::vector<std::pair<std::string, std::string>> describe_mode(const RootTower& tower, const WorkingMode& mode) {
  ensure(mode.size() == tower.roots.size(), "a working mode has one sign a root");
  std::vector<std::pair<std::string, std::string>> described;
  for (std::size_t j = 0; j < mode.size(); ++j)
    if (tower.roots[j].role == RootRole::working_mode)
      described.emplace_back(tower.roots[j].point, tower.roots[j].sides[mode[j] > 0 ? 0 : 1]);
  return described;
}

}  // namespace clearloci::core
