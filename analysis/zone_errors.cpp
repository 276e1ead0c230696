#include "analysis/zone_errors.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci {

std::vector<std::size_t> cells_in(const core::Zone& zone, const core::FieldMap& map) {
  std::vector<std::size_t> cells;
  std::vector<double> crossings;  // of the zone's rings with the row's middle line
  const auto cross = [&](const core::Polyline& ring, double y) {
    for (std::size_t i = 1; i < ring.size(); ++i) {
      const core::Point2 &a = ring[i - 1], &b = ring[i];
      if ((a[1] > y) != (b[1] > y)) crossings.push_back(a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]));
    }
  };
  const double width = (map.upper[0] - map.lower[0]) / map.nx;
  for (int j = 0; j < map.ny; ++j) {
    crossings.clear();
    cross(zone.outer, map.y(j));
    for (const core::Polyline& hole : zone.holes) cross(hole, map.y(j));
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const double first = std::ceil((crossings[k] - map.lower[0]) / width - 0.5);
      for (int i = std::max(0, static_cast<int>(first)); i < map.nx && map.x(i) < crossings[k + 1]; ++i)
        cells.push_back(map.index(i, j));
    }
  }
  return cells;
}

}  // namespace clearloci
