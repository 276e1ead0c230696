#include "symbolic/sheets.hpp"

#include <algorithm>

#include "symbolic/angle_range.hpp"
#include "symbolic/rigid_sheets.hpp"

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

namespace {

/// Leaves the sheets and modes on which all links are rigid; of every other mode the last thing that bends.
std::vector<BentMode> leave_rigid(const mechanism::Mechanism& mechanism, std::vector<SheetGeometry>& sheets,
                                  const std::vector<Sides>& modes) {
  std::vector<BentMode> bent;
  const mechanism::HeldByLinks held = mechanism::held_by_links(mechanism);
  if (held.empty()) return bent;
  for (SheetGeometry& sheet : sheets) {
    const Elimination elimination(sheet.geometry);
    std::erase_if(sheet.modes, [&](const Sides& sides) {
      std::optional<std::string> what = what_bends(sheet.geometry, elimination, held, sides);
      if (what) bent.push_back({sides, std::move(*what)});
      return what.has_value();
    });
  }
  std::erase_if(sheets, [](const SheetGeometry& sheet) { return sheet.modes.empty(); });
  std::vector<BentMode> lost;
  for (const Sides& sides : modes) {
    const auto is_held = [&](const SheetGeometry& sheet) {
      return std::find(sheet.modes.begin(), sheet.modes.end(), sides) != sheet.modes.end();
    };
    if (std::any_of(sheets.begin(), sheets.end(), is_held)) continue;
    const auto why = std::find_if(bent.begin(), bent.end(), [&](const BentMode& mode) { return mode.sides == sides; });
    if (why != bent.end()) lost.push_back(*why);
  }
  return lost;
}

}  // namespace

std::vector<SheetGeometry> sheet_geometries(const mechanism::Mechanism& mechanism, const Charts& charts,
                                            const std::vector<Sides>& modes, std::vector<BentMode>* bent) {
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
  std::vector<BentMode> lost = leave_rigid(mechanism, all, modes);
  if (bent != nullptr) *bent = std::move(lost);
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
