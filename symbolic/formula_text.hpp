// Formulas put together as text, with the parentheses that each language needs and no others. Private to symbolic/.
#pragma once

#include <string>
#include <vector>

#include "core/polynomial.hpp"
#include "symbolic/equation_sheet.hpp"

namespace clearloci::symbolic {

/// A formula as text and how tightly it holds together.
struct FormulaText {
  enum class Form { zero, one, atom, product, sum };
  std::string text;
  Form form = Form::atom;
};

/// A polynomial as such a text.
FormulaText formula_text(const core::Polynomial& p, const std::vector<std::string>& names, Language language);

/// What is 0 or 1 disappears where that changes nothing.
class FormulaWriter {
 public:
  explicit FormulaWriter(Language language) : language_(language) {}

  FormulaText sum(const FormulaText& a, const FormulaText& b) const;
  FormulaText difference(const FormulaText& a, const FormulaText& b) const;
  FormulaText product(const FormulaText& a, const FormulaText& b) const;
  /// Required: b is not 0.
  FormulaText quotient(const FormulaText& a, const FormulaText& b) const;
  FormulaText squared(const FormulaText& a) const;
  FormulaText root(const FormulaText& a) const;
  /// Of the way (x, y) from the x axis.
  FormulaText angle(const FormulaText& y, const FormulaText& x) const;
  FormulaText negated(const FormulaText& a) const;
  FormulaText twice(const FormulaText& a) const;

 private:
  std::string grouped(const FormulaText& a) const;
  std::string in_parentheses(const std::string& text) const;

  Language language_;
};

}  // namespace clearloci::symbolic
