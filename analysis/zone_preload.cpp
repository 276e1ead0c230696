#include "analysis/zone_preload.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/effort_cells.hpp"
#include "analysis/idle_efforts.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/pose_efforts.hpp"
#include "analysis/pose_tensions.hpp"
#include "analysis/task_demands.hpp"
#include "core/rational.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/effort_gaps.hpp"

namespace clearloci {
namespace {

using mechanism::Mechanism;
using numeric::EffortGap;
using Signs = std::vector<std::pair<core::Vanishing, int>>;

std::vector<numeric::Bounded> exactly(const std::vector<double>& pose) { return {pose.begin(), pose.end()}; }

/// The efforts of one zone after the other.
class SampleEfforts {
 public:
  SampleEfforts(const Mechanism& mechanism, mechanism::JointIndex joint, const LociRequest& request, core::Zones& map)
      : mechanism_(mechanism),
        joint_(mechanism.joints[static_cast<std::size_t>(joint)]),
        request_(request),
        models_(models_under_efforts(mechanism, {joint})),
        map_(map) {}

  void run() {
    std::vector<std::string> notes;
    for (const core::ZonedMode& mode : map_.modes) {
      const std::vector<int> sides = numeric::dyad_signs(models_[0], map_.loci.tower, mode.mode);
      std::vector<std::vector<double>> poses;
      for (const core::Zone& zone : map_.zones)
        if (zone.mode == mode.mode) poses.push_back(zone.sample);
      if (poses.empty()) continue;
      const std::vector<core::TaskDemand> demands =
          loaded_demands(models_, sides, demands_of(mechanism_, request_), poses, notes);
      for (core::Zone& zone : map_.zones)
        if (zone.mode == mode.mode) zone.preload = at(zone.sample, sides, demands);
    }
  }

 private:
  std::optional<core::ZonePreload> at(const std::vector<double>& pose, const std::vector<int>& sides,
                                      const std::vector<core::TaskDemand>& demands) const {
    const numeric::Bounded determinant = numeric::bounded_numerators(models_[0], exactly(pose), sides).determinant;
    if (!(std::abs(determinant.value) > determinant.error)) return std::nullopt;
    std::vector<EffortGap> gaps = numeric::effort_gaps(models_[0], models_[1], exactly(pose), sides, demands);
    if (const auto gap = own_gap(mechanism_, joint_.name, request_)) gaps.push_back(*gap);
    core::ZonePreload preload;
    FeasibleEfforts& efforts = preload.efforts.emplace_back(efforts_without_ranges(joint_));
    set_ranges(gaps, efforts);
    preload.feasible = !efforts.ranges.empty();
    for (const EffortRange& range : efforts.ranges) {
      preload.patterns.push_back(pattern_of(range, gaps));
      const double effort = range.from > 0 ? range.from : range.to < 0 ? range.to : 0;
      if (preload.smallest && *preload.smallest <= size_of(effort)) continue;
      preload.smallest = size_of(effort);
      efforts.effort = effort;
    }
    return preload;
  }

  double size_of(double effort) const {
    return std::abs(effort) / core::to_double(reference_effort(*joint_.free_effort));
  }

  static Signs pattern_of(const EffortRange& range, const std::vector<EffortGap>& gaps) {
    Signs signs;
    for (const EffortGap& gap : gaps)
      if (gap.sign_above != 0)
        signs.emplace_back(core::Vanishing{gap.demand.joint, gap.demand.quantity, 1},
                           range.from >= gap.to ? gap.sign_above : -gap.sign_above);
    return signs;
  }

