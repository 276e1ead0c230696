#include "analysis/zone_errors.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace clearloci {
namespace {

std::vector<std::size_t> cells_in_rings(const core::Zone& zone, const core::FieldMap& map) {
  std::vector<std::size_t> cells;
  std::vector<double> crossings;  // of the zone's rings with the row's middle line
  const auto cross = [&](const core::Polyline& ring, double y) {
    for (std::size_t i = 1; i < ring.size(); ++i) {
      const core::Point2 &a = ring[i - 1], &b = ring[i];
      if ((a[1] > y) != (b[1] > y)) crossings.push_back(a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]));
    }
  };
  const std::vector<double>&xs = map.axes[0], &ys = map.axes[1];
  for (std::size_t j = 0; j < ys.size(); ++j) {
    crossings.clear();
    cross(zone.outer, ys[j]);
    for (const core::Polyline& hole : zone.holes) cross(hole, ys[j]);
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      for (auto x = std::lower_bound(xs.begin(), xs.end(), crossings[k]); x != xs.end() && *x < crossings[k + 1]; ++x)
        cells.push_back(map.index({static_cast<std::size_t>(x - xs.begin()), j}));
  }
  return cells;
}

std::vector<std::size_t> cells_between_ends(const core::Zone& zone, const core::FieldMap& map) {
  std::vector<std::size_t> cells;
  const std::vector<double>& at = map.axes.front();
  for (std::size_t i = 0; i < at.size(); ++i)
    if (zone.lower[0] < at[i] && at[i] < zone.upper[0]) cells.push_back(i);
  return cells;
}

}  // namespace

std::vector<std::size_t> cells_in(const core::Zones& zones, std::size_t number, const core::FieldMap& map) {
  const core::Zone& zone = zones.zones[number];
  if (!zones.by_cells) return cells_in_rings(zone, map);
  if (map.dimension() == 1) return cells_between_ends(zone, map);
  const auto found = std::find_if(zones.modes.begin(), zones.modes.end(),
                                  [&](const core::ZonedMode& mode) { return mode.mode == zone.mode; });
  core::ensure(found != zones.modes.end() && found->labels.size() == map.size(), "zones have labels on the map's grid");
  std::vector<std::size_t> cells;
  for (std::size_t k = 0; k < found->labels.size(); ++k)
    if (found->labels[k] == static_cast<int>(number) + 1) cells.push_back(k);
  return cells;
}

}  // namespace clearloci
