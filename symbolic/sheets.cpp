#include "symbolic/sheets.hpp"

#include <algorithm>

#include "symbolic/angle_range.hpp"

namespace clearloci::symbolic {
namespace {

/// Both sides of every fold of one mode; which folds there are may depend on the side of those before.
std::vector<SheetGeometry> sides_of_folds(const mechanism::Mechanism& mechanism, const Charts& charts,
                                          const Sides& mode) {
  std::vector<SheetGeometry> result;
  std::vector<std::vector<int>> open = {{}};
  while (!open.empty()) {
    std::vector<int> halves = std::move(open.back());
    open.pop_back();
    Geometry geometry(mechanism, false, charts, {mode, halves});
    if (geometry.folds().size() == halves.size()) {
      result.push_back({std::move(geometry), {mode}});
      continue;
    }
    for (const int half : {-1, 1}) {
      open.push_back(halves);
      open.back().push_back(half);
    }
  }
  return result;
}

}  // namespace

std::vector<SheetGeometry> sheet_geometries(const mechanism::Mechanism& mechanism, const Charts& charts,
                                            const std::vector<Sides>& modes) {
  std::vector<std::vector<SheetGeometry>> found;
  for (const Sides& mode : modes) {
    const auto alike = std::find_if(found.begin(), found.end(), [&](const std::vector<SheetGeometry>& sheets) {
      return std::all_of(sheets.begin(), sheets.end(),
                         [&](const SheetGeometry& s) { return s.geometry.same_for(mode); });
    });
    if (alike == found.end())
      found.push_back(sides_of_folds(mechanism, charts, mode));
    else
      for (SheetGeometry& sheet : *alike) sheet.modes.push_back(mode);
  }
  std::vector<SheetGeometry> all;
  for (std::vector<SheetGeometry>& sheets : found)
    for (SheetGeometry& sheet : sheets) all.push_back(std::move(sheet));
  return all;
}

std::vector<Sides> all_modes(const mechanism::Mechanism& mechanism) {
  std::vector<Sides> all(1);
  for (std::size_t j = 0; j < mechanism::dyad_points(mechanism).size(); ++j) {
    std::vector<Sides> longer;
    for (const Sides& chosen : all)
      for (const int side : {1, -1}) {
        longer.push_back(chosen);
        longer.back().push_back(side);
      }
    all = std::move(longer);
  }
  return all;
}

std::vector<Charts> all_charts(const mechanism::Mechanism& mechanism) {
  std::vector<Charts> all(1);
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
    std::vector<Charts> longer;
    for (const Charts& chosen : all) {
      if (!coordinate.angle) longer.push_back(chosen), longer.back().emplace_back();
      if (coordinate.angle)
        for (const ChartRange& range : chart_ranges(mechanism, coordinate))
          longer.push_back(chosen), longer.back().emplace_back(range.chart);
    }
    all = std::move(longer);
  }
  return all;
}

std::optional<std::string> vanishing_factor(const FactoredPoly& product, const Geometry& geometry,
                                            const Elimination& elimination, const Causes& causes) {
  if (product.is_zero()) return "it is zero as it stands";
  for (const PolyFactor& factor : product.factors) {
    if (!elimination.vanishes_everywhere(factor.poly)) continue;
    const std::string cause = causes.of(factor.poly);
    return "its factor " + core::to_string(factor.poly.plain(), geometry.ring().names()) + " is zero" +
           (cause.empty() ? "" : " (" + cause + ")");
  }
  return std::nullopt;
}

}  // namespace clearloci::symbolic
