#include "symbolic/formula_text.hpp"

#include "core/errors.hpp"
#include "symbolic/formula.hpp"

namespace clearloci::symbolic {

using Form = FormulaText::Form;

FormulaText formula_text(const core::Polynomial& p, const std::vector<std::string>& names, Language language) {
  const std::string text = formula(p, names, language);
  if (p.is_zero()) return {text, Form::zero};
  if (p.terms.size() > 1 || p.terms.front().coefficient < 0) return {text, Form::sum};
  if (p.is_constant() && p.terms.front().coefficient == 1) return {text, Form::one};
  int factors = p.terms.front().coefficient == 1 ? 0 : 1;
  if (p.terms.front().coefficient.get_den() != 1) ++factors;
  for (const int exponent : p.terms.front().exponents) factors += exponent == 0 ? 0 : exponent == 1 ? 1 : 2;
  return {text, factors > 1 ? Form::product : Form::atom};
}

std::string FormulaWriter::in_parentheses(const std::string& text) const {
  return language_ == Language::latex ? "\\left(" + text + "\\right)" : "(" + text + ")";
}

std::string FormulaWriter::grouped(const FormulaText& a) const {
  return a.form == Form::sum ? in_parentheses(a.text) : a.text;
}

FormulaText FormulaWriter::sum(const FormulaText& a, const FormulaText& b) const {
  if (a.form == Form::zero) return b;
  if (b.form == Form::zero) return a;
  if (b.text.front() == '-') return {a.text + " - " + b.text.substr(1), Form::sum};
  return {a.text + " + " + b.text, Form::sum};
}

FormulaText FormulaWriter::difference(const FormulaText& a, const FormulaText& b) const {
  if (b.form == Form::zero) return a;
  if (a.form == Form::zero) return negated(b);
  return {a.text + " - " + grouped(b), Form::sum};
}

FormulaText FormulaWriter::product(const FormulaText& a, const FormulaText& b) const {
  if (a.form == Form::zero || b.form == Form::one) return a;
  if (b.form == Form::zero || a.form == Form::one) return b;
  return {grouped(a) + (language_ == Language::latex ? " " : "*") + grouped(b), Form::product};
}

FormulaText FormulaWriter::quotient(const FormulaText& a, const FormulaText& b) const {
  core::ensure(b.form != Form::zero, "a divisor is not 0");
  if (a.form == Form::zero || b.form == Form::one) return a;
  if (language_ == Language::latex) return {"\\frac{" + a.text + "}{" + b.text + "}", Form::product};
  const bool tight = b.form == Form::atom || b.form == Form::one;
  return {grouped(a) + "/" + (tight ? b.text : in_parentheses(b.text)), Form::product};
}

FormulaText FormulaWriter::squared(const FormulaText& a) const {
  if (a.form == Form::zero || a.form == Form::one) return a;
  const std::string base = a.form == Form::atom ? a.text : in_parentheses(a.text);
  if (language_ == Language::c) return {base + "*" + base, Form::product};
  const std::string exponent = language_ == Language::python ? "**2" : language_ == Language::latex ? "^{2}" : "^2";
  return {base + exponent, Form::product};
}

FormulaText FormulaWriter::root(const FormulaText& a) const {
  return {language_ == Language::latex ? "\\sqrt{" + a.text + "}" : "sqrt(" + a.text + ")", Form::atom};
}

FormulaText FormulaWriter::angle(const FormulaText& y, const FormulaText& x) const {
  if (language_ == Language::latex)
    return {"\\operatorname{atan2}\\left(" + y.text + ", " + x.text + "\\right)", Form::atom};
  return {"atan2(" + y.text + ", " + x.text + ")", Form::atom};
}

FormulaText FormulaWriter::negated(const FormulaText& a) const {
  return a.form == Form::zero ? a : FormulaText{"-" + grouped(a), Form::sum};
}

FormulaText FormulaWriter::twice(const FormulaText& a) const {
  return product({language_ == Language::c ? "2.0" : "2", Form::atom}, a);
}

}  // namespace clearloci::symbolic