  const Mechanism& mechanism_;
  const mechanism::Joint& joint_;
  const LociRequest& request_;
  std::vector<numeric::NumericModel> models_;
  core::Zones& map_;
};

/// Of several free efforts.
void add_cells(const Mechanism& mechanism, const LociRequest& request, core::Zones& map) {
  const numeric::NumericModel model = numeric::compile(with_idle_efforts(mechanism));
  const std::vector<core::TaskDemand> demands = demands_of(mechanism, request);
  for (core::Zone& zone : map.zones)
    zone.preload = efforts_in_cells(mechanism, zone.sample, numeric::dyad_signs(model, map.loci.tower, zone.mode),
                                    demands, request);
}

core::ZonePreload tensions_at(const Mechanism& mechanism, const std::vector<double>& pose, const DyadSides& sides) {
  core::ZonePreload preload;
  preload.efforts = pose_tensions(mechanism, exactly(pose), sides).efforts;
  for (const FeasibleEfforts& efforts : preload.efforts) {
    if (efforts.ranges.empty()) continue;
    preload.feasible = true;
    preload.smallest = std::max(preload.smallest.value_or(0), std::abs(efforts.effort) / (*efforts.within)[1]);
  }
  return preload;
}

void add_tensions(const Mechanism& mechanism, core::Zones& map) {
  const numeric::NumericModel model = numeric::compile(with_idle_efforts(mechanism));
  for (core::Zone& zone : map.zones)
    zone.preload = tensions_at(mechanism, zone.sample, numeric::dyad_signs(model, map.loci.tower, zone.mode));
}

Signs sorted(Signs signs) {
  const auto key = [](const auto& zone) { return std::pair(zone.first.joint, zone.first.quantity); };
  std::sort(signs.begin(), signs.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return signs;
}

bool has_pattern(const core::Zone& zone, const Signs& signs) {
  return zone.preload && std::any_of(zone.preload->patterns.begin(), zone.preload->patterns.end(),
                                     [&](const Signs& pattern) { return sorted(pattern) == signs; });
}

/// All zones that efforts with these signs reach from a first one.
core::PreloadRegion region_from(const core::Zones& map, const core::Zone& first, const Signs& signs) {
  core::PreloadRegion region{first.mode, signs, {}, 0};
  std::vector<std::string> open = {first.id};
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    if (std::find(region.zones.begin(), region.zones.end(), name) != region.zones.end()) continue;
    const auto zone = std::find_if(map.zones.begin(), map.zones.end(),
                                   [&](const core::Zone& candidate) { return candidate.id == name; });
    if (zone == map.zones.end() || !has_pattern(*zone, signs)) continue;
    region.zones.push_back(name);
    region.size += zone->size;
    for (const core::ZoneBorder& border : zone->borders)
      if (border.kind == core::LocusKind::preload) open.insert(open.end(), border.beside.begin(), border.beside.end());
  }
  return region;
}

void find_regions(core::Zones& map) {
  std::vector<core::PreloadRegion>& regions = map.preload_regions;
  for (const core::Zone& zone : map.zones) {
    if (!zone.preload) continue;
    for (const Signs& pattern : zone.preload->patterns) {
      const Signs signs = sorted(pattern);
      const bool is_present = std::any_of(regions.begin(), regions.end(), [&](const core::PreloadRegion& region) {
        return region.mode == zone.mode && region.signs == signs &&
               std::find(region.zones.begin(), region.zones.end(), zone.id) != region.zones.end();
      });
      if (!is_present) regions.push_back(region_from(map, zone, signs));
    }
  }
  std::vector<core::WorkingMode> modes;
  for (const core::ZonedMode& mode : map.modes) modes.push_back(mode.mode);
  const auto key = [&](const core::PreloadRegion& region) {
    return std::pair(std::find(modes.begin(), modes.end(), region.mode) - modes.begin(), -region.size);
  };
  std::stable_sort(regions.begin(), regions.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
}

}  // namespace

PreloadLabel label_of_preload(const Mechanism& mechanism, const mechanism::Frame& frame) {
  if (!only_tensions_are_free(mechanism)) return {};
  return [&mechanism, frame, model = numeric::compile(with_idle_efforts(mechanism))](
             const core::TowerNames& tower, const core::WorkingMode& mode, std::vector<double> sample) -> std::string {
    for (std::size_t i = 0; i < sample.size(); ++i)
      sample[i] = (i < frame.from.size() ? core::to_double(frame.from[i]) : 0) + frame.scale_value() * sample[i];
    return tensions_at(mechanism, sample, numeric::dyad_signs(model, tower, mode)).feasible ? "feasible" : "none";
  };
}

void add_preload(const Mechanism& mechanism, const LociRequest& request, core::Zones& map) {
  const std::vector<mechanism::JointIndex> joints = mechanism::joints_without_preload(mechanism);
  if (joints.empty()) return;
  if (only_tensions_are_free(mechanism)) return add_tensions(mechanism, map);
  if (joints.size() == 1) {
    SampleEfforts(mechanism, joints.front(), request, map).run();
    find_regions(map);
    return;
  }
  add_cells(mechanism, request, map);
  find_regions(map);
}

}  // namespace clearloci
