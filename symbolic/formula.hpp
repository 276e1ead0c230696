// Polynomials written out in the languages of `equations`. Private to symbolic/.
#pragma once

#include <string>
#include <vector>

#include "core/polynomial.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/equation_sheet.hpp"

namespace clearloci::symbolic {

/// A number: "1/2", "\frac{1}{2}", "1.0/2.0".
std::string number_text(const core::Rational& value, Language language);

/// A polynomial as a sum of terms, in the order of its terms. `names`: of its variables, as the language writes them.
std::string formula(const core::Polynomial& p, const std::vector<std::string>& names, Language language);

/// constant * (factor)^multiplicity * ...
std::string product_formula(const FactoredPoly& p, const std::vector<std::string>& names, Language language);

}  // namespace clearloci::symbolic
