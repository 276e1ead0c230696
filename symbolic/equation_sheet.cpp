#include "symbolic/equation_sheet.hpp"

#include "symbolic/algebra_turn.hpp"
#include "symbolic/sheet_writer.hpp"

namespace clearloci::symbolic {

using mechanism::Mechanism;

std::vector<EquationSheet> equation_sheets(const Mechanism& mechanism, const std::vector<Language>& languages,
                                           bool keep_parameters) {
  const auto turn = algebra_turn();
  SheetWriter writer(mechanism, keep_parameters);
  std::vector<EquationSheet> sheets;
  for (const Language language : languages) sheets.push_back(writer.write(language));
  return sheets;
}

EquationSheet equation_sheet(const Mechanism& mechanism, const SheetOptions& options) {
  return equation_sheets(mechanism, {options.language}, options.keep_parameters).front();
}

}  // namespace clearloci::symbolic
