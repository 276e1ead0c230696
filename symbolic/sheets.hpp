// The sheets of a tower some of whose roots depend on earlier ones (method.md section 10): what is placed alike in
// several working modes is derived once, and apart on both sides of every fold. Private to symbolic/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/causes.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/factored_poly.hpp"
#include "symbolic/geometry.hpp"

namespace clearloci::symbolic {

/// One side of a dyad or slider each: +1 left or ahead, -1 right or behind.
using Sides = std::vector<int>;

struct SheetGeometry {
  Geometry geometry;
  std::vector<Sides> modes;  ///< those whose postures it holds
};

/// A mode in which some link is rigid on no sheet.
struct BentMode {
  Sides sides;
  std::string what;  ///< rigid_sheets.hpp
};

/// Every mode is in the modes of one of them, or of one for each side of its folds. A single one, of all modes, where
/// every root is independent of the others. Without the sides on which a link bends, which are no workspace; `bent`
/// takes the modes that nothing is left of.
std::vector<SheetGeometry> sheet_geometries(const mechanism::Mechanism& mechanism, const Charts& charts,
                                            const std::vector<Sides>& modes, std::vector<BentMode>* bent = nullptr);

/// Every combination of sides.
std::vector<Sides> all_modes(const mechanism::Mechanism& mechanism);

/// Every choice of one chart an angle, the last angle's fastest.
std::vector<Charts> all_charts(const mechanism::Mechanism& mechanism);

/// What makes a product vanish in every pose of a sheet, "its factor ... is zero"; nothing where it does not.
std::optional<std::string> vanishing_factor(const FactoredPoly& product, const Geometry& geometry,
                                            const Elimination& elimination, const Causes& causes);

}  // namespace clearloci::symbolic
