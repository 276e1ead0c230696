// Expressions of the file, in the parameters, written in the languages of `equations`. Private to symbolic/.
#pragma once

#include <functional>
#include <string>

#include "core/expression.hpp"
#include "symbolic/equation_sheet.hpp"

namespace clearloci::symbolic {

/// `name`: how the language writes a symbol. In a program the value is that of the expression: 1/3 in C is no 0, and
/// a^b^c is a^(b^c) in MATLAB too.
std::string expression_text(const core::Expression& expression, Language language,
                            const std::function<std::string(const std::string&)>& name);

/// The same, in parentheses where it would fall apart inside a product or under a power.
std::string enclosed_expression_text(const core::Expression& expression, Language language,
                                     const std::function<std::string(const std::string&)>& name);

}  // namespace clearloci::symbolic
