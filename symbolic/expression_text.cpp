#include "symbolic/expression_text.hpp"

#include "symbolic/formula.hpp"

namespace clearloci::symbolic {
namespace {

using core::Expression;
using Kind = Expression::Kind;

/// How tightly a text holds together.
enum Binding { sum, product, power, atom };

struct Printed {
  std::string text;
  Binding binding = atom;
};

class Printer {
 public:
  Printer(Language language, const std::function<std::string(const std::string&)>& name)
      : language_(language), name_(name) {}

  Printed operator()(const Expression& e) const {
    const auto argument = [&](std::size_t i) { return (*this)(e.arguments()[i]); };
    const bool latex = language_ == Language::latex;
    switch (e.kind()) {
      case Kind::number: {
        const std::string text = number_text(e.value(), language_);
        if (sgn(e.value()) < 0) return {text, sum};
        return {text, e.value().get_den() == 1 ? atom : product};
      }
      case Kind::symbol:
        return {name_(e.name()), atom};
      case Kind::pi:
        return {latex ? "\\pi" : "pi", atom};
      case Kind::add: {
        const Expression& right = e.arguments()[1];
        if (right.kind() == Kind::negate)
          return {argument(0).text + " - " + enclosed((*this)(right.arguments()[0]), product), sum};
        return {argument(0).text + " + " + enclosed(argument(1), product), sum};
      }
      case Kind::multiply:
        return {enclosed(argument(0), product) + (latex ? " " : "*") + enclosed(argument(1), power), product};
      case Kind::divide:
        if (latex) return {"\\frac{" + argument(0).text + "}{" + argument(1).text + "}", product};
        return {enclosed(argument(0), product) + "/" + enclosed(argument(1), power), product};
      case Kind::negate:
        return {"-" + enclosed(argument(0), product), sum};
      case Kind::power:
        if (language_ == Language::c) return {"pow(" + argument(0).text + ", " + argument(1).text + ")", atom};
        if (latex) return {enclosed(argument(0), atom) + "^{" + argument(1).text + "}", power};
        return {
            enclosed(argument(0), atom) + (language_ == Language::python ? "**" : "^") + enclosed(argument(1), atom),
            power};
      case Kind::sqrt:
        if (latex) return {"\\sqrt{" + argument(0).text + "}", atom};
        return call("sqrt", argument(0));
      case Kind::cos:
        return call("cos", argument(0));
      case Kind::sin:
        return call("sin", argument(0));
    }
    return {};
  }

  std::string enclosed(const Printed& printed, Binding needed) const {
    if (printed.binding >= needed) return printed.text;
    return language_ == Language::latex ? "\\left(" + printed.text + "\\right)" : "(" + printed.text + ")";
  }

 private:
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
  return Printer(language, name)(expression).text;
}

std::string enclosed_expression_text(const Expression& expression, Language language,
                                     const std::function<std::string(const std::string&)>& name) {
  const Printer printer(language, name);
  return printer.enclosed(printer(expression), atom);
}

}  // namespace clearloci::symbolic
