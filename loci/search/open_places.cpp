#include "loci/search/open_places.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace clearloci::loci::sheet {

namespace {

// Of the region.
constexpr double widest_part = 1.0 / 64;

double width_of(const PlaneCell& cell) { return std::max(cell.x.width(), cell.y.width()); }

bool holds(const PlaneCell& outer, const PlaneCell& cell) {
  return outer.x.lower() <= cell.x.lower() && cell.x.upper() <= outer.x.upper() && outer.y.lower() <= cell.y.lower() &&
         cell.y.upper() <= outer.y.upper();
}

}  // namespace

std::vector<PlaneCell> open_places(const std::vector<PlaneCell>& cells, double size) {
  const double widest = widest_part * size;
  std::vector<PlaneCell> places, wide;
  for (const PlaneCell& place : clusters(cells)) (width_of(place) <= widest ? places : wide).push_back(place);
  if (wide.empty()) return places;
  std::map<std::pair<double, double>, PlaneCell> pieces;
  for (const PlaneCell& cell : cells) {
    if (std::none_of(wide.begin(), wide.end(), [&](const PlaneCell& place) { return holds(place, cell); })) continue;
    const std::pair key = {std::floor(cell.x.middle() / widest), std::floor(cell.y.middle() / widest)};
    const auto [piece, fresh] = pieces.try_emplace(key, cell);
    if (!fresh) piece->second = {hull(piece->second.x, cell.x), hull(piece->second.y, cell.y)};
  }
  for (const auto& [key, piece] : pieces) places.push_back(piece);
  return places;
}

}  // namespace clearloci::loci::sheet
