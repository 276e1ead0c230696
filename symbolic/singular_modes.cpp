#include "symbolic/singular_modes.hpp"

#include "core/errors.hpp"
#include "symbolic/algebra_turn.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/sheets.hpp"

namespace clearloci::symbolic {

std::optional<std::string> why_singular(const mechanism::Mechanism& mechanism, const std::vector<int>& sides) {
  const auto turn = algebra_turn();
  std::optional<std::string> why;
  for (const Charts& charts : all_charts(mechanism)) {
    for (const SheetGeometry& sheet : sheet_geometries(mechanism, charts, {sides})) {
      const std::optional<FactoredDeterminants> found = regular_determinants(sheet.geometry);
      if (!found && !sheet.geometry.has_dependent_roots()) throw_singular(mechanism);
      const Elimination elimination(sheet.geometry);
      why = vanishing_factor(found ? found->determinant : FactoredPoly{0, {}}, sheet.geometry, elimination,
                             Causes(sheet.geometry));
      if (!why) return std::nullopt;
    }
  }
  return why;
}

std::string mode_words(const mechanism::Mechanism& mechanism, const std::vector<int>& sides) {
  const std::vector<mechanism::PointIndex> points = mechanism::dyad_points(mechanism);
  std::string list;
  for (std::size_t j = 0; j < points.size(); ++j)
    list += (j == 0 ? "" : ", ") + mechanism.points[static_cast<std::size_t>(points[j])].name + " " +
            mechanism::side_name(mechanism, points[j], sides[j]);
  return list;
}

}  // namespace clearloci::symbolic
