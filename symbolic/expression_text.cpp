#include "symbolic/expression_text.hpp"

#include "core/interpret.hpp"
#include "symbolic/formula.hpp"

namespace clearloci::symbolic {
namespace {

using core::Expression;

/// How tightly a text holds together.
enum Binding { sum, product, power, atom };

struct Printed {
  std::string text;
  Binding binding = atom;
  bool is_negation = false;  ///< its text after the minus is what a sum subtracts
};

class Printer {
 public:
  Printer(Language language, const std::function<std::string(const std::string&)>& name)
      : language_(language), name_(name) {}

  using Value = Printed;
  Printed number(const core::Rational& value) const {
    const std::string text = number_text(value, language_);
    if (sgn(value) < 0) return {text, sum};
    return {text, value.get_den() == 1 ? atom : product};
  }
  Printed symbol(const std::string& name) const { return {name_(name), atom}; }
  Printed pi() const { return {is_latex() ? "\\pi" : "pi", atom}; }
  Printed negate(const Printed& a) const { return {"-" + enclosed(a, product), sum, true}; }
  Printed add(const Printed& a, const Printed& b) const {
    if (b.is_negation) return {a.text + " - " + b.text.substr(1), sum};
    return {a.text + " + " + enclosed(b, product), sum};
  }
  Printed multiply(const Printed& a, const Printed& b) const {
    return {enclosed(a, product) + (is_latex() ? " " : "*") + enclosed(b, Binding::power), product};
  }
  Printed divide(const Printed& a, const Printed& b, const Expression&) const {
    if (is_latex()) return {"\\frac{" + a.text + "}{" + b.text + "}", product};
    return {enclosed(a, product) + "/" + enclosed(b, Binding::power), product};
  }
  Printed power(const Printed& a, const Expression& e) const {
    const Printed exponent = core::interpret(e.arguments()[1], *this);
    if (language_ == Language::c) return {"pow(" + a.text + ", " + exponent.text + ")", atom};
    if (is_latex()) return {enclosed(a, atom) + "^{" + exponent.text + "}", Binding::power};
    return {enclosed(a, atom) + (language_ == Language::python ? "**" : "^") + enclosed(exponent, atom),
            Binding::power};
  }
  Printed sqrt(const Printed& a, const Expression&) const {
    return is_latex() ? Printed{"\\sqrt{" + a.text + "}", atom} : call("sqrt", a);
  }
  Printed cos(const Printed& a, const Expression&) const { return call("cos", a); }
  Printed sin(const Printed& a, const Expression&) const { return call("sin", a); }
  Printed atan(const Printed& a, const Expression&) const {
    return call(language_ == Language::latex ? "arctan" : "atan", a);
  }

  std::string enclosed(const Printed& printed, Binding needed) const {
    if (printed.binding >= needed) return printed.text;
    return language_ == Language::latex ? "\\left(" + printed.text + "\\right)" : "(" + printed.text + ")";
  }

 private:
  bool is_latex() const { return language_ == Language::latex; }

  Printed call(const std::string& function, const Printed& argument) const {
    if (language_ == Language::latex) return {"\\" + function + "\\left(" + argument.text + "\\right)", atom};
    return {function + "(" + argument.text + ")", atom};
  }

  Language language_;
  const std::function<std::string(const std::string&)>& name_;
};

}  // namespace

std::string expression_text(const Expression& expression, Language language,
                            const std::function<std::string(const std::string&)>& name) {
  return core::interpret(expression, Printer(language, name)).text;
}

std::string enclosed_expression_text(const Expression& expression, Language language,
                                     const std::function<std::string(const std::string&)>& name) {
  const Printer printer(language, name);
  return printer.enclosed(core::interpret(expression, printer), atom);
}

}  // namespace clearloci::symbolic
